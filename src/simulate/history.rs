//! Wear histories: from fresh flanks to the requested cycles, with the balance of worn area at every step.

mod area_check;
mod steps;

use self::area_check::{AreaCheck, Verdict};
use self::steps::{History, Trial};
use crate::contact::model::ContactModel;
use crate::simulate::balance::Balance;
use crate::wear::acting::Acting;
use crate::wear::archard::{AreaRate, WearError};
use crate::wear::integrator::{Stand, Step, StepControl, StepError};
use crate::wear::tangent::{Differentiated, Direction};

/// What an observer gets after each accepted wear step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport<'a> {
    /// Where the integration stands.
    pub stand: &'a Stand,
    /// Worn area so far.
    pub balance: Balance,
    /// Largest depth on pinion and gear, mm.
    pub max_depth: [f64; 2],
    /// Contact problems solved so far.
    pub solves: usize,
}

/// A wear history in progress: everything a resumed run needs besides the model.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Progress {
    /// The integrator's state.
    pub stand: Stand,
    /// Worn areas so far.
    pub balance: Balance,
    /// Rate of worn area by the law at the last step's end, mm² per cycle.
    rate: AreaRate,
    /// Area that effects displaced so far, mm².
    displaced: [f64; 2],
    /// Contact problems solved so far.
    pub solves: usize,
    /// Largest depth on pinion and gear, mm.
    pub max_depth: [f64; 2],
    /// Contact sets of the last solution, so that a resumed run walks the same way.
    warm: Vec<Vec<usize>>,
}

impl Progress {
    /// What an observer gets of it.
    pub fn report(&self) -> StepReport<'_> {
        StepReport {
            stand: &self.stand,
            balance: self.balance,
            max_depth: self.max_depth,
            solves: self.solves,
        }
    }

    /// Area that effects displaced without loss of mass, per tooth of pinion and gear, mm².
    pub fn displaced(&self) -> [f64; 2] {
        self.displaced
    }

    /// Forgets the contact sets: their numbering has changed.
    pub fn forget_sets(&mut self) {
        self.warm.clear();
    }

    /// Fresh flanks of depths `u` (all 0), worn off at `rate`.
    fn fresh(u: Vec<f64>, control: StepControl, rate: AreaRate) -> Self {
        Self {
            stand: Stand::new(u, control),
            balance: Balance::default(),
            rate,
            displaced: [0.0; 2],
            solves: 0,
            max_depth: [0.0; 2],
            warm: Vec::new(),
        }
    }

    /// Goes on to the end of `trial`; `solves_before`: contact problems solved before this part of the history.
    fn accept(&mut self, trial: Trial, solves_before: usize) {
        self.balance = trial.balance;
        for side in 0..2 {
            self.displaced[side] +=
                0.5 * trial.length * (self.rate.displaced[side] + trial.rate.displaced[side]);
        }
        self.rate = trial.rate;
        self.solves = solves_before + trial.solves;
        self.warm = trial.warm;
        self.max_depth = trial.max_depth;
        self.stand = trial.stand;
    }
}

/// Archard wear coefficients, effects and step control of a history.
#[derive(Clone, Copy)]
pub struct WearLaw<'a> {
    /// Wear coefficient of pinion and gear, mm²/N.
    pub coefficient: [f64; 2],
    /// Physical effects on the law.
    pub acting: Option<&'a Acting>,
    /// Allowed step error relative to the largest depth.
    pub tolerance: f64,
    /// Depth below which it is absolute, modules.
    pub floor: f64,
    /// How the worn area is held against the line loads.
    pub balance: Balancing,
}

/// How the worn area is held against what the line loads wear off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Balancing {
    /// It is not integrated from the line loads: [`Balance::law`] and [`Progress::displaced`] stay 0.
    Off,
    /// A step that is off is taken again, shorter.
    Steps,
    /// The same, and steps that would add to a difference that stands already are to be better the larger it is. Of a contact that is not
    /// solved (Hertz) a part of the difference is its own, at any length of step.
    History,
}

/// Depth above which the step tolerance is absolute where areas are balanced over the history, modules: what the teeth give and how
/// contacts pass over worn flanks does not grow with the depth, and in proportion to it steps of a flank worn by a fifth of its tooth left
/// areas by law and geometry 1.5 % apart. (In a fit's analytic histories, which try any coefficient, it made hundreds of thousands of steps.)
const DEPTH_CEILING: f64 = 0.05;

/// The deepest place grows by more than this in every step, modules.
const LEAST_GROWTH: f64 = 1e-11;

