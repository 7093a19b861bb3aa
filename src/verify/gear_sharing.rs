//! Case E3: how two tooth pairs share the load, and the loaded transmission error over the mesh cycle.
//!
//! Targets: an independent program's 2 x 2 compliance of both gears with contact on the line of action only. Here tip
//! corners may touch outside it as well.

use crate::gear::{Gear, Pair};
use crate::verify::gear_pairs::{Bench, Teeth};
use crate::verify::{CaseError, Measured};

/// Fraction of AB, share of the entering pair, angle in µrad.
fn targets(name: &str) -> [(f64, f64, f64); 3] {
    match name {
        "REF" => [
            (0.05, 0.405, 248.12),
            (0.5, 0.491, 241.47),
            (0.95, 0.582, 247.65),
        ],
        "FZG-C" => [
            (0.05, 0.412, 730.01),
            (0.5, 0.490, 718.60),
            (0.95, 0.571, 729.32),
        ],
        _ => [
            (0.05, 0.413, 295.26),
            (0.5, 0.500, 289.80),
            (0.95, 0.586, 295.30),
        ],
    }
}

/// Shares within 0.02, transmission error within 3 %, its peak to peak within 5 %.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn shares(bench: &Bench, positions: usize) -> Result<Vec<Measured>, CaseError> {
    let name = bench.case.name;
    let [a, b, ..] = bench.pair.path_points();
    let rows = targets(name);
    let paths: Vec<f64> = rows.iter().map(|(f, ..)| a + f * (b - a)).collect();
    let solved = bench.solve(&paths, bench.case.torque, Teeth::All)?;
    let torque = bench.case.torque / bench.case.set.face_width;
    let mut out = Vec::new();
    let mut sum_error = 0.0_f64;
    for (q, (fraction, share, angle)) in rows.into_iter().enumerate() {
        let found = solved.torque(q, solved.pair(q, paths[q])) / torque;
        let all: f64 = solved.cycle.positions[q]
            .pairs
            .iter()
            .map(|p| solved.torque(q, p))
            .sum();
        sum_error = sum_error.max((all / torque - 1.0).abs());
        out.push(Measured::absolute(
            "E3",
            format!("{name} share of the entering pair at {fraction} AB"),
            found,
            share,
            0.02,
        ));
        out.push(Measured::relative(
            "E3",
            format!("{name} transmission error at {fraction} AB, µrad"),
            1e6 * solved.contacts[q].approach,
            angle,
            0.03,
        ));
    }
    out.push(Measured::bound(
        "E3",
        format!("{name} sum of shares, minus 1"),
        sum_error,
        1e-6,
    ));
    let target = match name {
        "REF" => 108.0,
        "FZG-C" => 311.0,
        _ => 100.0,
    };
    out.push(Measured::relative(
        "E3",
        format!(
            "{name} transmission error, peak to peak, contact on the line of action only, µrad"
        ),
        nominal_range(bench)?,
        target,
        0.05,
    ));
    // corner contact takes load off before B, so the nominal peak at B is never reached: the case list allows 8 %
    out.push(Measured::relative(
        "E3",
        format!("{name} transmission error, peak to peak, tip corners included, µrad"),
        peak_to_peak(bench, positions)?,
        target,
        0.08,
    ));
    Ok(out)
}

/// Angle of one pair alone at B less that of both in the middle of AB, µrad: what the independent program's figure is made of.
fn nominal_range(bench: &Bench) -> Result<f64, CaseError> {
    let [a, b, ..] = bench.pair.path_points();
    let torque = bench.case.torque;
    let alone = bench.solve(&[b], torque, Teeth::One)?.contacts[0].approach;
    let both = bench.solve(&[0.5 * (a + b)], torque, Teeth::All)?.contacts[0].approach;
    Ok(1e6 * (alone - both))
}

/// Largest minus smallest transmission error over the cycle, µrad.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn peak_to_peak(bench: &Bench, positions: usize) -> Result<f64, CaseError> {
    let (low, high) = range(bench, &bench.pair, positions, bench.case.torque)?;
    Ok(1e6 * (high - low))
}

