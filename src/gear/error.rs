//! What can be wrong with a gear or a pair, with the values found and allowed.

use super::Member;

/// Why a gear cannot be made. Lengths in mm, unless the text says modules.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GearError {
    /// NaN or infinite input.
    #[error("{quantity} is {value}, a finite number is needed")]
    NotFinite {
        /// Which input.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// An input that must be positive is not.
    #[error("{quantity} is {value}, it must be above 0")]
    NotPositive {
        /// Which input.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// An input that must not be negative is.
    #[error("{quantity} is {value}, it must be 0 or more")]
    Negative {
        /// Which input.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// Module zero or negative.
    #[error("module is {module} mm, it must be above 0")]
    Module {
        /// The module, mm.
        module: f64,
    },
    /// Pressure angle outside what involute gears use.
    #[error("pressure angle is {angle_deg:.3}°, allowed {min_deg:.0}° to {max_deg:.0}°")]
    PressureAngle {
        /// Found, degrees.
        angle_deg: f64,
        /// Smallest, degrees.
        min_deg: f64,
        /// Largest, degrees.
        max_deg: f64,
    },
    /// Too few teeth.
    #[error("{teeth} teeth, at least {min} are needed")]
    TooFewTeeth {
        /// Found.
        teeth: u32,
        /// Smallest number.
        min: u32,
    },
    /// The rack's root rounding does not fit between its flanks.
    #[error("fillet radius is {radius} modules, allowed 0 to {max:.4} (full round) for this rack")]
    FilletRadius {
        /// Found, modules.
        radius: f64,
        /// Largest, modules.
        max: f64,
    },
    /// The root circle vanishes.
    #[error(
        "root radius is {root_radius:.4} mm, it must be above 0: more teeth, more profile shift or less dedendum"
    )]
    NegativeRoot {
        /// Root radius, mm.
        root_radius: f64,
    },
    /// The teeth meet in a point below the tip circle.
    #[error(
        "tip thickness is {tip_thickness:.4} mm, at least {min:.4} mm is needed: less profile shift, addendum or thickness reduction"
    )]
    PointedTooth {
        /// Thickness at the tip circle, mm; negative if the flanks cross below it.
        tip_thickness: f64,
        /// Smallest thickness, mm.
        min: f64,
    },
    /// No involute is left between fillet and tip.
    #[error(
        "no involute is left: it would begin at radius {form_radius:.4} mm and end at {tip_radius:.4} mm"
    )]
    NoInvolute {
        /// Where the involute would begin, mm (at least the base radius).
        form_radius: f64,
        /// Where it would end, mm.
        tip_radius: f64,
    },
    /// Undercut thins the tooth's foot too much.
    #[error(
        "the undercut leaves a tooth foot of {thickness:.4} mm, at least {min:.4} mm is needed: more teeth or more profile shift"
    )]
    ThinFoot {
        /// Smallest thickness of the foot, mm.
        thickness: f64,
        /// Needed, mm.
        min: f64,
    },
    /// The bore leaves no rim.
    #[error(
        "bore diameter is {diameter} mm, allowed up to {max:.4} mm (half a module of rim below the root circle)"
    )]
    Bore {
        /// Found, mm.
        diameter: f64,
        /// Largest, mm.
        max: f64,
    },
    /// Tip relief deeper than a correction can be.
    #[error(
        "tip relief amount is {amount:.4} mm, allowed 0 to {max:.4} mm (a tenth of the module)"
    )]
    TipReliefAmount {
        /// Found, mm.
        amount: f64,
        /// Largest, mm.
        max: f64,
    },
    /// Tip relief longer than the involute, or an amount without a length.
    #[error(
        "tip relief length is {length:.4} mm, it must be above 0 and at most {max:.4} mm (the whole involute)"
    )]
    TipReliefLength {
        /// Found, mm along the path of contact.
        length: f64,
        /// Largest, mm.
        max: f64,
    },
    /// The tip rounding eats the tip land or the involute.
    #[error("tip rounding is {radius:.4} mm, allowed 0 to {max:.4} mm for this tooth")]
    TipRounding {
        /// Found, mm.
        radius: f64,
        /// Largest, mm.
        max: f64,
    },
}

