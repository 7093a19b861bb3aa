//! Case F9: wear of gear flanks per pass against the closed form, by the analytic module and through the whole pipeline.
//!
//! ```text
//! h1 = k F'(y) |1 − v2/v1|,   h2 = k F'(y) |1 − v1/v2|     per pass; the gear's teeth pass z1/z2 times per pinion cycle
//! ```
//! F'(y) is the solved line load, so only the bookkeeping of pressure, sliding and time is judged.

mod pass;

use self::pass::{FreshRate, Pass};
use crate::analytic::archard_pass::{depth_per_pass, linear_load_share};
use crate::gear::Member;
use crate::numeric::interpolate;
use crate::simulate::forward::{Conditions, Forward};
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::wear_state::worn_area;
use crate::verify::gear_pairs::GearCase;
use crate::verify::{CaseError, Measured, gear_condensation};
use crate::wear::archard::ArchardSystem;
use crate::wear::integrator::WearSystem;

/// Wear per k and pass at A, B (2/3), B (1), D (1), E by the linear share, N/mm.
type Table = [[f64; 5]; 2];

/// The analytic module against specific sliding times load (1e-6) and against the tabulated first-cycle values.
///
/// # Errors
/// [`CaseError`] if a pair cannot be built.
pub fn formula() -> Result<Vec<Measured>, CaseError> {
    let tables: [(GearCase, f64, Table); 2] = [
        (
            GearCase::reference()?,
            100e3,
            [
                [77.774, 16.140, 24.210, 12.616, 20.584],
                [26.333, 13.420, 20.130, 14.106, 42.619],
            ],
        ),
        (
            GearCase::fzg_c()?,
            372.6e3,
            [
                [984.71, 295.83, 443.75, 269.19, 179.68],
                [207.09, 189.15, 283.72, 409.21, 570.71],
            ],
        ),
    ];
    let mut out = Vec::new();
    for (case, torque, table) in tables {
        let pair = case.pair()?;
        let load = case.load(torque);
        let limits = [pair.rho_a, pair.rho_b, pair.rho_d, pair.rho_e];
        let share = |rho: f64| linear_load_share(rho, limits);
        let places = [
            ("A", pair.rho_a, share(pair.rho_a)),
            ("B (2/3)", pair.rho_b, share(pair.rho_b - 1e-9)),
            ("B (1)", pair.rho_b, share(pair.rho_b)),
            ("D (1)", pair.rho_d, share(pair.rho_d)),
            ("E", pair.rho_e, share(pair.rho_e)),
        ];
        let mut worst = 0.0_f64;
        for (column, (at, rho, share)) in places.into_iter().enumerate() {
            let path = rho - pair.rho_c;
            let speeds = [rho, pair.rho_gear(path) / pair.speed_ratio];
            for (side, member) in Member::BOTH.into_iter().enumerate() {
                let depth = depth_per_pass(1.0, share * load, speeds[side], speeds[1 - side]);
                let sliding = share * load * pair.sliding_ratio(member, path).abs();
                worst = worst.max((depth / sliding - 1.0).abs());
                let quantity = format!("{} {member} h/k at {at}, N/mm", case.name);
                let target = table[side][column];
                out.push(Measured::relative("F9", quantity, depth, target, 1e-4));
            }
        }
        out.push(Measured::bound(
            "F9",
            format!(
                "{} depth per pass over k F' |specific sliding|, minus 1",
                case.name
            ),
            worst,
            1e-6,
        ));
    }
    Ok(out)
}

