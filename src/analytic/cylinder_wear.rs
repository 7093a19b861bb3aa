//! Wear of an elastic cylinder on a half plane under constant load, always the same points in contact (sliding out of plane).
//!
//! ```text
//! σ = k E* s/(2 a0)                          a0, p0 the Hertz values at s = 0
//! worn area = k F' s = (π/2) σ a0³/R         exact (all that is worn is k times load times sliding)
//! ```

/// One row of the reference solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// σ = k E* s/(2 a0).
    pub sliding: f64,
    /// Half width over a0; uncertain by 0.007 (panels of 1/150 a0).
    pub half_width: f64,
    /// Pressure in the middle over p0.
    pub pressure: f64,
    /// Depth worn in the middle, times R/a0².
    pub depth: f64,
}

/// Computed once by an independent boundary-element program: 150 panels per a0, backward Euler with extrapolation.
pub const HISTORY: [Row; 5] = [
    row(0.1, 1.107, 0.9373, 0.0968),
    row(0.3, 1.247, 0.8287, 0.2730),
    row(1.0, 1.553, 0.6045, 0.7633),
    row(3.0, 2.067, 0.4123, 1.7339),
    row(10.0, 2.960, 0.2743, 4.0084),
];

const fn row(sliding: f64, half_width: f64, pressure: f64, depth: f64) -> Row {
    Row {
        sliding,
        half_width,
        pressure,
        depth,
    }
}

/// Dimensionless sliding σ: k mm²/N, E* MPa, s and a0 mm.
pub fn dimensionless_sliding(k: f64, contact_modulus: f64, sliding: f64, half_width: f64) -> f64 {
    k * contact_modulus * sliding / (2.0 * half_width)
}

/// Worn area of the cross-section, mm²: `(π/2) σ a0³/R`.
pub fn worn_area(sigma: f64, half_width: f64, radius: f64) -> f64 {
    std::f64::consts::FRAC_PI_2 * sigma * half_width.powi(3) / radius
}

/// Rough half width over a0: `(1 + 3πσ/4)^(1/3)`, from uniform pressure on a scar that starts at a0. Low by 2 to 4 %.
pub fn rough_half_width(sigma: f64) -> f64 {
    (1.0 + 0.75 * std::f64::consts::PI * sigma).cbrt()
}