impl WearLaw<'_> {
    fn control(&self, module: f64, rate: &[f64]) -> StepControl {
        // the first step wears a tenth of the floor where the flank wears fastest
        let fastest = rate.iter().fold(f64::MIN_POSITIVE, |m, r| m.max(*r));
        StepControl {
            tolerance: self.tolerance,
            floor: self.floor * module,
            ceiling: match self.balance {
                Balancing::History => DEPTH_CEILING * module,
                Balancing::Off | Balancing::Steps => f64::INFINITY,
            },
            first_step: 0.1 * self.floor * module / fastest,
            // corners that come into contact refuse a step much longer than those before, again and again; the steps of single runs, whose
            // areas are balanced too, stay as they were validated
            hesitates: self.balance == Balancing::Off,
            least_growth: LEAST_GROWTH * module,
        }
    }
}

/// Derivatives of a history where it stands, by parameter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HistoryTangents {
    /// Of the depths at the stations of pinion and gear, mm per unit.
    pub depth: Vec<Vec<f64>>,
    /// Of [`Progress::displaced`], mm² per unit.
    pub displaced: Vec<[f64; 2]>,
    /// Of its rate at the last step's end.
    displaced_rate: Vec<[f64; 2]>,
}

impl HistoryTangents {
    /// Of a state read between steps.
    pub fn read(depth: Vec<Vec<f64>>, displaced: Vec<[f64; 2]>) -> Self {
        Self {
            depth,
            displaced,
            displaced_rate: Vec::new(),
        }
    }

    /// Of fresh flanks with so many stations, by so many parameters.
    fn fresh(parameters: usize, stations: usize) -> Self {
        Self {
            depth: vec![vec![0.0; stations]; parameters],
            displaced: vec![[0.0; 2]; parameters],
            displaced_rate: vec![[0.0; 2]; parameters],
        }
    }

    /// Takes the derivatives over a step that ended with the depths `u` at `n` cycles; `displaces`: whether an effect displaces material.
    fn follow<M: ContactModel + ?Sized>(
        &mut self,
        system: &mut Differentiated<'_, '_, M>,
        step: &Step,
        (n, u): (f64, &[f64]),
        displaces: bool,
    ) -> Result<(), WearError> {
        step.follow(system, &mut self.depth)?;
        if displaces {
            let rates = system.displaced_tangents(n, u, &self.depth)?;
            let before = std::mem::replace(&mut self.displaced_rate, rates);
            let rates = before.iter().zip(&self.displaced_rate);
            for (displaced, (before, after)) in self.displaced.iter_mut().zip(rates) {
                for side in 0..2 {
                    displaced[side] += 0.5 * step.length() * (before[side] + after[side]);
                }
            }
        }
        Ok(())
    }
}

/// Integrates wear under `model` from `progress` (or fresh flanks) to `end` cycles; `observe` sees every step and may stop
/// the run by returning false.
///
/// # Errors
/// [`StepError`] with the cycles reached; `progress` then holds the last accepted step.
pub fn wear_until<M: ContactModel + ?Sized>(
    model: &M,
    law: WearLaw<'_>,
    progress: &mut Option<Progress>,
    end: f64,
    observe: &mut dyn FnMut(&Progress) -> bool,
) -> Result<bool, StepError<WearError>> {
    let mut none = HistoryTangents::default();
    wear_with_tangents(model, law, progress, end, (&[], &mut none), &mut |p, _| {
        observe(p)
    })
}

/// As [`wear_until`], with the derivatives along each of the directions (empty: those of fresh flanks), which `observe` sees too.
///
/// # Errors
/// As [`wear_until`].
pub fn wear_with_tangents<M: ContactModel + ?Sized>(
    model: &M,
    law: WearLaw<'_>,
    progress: &mut Option<Progress>,
    end: f64,
    (directions, tangents): (&[Direction<'_>], &mut HistoryTangents),
    observe: &mut dyn FnMut(&Progress, &HistoryTangents) -> bool,
) -> Result<bool, StepError<WearError>> {
    let mut history = History::new(model, law);
    let control = history.begin(progress)?;
    let progress = progress.as_mut().expect("filled above");
    if tangents.depth.is_empty() {
        history.begin_tangents(directions, progress, tangents)?;
    }
    let solves_before = progress.solves;
    history.system.start_from(&progress.warm);
    let mut area_check = AreaCheck::new(&law, model.cycle());
    while progress.stand.n < end {
        let mut trial = history.step(progress, end, control)?;
        match area_check.judge(progress, &trial) {
            Verdict::Again { shorter } => {
                progress.stand.step = shorter;
                progress.stand.rejected += 1;
                continue;
            }
            Verdict::Counts { next } => trial.stand.step = next,
        }
        if !directions.is_empty() {
            history.follow(&trial, directions, tangents)?;
        }
        // from here on nothing fails: a step counts whole or not at all
        area_check.next_step();
        progress.accept(trial, solves_before);
        if !observe(progress, tangents) {
            return Ok(false);
        }
    }
    Ok(true)
}