/// F9 through the deposit of one pass on fresh flanks, by finite elements if there are `members`, else with Hertz pressures.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn one_pass(
    case: &GearCase,
    members: Option<&Members>,
    numerics: Numerics,
) -> Result<Vec<Measured>, CaseError> {
    let forward = Forward::new(&case.set, members, conditions(case, 1.0), numerics)
        .map_err(CaseError::gears)?;
    let fresh = forward
        .with_model(FreshRate::new)
        .map_err(CaseError::gears)??;
    let arc = &forward.cycle().stations.arc;
    let pass = Pass {
        fresh: &fresh,
        pair: &forward.cycle().pair,
        load: case.load(case.torque),
        modulus: case.set.modulus(),
    };
    let by = if members.is_some() {
        "FE"
    } else {
        "Hertz model"
    };
    let name = format!("{} {by}", case.name);
    let mut out = Vec::new();
    for (side, member) in Member::BOTH.into_iter().enumerate() {
        // the 3 % are asked of finite elements; the analytic closed form is held to 1e-6 by itself, and the analytic
        // contact's share jumps between two positions, which its carried rates smooth (measured: up to 3.6 %)
        if members.is_some() {
            out.extend(pass.deviations(member, &arc[side], &name));
        }
        out.push(Measured::relative(
            "F9",
            format!("{name} {member} worn area of a pass over k and load times sliding"),
            worn_area(&arc[side], &fresh.rate[side]),
            pass.per_cycle(member) * fresh.sliding_work,
            0.005,
        ));
    }
    out.push(pass.at_pitch_point(&arc[0], &name));
    Ok(out)
}

fn conditions(case: &GearCase, k: f64) -> Conditions {
    Conditions {
        torque: case.torque,
        speed: 2000.0,
        misalignment: 0.0,
        cycles: 1e6,
        coefficient: [k; 2],
    }
}

/// F1, F9 (feedback) and the effect of condensing again, along one wear run of REF: k 4.7e-10 mm²/N, 1e6 pinion cycles.
///
/// # Errors
/// [`CaseError`] if the run stops early.
pub fn history(
    case: &GearCase,
    members: &Members,
    numerics: Numerics,
) -> Result<Vec<Measured>, CaseError> {
    let k = 4.7e-10;
    let mut forward = Forward::new(&case.set, Some(members), conditions(case, k), numerics)
        .map_err(CaseError::gears)?;
    let mut progress = None;
    let condensed_again_at = numerics.condense_after * forward.cycle().pair.pinion.rack.module;
    forward
        .wear_to(&mut progress, 1e6, &mut |_, p| {
            p.max_depth.iter().all(|d| *d < condensed_again_at)
        })
        .map_err(CaseError::gears)?;
    let mut out = match &progress {
        Some(progress) => {
            let mut out = gear_condensation::effect(&mut forward, progress)?;
            out.push(gear_condensation::condensed_often(&mut forward, progress)?);
            out
        }
        None => Vec::new(),
    };
    let fresh = vec![0.0; forward.cycle().stations.count()];
    let rate = |forward: &Forward, u: &[f64]| {
        let rates = forward
            .with_model(|m| ArchardSystem::new(m, [k; 2]).rate(0.0, u))
            .map_err(CaseError::gears)?;
        rates.map_err(CaseError::gears)
    };
    let first = rate(&forward, &fresh)?;
    let mut balance = 0.0_f64;
    forward
        .wear_to(&mut progress, 1e6, &mut |_, p| {
            balance = balance.max(p.balance.error());
            true
        })
        .map_err(CaseError::gears)?;
    let Some(progress) = progress else {
        return Ok(out);
    };
    let last = rate(&forward, &progress.stand.u)?;
    out.push(Measured::bound(
        "F1",
        "REF worst balance of worn area along the run",
        balance,
        0.005,
    ));
    let pair = &forward.cycle().pair;
    let arc = &forward.cycle().stations.arc;
    let split = arc[0].len();
    let places = [
        ("pinion at A", 0, pair.pinion.arc(pair.rho_a)),
        ("gear at A", 1, pair.gear.arc(pair.gear.rho_end)),
        ("pinion at E", 0, pair.pinion.arc(pair.pinion.rho_end)),
        ("gear at E", 1, pair.gear.arc(pair.line_length - pair.rho_e)),
    ];
    for (what, side, s) in places {
        let own = |v: &[f64]| {
            let part = if side == 0 { &v[..split] } else { &v[split..] };
            interpolate(&arc[side], part, s)
        };
        out.push(Measured {
            id: "F9",
            quantity: format!(
                "wear rate of the {what} after 1e6 cycles over the first (must fall; largest depth {:.1} µm)",
                1e3 * progress.max_depth.iter().fold(0.0, |m: f64, d| m.max(*d))
            ),
            value: own(&last) / own(&first),
            target: 1.0,
            error: f64::from(u8::from(own(&last) >= own(&first))),
            tolerance: 0.0,
        });
    }
    Ok(out)
}
