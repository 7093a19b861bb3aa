//! What is measured in a test unless somebody says otherwise: where, when, and what an instrument reads of nothing.
//!
//! Made-up measurements and tests that are only planned are measured alike.

use crate::gear::{Member, Pair};
use crate::measure::{Observation, Quantity, Subject, Trace};
use crate::study::Study;

/// Points of a trace along a flank.
const POINTS: usize = 41;
/// Arc left out at the root end and at the tip end of the active flank, modules.
const MARGINS: [f64; 2] = [0.12, 0.15];
/// When is measured, as shares of a test's cycles.
const CHECKPOINTS: [f64; 5] = [0.1, 0.25, 0.5, 0.75, 1.0];
/// Positions of a transmission error over the base pitch.
const TURNS: usize = 24;
/// Noise of an instrument that measures nothing, µm.
const FLOOR_UM: f64 = 0.02;

/// The rows of test number `test` of the name `id`, without values: depths along both flanks and masses at every checkpoint, a transmission
/// error at the end. Its traces join `traces`.
pub(in crate::learn) fn rows(
    (test, id): (usize, &str),
    pair: &Pair,
    cycles: f64,
    traces: &mut Vec<Trace>,
) -> Vec<Observation> {
    let mut times: Vec<f64> = CHECKPOINTS
        .iter()
        .map(|share| (share * cycles).round())
        .filter(|&time| time >= 1.0 && time <= cycles)
        .collect();
    times.dedup();
    if times.is_empty() {
        times.push(cycles);
    }
    let mut rows = Vec::new();
    for (checkpoint, &cycles) in times.iter().enumerate() {
        for member in Member::BOTH {
            let row = |quantity, position, trace| Observation {
                test,
                member: member.into(),
                cycles,
                quantity,
                position,
                value: 0.0,
                sigma: 1.0,
                trace,
                face: None,
                tooth: None,
                line: 0,
            };
            let trace = Some(traces.len());
            traces.push(Trace {
                name: format!("{id}-{}-{}", member.name(), checkpoint + 1),
                quantity: Quantity::WearDepth,
                line: 0,
            });
            rows.extend(radii(pair, member).map(|r| row(Quantity::WearDepth, Some(r), trace)));
            rows.push(row(Quantity::MassLoss, None, None));
        }
    }
    let last = rows[rows.len() - 1].clone();
    rows.extend((0..TURNS).map(|i| Observation {
        member: Subject::Pair,
        quantity: Quantity::TransmissionError,
        // rounded as it is written
        position: Some((1e4 * i as f64 / TURNS as f64).round() / 1e4),
        ..last.clone()
    }));
    rows
}

/// 0.02 µm in the unit of an observation's quantity: a mass by the worn flanks' area, an angle by the gear's base radius.
pub(in crate::learn) fn floor(o: &Observation, study: &Study, pair: &Pair) -> f64 {
    match o.quantity {
        Quantity::MassLoss => {
            let member = o.member.member().unwrap_or(Member::Pinion);
            let density = match member {
                Member::Pinion => study.materials.pinion.density_kg_m3,
                Member::Gear => study.materials.gear.density_kg_m3,
            };
            let [from, to] = active_arcs(pair, member);
            let teeth = f64::from(pair.member(member).spec.teeth);
            // mm³ · kg/m³ = µg
            1e-3 * (1e-3 * FLOOR_UM) * (to - from) * study.gears.face_width * teeth * density
        }
        // µm over mm = 1e-3 rad
        Quantity::TransmissionError => 1e3 * FLOOR_UM / pair.gear.base_radius,
        Quantity::MeanLag => 1e3 * FLOOR_UM / pair.pinion.base_radius,
        _ => FLOOR_UM,
    }
}

/// Arcs where the active flank begins and ends, mm.
fn active_arcs(pair: &Pair, member: Member) -> [f64; 2] {
    let [a, .., e] = pair.path_points();
    let gear = pair.member(member);
    let ends = [a, e].map(|path| gear.arc(pair.rho(member, path)));
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}

/// Radii inside the active flank, equally far apart along it, mm, with three decimals as they are written.
fn radii(pair: &Pair, member: Member) -> impl Iterator<Item = f64> {
    let gear = pair.member(member).clone();
    let [from, to] = active_arcs(pair, member);
    let module = gear.rack.module;
    let [root, tip] = MARGINS.map(|margin| (margin * module).min(0.2 * (to - from)));
    let (from, to) = (from + root, to - tip);
    (0..POINTS).map(move |i| {
        let arc = from + (to - from) * i as f64 / (POINTS - 1) as f64;
        let radius = gear.radius_at_rho(gear.rho_at_arc(arc));
        (1e3 * radius).round() / 1e3
    })
}
