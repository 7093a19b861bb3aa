//! The gear pair as a fit sees it: a wear history of each test, read at the measured places and times.
//!
//! Where an effect concerns the measured tooth of a member alone, what is measured there is read from a history of that tooth, all else from one of
//! the mean tooth.
//!
//! Histories are kept, so that a wear coefficient more costs nothing where it only stretches time ([`crate::learn::trajectory`]).

mod derivatives;

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::effects::{Combined, Local, ParamRole};
use crate::gear::Member;
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::observe::{Reading, measured_tooth};
use crate::learn::prediction::predictor::{Linearised, Move, PredictError, Predictor};
use crate::learn::prediction::trajectory::Trajectory;
use crate::measure::{Observation, Quantity};
use crate::simulate::forward::{Forward, ForwardError, Variation};
use crate::study::EffectModel;
use crate::wear::acting::Acting;

/// Builds the effects of a model from the values of its free parameters.
pub type EffectsOf<'a> = Box<dyn Fn(&[f64]) -> Combined + Send + Sync + 'a>;

/// A model of the gears on a bench: base model and effects, with some of the effects' parameters free.
pub struct GearModel<'a> {
    bench: &'a Bench<'a>,
    effects: EffectsOf<'a>,
    stretches: bool,
    /// The parameters that concern measured teeth alone, by their places.
    of_measured_teeth: Vec<usize>,
    /// Each with its derivatives, without, or both.
    histories: Mutex<HashMap<Key, Vec<Arc<Trajectory>>>>,
    /// Whether histories are given up that wear far deeper than was measured.
    gives_up: bool,
    /// Those that were, with the cycles at which they were.
    given_up: Mutex<HashMap<Key, f64>>,
    /// The largest depth of each test's first history, mm.
    first: Mutex<HashMap<usize, f64>>,
}

/// What a history belongs to: test, bits of the parameters, bits of the wear coefficient it was worn with.
type Key = (usize, Vec<u64>, u64);

/// How many times as deep as measured, or as its first history, a test is worn before that is given up.
const TOO_DEEP: f64 = 4.0;

