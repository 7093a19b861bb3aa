//! One whole run: members, mesh cycle, wear history, fields, gathered as a [`Run`].

use std::sync::Arc;
use std::time::Instant;

use crate::contact::model::PositionContact;
use crate::effects::Surroundings;
use crate::gear::{Member, Pair};
use crate::mesh::Quality;
use crate::simulate::checkpoint::{Checkpoint, Stored};
use crate::simulate::forward::{Conditions, ContactKind, Forward, ForwardError, Fresh, GearSet};
use crate::simulate::gather;
use crate::simulate::history::{Progress, StepReport};
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::result::{Check, Cost, FieldFrame, MeshSummary, RootStress, Run, State};
use crate::simulate::root_stress;
use crate::simulate::wear_state::WearState;
use crate::simulate::worn_away::WornAway;
use crate::wear::acting::Acting;

/// What a run is to do.
#[derive(Clone)]
pub struct Plan<'a> {
    /// Free text of the study.
    pub title: &'a str,
    /// Id of the test, if the conditions are a test's.
    pub test: Option<&'a str>,
    /// The gears.
    pub set: &'a GearSet,
    /// Conditions.
    pub conditions: Conditions,
    /// Resolution.
    pub numerics: Numerics,
    /// Contact model.
    pub kind: ContactKind,
    /// Physical effects, if any.
    pub acting: Option<&'a Acting>,
    /// What the study states about oil and heat.
    pub surroundings: Surroundings,
    /// Their names with parameter values, for the results.
    pub effects: &'a [String],
    /// Worn states to store, evenly over the cycles.
    pub stored_states: usize,
    /// Mesh positions to draw at the last state.
    pub drawn_positions: usize,
    /// Whether the stresses in the fillets are wanted, where there is a mesh.
    pub root_stress: bool,
}

/// Where a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event<'a> {
    /// A stage begins.
    Stage(&'static str),
    /// A wear step is done.
    Step {
        /// Fraction of the cycles done.
        fraction: f64,
        /// The step.
        report: StepReport<'a>,
    },
}

/// The stage in which the stresses of the last state are computed at all positions that are drawn.
pub const FIELDS_STAGE: &str = "stress fields of the last state";

/// Who watches a run.
pub trait Observer {
    /// Called at every event; `false` stops the run.
    fn event(&mut self, event: Event) -> bool;
    /// Given the state after each wear step.
    ///
    /// # Errors
    /// A text, if it cannot be kept; the run then ends.
    fn keep(&mut self, checkpoint: &Checkpoint) -> Result<(), String>;
}