/// Why two gears cannot mesh. Lengths in mm.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PairError {
    /// NaN or infinite input.
    #[error("{quantity} is {value}, a finite number is needed")]
    NotFinite {
        /// Which input.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// The base pitches differ.
    #[error("the base pitches differ: pinion {pinion:.6} mm, gear {gear:.6} mm")]
    BasePitch {
        /// Of the pinion, mm.
        pinion: f64,
        /// Of the gear, mm.
        gear: f64,
    },
    /// The teeth jam: no backlash left.
    #[error(
        "centre distance {centre_distance:.4} mm is too small, the teeth jam (backlash {backlash_um:.2} µm): at least {min:.4} mm is \
         needed, misalignment included"
    )]
    Jam {
        /// Working centre distance, mm.
        centre_distance: f64,
        /// Backlash there, µm; −infinity if even the base circles overlap.
        backlash_um: f64,
        /// Smallest working centre distance, mm.
        min: f64,
    },
    /// A tip touches the mate's root circle.
    #[error(
        "the {member}'s tip meets its mate's root: clearance {clearance:.4} mm at centre distance {centre_distance:.4} mm; more than \
         {min:.4} mm is needed, or less addendum"
    )]
    RootClearance {
        /// Whose tip.
        member: Member,
        /// Tip to root distance, mm.
        clearance: f64,
        /// Working centre distance, mm.
        centre_distance: f64,
        /// Working centre distance at which the clearance is 0, mm.
        min: f64,
    },
    /// Fewer than one pair of teeth in contact.
    #[error("{}", too_far_apart(*.contact_ratio, *.centre_distance, *.max_centre_distance, *.max_misalignment))]
    ContactRatio {
        /// Transverse contact ratio found.
        contact_ratio: f64,
        /// Working centre distance, mm.
        centre_distance: f64,
        /// Largest working centre distance with ratio 1, mm.
        max_centre_distance: f64,
        /// The same as misalignment, mm.
        max_misalignment: f64,
    },
    /// The mate's tip would work below the involute or dip into the fillet.
    #[error(
        "interference: the mate's tip meets the {member}'s fillet: contact would begin at radius {start_radius:.4} mm, the involute \
         begins at {form_radius:.4} mm (centre distance {centre_distance:.4} mm); free from {min:.4} mm on, or with less addendum of the mate"
    )]
    Interference {
        /// Whose fillet is met.
        member: Member,
        /// Radius of the start of the active profile on it, mm (0 if the path of contact passes the base circle).
        start_radius: f64,
        /// Form radius, mm.
        form_radius: f64,
        /// Working centre distance, mm.
        centre_distance: f64,
        /// Smallest working centre distance at which the tip stays clear of the fillet, mm.
        min: f64,
    },
}

/// What a contact ratio below 1 means: a negative one, that no tooth reaches its mate.
fn too_far_apart(ratio: f64, found: f64, allowed: f64, misalignment: f64) -> String {
    let what = if ratio > 0.0 {
        format!("contact ratio is {ratio:.4}, at least 1 is needed")
    } else {
        "the teeth do not reach each other".to_owned()
    };
    // far from usual proportions it is not the distance that is wrong
    if found <= allowed {
        return format!("{what}, at a centre distance of {found:.4} mm");
    }
    let shift = if misalignment > 0.0 {
        format!(", a misalignment of at most {misalignment:.4} mm")
    } else {
        String::new()
    };
    format!("{what}: centre distance {found:.4} mm found, at most {allowed:.4} mm allowed{shift}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of teeth that are too short at any distance the distance is not called too large.
    #[test]
    fn a_contact_ratio_below_1_blames_the_distance_only_where_it_is_too_large() {
        let far = too_far_apart(0.6168, 82.4, 81.4996, 1.4996);
        assert!(
            far.contains("82.4000 mm found, at most 81.4996 mm allowed"),
            "{far}"
        );
        let short = too_far_apart(0.9689, 28.5245, 28.5567, 0.0);
        assert!(
            short.ends_with("at a centre distance of 28.5245 mm"),
            "{short}"
        );
    }
}
