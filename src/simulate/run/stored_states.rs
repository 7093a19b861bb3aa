//! The wear history of a run, with what is kept of the states that it stores.

use super::stages::Stages;
use super::{Event, FIELDS_STAGE, Observer, Plan, RunError};
use crate::contact::model::PositionContact;
use crate::simulate::checkpoint::{Checkpoint, Stored};
use crate::simulate::forward::{Forward, ForwardError};
use crate::simulate::gather;
use crate::simulate::history::Progress;
use crate::simulate::result::{FieldFrame, RootStress, State};
use crate::simulate::root_stress;
use crate::simulate::wear_state::WearState;
use crate::simulate::worn_away::WornAway;

/// What a whole history leaves.
pub(super) struct Worn {
    /// Of every stored state.
    pub(super) kept: Vec<Kept>,
    /// At the last cycle.
    pub(super) progress: Progress,
}

/// What is kept of a stored state. It is gathered while the contact is prepared as the wear found it: a later preparation
/// looks for contact in a wider strip, so its unknowns are others.
pub(super) struct Kept {
    pub(super) state: State,
    pub(super) frames: Vec<FieldFrame>,
    pub(super) root_stress: Option<[RootStress; 2]>,
    pub(super) penetration: f64,
    pub(super) torque_error: f64,
}

/// The wear history with its stored states; every step goes to the observer.
pub(super) fn wear(
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
    let mut history = match start {
        Some(start) => History::resumed(plan, forward, start, stages)?,
        None => History::new(plan),
    };
    for &stop in &stops[history.stored.len()..] {
        history.wear_to(stop, forward, observer)?;
        history.store(forward, stages, observer)?;
    }
    let progress = history
        .progress
        .unwrap_or_else(|| unreachable!("the first stop at zero cycles always leaves a progress"));
    Ok(Worn {
        kept: history.kept,
        progress,
    })
}

/// A wear history as far as it has come.
struct History<'a> {
    plan: &'a Plan<'a>,
    progress: Option<Progress>,
    /// What a checkpoint holds of the states stored so far.
    stored: Vec<Stored>,
    /// What the result needs of them.
    kept: Vec<Kept>,
}

impl<'a> History<'a> {
    fn new(plan: &'a Plan<'a>) -> Self {
        Self {
            plan,
            progress: None,
            stored: Vec::new(),
            kept: Vec::new(),
        }
    }

    /// Goes on from `start`; its stored states are gathered anew, each with the contact prepared as it was.
    fn resumed(
        plan: &'a Plan<'a>,
        forward: &mut Forward,
        start: Checkpoint,
        stages: &mut Stages,
    ) -> Result<Self, ForwardError> {
        let mut kept = Vec::new();
        for earlier in &start.stored {
            forward.prepare(&earlier.preparation)?;
            kept.push(keep(plan, forward, &earlier.progress, stages)?);
        }
        forward.prepare(&start.preparation)?;
        Ok(Self {
            plan,
            progress: start.progress,
            stored: start.stored,
            kept,
        })
    }

    /// Wears the flanks up to `stop` cycles.
    fn wear_to(
        &mut self,
        stop: f64,
        forward: &mut Forward,
        observer: &mut dyn Observer,
    ) -> Result<(), RunError> {
        let (plan, stored) = (self.plan, &self.stored);
        let mut outcome_of_keeping = Ok(());
        let mut worn_away = None;
        let pair = forward.cycle().pair.clone();
        let outcome = forward.wear_to(&mut self.progress, stop, &mut |preparation, progress| {
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
                    fraction: progress.stand.n / plan.conditions.cycles,
                    report: progress.report(),
                })
        });
        outcome_of_keeping.map_err(RunError::Keep)?;
        if let Some(error) = worn_away {
            return Err(error.into());
        }
        if outcome.map_err(|source| self.failed(source))? {
            Ok(())
        } else {
            Err(RunError::Stopped {
                cycles: self.cycles(),
            })
        }
    }

    /// Stores the state where the history stands.
    fn store(
        &mut self,
        forward: &Forward,
        stages: &mut Stages,
        observer: &mut dyn Observer,
    ) -> Result<(), RunError> {
        let Some(reached) = &self.progress else {
            return Ok(());
        };
        stages.end("contact and wear");
        if reached.stand.n >= self.plan.conditions.cycles && self.plan.drawn_positions > 0 {
            observer.event(Event::Stage(FIELDS_STAGE));
        }
        let kept = keep(self.plan, forward, reached, stages);
        self.kept.push(kept.map_err(|source| self.failed(source))?);
        self.stored.push(Stored {
            preparation: forward.preparation(),
            progress: reached.clone(),
        });
        observer
            .keep(&Checkpoint {
                preparation: forward.preparation(),
                progress: self.progress.clone(),
                stored: self.stored.clone(),
            })
            .map_err(RunError::Keep)
    }

    /// Cycles done.
    fn cycles(&self) -> f64 {
        self.progress.as_ref().map_or(0.0, |p| p.stand.n)
    }

    /// A failure here, with the cycles done where there are any.
    fn failed(&self, source: ForwardError) -> RunError {
        match self.cycles() {
            cycles if cycles > 0.0 => RunError::Midway {
                cycles,
                end: self.plan.conditions.cycles,
                source,
            },
            _ => source.into(),
        }
    }
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
