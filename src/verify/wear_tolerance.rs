//! How much the step tolerance matters: the wear cases at the default tolerance and at half of it (benchmark F8).

use crate::verify::sliding::DEFAULT_TOLERANCE;
use crate::verify::{CaseError, Measured, wear_half_plane, wear_punch, wear_winkler};

/// Largest relative change of the pressures and depths of F3, F4, F6 and F7 when the default tolerance is halved.
///
/// Half widths are left out: they count whole elements. `elements` is the number on a₀ (F4, F6) and a third of the
/// number under the punch (F7).
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn halving(elements: usize) -> Result<Vec<Measured>, CaseError> {
    type Case<'a> = (
        &'static str,
        &'a dyn Fn(f64) -> Result<Vec<Measured>, CaseError>,
    );
    let cases: [Case; 3] = [
        ("F4", &|t| wear_winkler::parabola(elements, t)),
        ("F6", &|t| wear_half_plane::cylinder(elements, 3.0, t)),
        ("F7", &|t| wear_punch::straight(3 * elements, t)),
    ];
    let mut out = Vec::new();
    for (id, run) in cases {
        let (default, halved) = (run(DEFAULT_TOLERANCE)?, run(0.5 * DEFAULT_TOLERANCE)?);
        let change = default
            .iter()
            .zip(&halved)
            .filter(|(m, _)| m.quantity.contains("p(") || m.quantity.contains("w(0)"))
            .map(|(m, h)| (m.value / h.value - 1.0).abs())
            .fold(0.0, f64::max);
        out.push(Measured::bound(
            id,
            "largest change of p and w when the step tolerance is halved",
            change,
            0.01,
        ));
    }
    Ok(out)
}
