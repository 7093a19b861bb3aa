//! Two gears at a working centre distance: path of contact, backlash, kinematics.
//!
//! Fixed frame: pinion centre at the origin, gear centre at (a, 0). The pinion turns counter-clockwise and drives. The
//! common normal n = (sin α', cos α') points from the pinion into the gear; it touches the base circles at T1 and T2:
//!
//! ```text
//! T1 = r_b1 (cos α', −sin α'),   contact at T1 + rho1 n,   rho1 + rho2 = T1T2 = a sin α',   cos α' = (r_b1 + r_b2)/a
//! path coordinate y = rho1 − rho_C  (y < 0: approach, y = 0: pitch point)
//! A: the gear's tip begins,  B = E − p_b,  C: pitch point,  D = A + p_b,  E: the pinion's tip ends
//! ```
//! Involute kinematics as in any gear book, e.g. Maitra, Handbook of Gear Design; ISO 21771.

mod mounting;

use super::Member;
use super::error::PairError;
use super::involute::{inv, inverse_inv};
use super::tooth::Gear;
use crate::numeric::Vec2;

/// Overlap of the unloaded flanks that counts as rounding of the stated centre distance, modules (FZG type C: 91.5 mm is
/// stated where 91.5001 mm is free of backlash).
pub const JAM_TOLERANCE: f64 = 2e-4;

/// A working pair. Lengths mm, angles rad.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The driving member.
    pub pinion: Gear,
    /// The driven member.
    pub gear: Gear,
    /// Working centre distance: nominal + misalignment.
    pub centre_distance: f64,
    /// Nominal centre distance.
    pub nominal_centre_distance: f64,
    /// Working pressure angle α'.
    pub working_pressure_angle: f64,
    /// Helix angle at the base circles β_b, with the sign of the gears' helix angle; 0 for spur gears.
    pub base_helix: f64,
    /// Base pitch p_b, of helical gears that of the transverse section.
    pub base_pitch: f64,
    /// Transverse contact ratio: `path_length` / `base_pitch`; tip relief does not count, tip rounding does.
    pub contact_ratio: f64,
    /// Length of the path of contact A to E.
    pub path_length: f64,
    /// Distance T1T2 of the points where the line of action touches the base circles: rho1 + rho2.
    pub line_length: f64,
    /// Pinion curvature radius at A, start of contact.
    pub rho_a: f64,
    /// Pinion curvature radius at B = E − p_b, start of single contact (if the contact ratio is below 2).
    pub rho_b: f64,
    /// Pinion curvature radius at the pitch point C.
    pub rho_c: f64,
    /// Pinion curvature radius at D = A + p_b, end of single contact.
    pub rho_d: f64,
    /// Pinion curvature radius at E, end of contact.
    pub rho_e: f64,
    /// Circumferential backlash at the operating pitch circles.
    pub backlash: f64,
    /// Speed ratio ω1/ω2 = z2/z1, the same at every centre distance.
    pub speed_ratio: f64,
    /// Operating pitch radius of the pinion.
    pub pitch_radius_pinion: f64,
    /// Operating pitch radius of the gear.
    pub pitch_radius_gear: f64,
}

impl Pair {
    /// The pair at `centre_distance` + `misalignment`, mm.
    ///
    /// Contact begins where the mate's tip (the end of its usable involute) meets the flank. If a member is undercut and
    /// the mate's tip would reach below its form point, contact begins at the form point: there the flank is gone.
    ///
    /// # Errors
    /// A [`PairError`] if the members cannot run together there.
    pub fn new(
        pinion: Gear,
        gear: Gear,
        centre_distance: f64,
        misalignment: f64,
    ) -> Result<Pair, PairError> {
        let least = -JAM_TOLERANCE * pinion.rack.module;
        Pair::mounted(pinion, gear, centre_distance, misalignment, least)
    }

    /// cos β_b, 1 for spur gears: of a transverse distance along the path of contact what is normal to the flanks; the force normal to the
    /// flanks is 1/cos β_b of that in the transverse section.
    pub fn cos_base_helix(&self) -> f64 {
        self.base_helix.cos()
    }

    /// By how many base pitches sections stand turned per mm along the face: tan β_b/p_b.
    pub fn turned_per_mm(&self) -> f64 {
        self.pinion.turned_per_mm()
    }

    /// Overlap ratio ε_β of a face `width` mm wide: b tan β_b/p_b.
    pub fn overlap_ratio(&self, width: f64) -> f64 {
        (width * self.turned_per_mm()).abs()
    }

    /// The same where the backlash is not known: the teeth may be thinner than stated, and only their driving flanks touch.
    ///
    /// # Errors
    /// A [`PairError`] if the members cannot run together there however thin their teeth are.
    pub fn with_any_backlash(
        pinion: Gear,
        gear: Gear,
        centre_distance: f64,
        misalignment: f64,
    ) -> Result<Pair, PairError> {
        Pair::mounted(
            pinion,
            gear,
            centre_distance,
            misalignment,
            f64::NEG_INFINITY,
        )
    }

    /// Centre distance at which the profile shifts alone leave no backlash, mm (thickness reductions are left out: they
    /// are the backlash allowance).
    ///
    /// ```text
    /// inv α' = inv α + 2 tan α (x1 + x2)/(z1 + z2),   a = m (z1 + z2)/2 · cos α / cos α'
    /// ```
    pub fn zero_backlash_centre_distance(pinion: &Gear, gear: &Gear) -> f64 {
        centre_distance_for(pinion, gear, 0.0)
    }

