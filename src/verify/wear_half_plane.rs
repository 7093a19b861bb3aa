//! Wear of an elastic cylinder on a half plane whose same points stay in touch (benchmark F6).
//!
//! ```text
//! σ = k E* s/(2 a₀),   worn area = (π/2) σ a₀³/R,   a₀ and p₀ the Hertz values at s = 0
//! ```
//! There is no closed form for the pressure. The table was computed for the benchmarks by a boundary-element program that
//! shares no code with this one (150 elements per a₀, backward Euler with extrapolation; a/a₀ to ± 0.007).

use std::f64::consts::PI;

use crate::analytic::cylinder_wear::{HISTORY, Row, worn_area};
use crate::analytic::half_plane_elements::weighted_compliance;
use crate::analytic::hertz_line;
use crate::verify::sliding::{SlidingContact, even_grid, half_width, history};
use crate::verify::{CaseError, Measured};

/// Load per width N/mm, relative radius mm, contact modulus MPa, wear coefficient mm²/N.
pub const DATA: (f64, f64, f64, f64) = (10.0, 4.0, 109.8901, 1e-3);

/// F6 with `per_half_width` elements on a₀, up to the σ `last`.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn cylinder(
    per_half_width: usize,
    last: f64,
    tolerance: f64,
) -> Result<Vec<Measured>, CaseError> {
    let (load, radius, modulus, k) = DATA;
    let a0 = hertz_line::half_width(load, radius, modulus);
    let rows: Vec<_> = HISTORY.iter().filter(|row| row.sliding <= last).collect();
    let widest = rows.iter().map(|row| row.half_width).fold(1.0, f64::max);
    let cells = ((widest + 0.15) * per_half_width as f64).ceil() as usize;
    let reach = a0 * cells as f64 / per_half_width as f64;
    let compliance = |x: &[f64], _: &_| weighted_compliance(x, modulus, 8.0 * reach);
    let mut system = SlidingContact::new(
        even_grid(-reach, reach, 2 * cells),
        |x| x * x / (2.0 * radius),
        compliance,
        load,
        k,
    );
    table_rows(
        "F6",
        "half plane",
        &mut system,
        &rows,
        cells,
        [load, radius, modulus, a0],
        tolerance,
    )
}

/// Runs `system` (centre node `centre`) through rows of [`HISTORY`]; `data` is load, radius, modulus, a₀.
pub(crate) fn table_rows(
    id: &'static str,
    body: &str,
    system: &mut SlidingContact,
    rows: &[&Row],
    centre: usize,
    data: [f64; 4],
    tolerance: f64,
) -> Result<Vec<Measured>, CaseError> {
    let [load, radius, modulus, a0] = data;
    let p0 = 2.0 * load / (PI * a0);
    let element = system.x[centre + 1] - system.x[centre];
    let stops: Vec<f64> = rows
        .iter()
        .map(|row| 2.0 * a0 * row.sliding / (system.coefficient * modulus))
        .collect();
    let mut out = Vec::new();
    for (row, snap) in rows
        .iter()
        .zip(history(system, &stops, tolerance, 1e-3 * a0 * a0 / radius)?)
    {
        let Row {
            sliding: sigma,
            half_width: a,
            pressure: p,
            depth: w,
        } = **row;
        let width = half_width(&system.x, &snap.active) / a0;
        let at = format!("{body}, sigma {sigma} ({} steps)", snap.steps);
        out.push(Measured::absolute(
            id,
            format!("{at}: a/a0"),
            width,
            a,
            element / a0 + 0.01 * a,
        ));
        out.push(Measured::relative(
            id,
            format!("{at}: p(0)/p0"),
            snap.pressure[centre] / p0,
            p,
            0.02,
        ));
        out.push(Measured::relative(
            id,
            format!("{at}: w(0) R/a0^2"),
            snap.depth[centre] * radius / (a0 * a0),
            w,
            0.02,
        ));
        let area = worn_area(sigma, a0, radius);
        out.push(Measured::relative(
            id,
            format!("{at}: F1 balance, worn area, mm2"),
            system.worn_area(&snap.depth),
            area,
            1e-6,
        ));
    }
    Ok(out)
}
