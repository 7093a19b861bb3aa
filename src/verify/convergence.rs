//! Numerical error of the worn depth: one history at the default resolution against the same with one resolution doubled.
//!
//! Spur pair of 27 and 53 teeth, module 2 mm, 100 N·m, face width 33 mm, bores 25 and 40 mm, k 4.7e-10 mm²/N, 1e6 pinion
//! revolutions. The figure is the largest change of depth inside the flank over the largest depth there, per member.
//!
//! Left out are the ends of the flank, where the mate's tip corner digs in and the depth has a singular peak:
//! 0.12 module of arc above the start of the active profile and 0.15 module of radius below the tip.

use crate::gear::{BasicRack, Gear, GearError, Member, Pair, ToothSpec};
use crate::material::Elastic;
use crate::numeric::interpolate;
use crate::simulate::forward::{Conditions, Forward, ForwardError, GearSet};
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::verify::Measured;

/// Cases: flank spacing, mesh positions, wear steps.
pub const IDS: [&str; 3] = [
    "convergence.spacing",
    "convergence.positions",
    "convergence.steps",
];

/// Why the tolerance is what it is.
pub const REASON: &str = "0.2 % of the largest depth, the bound set for the default resolution";

/// Why the histories have no result.
#[derive(Debug, thiserror::Error)]
pub enum ConvergenceError {
    /// A gear of the pair.
    #[error(transparent)]
    Gear(#[from] GearError),
    /// A history.
    #[error(transparent)]
    Forward(#[from] ForwardError),
}

/// Largest change that passes, over the largest depth.
const TOLERANCE: f64 = 2e-3;

/// Radii at which the depths are compared.
const POINTS: usize = 400;

const MODULE: f64 = 2.0;
pub(super) const TORQUE: f64 = 100e3;
const CYCLES: f64 = 1e6;

/// Worn depths of both members at the compared radii, mm.
type Depths = [Vec<f64>; 2];

/// Runs the histories and compares them.
///
/// # Errors
/// [`ConvergenceError`] if a history does not come to its end.
pub fn all() -> Result<Vec<Measured>, ConvergenceError> {
    let set = set()?;
    let base = Numerics::default();
    let fine = Numerics {
        elements_per_half_width: 2.0 * base.elements_per_half_width,
        ..base
    };
    let often = Numerics {
        positions: 2 * base.positions,
        ..base
    };
    let careful = Numerics {
        step_tolerance: 0.5 * base.step_tolerance,
        ..base
    };
    let members = members(&set, &base)?;
    let reference = history(&set, &members, base)?;
    let mut out = Vec::new();
    let mut compare = |id, what: String, changed: &Depths| {
        for (member, (before, after)) in Member::BOTH.iter().zip(reference.iter().zip(changed)) {
            let most = before.iter().fold(0.0, |m: f64, d| m.max(*d));
            out.push(Measured::bound(
                id,
                format!(
                    "{} depth over its largest ({:.3} µm): {what}",
                    member.name(),
                    most * 1e3
                ),
                change(before, after) / most,
                TOLERANCE,
            ));
        }
    };
    let finer = self::members(&set, &fine)?;
    compare(
        IDS[0],
        format!(
            "{} to {} edges per half width",
            base.elements_per_half_width, fine.elements_per_half_width
        ),
        &history(&set, &finer, fine)?,
    );
    drop(finer);
    compare(
        IDS[1],
        format!("{} to {} mesh positions", base.positions, often.positions),
        &history(&set, &members, often)?,
    );
    compare(
        IDS[2],
        format!(
            "step tolerance {:e} to {:e}",
            base.step_tolerance, careful.step_tolerance
        ),
        &history(&set, &members, careful)?,
    );
    Ok(out)
}

pub(super) fn set() -> Result<GearSet, GearError> {
    let rack = BasicRack {
        module: MODULE,
        pressure_angle: 20f64.to_radians(),
        addendum: 1.0,
        dedendum: 1.25,
        fillet_radius: 0.38,
    };
    let steel = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };
    Ok(GearSet {
        gears: [
            Gear::new(rack, ToothSpec::plain(27, 25.0))?,
            Gear::new(rack, ToothSpec::plain(53, 40.0))?,
        ],
        materials: [steel; 2],
        densities: [7850.0; 2],
        centre_distance: 80.0,
        face_width: 33.0,
        face: crate::gear::Face::default(),
        teeth: crate::gear::Teeth::default(),
    })
}

pub(super) fn members(set: &GearSet, numerics: &Numerics) -> Result<Members, ForwardError> {
    set.members(numerics, &[TORQUE], &[0.0])
}

fn history(set: &GearSet, members: &Members, numerics: Numerics) -> Result<Depths, ForwardError> {
    let conditions = Conditions {
        torque: TORQUE,
        speed: 2000.0,
        misalignment: 0.0,
        cycles: CYCLES,
        coefficient: [4.7e-10; 2],
    };
    let mut forward = Forward::new(set, Some(members), conditions, numerics)?;
    let (mut progress, mut depth) = (None, [Vec::new(), Vec::new()]);
    forward.wear(&mut progress, &[CYCLES], &mut |_| true, &mut |state| {
        depth = state.depth
    })?;
    let cycle = forward.cycle();
    Ok([Member::Pinion, Member::Gear].map(|member| {
        let side = member as usize;
        let gear = cycle.pair.member(member);
        let radius: Vec<f64> = cycle.stations.arc[side]
            .iter()
            .map(|arc| gear.radius_at_rho(gear.rho_at_arc(*arc)))
            .collect();
        radii(&cycle.pair, member)
            .map(|r| interpolate(&radius, &depth[side], r))
            .collect()
    }))
}

/// The radii compared on a member, mm.
fn radii(pair: &Pair, member: Member) -> impl Iterator<Item = f64> {
    let gear = pair.member(member);
    let active = match member {
        Member::Pinion => pair.rho_a,
        Member::Gear => pair.line_length - pair.rho_e,
    };
    let first = gear.radius_at_rho(gear.rho_at_arc(gear.arc(active) + 0.12 * MODULE));
    let last = gear.tip_radius - 0.15 * MODULE;
    (0..=POINTS).map(move |i| first + (last - first) * i as f64 / POINTS as f64)
}

fn change(before: &[f64], after: &[f64]) -> f64 {
    before
        .iter()
        .zip(after)
        .fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}
