//! `[gears]`: basic rack, two members, centre distance; and the checks that need all of them.

use std::path::{Path, PathBuf};

use super::quantity::{self as q, span_of_numbers};
use super::reader::Table;
use super::relative;
use crate::gear::{BasicRack, Gear, GearError, MIN_TEETH, Member, Pair, PairError, ToothSpec};
use crate::source_text::{Diagnostic, Fault};

pub(super) const KEYS: &[&str] = &[
    "module",
    "pressure_angle",
    "face_width",
    "centre_distance",
    "addendum",
    "dedendum",
    "fillet_radius",
    "pinion",
    "gear",
];
pub(super) const MEMBER_KEYS: &[&str] = &[
    "teeth",
    "profile_shift",
    "thickness_reduction",
    "bore_diameter",
    "tip_relief_amount",
    "tip_relief_length",
    "tip_rounding",
    "profile_file",
];

/// The gear set: two members cut by one rack, their nominal centre distance and their width.
#[derive(Debug, Clone, PartialEq)]
pub struct Gears {
    /// The driving member; rack, teeth, relief, rounding and bore are in it.
    pub pinion: Gear,
    /// The driven member.
    pub gear: Gear,
    /// Common face width, mm.
    pub face_width: f64,
    /// Nominal centre distance, mm; if the study states none, that of zero backlash for the profile shifts.
    pub centre_distance: f64,
}

impl Gears {
    /// The working pair at the nominal centre distance plus `misalignment_mm`.
    ///
    /// # Errors
    /// A [`PairError`] if the two cannot run there; never for the conditions of a valid study.
    pub fn pair(&self, misalignment_mm: f64) -> Result<Pair, PairError> {
        Pair::new(
            self.pinion.clone(),
            self.gear.clone(),
            self.centre_distance,
            misalignment_mm,
        )
    }
}

type Result<T, E = Box<Diagnostic>> = std::result::Result<T, E>;

/// The gears; `helix`: the pinion's helix angle, rad, where these keys state the normal section.
pub(super) fn read(root: &Table<'_>, helix: f64) -> Result<Gears> {
    let table = root.required_table("gears", KEYS)?;
    let rack = BasicRack {
        module: table.required_number("module", &q::MODULE)?,
        pressure_angle: table
            .required_number("pressure_angle", &q::PRESSURE_ANGLE)?
            .to_radians(),
        addendum: table.number("addendum", &q::ADDENDUM)?.unwrap_or(1.0),
        dedendum: table.number("dedendum", &q::DEDENDUM)?.unwrap_or(1.25),
        fillet_radius: table
            .number("fillet_radius", &q::FILLET_RADIUS)?
            .unwrap_or(0.38),
    };
    let face_width = table.required_number("face_width", &q::FACE_WIDTH)?;
    let stated = table.number("centre_distance", &q::CENTRE_DISTANCE)?;
    let pinion = member(&table, Member::Pinion, rack, helix)?;
    let gear = member(&table, Member::Gear, rack, helix)?;
    let centre_distance =
        stated.unwrap_or_else(|| Pair::zero_backlash_centre_distance(&pinion, &gear));
    Ok(Gears {
        pinion,
        gear,
        face_width,
        centre_distance,
    })
}

