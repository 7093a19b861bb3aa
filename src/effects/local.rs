//! The state of a place on a flank, as an effect sees it.

use crate::gear::Member;

/// One flank point in one passage of a contact. Plain numbers, so that an effect is tested without a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Local {
    /// Whose flank.
    pub member: Member,
    /// Radius of the point on its member, mm.
    pub radius: f64,
    /// Signed distance of the contact from the pitch point along the path of contact, mm; positive towards the pinion's tip.
    pub path: f64,
    /// Whether the contact is on the approach side (before the pitch point in the direction of drive).
    pub approach: bool,
    /// Radii of curvature of pinion and gear flank here, mm.
    pub curvature: [f64; 2],
    /// Rolling speeds u1 and u2 of pinion and gear flank, m/s.
    pub rolling: [f64; 2],
    /// Contact pressure here and now, MPa.
    pub pressure: f64,
    /// Largest pressure this point sees in the passage, averaged over about 30 µm of flank, MPa.
    pub peak_pressure: f64,
    /// Largest pressure of Hertz's ellipse under the load of this tooth pair on the unworn flanks, MPa.
    pub hertz_pressure: f64,
    /// Load of this tooth pair per face width, N/mm.
    pub line_load: f64,
    /// Half width of the contact, mm.
    pub half_width: f64,
    /// Normal load of all pairs together per face width, N/mm: torque over base radius and face width.
    pub normal_load: f64,
    /// Depth worn at this point so far, µm.
    pub depth: f64,
    /// Pinion revolutions so far.
    pub cycles: f64,
    /// Contacts of this member so far.
    pub contacts: f64,
    /// Hours run so far.
    pub hours: f64,
    /// Hours from one contact of this member to its next.
    pub contact_hours: f64,
    /// Volume worn off both members since the oil was last changed, mm³.
    pub worn_volume: f64,
    /// Pinion torque, N·m.
    pub torque: f64,
    /// Pinion speed, rpm.
    pub speed: f64,
    /// Base radius of the pinion, mm.
    pub base_radius: f64,
    /// Base pitch, mm.
    pub base_pitch: f64,
    /// Film ratio λ; 0 (dry) where the study states no film.
    pub film_ratio: f64,
    /// Coefficient of friction here; 0 where the study states none.
    pub friction: f64,
    /// Rise of the contact temperature over the bulk, K; 0 where the study does not state what it follows from.
    pub flash_temperature: f64,
    /// Bulk temperature, °C; 20 where the study states none.
    pub bulk_temperature: f64,
}

impl Local {
    /// Sliding speed |u1 − u2|, m/s.
    pub fn sliding_speed(&self) -> f64 {
        (self.rolling[0] - self.rolling[1]).abs()
    }

    /// Distance that the mate has slid over this point so far, m, were all its contacts like this one: each lets it slide by the contact's
    /// width times the sliding over the point's own rolling speed, 2 a |u1 − u2|/u.
    pub fn slid_distance(&self) -> f64 {
        let own = match self.member {
            Member::Pinion => self.rolling[0],
            Member::Gear => self.rolling[1],
        };
        if own > 0.0 {
            2e-3 * self.contacts * self.half_width * self.sliding_speed() / own
        } else {
            0.0
        }
    }

    /// Mean rolling (entraining) speed (u1 + u2)/2, m/s.
    pub fn entraining_speed(&self) -> f64 {
        0.5 * (self.rolling[0] + self.rolling[1])
    }

    /// Relative radius of curvature ρ1 ρ2/(ρ1 + ρ2), mm; 0 at a sharp corner.
    pub fn relative_radius(&self) -> f64 {
        let [a, b] = self.curvature;
        if a + b > 0.0 { a * b / (a + b) } else { 0.0 }
    }

    /// Whether this member slides against its rolling here (negative specific sliding: its dedendum).
    pub fn dedendum(&self) -> bool {
        let own = match self.member {
            Member::Pinion => self.rolling[0] - self.rolling[1],
            Member::Gear => self.rolling[1] - self.rolling[0],
        };
        own < 0.0
    }

    /// Sliding speed, m/s, kept from zero for effects that divide by it: at the pitch point itself the width of the contact
    /// still slides.
    pub fn floored_sliding(&self) -> f64 {
        self.sliding_speed().max(SLIDING_FLOOR)
    }
}

/// Smallest sliding speed that effects with a power of it see, m/s.
pub const SLIDING_FLOOR: f64 = 0.02;

/// One point of a flank as made, before the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileAt {
    /// Whose flank.
    pub member: Member,
    /// Radius of the point on its member, mm.
    pub radius: f64,
    /// Where on the path of contact the point touches its mate, from the pitch point, mm.
    pub path: f64,
    /// Distance from this member's tip along the path of contact, mm.
    pub from_tip: f64,
    /// The same place between the start (0) and the end (1) of the path of contact.
    pub along: f64,
}
