//! Wear of a gear flank per pass of the contact, without knowing the contact.
//!
//! The contact crosses a flank point at the point's own rolling speed v1 while the surfaces slide at |v1 − v2|, and
//! ∫ p dx = F', so pressure shape and width cancel:
//!
//! ```text
//! h1 = k F' |1 − v2/v1|,   h2 = k F' |1 − v1/v2|,   v1 : v2 = ρ1 : ρ2 z1/z2
//! ```
//! The content of the single-point-observation formula of the gear wear literature (Andersson & Eriksson 1990; Flodin &
//! Andersson 1997). Exact while load and curvature change little over one Hertz width; at the pitch point it gives zero,
//! where the width of the contact makes a small wear ([`pitch_point_depth`]).

use std::f64::consts::PI;

/// Depth per pass, mm, on the flank whose surface moves at `own` through the contact; speeds in any common unit.
///
/// k mm²/N, load per width N/mm.
pub fn depth_per_pass(k: f64, load: f64, own: f64, other: f64) -> f64 {
    k * load * (1.0 - other / own).abs()
}

/// Share of the load that a pair carries at ρ (mm, pinion radius of curvature) by the linear rule for rigid, perfect teeth.
///
/// ```text
/// 1/3 at A rising to 2/3 at B, 1 between B and D, 2/3 falling to 1/3 at E; zero outside A to E
/// ```
/// `limits` are A, B, D, E. At B and D themselves the pair carries all.
pub fn linear_load_share(rho: f64, limits: [f64; 4]) -> f64 {
    let [a, b, d, e] = limits;
    if rho < a || rho > e {
        0.0
    } else if rho < b {
        (1.0 + (rho - a) / (b - a)) / 3.0
    } else if rho <= d {
        1.0
    } else {
        (1.0 + (e - rho) / (e - d)) / 3.0
    }
}

/// Depth per pass of the pinion at the pitch point, mm, from the width of the contact.
///
/// ```text
/// h1(C) = k F' (1 + z1/z2) (r_b1/ρ1²) (4/(3π)) b
/// ```
/// From |sliding| growing linearly on both sides of the pitch point under a Hertz pressure of half width b (mm); `ratio` is
/// z1/z2, radii in mm.
pub fn pitch_point_depth(
    k: f64,
    load: f64,
    ratio: f64,
    base_radius: f64,
    rho: f64,
    half_width: f64,
) -> f64 {
    k * load * (1.0 + ratio) * base_radius / (rho * rho) * 4.0 / (3.0 * PI) * half_width
}
