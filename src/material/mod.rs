//! Floor 1: plain material data and what follows from it.

mod wear_pairs;

pub use wear_pairs::{WEAR_PAIRS, WearPair, wear_pair};

/// Linear isotropic elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Young's modulus E, MPa.
    pub youngs_modulus: f64,
    /// Poisson's ratio, -1 < nu < 0.5.
    pub poisson_ratio: f64,
}

impl Elastic {
    /// Plane-strain modulus E / (1 − ν²), MPa.
    pub fn plane_strain_modulus(&self) -> f64 {
        self.youngs_modulus / (1.0 - self.poisson_ratio * self.poisson_ratio)
    }
}

/// Contact modulus E* of two bodies, MPa: `1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂` (Johnson, Contact Mechanics, 1985, Eq. 4.22).
pub fn contact_modulus(first: Elastic, second: Elastic) -> f64 {
    1.0 / (1.0 / first.plane_strain_modulus() + 1.0 / second.plane_strain_modulus())
}