fn member(gears: &Table<'_>, member: Member, rack: BasicRack, helix: f64) -> Result<Gear> {
    let table = gears.required_table(member.name(), MEMBER_KEYS)?;
    let why = "fewer teeth cannot keep contact, more cannot be meshed as a whole circle";
    let zero = |key, quantity| {
        table
            .number(key, quantity)
            .map(|value| value.unwrap_or(0.0))
    };
    let spec = ToothSpec {
        teeth: table.required_count("teeth", MIN_TEETH as usize..=1000, why)? as u32,
        // lengths along the tooth's height are the same in the transverse section, those along the reference circle are longer
        profile_shift: zero("profile_shift", &q::PROFILE_SHIFT)? * helix.cos(),
        thickness_reduction: zero("thickness_reduction", &q::THICKNESS_REDUCTION)? / helix.cos(),
        bore_diameter: table.required_number("bore_diameter", &q::BORE_DIAMETER)?,
        tip_relief_amount: zero("tip_relief_amount", &q::RELIEF_AMOUNT)? * 1e-3,
        tip_relief_length: zero("tip_relief_length", &q::RELIEF_LENGTH)?,
        tip_rounding: zero("tip_rounding", &q::TIP_ROUNDING)?,
    };
    let transverse = rack.transverse(helix);
    let made = Gear::new(transverse, spec).map(|gear| gear.helical(helix));
    made.map_err(|error| {
        let error = in_the_normal_section(error, transverse, helix);
        // a tooth that thinning alone makes pointed
        let full = ToothSpec {
            thickness_reduction: 0.0,
            ..spec
        };
        match &error {
            GearError::PointedTooth { min, .. } if Gear::new(transverse, full).is_ok() => {
                inconsistent(
                    &table,
                    "thickness_reduction",
                    &error.to_string(),
                    format!("a tip thickness of at least {} mm", q::Short(*min)),
                )
            }
            _ => impossible_gear(gears, &table, &error),
        }
    })
}

/// The error with what is in modules as the study states it.
fn in_the_normal_section(error: GearError, transverse: BasicRack, helix: f64) -> GearError {
    let stated = |fillet_radius: f64| {
        let rack = BasicRack {
            fillet_radius,
            ..transverse
        };
        rack.normal(helix).fillet_radius
    };
    match error {
        GearError::FilletRadius { radius, max } => GearError::FilletRadius {
            radius: stated(radius),
            max: stated(max),
        },
        other => other,
    }
}

/// The files that hold measured profiles of pinion and gear, relative ones from the study's folder.
pub(super) fn profile_files(root: &Table<'_>, folder: &Path) -> Result<[Option<PathBuf>; 2]> {
    let gears = root.required_table("gears", KEYS)?;
    let file = |member: Member| -> Result<Option<PathBuf>> {
        let table = gears.required_table(member.name(), MEMBER_KEYS)?;
        let file = table.name("profile_file", "relative to the study file")?;
        Ok(file.map(|file| relative::joined(folder, Path::new(file))))
    };
    Ok([file(Member::Pinion)?, file(Member::Gear)?])
}

/// Sends an impossible gear to the key that can mend it.
fn impossible_gear(gears: &Table<'_>, member: &Table<'_>, error: &GearError) -> Box<Diagnostic> {
    let up_to = |from: f64, to: f64, unit: &str| {
        format!("{} for this gear", span_of_numbers(from, to, unit))
    };
    let (table, key, allowed) = match error {
        GearError::Module { .. } => (gears, "module", q::MODULE.to_string()),
        GearError::PressureAngle { .. } => (gears, "pressure_angle", q::PRESSURE_ANGLE.to_string()),
        GearError::FilletRadius { max: 0.0, .. } => {
            (gears, "dedendum", "a rack whose tip is not pointed: less dedendum, pressure_angle or thickness_reduction".to_owned())
        }
        GearError::FilletRadius { max, .. } => (gears, "fillet_radius", up_to(0.0, *max, "modules")),
        GearError::Bore { max, .. } => (member, "bore_diameter", up_to(0.1, *max, "mm")),
        GearError::TipReliefAmount { max, .. } => (member, "tip_relief_amount", up_to(0.0, max * 1e3, "um")),
        GearError::TipReliefLength { max, .. } => {
            (member, "tip_relief_length", format!("above 0, up to {} mm for this gear", q::Short(*max)))
        }
        GearError::TipRounding { max, .. } => (member, "tip_rounding", up_to(0.0, *max, "mm")),
        GearError::PointedTooth { min, .. } => {
            (member, "profile_shift", format!("a tip thickness of at least {} mm", q::Short(*min)))
        }
        GearError::TooFewTeeth { min, .. } => (member, "teeth", format!("a whole number, {min} to 1000")),
        GearError::NegativeRoot { .. } | GearError::ThinFoot { .. } | GearError::NoInvolute { .. } => {
            (member, "teeth", "a gear with a root, a foot and an involute: more teeth or other profile_shift, addendum, dedendum".to_owned())
        }
        GearError::NotFinite { .. } | GearError::NotPositive { .. } | GearError::Negative { .. } => {
            (member, "teeth", "finite, positive dimensions".to_owned())
        }
    };
    inconsistent(table, key, &error.to_string(), allowed)
}

