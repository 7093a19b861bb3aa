//! Wear under a flat punch on a half plane (benchmark F7).
//!
//! ```text
//! p(x, 0) = F'/(π √(a² − x²))  →  p̄ = F'/2a,   modes decay as exp(−μ_n s),  μ_n = π k E*/(2 a ν_n),   S = k E* s/a
//! ```
//! The table of pressures was computed for the benchmarks by an independent boundary-element program; ν_n are eigenvalues
//! recomputed here (`analytic::half_plane_elements`).

use crate::analytic::half_plane_elements::{punch_eigenvalues, weighted_compliance};
use crate::analytic::punch_wear::{EIGENVALUES, HISTORY, PunchWear, decay_rate};
use crate::verify::sliding::{SlidingContact, history, value_at};
use crate::verify::wear_winkler::balance;
use crate::verify::{CaseError, Measured};

/// Half width a, mm; contact modulus, MPa; wear coefficient, mm²/N; line load, N/mm.
pub const DATA: (f64, f64, f64, f64) = (1.0, 1e4, 1e-6, 20.0);

/// Even in the angle θ of x = a sin θ: fine towards the corners, where the pressure is singular at first.
pub fn graded_grid(a: f64, elements: usize) -> Vec<f64> {
    (0..=elements)
        .map(|i| a * ((i as f64 / elements as f64 - 0.5) * std::f64::consts::PI).sin())
        .collect()
}

/// The relaxation numbers with `panels` panels.
pub fn eigenvalues(panels: usize) -> Vec<Measured> {
    punch_eigenvalues(panels, 4)
        .into_iter()
        .zip(EIGENVALUES)
        .enumerate()
        .map(|(n, (value, target))| {
            Measured::relative(
                "F7",
                format!("nu_{} with {panels} panels", n + 1),
                value,
                target,
                1e-3,
            )
        })
        .collect()
}

/// A punch with the face `gap` (mm) on `elements` elements.
fn punch(elements: usize, gap: impl Fn(f64) -> f64) -> SlidingContact {
    let (a, modulus, k, load) = DATA;
    SlidingContact::new(
        graded_grid(a, elements),
        gap,
        |x, _| weighted_compliance(x, modulus, 8.0 * a),
        load,
        k,
    )
}

/// F7: the punch pressed straight, on `elements` (even) elements.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn straight(elements: usize, tolerance: f64) -> Result<Vec<Measured>, CaseError> {
    let mut system = punch(elements, |_| 0.0);
    table_rows("F7", "half plane", &mut system, DATA, tolerance)
}

/// Runs `system` through [`HISTORY`]; `data` is a, E*, k, F'.
pub(crate) fn table_rows(
    id: &'static str,
    body: &str,
    system: &mut SlidingContact,
    data: (f64, f64, f64, f64),
    tolerance: f64,
) -> Result<Vec<Measured>, CaseError> {
    let (a, modulus, k, load) = data;
    let mean = load / (2.0 * a);
    let stops = HISTORY.map(|row| row.0 * a / (k * modulus));
    let mut out = Vec::new();
    for ((sliding, row), snap) in HISTORY.iter().zip(history(
        system,
        &stops,
        tolerance,
        1e-3 * a * mean / modulus,
    )?) {
        for (place, (target, allowed)) in
            [0.0, 0.5, 0.9]
                .into_iter()
                .zip([(row[0], 0.02), (row[1], 0.02), (row[2], 0.05)])
        {
            let value = 0.5
                * (value_at(&system.x, &snap.pressure, place * a)
                    + value_at(&system.x, &snap.pressure, -place * a))
                / mean;
            let name = format!("{body}, S {sliding} ({} steps): p({place}a)/p", snap.steps);
            out.push(Measured::relative(id, name, value, target, allowed));
        }
        if *sliding > 0.0 {
            out.push(balance(id, system, &snap.depth, snap.s));
        }
    }
    Ok(out)
}

/// F7: a tilted punch that keeps its angle: the moment of the pressure decays with μ₁ once the higher odd modes are gone.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn tilted(elements: usize, tolerance: f64) -> Result<Vec<Measured>, CaseError> {
    let (a, modulus, k, load) = DATA;
    // a tenth of the tilt that would lift the unloaded corner
    let tilt = 0.1 * 2.0 * load / (std::f64::consts::PI * a * modulus);
    let mut system = punch(elements, |x| tilt * (x / a + 1.0) * a);
    let scale = a / (k * modulus);
    let snaps = history(
        &mut system,
        &[scale, 2.0 * scale, 3.0 * scale],
        tolerance,
        1e-3 * load / modulus,
    )?;
    let moment = |p: &[f64]| -> f64 {
        p.iter()
            .zip(&system.coupling.moment)
            .map(|(p, m)| p * m)
            .sum()
    };
    let decay = |from: f64, to: f64| (from / to).ln();
    let [first, second, third] = [0, 1, 2].map(|i| moment(&snaps[i].pressure));
    let nu = punch_eigenvalues(400, 1)[0];
    let modes = tilt_moments(&[1.0, 2.0]);
    let mut out = vec![
        Measured::relative(
            "F7",
            "tilted punch: decay of the moment from S = 1 to 2 against all modes",
            decay(first, second),
            decay(modes[0], modes[1]),
            0.01,
        ),
        Measured::relative(
            "F7",
            "tilted punch: decay of the moment from S = 2 to 3 against the first odd mode",
            decay(second, third),
            decay_rate(nu, k, modulus, a) * scale,
            0.03,
        ),
    ];
    out.push(balance("F7", &system, &snaps[2].depth, snaps[2].s));
    Ok(out)
}

/// Moment of the pressure that a small tilt adds, by its modes, at the given S (any unit).
///
/// It starts as x/√(1 − x²) (x in half widths); Johnson, Contact Mechanics (1985), section 2.7(b).
fn tilt_moments(sliding: &[f64]) -> Vec<f64> {
    let punch = PunchWear::new(300);
    let x = punch.positions();
    let half = 1.0 / x.len() as f64;
    let root = |x: f64| (1.0 - x * x).max(0.0).sqrt();
    let tilt: Vec<f64> = x
        .iter()
        .map(|x| (root(x - half) - root(x + half)) / (2.0 * half))
        .collect();
    sliding
        .iter()
        .map(|&s| {
            punch
                .history(&tilt, s)
                .iter()
                .zip(&x)
                .map(|(p, x)| p * x)
                .sum()
        })
        .collect()
}