/// Why a run has no result.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The simulation failed.
    #[error(transparent)]
    Forward(#[from] ForwardError),
    /// The simulation failed after some wear steps.
    #[error(
        "{source} (after {cycles:.0} of {end:.0} cycles; the steps up to there are kept for --resume)"
    )]
    Midway {
        /// Cycles done.
        cycles: f64,
        /// Cycles asked for.
        end: f64,
        /// What failed.
        source: ForwardError,
    },
    /// The published model does not cover the pair.
    #[error("the published model: {0}")]
    Paper(#[from] crate::paper::Error),
    /// A checkpoint could not be kept.
    #[error("{0}")]
    Keep(String),
    /// More wear than there is tooth.
    #[error(transparent)]
    WornAway(#[from] WornAway),
    /// The result is not one that can be relied on.
    #[error("{}", failed_checks(.0))]
    Unsound(Vec<Check>),
    /// The observer stopped the run.
    #[error("stopped after {cycles:.0} cycles")]
    Stopped {
        /// Cycles done.
        cycles: f64,
    },
}

/// What failed, by how much, and what helps.
fn failed_checks(checks: &[Check]) -> String {
    let failed = checks.iter().map(|c| {
        let help = match c.name.as_str() {
            WORN_AREA => "a smaller numerics.step_tolerance or more numerics.positions",
            _ => "more numerics.elements_per_half_width",
        };
        format!(
            "{} is off by {:.2e} (at most {:.0e} passes): {help}, or less wear, helps",
            c.name, c.value, c.limit
        )
    });
    let faults: Vec<String> = failed.collect();
    format!(
        "the result fails its own check and is not written: {}",
        faults.join("; ")
    )
}

/// The check that the worn flanks lack what the wear law took off them.
const WORN_AREA: &str = "worn area, law against geometry";

/// Largest relative difference of worn area by law and by geometry that passes as balanced (time steps of the two differ).
const BALANCE_LIMIT: f64 = 5e-3;

/// Largest penetration over the approach that passes.
const PENETRATION_LIMIT: f64 = 1e-3;

/// Largest relative difference of the torque that the contact forces carry from the load that passes: rounding.
const TORQUE_LIMIT: f64 = 1e-9;

/// Runs `plan`, from `start` if that is given. `members` are built if the plan needs and none are given.
///
/// # Errors
/// [`RunError`]; what was worn until then is with the observer.
pub fn run(
    plan: &Plan,
    members: Option<&Members>,
    start: Option<Checkpoint>,
    observer: &mut dyn Observer,
) -> Result<Run, RunError> {
    let begun = Instant::now();
    let mut stages = Stages::default();
    let members = match (plan.kind, members) {
        (ContactKind::Hertz, _) => Fresh::None,
        (ContactKind::Fem, Some(members)) => Fresh::Lent(members),
        (ContactKind::Fem, None) => {
            observer.event(Event::Stage("mesh, factor and condense both gears"));
            let built = plan.set.members(
                &plan.numerics,
                &[plan.conditions.torque],
                &[plan.conditions.misalignment],
            )?;
            Fresh::Own(Arc::new(built))
        }
    };
    let mesh = match members.condensed() {
        Some(m) => {
            let pair = pair_of(plan)?;
            Some(Member::BOTH.map(|which| mesh_summary(plan, m, &pair, which)))
        }
        None => None,
    };
    stages.end("mesh and compliance");
    observer.event(Event::Stage("mesh cycle"));
    let mut forward = Forward::on(
        plan.set,
        members,
        plan.conditions,
        plan.numerics,
        plan.acting,
    )?;
    stages.end("mesh cycle");
    let worn = wear(plan, &mut forward, start, &mut stages, observer)?;
    let pair = forward.cycle().pair.clone();
    let largest = |figure: fn(&Kept) -> f64| worn.kept.iter().map(figure).fold(0.0, f64::max);
    let checks = vec![
        check(WORN_AREA, worn.progress.balance.error(), BALANCE_LIMIT),
        check(
            "penetration over approach",
            largest(|k| k.penetration),
            PENETRATION_LIMIT,
        ),
        check(
            "torque from contact forces against the load",
            largest(|k| k.torque_error),
            TORQUE_LIMIT,
        ),
    ];
    let failed: Vec<Check> = (checks.iter().filter(|c| !c.passed())).cloned().collect();
    if !failed.is_empty() {
        return Err(RunError::Unsound(failed));
    }
    let root_stress = worn.kept.last().and_then(|kept| kept.root_stress);
    let (states, frames): (Vec<State>, Vec<Vec<FieldFrame>>) =
        worn.kept.into_iter().map(|k| (k.state, k.frames)).unzip();
    Ok(Run {
        title: plan.title.to_owned(),
        conditions: gather::conditions(plan),
        geometry: gather::geometry(&pair, plan.set.face_width, placed_within(&forward)),
        mesh,
        states,
        fields: frames.into_iter().flatten().collect(),
        root_stress,
        balance_error: worn.progress.balance.error(),
        checks,
        cost: Cost {
            seconds: begun.elapsed().as_secs_f64(),
            factorisations: forward.factorisations(),
            contact_solves: worn.progress.solves,
            wear_steps: worn.progress.stand.accepted,
            peak_memory_mb: peak_memory_mb(),
            threads: rayon::current_num_threads(),
            stages: stages.list,
        },
    })
}

struct Worn {
    kept: Vec<Kept>,
    progress: Progress,
}

/// What is kept of a stored state. It is gathered while the contact is prepared as the wear found it: a later preparation
/// looks for contact in a wider strip, so its unknowns are others.
struct Kept {
    state: State,
    frames: Vec<FieldFrame>,
    root_stress: Option<[RootStress; 2]>,
    penetration: f64,
    torque_error: f64,
}

/// The wear history with its stored states; every step goes to the observer.
fn wear(
    plan: &Plan,
    forward: &mut Forward,
    start: Option<Checkpoint>,
    stages: &mut Stages,
    observer: &mut dyn Observer,
) -> Result<Worn, RunError> {
    let end = plan.conditions.cycles;
    let stops: Vec<f64> = (0..=plan.stored_states)
        .map(|i| end * i as f64 / plan.stored_states as f64)
        .collect();
    let (mut progress, mut stored) = (None, Vec::new());
    let mut kept = Vec::new();
    if let Some(start) = start {
        for earlier in &start.stored {
            forward.prepare(&earlier.preparation)?;
            kept.push(keep(plan, forward, &earlier.progress, stages)?);
        }
        forward.prepare(&start.preparation)?;
        (progress, stored) = (start.progress, start.stored);
    }
    for &stop in &stops[stored.len()..] {
        let mut outcome_of_keeping = Ok(());
        let mut worn_away = None;
        let pair = forward.cycle().pair.clone();
        let outcome = forward.wear_to(&mut progress, stop, &mut |preparation, progress| {
            let fraction = progress.stand.n / end;
            worn_away = WornAway::by_the_end(plan, &pair, progress);
            if worn_away.is_some() {
                return false;
            }
            outcome_of_keeping = observer.keep(&Checkpoint {
                preparation: preparation.clone(),
                progress: Some(progress.clone()),
                stored: stored.clone(),
            });
            outcome_of_keeping.is_ok()
                && observer.event(Event::Step {
                    fraction,
                    report: progress.report(),
                })
        });
        outcome_of_keeping.map_err(RunError::Keep)?;
        if let Some(error) = worn_away {
            return Err(error.into());
        }
        let reached = progress.as_ref().map_or(0.0, |p| p.stand.n);
        let failed = |source: ForwardError| match reached {
            cycles if cycles > 0.0 => RunError::Midway {
                cycles,
                end,
                source,
            },
            _ => source.into(),
        };
        if !outcome.map_err(failed)? {
            return Err(RunError::Stopped { cycles: reached });
        }
        let Some(reached) = &progress else { continue };
        stages.end("contact and wear");
        if reached.stand.n >= end && plan.drawn_positions > 0 {
            observer.event(Event::Stage(FIELDS_STAGE));
        }
        kept.push(keep(plan, forward, reached, stages).map_err(failed)?);
        stored.push(Stored {
            preparation: forward.preparation(),
            progress: reached.clone(),
        });
        observer
            .keep(&Checkpoint {
                preparation: forward.preparation(),
                progress: progress.clone(),
                stored: stored.clone(),
            })
            .map_err(RunError::Keep)?;
    }
    let progress = progress
        .unwrap_or_else(|| unreachable!("the first stop at zero cycles always leaves a progress"));
    Ok(Worn { kept, progress })
}

/// Gathers the state where `progress` stands, with its fields: at the position nearest to the pitch point, and of the last
/// state at evenly spread positions; of several slices that of the one which carries most.
fn keep(
    plan: &Plan,
    forward: &Forward,
    progress: &Progress,
    stages: &mut Stages,
) -> Result<Kept, ForwardError> {
    use rayon::prelude::*;
    let worn = forward.state(progress)?;
    let state = gather::state(plan, forward, &worn);
    stages.end("contact and wear");
    let most_loaded = gather::most_loaded(forward, &worn);
    let (section, load) = match &most_loaded {
        Some((section, load)) => (section, load),
        None => (&worn, &1.0),
    };
    let positions = match (plan.drawn_positions, forward.blanks()) {
        (0, _) | (_, None) => 0,
        (all, Some(_)) if worn.cycles == plan.conditions.cycles => all,
        _ => 1,
    };
    let drawn = match positions {
        0 => None,
        _ => gather::drawn(forward, section)?,
    };
    let frames = (0..positions)
        .into_par_iter()
        .filter_map(|i| {
            let q = forward.cycle().nearest(i as f64 / positions as f64);
            Some(gather::frame(forward, section, drawn.as_ref()?, *load, q))
        })
        .collect::<Result<Vec<Option<FieldFrame>>, ForwardError>>()?;
    let root_stress = if plan.root_stress && worn.cycles == plan.conditions.cycles {
        root_stress::largest(forward, section)?
    } else {
        None
    };
    stages.end("fields");
    Ok(Kept {
        state,
        frames: frames.into_iter().flatten().collect(),
        root_stress,
        penetration: largest(&worn, |c| c.penetration),
        torque_error: largest(&worn, |c| c.torque_error),
    })
}

fn largest(state: &WearState, figure: fn(&PositionContact) -> f64) -> f64 {
    state.contacts.iter().map(figure).fold(0.0, f64::max)
}

fn check(name: &str, value: f64, limit: f64) -> Check {
    Check {
        name: name.to_owned(),
        value,
        limit,
        unit: "-".to_owned(),
    }
}

fn mesh_summary(plan: &Plan, members: &Members, pair: &Pair, which: Member) -> MeshSummary {
    let member = &members.members[usize::from(which == Member::Gear)];
    let quality = Quality::of(&member.mesh);
    let torque = plan.conditions.torque / plan.set.face_width;
    MeshSummary {
        element: if member.order() == 1 { "T3" } else { "T6" }.to_owned(),
        nodes: quality.nodes,
        elements: quality.elements,
        dof: member.body.dof_count(),
        min_angle_deg: quality.min_angle_deg,
        flank_spacing: members.spacing(),
        edges_per_half_width: Numerics::half_width(pair, plan.set.modulus(), torque)
            / members.spacing(),
    }
}

/// Names and times of stages as they end.
struct Stages {
    last: Instant,
    list: Vec<(String, f64)>,
}

impl Default for Stages {
    fn default() -> Self {
        Self {
            last: Instant::now(),
            list: Vec::new(),
        }
    }
}

impl Stages {
    /// The time since the last end belongs to the stage `name`.
    fn end(&mut self, name: &str) {
        let seconds = self.last.elapsed().as_secs_f64();
        self.last = Instant::now();
        match self.list.iter_mut().find(|(known, _)| known == name) {
            Some((_, sum)) => *sum += seconds,
            None => self.list.push((name.to_owned(), seconds)),
        }
    }
}

/// Peak resident memory of this process, 10⁶ bytes, where the system tells it.
fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib * 1024.0 / 1e6)
}

/// How far along the face slices of helical gears may be off their places because they stand at mesh positions, mm.
fn placed_within(forward: &Forward) -> f64 {
    let (cycle, slices) = (forward.cycle(), forward.slices());
    let pitches = cycle.pair.turned_per_mm();
    let slices = slices.filter(|_| pitches != 0.0);
    slices.map_or(0.0, |s| {
        s.off(pitches, cycle.positions.len()) / pitches.abs()
    })
}

/// The mounted pair of a plan.
///
/// # Errors
/// [`ForwardError`] if the gears cannot run so.
pub fn pair_of(plan: &Plan) -> Result<Pair, ForwardError> {
    Ok(plan.set.mount(plan.conditions.misalignment)?)
}