/// Refuses conditions at which the pair cannot run; `table` is `[operation]` or a `[[test]]`.
pub(super) fn check_pair(
    root: &Table<'_>,
    gears: &Gears,
    table: &Table<'_>,
    misalignment: f64,
) -> Result<Pair> {
    gears
        .pair(misalignment)
        .map_err(|error| match gears_table(root) {
            Ok(home) if misalignment == 0.0 || !table.has("misalignment") => {
                impossible_pair(&home, gears, &error)
            }
            Ok(_) => impossible_misalignment(table, gears, &error),
            Err(diagnostic) => diagnostic,
        })
}

fn gears_table<'a>(root: &Table<'a>) -> Result<Table<'a>> {
    root.required_table("gears", KEYS)
}

fn impossible_pair(table: &Table<'_>, gears: &Gears, error: &PairError) -> Box<Diagnostic> {
    let allowed = match working_range(gears) {
        Some((from, to)) => {
            let nominal = gears.centre_distance;
            format!(
                "{} for this pair",
                span_of_numbers(nominal + from, nominal + to, "mm")
            )
        }
        None => "no centre distance suits these gears: other profile shifts, addendum or teeth"
            .to_owned(),
    };
    Box::new(
        inconsistent(table, "centre_distance", &error.to_string(), allowed)
            .with_hint(way_out(error)),
    )
}

fn way_out(error: &PairError) -> &'static str {
    match error {
        PairError::Jam { .. } => {
            "a larger centre distance, less profile shift or a thickness_reduction gives backlash"
        }
        PairError::RootClearance { .. } => {
            "a dedendum above the addendum (1.25 against 1 is usual) leaves room for the tip"
        }
        PairError::ContactRatio { .. } => {
            "a smaller centre distance or a larger addendum keeps the teeth in contact longer"
        }
        PairError::Interference { .. } => {
            "more teeth, more profile shift or a smaller fillet_radius also keep contact on the involute"
        }
        PairError::NotFinite { .. } | PairError::BasePitch { .. } => "",
    }
}

fn impossible_misalignment(table: &Table<'_>, gears: &Gears, error: &PairError) -> Box<Diagnostic> {
    let allowed = match working_range(gears) {
        Some((from, to)) => format!("{} for this pair", span_of_numbers(from, to, "mm")),
        None => "no centre distance suits these gears: other profile shifts, addendum or teeth"
            .to_owned(),
    };
    let hint = format!(
        "the misalignment is added to the centre distance ({} mm)",
        q::Short(gears.centre_distance)
    );
    Box::new(inconsistent(table, "misalignment", &error.to_string(), allowed).with_hint(hint))
}

/// Smallest and largest misalignment at which the pair can run, mm, rounded inwards to 1 µm.
fn working_range(gears: &Gears) -> Option<(f64, f64)> {
    let reach = gears.pinion.rho_end + gears.gear.rho_end - gears.pinion.rack.base_pitch();
    let base_sum = gears.pinion.base_radius + gears.gear.base_radius;
    let runs = |misalignment: f64| gears.pair(misalignment).is_ok();
    let (low, high) = (
        base_sum - gears.centre_distance,
        reach.max(0.0).hypot(base_sum) - gears.centre_distance,
    );
    // The admissible centre distances are one interval; a coarse walk finds it, bisection its ends.
    let steps = 400;
    let at = |i: usize| low + (high - low) * i as f64 / steps as f64;
    let first = (0..=steps).find(|&i| runs(at(i)))?;
    let last = (first..=steps).rev().find(|&i| runs(at(i)))?;
    let edge = |mut good: f64, mut bad: f64| {
        for _ in 0..40 {
            let middle = 0.5 * (good + bad);
            if runs(middle) {
                good = middle
            } else {
                bad = middle
            }
        }
        good
    };
    let from = if first == 0 {
        at(0)
    } else {
        edge(at(first), at(first - 1))
    };
    let to = if last == steps {
        at(steps)
    } else {
        edge(at(last), at(last + 1))
    };
    // Not 1e-9 beside the edge but on the safe side of what is printed.
    let (from, to) = (
        (from * 1e3 - 1e-3).ceil() / 1e3,
        (to * 1e3 + 1e-3).floor() / 1e3,
    );
    (from <= to).then_some((from, to))
}

