//! Partial slip of two half cylinders after Cattaneo and Mindlin (benchmark B5), by the product's operators.
//!
//! ```text
//! c = b √(1 − Q'/(μ F'))   q(x) = μ p₀ (√(1 − x²/b²) − (c/b) √(1 − x²/c²))
//! ```
//! The gear contact itself knows full slip only. Here the tangential compliance is condensed and weighted in the same way
//! as the normal one, and the same unilateral solver finds where the bodies stick.

use crate::analytic::cattaneo::PartialSlip;
use crate::contact::unilateral::{Drive, Problem, solve};
use crate::fem::structured::Order;
use crate::numeric::Vec2;
use crate::verify::hertz_cylinders::{Cylinders, Grid};
use crate::verify::sliding::half_width;
use crate::verify::{CaseError, Measured, discipline};

/// B5: a tangential load after the normal load of B2.
///
/// The bodies are alike, so normal and tangential problems do not couple; q = μp − c where the correction c ≥ 0 solves a
/// unilateral problem of the same form with the tangential compliance (Jäger, Arch. Appl. Mech. 68, 1998):
/// r = δ L − W_t (μ p − c) ≥ 0 is the slip, L·c = μF' − Q'.
///
/// # Errors
/// [`CaseError`] if a mesh is refused or a contact has no solution.
pub fn cattaneo_mindlin(per_half_width: usize) -> Result<Vec<Measured>, CaseError> {
    let (friction, pull) = (0.2, 16.0 * 0.05851);
    let case = Cylinders {
        held: true,
        ..Cylinders::benchmark(per_half_width, Order::Quadratic, Grid::Nodes)
    };
    let pair = case.build()?;
    let normal = pair.solve(Drive::Load(case.load()))?;
    let w = pair.compliance_along(Vec2::x());
    let limit = nalgebra::DVector::from_iterator(
        pair.xi.len(),
        normal.pressure.iter().map(|p| friction * p),
    );
    let gap: Vec<f64> = (&w * &limit * -1.0).iter().copied().collect();
    let length = &pair.coupling.length;
    let drive = Drive::Load(friction * case.load() - pull);
    let problem = Problem {
        w: &w,
        gap: &gap,
        arm: length,
        lever: length,
        drive,
        symmetric: true,
    };
    let stick = solve(&problem, &[])?;
    let q: Vec<f64> = limit
        .iter()
        .zip(&stick.pressure)
        .map(|(l, c)| l - c)
        .collect();
    let b = case.half_width();
    let exact = PartialSlip::new(case.peak(), b, friction, pull);
    let largest = q.iter().fold(0.0f64, |m, q| m.max(*q));
    let over = q
        .iter()
        .zip(&limit)
        .map(|(q, l)| q.abs() - l)
        .fold(0.0, f64::max);
    let at = format!("{per_half_width} edges per b");
    let mut out = vec![
        Measured::absolute(
            "B5",
            format!("{at}: stick half width c, mm"),
            half_width(&pair.xi, &stick.active),
            exact.stick,
            b / per_half_width as f64,
        ),
        Measured::relative(
            "B5",
            format!("{at}: largest q, MPa"),
            largest,
            exact.peak_traction(),
            0.03,
        ),
        Measured::relative(
            "B5",
            format!("{at}: integral of q, N/mm"),
            pair.resultant(&q),
            pull,
            1e-8,
        ),
        Measured::bound("B5", format!("{at}: largest |q| - mu p, MPa"), over, 1e-9),
    ];
    out.extend(discipline("B5", &at, &stick));
    Ok(out)
}
