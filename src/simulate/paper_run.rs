//! A run by the published model: the pinion alone, at its own fifty points.

use std::time::Instant;

use crate::gear::Pair;
use crate::paper::{self, Inputs, Outcome};
use crate::simulate::forward::{Conditions, GearSet};
use crate::simulate::gather;
use crate::simulate::result::{
    Cost, Friction, PairState, PositionState, Profile, Run, Sliding, State,
};
use crate::simulate::run::{Plan, RunError, pair_of};
use crate::simulate::stated;

/// Speeds the paper prints: its gear turns at half the pinion's speed, which its wear numbers need.
const PRINTED: ([u32; 2], [f64; 2]) = ([27, 53], [2000.0, 1000.0]);

/// The published model's inputs for a gear set and its conditions; the printed gear speed for the paper's own pair, the true
/// one for others.
///
/// The model knows no profile shift, relief or rounding beyond the tip radii, and one wear coefficient, the pinion's.
pub fn inputs(set: &GearSet, conditions: &Conditions) -> Inputs {
    let [pinion, gear] = &set.gears;
    let teeth = [pinion.spec.teeth, gear.spec.teeth];
    let speed = conditions.speed;
    let printed = teeth == PRINTED.0 && speed == PRINTED.1[0];
    Inputs {
        teeth,
        module: pinion.rack.module,
        pressure_angle: pinion.rack.pressure_angle,
        tip_radius: [pinion.tip_radius, gear.tip_radius],
        face_width: set.face_width,
        torque: conditions.torque,
        speed: if printed {
            PRINTED.1
        } else {
            [speed, speed * f64::from(teeth[0]) / f64::from(teeth[1])]
        },
        k: conditions.coefficient[0],
        youngs_modulus: set.materials.map(|m| m.youngs_modulus),
        poisson_ratio: set.materials.map(|m| m.poisson_ratio),
        centre_distance: set.centre_distance,
        misalignment: conditions.misalignment,
        cycles: conditions.cycles.round() as u64,
        ..Inputs::default()
    }
}

/// Runs `plan` by the published model.
///
/// # Errors
/// [`RunError`] if the pair cannot run or lies outside what the model covers.
pub fn run(plan: &Plan) -> Result<Run, RunError> {
    let begun = Instant::now();
    let pair = pair_of(plan)?;
    let inputs = inputs(plan.set, &plan.conditions);
    let stops: Vec<u64> = (0..=plan.stored_states)
        .map(|i| inputs.cycles * i as u64 / plan.stored_states as u64)
        .collect();
    let outcome = paper::run_with_states(&inputs, &stops)?;
    let states = outcome
        .states
        .iter()
        .map(|state| State {
            cycles: state.cycles as f64,
            pinion: profile(&pair, &inputs, &outcome, state, plan.set.densities[0]),
            gear: Profile::default(),
            cycle: mesh_cycle(&pair, &inputs, &outcome, state),
            slices: Vec::new(),
            teeth: Vec::new(),
            turn: Vec::new(),
        })
        .collect();
    let mut conditions = gather::conditions(plan);
    conditions.model = "paper".to_owned();
    conditions.friction = Friction::default();
    Ok(Run {
        title: plan.title.to_owned(),
        conditions,
        geometry: gather::geometry(&pair, plan.set.face_width, 0.0),
        made: stated::made(plan),
        mesh: None,
        states,
        fields: Vec::new(),
        root_stress: None,
        balance_error: 0.0,
        checks: Vec::new(),
        cost: Cost {
            seconds: begun.elapsed().as_secs_f64(),
            wear_steps: inputs.cycles as usize,
            threads: rayon::current_num_threads(),
            ..Cost::default()
        },
    })
}

/// The worn flank of the pinion, of a material with this density, kg/m³.
fn profile(
    pair: &Pair,
    inputs: &Inputs,
    outcome: &Outcome,
    state: &paper::State,
    density: f64,
) -> Profile {
    let volume_per_area = inputs.face_width * f64::from(inputs.teeth[0]);
    let radius: Vec<f64> = outcome.points.iter().map(|p| p.radius).collect();
    let depth: Vec<f64> = state.points.iter().map(|p| 1e3 * p.depth).collect();
    let arc: Vec<f64> = radius
        .iter()
        .map(|r| pair.pinion.arc(pair.pinion.rho_at_radius(*r)))
        .collect();
    let area: f64 = arc
        .windows(2)
        .zip(depth.windows(2))
        .map(|(s, h)| 0.5e-3 * (s[1] - s[0]) * (h[0] + h[1]))
        .sum();
    Profile {
        path: outcome.points.iter().map(|p| p.y).collect(),
        radius,
        depth,
        worn_area_mm2: area,
        mass_loss_mg: 1e-3 * area * volume_per_area * density,
    }
}

/// The loaded points, each as a position of the mesh cycle with one pair in contact.
fn mesh_cycle(
    pair: &Pair,
    inputs: &Inputs,
    outcome: &Outcome,
    state: &paper::State,
) -> Vec<PositionState> {
    let full = inputs.torque / (outcome.geometry.base_radius[0] * inputs.face_width);
    let loaded = outcome
        .points
        .iter()
        .zip(&state.points)
        .filter(|(p, _)| p.load_per_width > 0.0);
    let mut cycle: Vec<PositionState> = loaded
        .map(|(point, now)| {
            let turns = point.y / pair.base_pitch;
            PositionState {
                position: turns - turns.floor(),
                angle_urad: 0.0,
                pairs: vec![PairState {
                    pair: turns.floor() as i32,
                    path: point.y,
                    load_share: point.load_per_width / full,
                    line_load: point.load_per_width,
                    peak_pressure: now.pressure,
                    half_width: now.half_width,
                    off_line_of_action: false,
                    at_corner: false,
                    over_kink: false,
                    face: None,
                    sliding: Sliding::default(),
                }],
            }
        })
        .collect();
    cycle.sort_by(|a, b| a.position.total_cmp(&b.position));
    cycle
}
