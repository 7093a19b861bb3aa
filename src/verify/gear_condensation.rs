//! Case `recondensation`: what changes if the members' compliance is condensed again on the worn meshes.

use crate::gear::Member;
use crate::simulate::forward::{ContactKind, Forward, Preparation};
use crate::simulate::history::Progress;
use crate::simulate::touching_strip::TouchingStrip;
use crate::simulate::wear_state::line_load;
use crate::verify::{CaseError, Measured};

/// Distance from the pitch point up to which peak pressures are held to the tighter bound, mm along the path of contact.
const INNER_PATH: f64 = 4.2;

/// Peaks below this are left out, MPa: a corner about to leave contact.
const LEAST_PEAK: f64 = 50.0;

/// Contact at `progress` with the old and with new condensations; `forward` is left as it was.
///
/// # Errors
/// [`CaseError`] if the worn members cannot be condensed.
pub fn effect(forward: &mut Forward, progress: &Progress) -> Result<Vec<Measured>, CaseError> {
    let before = forward.state(progress).map_err(CaseError::gears)?;
    let old = forward.preparation();
    let new = Preparation {
        condensed_at: Some(progress.stand.u.clone()),
        ..old.clone()
    };
    forward.prepare(&new).map_err(CaseError::gears)?;
    let after = forward.state(progress).map_err(CaseError::gears)?;
    let load = forward.torque() / forward.cycle().pair.pinion.base_radius;
    let (mut share, mut inner, mut any) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (position, (a, b)) in forward
        .cycle()
        .positions
        .iter()
        .zip(before.contacts.iter().zip(&after.contacts))
    {
        for pair in &position.pairs {
            share = share.max((line_load(pair, a) - line_load(pair, b)).abs() / load);
            let peak = |pressure: &[f64]| {
                let own = &pressure[pair.offset..pair.offset + pair.xi.len()];
                TouchingStrip::of(ContactKind::Fem, forward.cycle(), pair, own).peak_pressure
            };
            let (x, y) = (peak(&a.pressure), peak(&b.pressure));
            if x > LEAST_PEAK {
                let change = (y / x - 1.0).abs();
                any = any.max(change);
                if pair.path.abs() <= INNER_PATH {
                    inner = inner.max(change);
                }
            }
        }
    }
    let rate = wear_rates(forward, progress)?;
    forward.prepare(&old).map_err(CaseError::gears)?;
    let old_rate = wear_rates(forward, progress)?;
    let worst = |v: &[f64]| v.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
    let change: Vec<f64> = rate.iter().zip(&old_rate).map(|(a, b)| a - b).collect();
    let depth = 1e3 * worst(&progress.stand.u);
    let bound = |what: &str, value: f64, limit: f64| {
        Measured::bound(
            "recondensation",
            format!("after {depth:.1} µm: {what}"),
            value,
            limit,
        )
    };
    Ok(vec![
        bound("change of load shares", share, 5e-4),
        bound(
            "relative change of peak pressures within 4.2 mm of C",
            inner,
            0.005,
        ),
        bound("relative change of any peak pressure", any, 0.03),
        bound(
            "change of wear rates over the largest (no gate)",
            worst(&change) / worst(&old_rate),
            1.0,
        ),
    ])
}

fn wear_rates(forward: &Forward, progress: &Progress) -> Result<Vec<f64>, CaseError> {
    use crate::wear::archard::ArchardSystem;
    use crate::wear::integrator::WearSystem;
    let rates = forward
        .with_model(|m| ArchardSystem::new(m, [1.0; 2]).rate(0.0, &progress.stand.u))
        .map_err(CaseError::gears)?;
    rates.map_err(CaseError::gears)
}

/// Wear between condensations of the finer run, mm.
const STEP: f64 = 0.004;

/// Depth after the cycles of `progress` if the members are condensed again after every 4 µm of wear, against `progress`
/// (fresh members throughout): largest change over the largest depth.
///
/// # Errors
/// [`CaseError`] if the run stops early.
pub fn condensed_often(forward: &mut Forward, progress: &Progress) -> Result<Measured, CaseError> {
    let old = forward.preparation();
    let (mut finer, mut next) = (None, STEP);
    loop {
        let reached = |p: &Progress| p.max_depth.iter().any(|d| *d >= next);
        let done = forward
            .wear_to(&mut finer, progress.stand.n, &mut |_, p| !reached(p))
            .map_err(CaseError::gears)?;
        let Some(p) = finer.as_ref().filter(|_| !done) else {
            break;
        };
        next = p.max_depth.iter().fold(0.0, |m: f64, d| m.max(*d)) + STEP;
        let again = Preparation {
            condensed_at: Some(p.stand.u.clone()),
            ..forward.preparation()
        };
        forward.prepare(&again).map_err(CaseError::gears)?;
    }
    forward.prepare(&old).map_err(CaseError::gears)?;
    let largest = progress.max_depth.iter().fold(0.0, |m: f64, d| m.max(*d));
    // inside the flank: the sharp corners' own stations hold whatever the last element makes of them
    let cycle = forward.cycle();
    let module = cycle.pair.pinion.rack.module;
    let inside = Member::BOTH.iter().enumerate().flat_map(|(side, &member)| {
        let gear = cycle.pair.member(member);
        let active = cycle.pair.path_points()[4 * side];
        let from = gear.arc(cycle.pair.rho(member, active)) + 0.12 * module;
        let to = gear.arc(gear.rho_at_radius(gear.tip_radius - 0.15 * module));
        cycle.stations.arc[side]
            .iter()
            .map(move |s| (from..to).contains(s))
    });
    let change = finer.map_or(f64::NAN, |f| {
        (f.stand.u.iter().zip(&progress.stand.u))
            .zip(inside)
            .filter(|(_, inside)| *inside)
            .fold(0.0, |m: f64, ((a, b), _)| m.max((a - b).abs()))
    });
    Ok(Measured::bound(
        "recondensation",
        format!(
            "change of depth inside the flank over the largest at {:.1} µm, condensed every 4 µm against never",
            1e3 * largest
        ),
        change / largest,
        2e-4,
    ))
}