fn range(
    bench: &Bench,
    pair: &Pair,
    positions: usize,
    torque: f64,
) -> Result<(f64, f64), CaseError> {
    let pitch = bench.pair.base_pitch;
    let [a, b, _, d, _] = bench.pair.path_points();
    let mut paths: Vec<f64> = (0..positions)
        .map(|i| pitch * (i as f64 + 0.5) / positions as f64)
        .collect();
    paths.extend([0.5 * (a + b), b, 0.98 * b, 0.0, 0.98 * d, d]);
    let solved = bench.solve_as(pair, &paths, torque, Teeth::All)?;
    let all = solved.contacts.iter().map(|c| c.approach);
    Ok(all.fold((f64::INFINITY, 0.0), |(l, h), x| (l.min(x), h.max(x))))
}

/// Double load, tip relief, and how far contact reaches beyond the path of contact.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn behaviour(bench: &Bench, positions: usize) -> Result<Vec<Measured>, CaseError> {
    let torque = bench.case.torque;
    let mut out = Vec::new();
    let at = |t: f64| -> Result<f64, CaseError> {
        Ok(bench.solve(&[0.0], t, Teeth::All)?.contacts[0].approach)
    };
    let single = at(torque)?;
    // +1 to +6 %
    out.push(Measured::absolute(
        "E3",
        "k at C at twice the load over k",
        2.0 * single / at(2.0 * torque)?,
        1.035,
        0.025,
    ));
    out.push(extension(bench)?);
    let base_radius = bench.pair.pinion.base_radius;
    let changed = relieved(bench, single * base_radius)?;
    let plain = range(bench, &bench.pair, positions, torque)?;
    let eased = range(bench, &changed, positions, torque)?;
    out.push(Measured::bound(
        "E3",
        // a figure of 0.6 is quoted from memory in the case list; only the direction is a gate
        "peak to peak with tip reliefs of the deflection from B and D, over unmodified (must fall)",
        (eased.1 - eased.0) / (plain.1 - plain.0),
        1.0,
    ));
    Ok(out)
}

/// Perfect involutes transmit without error as the load vanishes; what is left is the contact grid's own error, second order
/// in its spacing, so it takes a fine grid.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn light_load(bench: &Bench, positions: usize) -> Result<Vec<Measured>, CaseError> {
    let (low, high) = range(bench, &bench.pair, positions, 1e-6 * bench.case.torque)?;
    let bound = |what: &str, value: f64| {
        Measured::bound(
            "E3",
            format!("{what} at 1e-6 of the load, µrad"),
            value,
            0.01,
        )
    };
    Ok(vec![
        bound("variation of the transmission error", 1e6 * (high - low)),
        bound("largest transmission error", 1e6 * high),
    ])
}

/// The pair with tip reliefs of `amount` (mm) that begin where single contact ends.
fn relieved(bench: &Bench, amount: f64) -> Result<Pair, CaseError> {
    let length = bench.pair.rho_e - bench.pair.rho_d;
    let gear = |plain: &Gear| {
        let spec = crate::gear::ToothSpec {
            tip_relief_amount: amount,
            tip_relief_length: length,
            ..plain.spec
        };
        Gear::new(plain.rack, spec).map_err(CaseError::gears)
    };
    Pair::new(
        gear(&bench.pair.pinion)?,
        gear(&bench.pair.gear)?,
        bench.pair.centre_distance,
        0.0,
    )
    .map_err(CaseError::gears)
}

/// How far before A the gear's tip corner still carries load, in base pitches: below 0.2 and above 0.
fn extension(bench: &Bench) -> Result<Measured, CaseError> {
    let [a, ..] = bench.pair.path_points();
    let pitch = bench.pair.base_pitch;
    let paths: Vec<f64> = (1..=40).map(|i| a - 0.005 * f64::from(i) * pitch).collect();
    let solved = bench.solve(&paths, bench.case.torque, Teeth::All)?;
    let reach = (0..paths.len())
        .take_while(|&q| {
            (solved.pair(q, paths[q]).path - paths[q]).abs() < 1e-6
                && solved.load(q, paths[q]) > 0.0
        })
        .count();
    Ok(Measured::absolute(
        "E3",
        format!(
            "{} contact before A, base pitches (no target)",
            bench.case.name
        ),
        0.005 * reach as f64,
        0.1,
        0.0995,
    ))
}
