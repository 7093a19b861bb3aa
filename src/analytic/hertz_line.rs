//! Hertz line contact: two parallel cylinders without friction.
//!
//! ```text
//! 1/R  = 1/R1 + 1/R2                          a concave body counts with a negative radius
//! b    = sqrt(4 w R / (π E*))                 half width, mm
//! p0   = 2 w / (π b) = sqrt(w E* / (π R))     largest pressure, MPa
//! p(x) = p0 sqrt(1 − x²/b²)
//! ```
//! w N/mm load per width, R mm, E* MPa contact modulus. K. L. Johnson, Contact Mechanics (1985), section 4.2(c), Eqs.
//! (4.42) to (4.46). Valid for b much smaller than both radii and both bodies.

use std::f64::consts::PI;

/// Relative radius of curvature R, mm, of two radii in mm.
pub fn relative_radius(first: f64, second: f64) -> f64 {
    first * second / (first + second)
}

/// Half width b of the contact, mm; zero without load.
///
/// ```
/// # use gearwear::analytic::hertz_line::half_width;
/// assert!((half_width(119.44, 5.0, 115_385.0) - 0.08118).abs() < 1e-5);
/// ```
pub fn half_width(load: f64, radius: f64, contact_modulus: f64) -> f64 {
    (4.0 * load.max(0.0) * radius / (PI * contact_modulus)).sqrt()
}

/// Largest pressure p0, MPa; zero without load.
pub fn peak_pressure(load: f64, radius: f64, contact_modulus: f64) -> f64 {
    (load.max(0.0) * contact_modulus / (PI * radius)).sqrt()
}

/// Pressure at a distance x from the middle, MPa; zero outside the contact.
pub fn pressure(x: f64, peak: f64, half_width: f64) -> f64 {
    let t = x / half_width;
    peak * (1.0 - t * t).max(0.0).sqrt()
}

/// Load per width of a contact with this peak pressure and half width, N/mm: `w = π b p0 / 2`.
pub fn load(peak: f64, half_width: f64) -> f64 {
    PI * half_width * peak / 2.0
}

/// Principal stresses on the axis at a depth z below the surface, MPa, along and across it.
///
/// ```text
/// σx = −p0 [ (b² + 2z²)/(b sqrt(b² + z²)) − 2z/b ]        σz = −p0 b / sqrt(b² + z²)
/// ```
/// Johnson (1985), Eq. (4.46). Half their difference is the largest shear stress: 0.300 p0 at z = 0.786 b.
pub fn axis_stress(depth: f64, peak: f64, half_width: f64) -> [f64; 2] {
    let (b, z) = (half_width, depth);
    let root = b.hypot(z);
    [
        -peak * ((b * b + 2.0 * z * z) / (b * root) - 2.0 * z / b),
        -peak * b / root,
    ]
}

/// Pressure-weighted mean gap `∫ p x²/(2R) dx / w`, mm: `b²/(8R)`.
///
/// What a work-conjugate mean displacement of the two surfaces lacks of their approach.
pub fn mean_gap(half_width: f64, radius: f64) -> f64 {
    half_width * half_width / (8.0 * radius)
}
