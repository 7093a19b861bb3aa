//! The basic rack: the common counterpart that generates every gear of a set.

use super::error::GearError;

/// A basic rack tooth profile (ISO 53). Its counterpart, the tool, cuts involute and fillet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasicRack {
    /// Module, mm.
    pub module: f64,
    /// Pressure angle at the reference circle, rad.
    pub pressure_angle: f64,
    /// Addendum h_aP, modules.
    pub addendum: f64,
    /// Dedendum h_fP, modules.
    pub dedendum: f64,
    /// Radius of the rack's root rounding ρ_fP, modules: the tip rounding of the tool.
    pub fillet_radius: f64,
}

impl BasicRack {
    /// Smallest pressure angle accepted, rad (10°).
    pub const MIN_PRESSURE_ANGLE: f64 = 10.0 * std::f64::consts::PI / 180.0;
    /// Largest pressure angle accepted, rad (35°).
    pub const MAX_PRESSURE_ANGLE: f64 = 35.0 * std::f64::consts::PI / 180.0;

    /// The profile A of ISO 53: 20°, addendum 1, dedendum 1.25, root rounding 0.38 modules; `module` in mm.
    pub fn iso53_a(module: f64) -> BasicRack {
        BasicRack {
            module,
            pressure_angle: 20.0_f64.to_radians(),
            addendum: 1.0,
            dedendum: 1.25,
            fillet_radius: 0.38,
        }
    }

    /// Base pitch, mm: π m cos α.
    pub fn base_pitch(&self) -> f64 {
        std::f64::consts::PI * self.module * self.pressure_angle.cos()
    }

    /// Largest root rounding that leaves the tool a tip (full round), modules, when the tool is wider than its standard
    /// by `widening` (mm, at its reference line, both sides together).
    ///
    /// ```text
    /// ρ_max = (π/4 + e/(2 m) − h_fP tan α) cos α / (1 − sin α)
    /// ```
    /// From the tool's half width at its tip line and a circle that touches tip line and flank.
    pub fn full_round_radius(&self, widening: f64) -> f64 {
        let (s, c) = self.pressure_angle.sin_cos();
        let half = std::f64::consts::FRAC_PI_4 + 0.5 * widening / self.module;
        (half - self.dedendum * s / c) * c / (1.0 - s)
    }

    /// Depth below the reference line where the tool's straight flank ends and its rounding begins, mm.
    pub fn straight_depth(&self) -> f64 {
        (self.dedendum - self.fillet_radius * (1.0 - self.pressure_angle.sin())) * self.module
    }

    /// Refuses racks that are none.
    pub(super) fn check(&self) -> Result<(), GearError> {
        for (quantity, value) in [
            ("module", self.module),
            ("pressure angle", self.pressure_angle),
            ("addendum", self.addendum),
            ("dedendum", self.dedendum),
            ("fillet radius", self.fillet_radius),
        ] {
            if !value.is_finite() {
                return Err(GearError::NotFinite { quantity, value });
            }
        }
        if self.module <= 0.0 {
            return Err(GearError::Module {
                module: self.module,
            });
        }
        let tiny = 1e-9;
        if self.pressure_angle < Self::MIN_PRESSURE_ANGLE - tiny
            || self.pressure_angle > Self::MAX_PRESSURE_ANGLE + tiny
        {
            return Err(GearError::PressureAngle {
                angle_deg: self.pressure_angle.to_degrees(),
                min_deg: Self::MIN_PRESSURE_ANGLE.to_degrees(),
                max_deg: Self::MAX_PRESSURE_ANGLE.to_degrees(),
            });
        }
        for (quantity, value) in [("addendum", self.addendum), ("dedendum", self.dedendum)] {
            if value <= 0.0 {
                return Err(GearError::NotPositive { quantity, value });
            }
        }
        Ok(())
    }
}
