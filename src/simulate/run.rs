//! One whole run: members, mesh cycle, wear history, fields, gathered as a [`Run`].

mod checks;
mod stages;
mod stored_states;

use std::sync::Arc;
use std::time::Instant;

use self::checks::{failed_checks, passed};
use self::stages::Stages;
use self::stored_states::wear;
use crate::effects::Surroundings;
use crate::gear::{Member, Pair};
use crate::mesh::Quality;
use crate::simulate::checkpoint::Checkpoint;
use crate::simulate::forward::{Conditions, ContactKind, Forward, ForwardError, Fresh, GearSet};
use crate::simulate::gather;
use crate::simulate::history::StepReport;
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::result::{Check, Cost, FieldFrame, MeshSummary, Run, State};
use crate::simulate::stated;
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
    let members = members_for(plan, members, observer)?;
    let mesh = match members.condensed() {
        Some(condensed) => Some(mesh_summaries(plan, condensed)?),
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
    let checks = passed(&worn)?;
    let root_stress = worn.kept.last().and_then(|kept| kept.root_stress);
    let (states, frames): (Vec<State>, Vec<Vec<FieldFrame>>) =
        worn.kept.into_iter().map(|k| (k.state, k.frames)).unzip();
    Ok(Run {
        title: plan.title.to_owned(),
        conditions: gather::conditions(plan),
        geometry: gather::geometry(
            &forward.cycle().pair,
            plan.set.face_width,
            placed_within(&forward),
        ),
        made: stated::made(plan),
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

/// The condensed members that the plan needs: those that are given, else built.
fn members_for<'m>(
    plan: &Plan,
    members: Option<&'m Members>,
    observer: &mut dyn Observer,
) -> Result<Fresh<'m>, RunError> {
    Ok(match (plan.kind, members) {
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
    })
}

/// The meshes of pinion and gear in figures.
fn mesh_summaries(plan: &Plan, members: &Members) -> Result<[MeshSummary; 2], ForwardError> {
    let pair = pair_of(plan)?;
    Ok(Member::BOTH.map(|which| mesh_summary(plan, members, &pair, which)))
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