/// Points at `key` if the study states it, else at the table's header.
fn inconsistent(table: &Table<'_>, key: &str, error: &str, allowed: String) -> Box<Diagnostic> {
    let mut diagnostic = if table.has(key) {
        table.refuse(key, "", allowed)
    } else {
        table.missing(key, &allowed)
    };
    diagnostic.fault = Fault::Inconsistent;
    if !table.has(key) {
        diagnostic.found = "its default".to_owned();
        diagnostic.message = format!("{}: {error}", diagnostic.key);
    } else {
        diagnostic.message = format!("{}: {error}", diagnostic.message.trim_end());
    }
    Box::new(diagnostic)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagnosed(rack: &str, member: &str) -> Option<(String, String)> {
        let text = format!(
            "[gears]\nmodule = 2.0\nface_width = 20.0\n{rack}\n[gears.pinion]\nteeth = 27\n{member}\n\
             [gears.gear]\nteeth = 53\nbore_diameter = 40.0\n[material]\nyoungs_modulus = 2.1e5\npoisson_ratio = 0.3\n\
             density = 7850.0\n[operation]\ntorque = 100.0\nspeed = 2000.0\n[wear]\ncoefficient = 6e-10\ncycles = 1e4\n"
        );
        let error = crate::study::Study::parse(&text, "study.toml").err()?;
        let found = error.diagnostic();
        Some((found.key.clone(), found.allowed.clone()))
    }

    /// A refusal points at the key that can mend the gear, and what it says to be allowed is.
    #[test]
    fn impossible_gears_are_sent_to_the_key_that_mends_them() {
        let plain = "pressure_angle = 20.0";
        let key = |rack, member| diagnosed(rack, member).unwrap().0;
        let thin = "thickness_reduction = 2.5\nbore_diameter = 25.0";
        assert_eq!(key(plain, thin), "gears.pinion.thickness_reduction");
        // half the rack's tooth is π/4 modules at the reference line, 1.25 tan 35° less at its tip: less than nothing
        let steep = "pressure_angle = 35.0";
        assert_eq!(key(steep, "bore_diameter = 25.0"), "gears.dedendum");
        // the root circle of 49 mm less a module
        let wide = diagnosed(plain, "bore_diameter = 47.01").unwrap();
        assert_eq!(wide.1, "0.1 to 47 mm for this gear");
        assert_eq!(diagnosed(plain, "bore_diameter = 47.0"), None);
    }

    /// The 27/53 pair of module 2 at 80 mm: free of backlash there (0 is the least misalignment), and the contact ratio is
    /// 1 where T1T2 = rho_end1 + rho_end2 − p_b, by the closed form.
    #[test]
    fn working_range_of_the_reference_pair() {
        let rack = BasicRack::iso53_a(2.0);
        let gears = Gears {
            pinion: Gear::new(rack, ToothSpec::plain(27, 25.0)).unwrap(),
            gear: Gear::new(rack, ToothSpec::plain(53, 40.0)).unwrap(),
            face_width: 33.0,
            centre_distance: 80.0,
        };
        let (rb1, rb2) = (
            27.0 * 20f64.to_radians().cos(),
            53.0 * 20f64.to_radians().cos(),
        );
        let line = (29f64.powi(2) - rb1 * rb1).sqrt() + (55f64.powi(2) - rb2 * rb2).sqrt()
            - std::f64::consts::PI * 2.0 * 20f64.to_radians().cos();
        let largest = line.hypot(rb1 + rb2) - 80.0;
        let (from, to) = working_range(&gears).unwrap();
        assert!(from.abs() <= 1e-3, "from {from}");
        assert!(
            to <= largest && largest - to < 1.1e-3,
            "to {to}, closed form {largest}"
        );
    }
}
