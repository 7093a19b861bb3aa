//! Cases E1 and E2: stiffness of a tooth pair by the formula of ISO 6336-1 and by finite elements.
//!
//! ```text
//! δ = approach · r_b1,   k = F'/δ          one tooth pair, secant
//! ```
//! Targets of E2: an independent program (quadratic triangles, Hertz pressure prescribed, displacement work-conjugate plus
//! b²/8ρ). It lets one pair carry all load; so do the values at B and D here. At C the neighbours are free to touch.

use std::f64::consts::PI;

use crate::analytic::iso6336::ToothPair;
use crate::simulate::numerics::Numerics;
use crate::verify::gear_pairs::{Bench, GearCase, Teeth};
use crate::verify::{CaseError, Measured};

/// E1: c'th, c' and c_γ of three pairs and of the standard's own example (published digits).
///
/// # Errors
/// [`CaseError`] if a pair cannot be built.
pub fn formula() -> Result<Vec<Measured>, CaseError> {
    let mut out = Vec::new();
    for (case, targets) in [
        (GearCase::reference()?, [17.284, 13.482, 20.531]),
        (GearCase::fzg_c()?, [15.776, 12.305, 16.573]),
        (GearCase::s30()?, [16.391, 12.785, 19.051]),
    ] {
        let ratio = case.pair()?.contact_ratio;
        let [pinion, gear] = case.set.gears.each_ref().map(|g| g.spec);
        let teeth = ToothPair {
            profile_shift: [pinion.profile_shift, gear.profile_shift],
            ..ToothPair::spur(pinion.teeth, gear.teeth)
        };
        let values = [teeth.theoretical(), teeth.single(), teeth.mesh(ratio)];
        for ((what, value), target) in ["c'th", "c'", "c_gamma"].iter().zip(values).zip(targets) {
            let quantity = format!("{} {what}, N/(mm µm)", case.name);
            out.push(Measured::relative("E1", quantity, value, target, 1e-4));
        }
    }
    Ok(out)
}

/// Angles on the pinion at B, C and D, µrad.
fn targets(name: &str) -> [f64; 3] {
    match name {
        "REF" => [349.63, 344.56, 346.18],
        "FZG-C" => [1029.39, 985.20, 1011.25],
        _ => [389.87, 385.93, 389.87],
    }
}

/// E2: stiffness and angle at C, and at B and D with one pair carrying all; C is the stiffest.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn single_pair(bench: &Bench) -> Result<Vec<Measured>, CaseError> {
    let name = bench.case.name;
    let [_, b, _, d, _] = bench.pair.path_points();
    let load = bench.case.load(bench.case.torque);
    let ends = bench.solve(&[b, d], bench.case.torque, Teeth::One)?;
    let angles = [
        ends.contacts[0].approach,
        at_pitch_point(bench, bench.case.torque)?,
        ends.contacts[1].approach,
    ];
    let mut out = Vec::new();
    for (i, (at, carried)) in [
        ("B", "one pair alone"),
        ("C", "all teeth"),
        ("D", "one pair alone"),
    ]
    .into_iter()
    .enumerate()
    {
        let target = targets(name)[i];
        let k = |angle: f64| 1e-3 * load / (angle * bench.pair.pinion.base_radius);
        out.push(Measured::relative(
            "E2",
            format!("{name} angle at {at}, {carried}, µrad"),
            1e6 * angles[i],
            target,
            0.015,
        ));
        out.push(Measured::relative(
            "E2",
            format!("{name} k at {at}, {carried}, N/(mm µm)"),
            k(angles[i]),
            k(1e-6 * target),
            0.015,
        ));
    }
    out.push(Measured::bound(
        "E2",
        format!("{name} C stiffer than B and D (0 if so)"),
        f64::from(u8::from(angles[1] >= angles[0].min(angles[2]))),
        0.0,
    ));
    Ok(out)
}

/// E2: B and D with all teeth under a sixteenth of the load, where the neighbours leave nearer to B and D; brought to full
/// load by the growth of a Hertz contact.
///
/// ```text
/// δ(F) = n δ(F/n) − F/(π E*) ln n          half width ∝ √F, everything else linear
/// ```
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn light_load(bench: &Bench) -> Result<Vec<Measured>, CaseError> {
    let name = bench.case.name;
    let n = 16.0_f64;
    let load = bench.case.load(bench.case.torque);
    let [_, b, _, d, _] = bench.pair.path_points();
    let [at_b, _, at_d] = targets(name);
    let mut out = Vec::new();
    for (at, from, target) in [("B", b, at_b), ("D", d, at_d)] {
        let paths: Vec<f64> = (0..=20)
            .map(|i| from * (1.0 - 0.04 * f64::from(i)))
            .collect();
        let solved = bench.solve(&paths, bench.case.torque / n, Teeth::All)?;
        let Some(q) = (0..paths.len()).find(|&q| solved.carrying(q) == 1) else {
            continue;
        };
        let hertz = load / (PI * bench.case.set.modulus()) * n.ln();
        let angle = n * solved.contacts[q].approach - hertz / bench.pair.pinion.base_radius;
        let away = (paths[q] - from).abs();
        out.push(Measured::relative(
            "E2",
            format!(
                "{name} angle {away:.2} mm inside {at}, all teeth, from 1/16 of the load, µrad"
            ),
            1e6 * angle,
            target,
            0.015,
        ));
    }
    Ok(out)
}

/// Approach at the pitch point, rad.
fn at_pitch_point(bench: &Bench, torque: f64) -> Result<f64, CaseError> {
    Ok(bench.solve(&[0.0], torque, Teeth::All)?.contacts[0].approach)
}

/// E2: k changes by at most 0.5 % with elements of half the size, and falls as the held bore gets smaller.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn bore_and_elements(bench: &Bench) -> Result<Vec<Measured>, CaseError> {
    let base = at_pitch_point(bench, bench.case.torque)?;
    let mut out = vec![halving(bench, base)?];
    for (diameter, softer) in [(20.0, true), (40.0, false)] {
        let other = Bench::new(GearCase::reference_with_bore(diameter)?, bench.numerics)?;
        let ratio = base / at_pitch_point(&other, other.case.torque)?;
        let holds = if softer { ratio < 1.0 } else { ratio > 1.0 };
        out.push(Measured {
            id: "E2",
            quantity: format!(
                "k with pinion bore {diameter} mm over k with 25 mm ({} 1)",
                if softer { "below" } else { "above" }
            ),
            value: ratio,
            target: 1.0,
            error: f64::from(u8::from(!holds)),
            tolerance: 0.0,
        });
    }
    Ok(out)
}

fn halving(bench: &Bench, base: f64) -> Result<Measured, CaseError> {
    let coarse = Numerics {
        elements_per_half_width: 0.5 * bench.numerics.elements_per_half_width,
        ..bench.numerics
    };
    let half = Bench::new(bench.case.clone(), coarse)?;
    let other = at_pitch_point(&half, half.case.torque)?;
    Ok(Measured::relative(
        "E2",
        format!(
            "{} angle at C with {} against {} flank edges per half width, µrad",
            bench.case.name, bench.numerics.elements_per_half_width, coarse.elements_per_half_width
        ),
        1e6 * base,
        1e6 * other,
        0.005,
    ))
}
