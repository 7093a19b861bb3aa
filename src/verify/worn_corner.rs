//! Numerical error of the pressures where a worn tip corner runs in: the paper's pair, 6e-10 mm²/N, 50 000 pinion revolutions.
//!
//! The peaks of the pairs 5.4 to 4.6 mm before the pitch point, by three resolutions. The finest stands for the limit, since the others come nearer to it in turn.

use crate::numeric::interpolate;
use crate::simulate::forward::{Conditions, ContactKind, Forward};
use crate::simulate::numerics::Numerics;
use crate::simulate::touching_strip::TouchingStrip;
use crate::verify::Measured;
use crate::verify::convergence::{ConvergenceError, TORQUE, members, set};

/// The case.
pub const ID: &str = "corner";

/// Why the tolerances are what they are.
pub const REASON: &str = "5 %, what peaks of unworn flanks differ by from Hertz at the default resolution, and half of that on a grid twice as fine";

/// Where the gear's tip corner digs into the pinion: path from the pitch point, mm.
const FROM: f64 = -5.4;
const TO: f64 = -4.6;

/// Edges per half width, positions, and what may lie between its peaks and those of the last (root mean square, relative to their mean).
const COARSE: [(f64, usize, f64); 2] = [(5.0, 100, 0.05), (10.0, 200, 0.025)];
const FINE: (f64, usize) = (20.0, 200);

/// Peaks by all resolutions, compared.
///
/// # Errors
/// [`ConvergenceError`] if a history does not come to its end.
pub fn all() -> Result<Vec<Measured>, ConvergenceError> {
    let (paths, fine): (Vec<f64>, Vec<f64>) = peaks(FINE.0, FINE.1)?.into_iter().unzip();
    let mut out = Vec::new();
    for (edges, positions, tolerance) in COARSE {
        let found = peaks(edges, positions)?;
        let inside: Vec<(f64, f64)> = (found.iter().copied())
            .filter(|(path, _)| (FROM..=TO).contains(path))
            .map(|(path, peak)| (peak, interpolate(&paths, &fine, path)))
            .collect();
        let count = inside.len() as f64;
        let mean = inside.iter().map(|(_, fine)| fine).sum::<f64>() / count;
        let square = |(peak, fine): &(f64, f64)| ((peak - fine) / mean).powi(2);
        let error = (inside.iter().map(square).sum::<f64>() / count).sqrt();
        let what = format!(
            "peaks of {} positions at the worn corner (mean {mean:.0} MPa), root mean square over their mean: {edges} edges per half width and \
             {positions} positions against {} and {}",
            inside.len(),
            FINE.0,
            FINE.1
        );
        out.push(Measured::bound(ID, what, error, tolerance));
    }
    Ok(out)
}

/// Path (ascending, mm) and peak pressure (MPa) of every loaded pair a little beyond the compared range.
fn peaks(edges: f64, positions: usize) -> Result<Vec<(f64, f64)>, ConvergenceError> {
    let set = set()?;
    let numerics = Numerics {
        elements_per_half_width: edges,
        positions,
        ..Numerics::default()
    };
    let members = members(&set, &numerics)?;
    let conditions = Conditions {
        torque: TORQUE,
        speed: 2000.0,
        misalignment: 0.0,
        cycles: 50e3,
        coefficient: [6e-10; 2],
    };
    let mut forward = Forward::new(&set, Some(&members), conditions, numerics)?;
    let (mut progress, mut contacts) = (None, Vec::new());
    let cycles = [conditions.cycles];
    forward.wear(&mut progress, &cycles, &mut |_| true, &mut |state| {
        contacts = state.contacts
    })?;
    let cycle = forward.cycle();
    let mut out = Vec::new();
    for (position, contact) in cycle.positions.iter().zip(&contacts) {
        for pair in &position.pairs {
            let pressure = &contact.pressure[pair.offset..pair.offset + pair.xi.len()];
            let strip = TouchingStrip::of(ContactKind::Fem, cycle, pair, pressure);
            if (FROM - 0.2..=TO + 0.2).contains(&pair.path) {
                out.push((pair.path, strip.peak_pressure));
            }
        }
    }
    out.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(out)
}
