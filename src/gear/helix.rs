//! Helical teeth: what a gear that is ordered by normal module and helix angle is in its transverse section.
//!
//! ```text
//! d = z m_n/cos β      tan α_t = tan α_n/cos β      m_t = m_n/cos β      tan β_b = tan β cos α_t
//! ε_β = b tan β_b/p_bt = b sin β/(π m_n)                                                                   ISO 21771
//! ```
//! Radial lengths (addendum, dedendum, profile shift, in m_n) are the same in both sections, lengths along the reference circle are
//! 1/cos β times those of the normal one. The root rounding of the tool is an ellipse in the transverse section; in its place stands the
//! circle that touches root line and flank at the same depth, so that form and root circle are those of the tool.

use super::BasicRack;

impl BasicRack {
    /// The rack in the transverse section of teeth with the helix angle `helix` (rad at the reference circle), this one being the normal
    /// section; for 0 itself, to the bit.
    pub fn transverse(&self, helix: f64) -> BasicRack {
        if helix == 0.0 {
            return *self;
        }
        let cos = helix.cos();
        let pressure_angle = (self.pressure_angle.tan() / cos).atan();
        let rounding = (1.0 - self.pressure_angle.sin()) / (1.0 - pressure_angle.sin());
        BasicRack {
            module: self.module / cos,
            pressure_angle,
            addendum: self.addendum * cos,
            dedendum: self.dedendum * cos,
            fillet_radius: self.fillet_radius * cos * rounding,
        }
    }

    /// The rack in the normal section, this one being the transverse: the inverse of [`BasicRack::transverse`].
    pub fn normal(&self, helix: f64) -> BasicRack {
        if helix == 0.0 {
            return *self;
        }
        let cos = helix.cos();
        let pressure_angle = (self.pressure_angle.tan() * cos).atan();
        let rounding = (1.0 - pressure_angle.sin()) / (1.0 - self.pressure_angle.sin());
        BasicRack {
            module: self.module * cos,
            pressure_angle,
            addendum: self.addendum / cos,
            dedendum: self.dedendum / cos,
            fillet_radius: self.fillet_radius / (cos * rounding),
        }
    }
}

/// Helix angle at the base circle, rad, of teeth with `helix` (rad) at the reference circle and this pressure angle of the transverse section.
pub(super) fn base_helix(helix: f64, pressure_angle: f64) -> f64 {
    (helix.tan() * pressure_angle.cos()).atan()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gear::{Gear, Pair, ToothSpec};

    /// The example of every textbook: m_n 3, 20°, β 12°, against values worked out by hand from the formulas of ISO 21771.
    #[test]
    fn the_transverse_section_is_that_of_the_standard() {
        let helix = 12f64.to_radians();
        let rack = BasicRack::iso53_a(3.0).transverse(helix);
        assert!((rack.module - 3.067_022).abs() < 1e-6, "{}", rack.module);
        let angle = rack.pressure_angle.to_degrees();
        assert!((angle - 20.410_311).abs() < 2e-5, "{angle}");
        assert!((rack.addendum * rack.module - 3.0).abs() < 1e-12);
        assert!((rack.dedendum * rack.module - 3.75).abs() < 1e-12);
        // the straight flank ends at the tool's depth
        let straight = BasicRack::iso53_a(3.0).straight_depth();
        assert!((rack.straight_depth() - straight).abs() < 1e-12);
        let back = rack.normal(helix);
        assert!((back.module - 3.0).abs() < 1e-12 && (back.fillet_radius - 0.38).abs() < 1e-12);
        assert_eq!(
            BasicRack::iso53_a(3.0).transverse(0.0),
            BasicRack::iso53_a(3.0)
        );

        let gear = |teeth, bore| {
            let gear = Gear::new(rack, ToothSpec::plain(teeth, bore)).unwrap();
            gear.helical(helix)
        };
        let (pinion, wheel) = (gear(23, 40.0), gear(67, 100.0));
        let centre = Pair::zero_backlash_centre_distance(&pinion, &wheel);
        let reference = 0.5 * 3.0 * 90.0 / helix.cos();
        assert!((centre / reference - 1.0).abs() < 1e-9, "{centre}");
        let pair = Pair::new(pinion, wheel, centre, 0.0).unwrap();
        // sin β_b = sin β cos α_n
        let base = (helix.sin() * 20f64.to_radians().cos()).asin();
        assert!((pair.base_helix - base).abs() < 1e-12);
        let overlap = 30.0 * helix.sin() / (std::f64::consts::PI * 3.0);
        assert!((pair.overlap_ratio(30.0) - overlap).abs() < 1e-12);
    }
}