    /// Smallest centre distance at which the teeth do not jam, mm, thickness reductions counted.
    pub fn tight_centre_distance(pinion: &Gear, gear: &Gear) -> f64 {
        let thinning = pinion.spec.thickness_reduction + gear.spec.thickness_reduction;
        centre_distance_for(pinion, gear, thinning)
    }

    /// The common normal in the fixed frame, from the pinion into the gear.
    pub fn normal(&self) -> Vec2 {
        let (s, c) = self.working_pressure_angle.sin_cos();
        Vec2::new(s, c)
    }

    /// Contact point at the path coordinate `y`, mm, fixed frame.
    pub fn contact_point(&self, y: f64) -> Vec2 {
        let (s, c) = self.working_pressure_angle.sin_cos();
        Vec2::new(self.pinion.base_radius * c, -self.pinion.base_radius * s)
            + self.rho_pinion(y) * Vec2::new(s, c)
    }

    /// Rotation of the pinion's member frame at which its tooth 0 touches at `y`, rad; slope 1/r_b1.
    pub fn pinion_angle(&self, y: f64) -> f64 {
        -self.working_pressure_angle - self.pinion.tangent_angle(self.rho_pinion(y))
    }

    /// Rotation of the gear's member frame, the half turn included, at which its tooth 0 touches at `y`, rad; slope
    /// −1/r_b2.
    pub fn gear_angle(&self, y: f64) -> f64 {
        std::f64::consts::PI
            - self.working_pressure_angle
            - self.gear.tangent_angle(self.rho_gear(y))
    }

    /// Curvature radius of the pinion's flank at `y`, mm.
    pub fn rho_pinion(&self, y: f64) -> f64 {
        self.rho_c + y
    }

    /// Curvature radius of the gear's flank at `y`, mm.
    pub fn rho_gear(&self, y: f64) -> f64 {
        self.line_length - self.rho_c - y
    }

    /// Curvature radius of `member`'s flank at `y`, mm.
    pub fn rho(&self, member: Member, y: f64) -> f64 {
        match member {
            Member::Pinion => self.rho_pinion(y),
            Member::Gear => self.rho_gear(y),
        }
    }

    /// Path coordinate of the point with curvature radius `rho` on `member`'s flank, mm.
    pub fn path_at_rho(&self, member: Member, rho: f64) -> f64 {
        match member {
            Member::Pinion => rho - self.rho_c,
            Member::Gear => self.line_length - rho - self.rho_c,
        }
    }

    /// Path coordinate of the radius `r` on `member`'s flank, mm; None inside the base circle or above the tip circle.
    pub fn path_at_radius(&self, member: Member, r: f64) -> Option<f64> {
        let gear = self.member(member);
        let slack = 1e-9 * gear.rack.module;
        (r >= gear.base_radius - slack && r <= gear.tip_radius + slack)
            .then(|| self.path_at_rho(member, gear.rho_at_radius(r)))
    }

    /// Radius on `member`'s flank at the path coordinate `y`, mm; None where the line of action has left T1T2.
    pub fn radius_at_path(&self, member: Member, y: f64) -> Option<f64> {
        let rho = self.rho(member, y);
        (rho >= 0.0).then(|| self.member(member).radius_at_rho(rho))
    }

    /// One of the two members.
    pub fn member(&self, member: Member) -> &Gear {
        match member {
            Member::Pinion => &self.pinion,
            Member::Gear => &self.gear,
        }
    }

    /// Path coordinates of A, B, C, D, E, mm (C is 0).
    pub fn path_points(&self) -> [f64; 5] {
        [self.rho_a, self.rho_b, self.rho_c, self.rho_d, self.rho_e].map(|rho| rho - self.rho_c)
    }

    /// Relative curvature radius, mm.
    ///
    /// ```text
    /// R = rho1 rho2 / (rho1 + rho2)
    /// ```
    pub fn relative_radius(&self, y: f64) -> f64 {
        self.rho_pinion(y) * self.rho_gear(y) / self.line_length
    }

    /// Specific sliding of the pinion, 1 − v2/v1 with the rolling speeds v1 : v2 = rho1 : rho2 z1/z2 (dimensionless;
    /// negative in the dedendum, −infinity at T1).
    pub fn sliding_ratio_pinion(&self, y: f64) -> f64 {
        1.0 - self.rho_gear(y) / (self.rho_pinion(y) * self.speed_ratio)
    }

    /// Specific sliding of the gear, 1 − v1/v2 (dimensionless; positive in the pinion's dedendum).
    pub fn sliding_ratio_gear(&self, y: f64) -> f64 {
        1.0 - self.rho_pinion(y) * self.speed_ratio / self.rho_gear(y)
    }

    /// Specific sliding of `member`.
    pub fn sliding_ratio(&self, member: Member, y: f64) -> f64 {
        match member {
            Member::Pinion => self.sliding_ratio_pinion(y),
            Member::Gear => self.sliding_ratio_gear(y),
        }
    }

    /// Circular pitch on the operating circles, mm: 2π r_w1/z1.
    pub fn operating_pitch(&self) -> f64 {
        self.pitch_radius_pinion * self.pinion.pitch_angle()
    }
}

fn centre_distance_for(pinion: &Gear, gear: &Gear, thinning: f64) -> f64 {
    let rack = &pinion.rack;
    let teeth = f64::from(pinion.spec.teeth) + f64::from(gear.spec.teeth);
    let shifts = pinion.spec.profile_shift + gear.spec.profile_shift;
    let base_sum = pinion.base_radius + gear.base_radius;
    let excess = 2.0 * shifts * rack.pressure_angle.tan() - thinning / rack.module;
    if excess == 0.0 {
        return pinion.reference_radius + gear.reference_radius;
    }
    base_sum / inverse_inv(inv(rack.pressure_angle) + excess / teeth).cos()
}