fn locked<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<'a> GearModel<'a> {
    /// The model with `effects`, from parameter values in the order that callers of [`Predictor::predict`] use.
    pub fn new(bench: &'a Bench<'a>, effects: EffectsOf<'a>) -> Self {
        Self {
            bench,
            effects,
            stretches: false,
            of_measured_teeth: Vec::new(),
            histories: Mutex::default(),
            gives_up: false,
            given_up: Mutex::default(),
            first: Mutex::default(),
        }
    }

    /// The model with the effects of a study, whose free parameters `names` stand in this order.
    pub(in crate::learn) fn of_effects<N: AsRef<str> + Send + Sync + 'a>(
        bench: &'a Bench<'a>,
        effects: &'a EffectModel,
        names: Vec<N>,
    ) -> Self {
        let of_measured_tooth = |name: &N| {
            let card = effects.parameter(name.as_ref()).and_then(|p| p.card);
            card.is_some_and(|card| card.role == ParamRole::MeasuredTooth)
        };
        let of_measured_teeth = (names.iter().enumerate())
            .filter_map(|(place, name)| of_measured_tooth(name).then_some(place))
            .collect();
        let build = move |values: &[f64]| {
            effects.build(&|name| {
                let place = names.iter().position(|known| known.as_ref() == name)?;
                values.get(place).copied()
            })
        };
        Self {
            of_measured_teeth,
            ..Self::new(bench, Box::new(build)).stretching(effects.stretches_time())
        }
    }

    /// The same, where the wear coefficient only stretches time: every effect multiplies it and none has a clock.
    pub fn stretching(mut self, stretches: bool) -> Self {
        self.stretches = stretches;
        self
    }

    /// The same, but histories that wear far deeper than was measured (and than the test's first history) are given up: trial steps of a fit lead
    /// there, no fit ends there, and following them would cost more than the rest of the fit. The first history of a test is always followed to
    /// its end, so it must be asked for before the others of that test.
    pub(in crate::learn) fn giving_up(mut self) -> Self {
        self.gives_up = true;
        self
    }

    /// How deep a history of a test is followed, mm.
    fn deepest(&self, test: usize) -> f64 {
        let first = locked(&self.first).get(&test).copied();
        let Some(first) = first.filter(|_| self.gives_up) else {
            return f64::INFINITY;
        };
        let depths = (self.bench.tests[test].observations.iter())
            .filter(|o| o.quantity == Quantity::WearDepth)
            .map(|o| 1e-3 * o.value);
        let measured = depths.reduce(f64::max);
        measured.map_or(f64::INFINITY, |depth| TOO_DEEP * depth.max(first))
    }

    /// The history of a test up to `cycles` at least, with its derivatives by `variations` if there are any.
    ///
    /// No lock is held while it wears: whoever else wants the same one meanwhile makes the same steps.
    fn history(
        &self,
        forward: &mut Forward,
        key: Key,
        cycles: f64,
        variations: &[Variation],
    ) -> Result<Arc<Trajectory>, ForwardError> {
        let kept = || locked(&self.histories);
        let same = |history: &Arc<Trajectory>| history.parameters() == variations.len();
        let serves = |history: &&Arc<Trajectory>| {
            history.reaches(cycles) && (variations.is_empty() || same(history))
        };
        let known = {
            let kept = kept();
            let known = kept.get(&key).map_or(&[][..], Vec::as_slice);
            if let Some(known) = known.iter().find(serves) {
                return Ok(Arc::clone(known));
            }
            known.iter().find(|known| same(known)).cloned()
        };
        let deepest = self.deepest(key.0);
        let too_deep_at = locked(&self.given_up).get(&key).copied();
        if let Some(cycles) = too_deep_at.filter(|at| *at <= cycles) {
            return Err(ForwardError::TooDeep { cycles, deepest });
        }
        let mut longer = known.map_or_else(Trajectory::default, |known| (*known).clone());
        let reached = longer.reach(forward, cycles, variations, deepest);
        if let Err(ForwardError::TooDeep { cycles, .. }) = &reached {
            locked(&self.given_up).insert(key.clone(), *cycles);
        }
        reached?;
        (locked(&self.first).entry(key.0)).or_insert_with(|| longer.deepest());
        let longer = Arc::new(longer);
        let mut kept = kept();
        let all = kept.entry(key).or_default();
        all.retain(|known| !same(known));
        all.push(Arc::clone(&longer));
        Ok(longer)
    }

    /// The runs that a test at some parameters takes, each with observations of its own; none without any.
    fn runs(&self, test: usize, coefficient: f64, parameters: &[f64]) -> Vec<Run> {
        let observations = &self.bench.tests[test].observations;
        let all = 0..observations.len();
        if all.is_empty() {
            return Vec::new();
        }
        let effects = (self.effects)(parameters);
        let mut bits: Vec<u64> = parameters.iter().map(|p| p.to_bits()).collect();
        let apart = effects.measured_teeth();
        if apart.is_empty() {
            let run = self.run(test, coefficient, (effects, bits, None), all.collect());
            return vec![run];
        }
        let chart = self.bench.templates[test].states_teeth();
        let whose = |row: &usize| {
            // rows beside a pitch chart are those of the mean tooth
            let measured = measured_tooth(&observations[*row], self.bench.set());
            measured.filter(|member| !chart && apart.contains(member))
        };
        let mut runs = Vec::new();
        for (i, member) in apart.iter().enumerate() {
            let rows: Vec<usize> = all.clone().filter(|r| whose(r) == Some(*member)).collect();
            if !rows.is_empty() {
                let effects = (self.effects)(parameters).felt_by(Some(*member));
                let bits = [&bits[..], &[i as u64]].concat();
                runs.push(self.run(test, coefficient, (effects, bits, Some(*member)), rows));
            }
        }
        let rows: Vec<usize> = all.filter(|row| whose(row).is_none()).collect();
        if !rows.is_empty() {
            for &place in &self.of_measured_teeth {
                bits[place] = 0;
            }
            runs.push(self.run(test, coefficient, (effects.felt_by(None), bits, None), rows));
        }
        runs
    }

    /// One of them, ready to be worn: with these effects, told from others by the bits, for these rows.
    fn run(
        &self,
        test: usize,
        coefficient: f64,
        (effects, bits, tooth): (Combined, Vec<u64>, Option<Member>),
        rows: Vec<usize>,
    ) -> Run {
        let measured = &self.bench.tests[test];
        // one history in a coefficient of the test's own serves all others
        let worn_with = if self.stretches {
            measured.wear.0
        } else {
            coefficient
        };
        let stretch = coefficient / worn_with;
        let observed = |row: &usize| stretch * measured.observations[*row].cycles;
        let mut order = rows.clone();
        order.sort_by(|a, b| observed(a).total_cmp(&observed(b)).then(a.cmp(b)));
        Run {
            test,
            acting: (!effects.is_empty()).then(|| self.bench.acting(test, effects)),
            worn_with,
            stretch,
            bits,
            tooth,
            rows,
            order,
        }
    }

    /// What `of` reads of every observation of a run in a history of it.
    fn read_off<T>(
        &self,
        run: &Run,
        forward: &mut Forward<'_>,
        history: &Trajectory,
        variations: &[Variation],
        of: &dyn Fn(&mut Reading<'_, '_>, &Observation) -> Result<T, ForwardError>,
    ) -> Result<Vec<T>, ForwardError> {
        let measured = &self.bench.tests[run.test];
        let observed = |row: &usize| run.stretch * measured.observations[*row].cycles;
        let mut values: Vec<(usize, T)> = Vec::with_capacity(run.order.len());
        for rows in run.order.chunk_by(|a, b| observed(a) == observed(b)) {
            let mut state = history.at(observed(&rows[0]));
            if self.stretches && !variations.is_empty() {
                self.stretched(history, &mut state);
            }
            let mut reading = Reading::new(forward, &state, self.bench.set(), variations);
            for &row in rows {
                values.push((row, of(&mut reading, &measured.observations[row])?));
            }
        }
        values.sort_by_key(|(row, _)| *row);
        Ok(values.into_iter().map(|(_, value)| value).collect())
    }

    /// What `of` reads of every observation of a test.
    fn read<T>(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
        of: impl Fn(&mut Reading<'_, '_>, &Observation) -> Result<T, ForwardError>,
    ) -> Result<Vec<T>, ForwardError> {
        let runs = self.runs(test, coefficient, parameters);
        by_row(&runs, |run| self.read_run(run, &of))
    }

    /// What `of` reads of every observation of a run.
    fn read_run<T>(
        &self,
        run: &Run,
        of: &dyn Fn(&mut Reading<'_, '_>, &Observation) -> Result<T, ForwardError>,
    ) -> Result<Vec<T>, ForwardError> {
        let mut forward = (self.bench).forward(run.test, run.worn_with, run.acting.as_ref())?;
        let history = self.history(&mut forward, run.key(), self.last(run), &[])?;
        self.read_off(run, &mut forward, &history, &[], of)
    }

    /// Cycles of the history at the last observation.
    fn last(&self, run: &Run) -> f64 {
        let observations = &self.bench.tests[run.test].observations;
        let last = run.order.last();
        last.map_or(0.0, |&row| run.stretch * observations[row].cycles)
    }

    /// What every observation of a test feels where and when it was made; none for what stands nowhere on a flank.
    ///
    /// # Errors
    /// As [`Predictor::predict`].
    pub(in crate::learn) fn locals(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<Option<Local>>, PredictError> {
        let acting = self.bench.acting(test, Combined::default());
        self.read(test, coefficient, parameters, |reading, observation| {
            reading.local(&acting, observation)
        })
        .map_err(|error| self.failed(test, &error))
    }

    fn failed(&self, test: usize, error: &ForwardError) -> PredictError {
        PredictError {
            test: self.bench.tests[test].id.clone(),
            reason: error.to_string(),
        }
    }
}

