//! Thick ring under internal pressure, plane strain (Lamé).
//!
//! ```text
//! σ_r = p a²/(b² − a²) (1 − b²/r²),   σ_θ = p a²/(b² − a²) (1 + b²/r²)
//! u   = p a² (1 + nu) / (E (b² − a²)) [ (1 − 2 nu) r + b²/r ]
//! ```
//! Timoshenko & Goodier, Theory of Elasticity (3rd ed., 1970), section 28, Eq. (45), with E and nu replaced by their plane-strain
//! values E/(1 − nu²), nu/(1 − nu) in the displacement. Valid for long rings without axial strain.

/// A ring and its load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LameRing {
    /// Inner radius a, mm.
    pub inner: f64,
    /// Outer radius b, mm.
    pub outer: f64,
    /// Internal pressure p, MPa.
    pub pressure: f64,
    /// Young's modulus E, MPa.
    pub youngs_modulus: f64,
    /// Poisson's ratio nu.
    pub poisson_ratio: f64,
}

impl LameRing {
    /// Radial stress at radius `r` (mm), MPa.
    pub fn radial_stress(&self, r: f64) -> f64 {
        self.stress_factor() * (1.0 - (self.outer / r).powi(2))
    }

    /// Hoop stress at radius `r` (mm), MPa.
    pub fn hoop_stress(&self, r: f64) -> f64 {
        self.stress_factor() * (1.0 + (self.outer / r).powi(2))
    }

    /// Radial displacement at radius `r` (mm), mm, positive outward.
    pub fn displacement(&self, r: f64) -> f64 {
        let nu = self.poisson_ratio;
        let bracket = (1.0 - 2.0 * nu) * r + self.outer * self.outer / r;
        self.stress_factor() * (1.0 + nu) / self.youngs_modulus * bracket
    }

    fn stress_factor(&self) -> f64 {
        let (a2, b2) = (self.inner * self.inner, self.outer * self.outer);
        self.pressure * a2 / (b2 - a2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RING: LameRing = LameRing {
        inner: 10.0,
        outer: 20.0,
        pressure: 100.0,
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };

    #[test]
    fn boundary_stresses_are_the_loads_and_the_hoop_stress_carries_them() {
        assert!((RING.radial_stress(10.0) + 100.0).abs() < 1e-12);
        assert!(RING.radial_stress(20.0).abs() < 1e-12);
        // Half the ring: pressure on the diameter 2 a p is carried by two walls.
        let n = 2000;
        let wall: f64 = (0..n)
            .map(|i| RING.hoop_stress(10.0 + 10.0 * (i as f64 + 0.5) / n as f64) * 10.0 / n as f64)
            .sum();
        assert!((2.0 * wall / (2.0 * 10.0 * 100.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn stress_follows_from_displacement_by_hooke() {
        let (e, nu, r, h) = (RING.youngs_modulus, RING.poisson_ratio, 13.0, 1e-4);
        let strain_r = (RING.displacement(r + h) - RING.displacement(r - h)) / (2.0 * h);
        let strain_t = RING.displacement(r) / r;
        let factor = e / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let hoop = factor * ((1.0 - nu) * strain_t + nu * strain_r);
        let radial = factor * ((1.0 - nu) * strain_r + nu * strain_t);
        assert!((hoop - RING.hoop_stress(r)).abs() < 1e-6);
        assert!((radial - RING.radial_stress(r)).abs() < 1e-6);
    }
}
