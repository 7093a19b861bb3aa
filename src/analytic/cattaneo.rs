//! Partial slip of a Hertz line contact pulled sideways with less than its friction limit.
//!
//! ```text
//! c    = b sqrt(1 − Q/(µ w))                                       half width that sticks
//! q(x) = µ p0 [ sqrt(1 − x²/b²) − (c/b) sqrt(1 − x²/c²) ]          second term only where |x| < c
//! ```
//! Cattaneo (1938), Mindlin (1949); K. L. Johnson, Contact Mechanics (1985), section 7.2(a). For like materials, so that
//! normal load and tangential pull do not couple.

use super::hertz_line;

/// A Hertz contact with a tangential pull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartialSlip {
    /// Peak pressure p0, MPa.
    pub peak_pressure: f64,
    /// Half width of the contact b, mm.
    pub half_width: f64,
    /// Half width of the sticking part c, mm; zero when all slips.
    pub stick: f64,
    /// Coefficient of friction µ.
    pub friction: f64,
}

impl PartialSlip {
    /// The contact under a pull Q, N/mm (its size counts). At or above the friction limit everything slips.
    pub fn new(peak_pressure: f64, half_width: f64, friction: f64, pull: f64) -> Self {
        let limit = friction * hertz_line::load(peak_pressure, half_width);
        Self {
            peak_pressure,
            half_width,
            stick: half_width * (1.0 - pull.abs() / limit).max(0.0).sqrt(),
            friction,
        }
    }

    /// Tangential traction at a distance x from the middle, MPa.
    pub fn traction(&self, x: f64) -> f64 {
        let slipping = hertz_line::pressure(x, self.peak_pressure, self.half_width);
        let held = if self.stick > 0.0 {
            self.stick / self.half_width * hertz_line::pressure(x, self.peak_pressure, self.stick)
        } else {
            0.0
        };
        self.friction * (slipping - held)
    }

    /// Largest traction, MPa, at the edge of the sticking part: `µ p0 sqrt(1 − c²/b²)`.
    pub fn peak_traction(&self) -> f64 {
        self.traction(self.stick)
    }

    /// Tangential force, N/mm: `µ (π/2) p0 b (1 − c²/b²)`.
    pub fn force(&self) -> f64 {
        let limit = self.friction * hertz_line::load(self.peak_pressure, self.half_width);
        limit * (1.0 - (self.stick / self.half_width).powi(2))
    }
}