impl Predictor for GearModel<'_> {
    fn predict(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, PredictError> {
        self.read(test, coefficient, parameters, |reading, observation| {
            reading.of(observation)
        })
        .map_err(|error| self.failed(test, &error))
    }

    /// Contacts that are solved give their derivatives for little more; the analytic ones cost as much again for each.
    fn has_derivatives(&self) -> bool {
        self.bench.is_elastic()
    }

    fn linearise(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
        moves: &[Move],
    ) -> Option<Result<Linearised, PredictError>> {
        let found = self.linearised(test, coefficient, parameters, moves);
        found.map_err(|error| self.failed(test, &error)).transpose()
    }
}

/// What `values` gives of the observations of each run, in the order of all.
fn by_row<T, E>(runs: &[Run], values: impl Fn(&Run) -> Result<Vec<T>, E>) -> Result<Vec<T>, E> {
    if let [run] = runs {
        return values(run);
    }
    let mut all: Vec<(usize, T)> = Vec::new();
    for run in runs {
        all.extend(run.rows.iter().copied().zip(values(run)?));
    }
    all.sort_by_key(|(row, _)| *row);
    Ok(all.into_iter().map(|(_, value)| value).collect())
}

/// One test at some parameters, or what of it is of one tooth.
struct Run {
    test: usize,
    /// The member whose measured tooth it is of; none: of the mean tooth, or of all where they are alike.
    tooth: Option<Member>,
    acting: Option<Acting>,
    /// Wear coefficient of the history, mm²/N.
    worn_with: f64,
    /// Cycles of the history per cycle of the test.
    stretch: f64,
    /// The parameters, and which tooth.
    bits: Vec<u64>,
    /// The observations that are read from it.
    rows: Vec<usize>,
    /// The same by ascending cycles.
    order: Vec<usize>,
}

impl Run {
    fn key(&self) -> Key {
        (self.test, self.bits.clone(), self.worn_with.to_bits())
    }
}
