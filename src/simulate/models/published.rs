//! The published model for a gear set, and the rungs that make correct theory of it.

use super::curves::State;
use super::data::{Alone, Cause, ContactCurve, Flank, Kind, ModelResult, Quantity, Span};
use super::ladder::{Step, change};
use crate::gear::{Member, Pair};
use crate::paper::{self, Corrections, Inputs, Outcome, Point};
use crate::simulate::forward::{Conditions, GearSet};
use crate::simulate::paper_run::inputs;

/// Points of the grid that stands for a continuous flank.
const FINE: usize = 2001;

/// The published model takes one explicit step per cycle; more than this would take minutes.
const MOST_CYCLES: f64 = 1e7;

/// Corrections by themselves are four more runs, each with a step per cycle: they are left out beyond this.
const MOST_CYCLES_SINGLY: f64 = 2e5;

/// Why the published model has no result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum Absent {
    /// Its own rules do not reach.
    #[error(transparent)]
    Model(#[from] paper::Error),
    /// Too many steps.
    #[error("{cycles} cycles: the published model takes a step per cycle, at most {MOST_CYCLES:e}")]
    Cycles {
        /// Asked for.
        cycles: f64,
    },
}

/// A correction by itself: what it corrects, in words what it does, and the state that comes of it.
type Single = (Cause, &'static str, State);

/// The published model and what follows from correcting it.
pub(super) struct Published {
    pub(super) model: ModelResult,
    pub(super) steps: Vec<Step>,
    singly: Vec<Single>,
}

impl Published {
    /// Each correction by itself.
    pub(super) fn alone(&self, spans: &[Span]) -> Vec<Alone> {
        let depth = |state: &State| state.means(Quantity::DepthPinion, spans);
        let Some(before) = depth(&State::of(&self.model)) else {
            return Vec::new();
        };
        self.singly
            .iter()
            .filter_map(|(cause, correction, state)| {
                Some(Alone {
                    cause: *cause,
                    correction,
                    change: change(&before, &depth(state)?),
                })
            })
            .collect()
    }
}

/// Runs the published model and its corrections for `pair`.
pub(super) fn run(
    set: &GearSet,
    conditions: &Conditions,
    pair: &Pair,
) -> Result<Published, Absent> {
    if conditions.cycles > MOST_CYCLES {
        return Err(Absent::Cycles {
            cycles: conditions.cycles,
        });
    }
    let inputs = inputs(set, conditions);
    let outcome = paper::run(&inputs)?;
    let model = model(&inputs, &outcome, pair);
    let singly = if conditions.cycles <= MOST_CYCLES_SINGLY {
        each_alone(&inputs, pair)?
    } else {
        Vec::new()
    };
    Ok(Published {
        model,
        steps: steps(&inputs, pair, conditions.cycles)?,
        singly,
    })
}

/// The published model with one correction each.
fn each_alone(inputs: &Inputs, pair: &Pair) -> Result<Vec<Single>, Absent> {
    let printed_speed = gear_speed_as_printed(inputs).is_some();
    let mut singly = Vec::new();
    for (correction, corrections) in Corrections::each() {
        let cause = cause(corrections);
        if cause == Cause::GearSpeed && !printed_speed {
            continue;
        }
        let outcome = paper::run(&Inputs {
            corrections,
            ..inputs.clone()
        })?;
        singly.push((cause, correction, state(inputs, &outcome, pair, 1.0)));
    }
    Ok(singly)
}

/// The published model without the angle update, corrected by more and more, after so many cycles.
fn steps(inputs: &Inputs, pair: &Pair, cycles: f64) -> Result<Vec<Step>, Absent> {
    // without the angle update every cycle takes the same depth: one stands for all
    let steady = |corrections: Corrections, points: usize| -> Result<State, Absent> {
        let inputs = Inputs {
            cycles: 1,
            corrections,
            points,
            ..inputs.clone()
        };
        let outcome = paper::run(&inputs)?;
        Ok(state(&inputs, &outcome, pair, cycles))
    };
    let mut corrected = Corrections {
        no_angle_feedback: true,
        ..Corrections::default()
    };
    let mut steps = vec![Step {
        cause: Cause::AngleUpdate,
        replaced: "profile angle changed by wear, point by point",
        by: "profile angle of the involute, unchanged",
        state: steady(corrected, inputs.points)?,
    }];
    if gear_speed_as_printed(inputs).is_some() {
        corrected.true_speed_ratio = true;
        steps.push(Step {
            cause: Cause::GearSpeed,
            replaced: "gear speed of 1000 rpm, as printed",
            by: "gear speed from the tooth numbers",
            state: steady(corrected, inputs.points)?,
        });
    }
    corrected.hertz_dwell = true;
    steps.push(Step {
        cause: Cause::Dwell,
        replaced: "each point slides for as long as the contact takes to reach it from the pitch point",
        by: "each point slides while the contact passes over it",
        state: steady(corrected, inputs.points)?,
    });
    corrected.tip_point = true;
    steps.push(Step {
        cause: Cause::Grid,
        replaced: "50 points, without the tip",
        by: "2001 points, including the tip",
        state: steady(corrected, FINE)?,
    });
    Ok(steps)
}

/// The gear's speed, rpm, if it is the printed one, which contradicts the tooth numbers.
pub(super) fn gear_speed_as_printed(inputs: &Inputs) -> Option<f64> {
    let [z1, z2] = inputs.teeth.map(f64::from);
    let apart = inputs.speed[1] * z2 / (inputs.speed[0] * z1) - 1.0;
    (apart.abs() > 1e-9).then_some(inputs.speed[1])
}

fn cause(corrections: Corrections) -> Cause {
    let Corrections {
        hertz_dwell,
        tip_point,
        linear_load_share,
        true_speed_ratio,
        ..
    } = corrections;
    match (hertz_dwell, tip_point, linear_load_share, true_speed_ratio) {
        (true, ..) => Cause::Dwell,
        (_, true, ..) => Cause::Grid,
        (_, _, true, _) => Cause::LoadShare,
        (.., true) => Cause::GearSpeed,
        _ => Cause::AngleUpdate,
    }
}

fn model(inputs: &Inputs, outcome: &Outcome, pair: &Pair) -> ModelResult {
    ModelResult {
        kind: Kind::Paper,
        contact: contact(inputs, outcome, pair, |point| point.pressure_before),
        contact_end: contact(inputs, outcome, pair, |point| point.pressure_after),
        pinion: flank(outcome, 1.0),
        gear: None,
    }
}

fn state(inputs: &Inputs, outcome: &Outcome, pair: &Pair, cycles: f64) -> State {
    State {
        contact: contact(inputs, outcome, pair, |point| point.pressure_before),
        depth: [Some(flank(outcome, cycles)), None],
    }
}

fn touching(outcome: &Outcome) -> impl Iterator<Item = &Point> + Clone {
    outcome.points.iter().filter(|p| p.load_per_width > 0.0)
}

/// Depth of the points in contact, `times` that of the outcome.
fn flank(outcome: &Outcome, times: f64) -> Flank {
    Flank {
        radius: touching(outcome).map(|p| p.radius).collect(),
        path: touching(outcome).map(|p| p.y).collect(),
        depth_um: touching(outcome).map(|p| 1e3 * times * p.depth).collect(),
    }
}

fn contact(
    inputs: &Inputs,
    outcome: &Outcome,
    pair: &Pair,
    pressure: fn(&Point) -> f64,
) -> ContactCurve {
    let all = inputs.torque / (outcome.geometry.base_radius[0] * inputs.face_width);
    let points = touching(outcome);
    ContactCurve {
        path: points.clone().map(|p| p.y).collect(),
        radius_pinion: points.clone().map(|p| p.radius).collect(),
        radius_gear: points
            .clone()
            .map(|p| pair.gear.radius_at_rho(pair.rho(Member::Gear, p.y)))
            .collect(),
        load_share: points.clone().map(|p| p.load_per_width / all).collect(),
        line_load: points.clone().map(|p| p.load_per_width).collect(),
        peak_pressure: points.clone().map(pressure).collect(),
        off_line_of_action: points.map(|_| false).collect(),
    }
}
