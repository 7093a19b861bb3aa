//! The elastic half plane: rigid flat punch, strips of pressure, and the step limit of explicit wear.
//!
//! ```text
//! u(x) = −2/(π E*) ∫ p(t) ln|x − t| dt + constant        displacement into the surface, mm
//! ```
//! K. L. Johnson, Contact Mechanics (1985), Eqs. (2.24), (2.64). The constant of a plane problem is free.

use std::f64::consts::PI;

/// Pressure under a rigid flat frictionless punch of half width a, MPa: `p = F'/(π sqrt(a² − x²))`.
///
/// Load F' in N/mm; infinite at the corners, zero outside. Johnson (1985), Eq. (2.64).
pub fn flat_punch_pressure(x: f64, load: f64, half_width: f64) -> f64 {
    if x.abs() > half_width {
        return 0.0;
    }
    load / (PI * (half_width * half_width - x * x).sqrt())
}

/// Mean pressure under the same punch between x = `from` and x = `to` (both inside), MPa.
pub fn flat_punch_mean_pressure(from: f64, to: f64, load: f64, half_width: f64) -> f64 {
    let angle = |x: f64| (x / half_width).clamp(-1.0, 1.0).asin();
    load * (angle(to) - angle(from)) / (PI * (to - from))
}

/// Surface displacement at x under unit pressure (1 MPa) from `from` to `to`, mm, lengths in mm, up to a constant.
///
/// ```text
/// u = −2/(π E*) [ s ln|s| − s ]  taken from s = x − to to s = x − from
/// ```
pub fn strip_displacement(x: f64, from: f64, to: f64, contact_modulus: f64) -> f64 {
    -2.0 / (PI * contact_modulus) * (log_integral(x - from) - log_integral(x - to))
}

/// Mean over one strip of the displacement under unit pressure on another of the same width, mm, up to a constant.
///
/// `distance` is that of the middles, mm. The Galerkin matrix of a half plane cut into equal strips; symmetric.
pub fn strip_influence(distance: f64, width: f64, contact_modulus: f64) -> f64 {
    let double = |s: f64| {
        if s == 0.0 {
            0.0
        } else {
            s * s * (0.5 * s.abs().ln() - 0.75)
        }
    };
    let d = distance;
    let integral = double(d + width) + double(d - width) - 2.0 * double(d);
    -2.0 / (PI * contact_modulus) * integral / width
}

/// Largest sliding distance of one explicit wear step that does not grow a saw-tooth of element length h, mm.
///
/// ```text
/// Δs < (4/π) h/(k E*)        no oscillation below half of it
/// ```
/// h mm, k mm²/N, E* MPa. A sinusoidal pressure of wavelength 2h and amplitude p displaces the surface by (2/π) p h/E*; a step
/// whose wear k p Δs is more than twice that turns the error over and makes it larger. Pressure constant on each element
/// changes the limit by a factor 1.166 (displacement taken at the middles) or 0.853 (means over the elements).
pub fn stable_sliding(element: f64, k: f64, contact_modulus: f64) -> f64 {
    4.0 / PI * element / (k * contact_modulus)
}

/// Depth worn in that largest step under a pressure p (MPa), mm: `(4/π) h p/E*`.
pub fn stable_depth(element: f64, pressure: f64, contact_modulus: f64) -> f64 {
    4.0 / PI * element * pressure / contact_modulus
}

fn log_integral(s: f64) -> f64 {
    if s == 0.0 {
        0.0
    } else {
        s * (s.abs().ln() - 1.0)
    }
}
