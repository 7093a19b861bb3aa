//! The gear pair as a fit sees it: a wear history of each test, read at the measured places and times.
//!
//! Histories are kept, so that a wear coefficient more costs nothing where it only stretches time ([`super::trajectory`]).

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use crate::effects::{Combined, Hook, Local};
use crate::learn::bench::Bench;
use crate::learn::observe::Reading;
use crate::learn::predictor::{PredictError, Predictor};
use crate::learn::trajectory::Trajectory;
use crate::measure::Observation;
use crate::simulate::forward::{Forward, ForwardError, Mounting};
use crate::wear::acting::Acting;

/// Builds the effects of a model from the values of its free parameters.
pub type EffectsOf<'a> = Box<dyn Fn(&[f64]) -> Combined + Send + Sync + 'a>;

/// A model of the gears on a bench: base model and effects, with some of the effects' parameters free.
pub struct GearModel<'a> {
    bench: &'a Bench<'a>,
    effects: EffectsOf<'a>,
    stretches: bool,
    histories: Mutex<HashMap<Key, Arc<Trajectory>>>,
    mountings: Mutex<HashMap<usize, Vec<Mounted>>>,
}

/// What a history belongs to: test, bits of the parameters, bits of the wear coefficient it was worn with.
type Key = (usize, Vec<u64>, u64);

/// A mounting that effects make, and the bits of the parameters it belongs to.
type Mounted = (Vec<u64>, Mounting);

/// Mountings kept of each test, those used last: a derivative with respect to k comes after those with respect to parameters, and each
/// mounting holds a mesh cycle and its compliance.
const MOUNTINGS: usize = 3;

impl<'a> GearModel<'a> {
    /// The model with `effects`, from parameter values in the order that callers of [`Predictor::predict`] use.
    pub fn new(bench: &'a Bench<'a>, effects: EffectsOf<'a>) -> Self {
        Self {
            bench,
            effects,
            stretches: false,
            histories: Mutex::default(),
            mountings: Mutex::default(),
        }
    }

    /// The same, where the wear coefficient only stretches time: every effect multiplies it and none has a clock.
    pub fn stretching(mut self, stretches: bool) -> Self {
        self.stretches = stretches;
        self
    }

    /// The history of a test up to `cycles` at least.
    ///
    /// No lock is held while it wears: whoever else wants the same one meanwhile makes the same steps.
    fn history(
        &self,
        forward: &mut Forward,
        key: Key,
        cycles: f64,
    ) -> Result<Arc<Trajectory>, ForwardError> {
        let kept = || {
            self.histories
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
        };
        let known = kept().get(&key).cloned().unwrap_or_default();
        if known.reaches(cycles) {
            return Ok(known);
        }
        let mut longer = Trajectory::clone(&known);
        longer.reach(forward, cycles)?;
        let longer = Arc::new(longer);
        kept().insert(key, Arc::clone(&longer));
        Ok(longer)
    }

    /// A fresh run of a test, on the mounting that one with the same parameters (by their bits) has made if effects change it.
    fn forward<'b>(
        &'b self,
        test: usize,
        coefficient: f64,
        bits: &[u64],
        acting: Option<&'b Acting>,
    ) -> Result<Forward<'b>, ForwardError> {
        let template = &self.bench.templates[test];
        let (_, members) = self.bench.tests[test].wear;
        let coefficients = members.map(|factor| factor * coefficient);
        if !acting.is_some_and(|acting| acting.acts(Hook::Operation)) {
            return template.again(coefficients, acting);
        }
        let kept = || {
            self.mountings
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
        };
        let known = kept().get_mut(&test).and_then(|mountings| {
            let at = mountings.iter().position(|(own, _)| own == bits)?;
            mountings[at..].rotate_left(1);
            mountings.last().map(|(_, mounting)| mounting.clone())
        });
        if let Some(mounting) = known {
            return template.again_at(&mounting, coefficients, acting);
        }
        let forward = template.again(coefficients, acting)?;
        let mut all = kept();
        let mountings = all.entry(test).or_default();
        if mountings.len() == MOUNTINGS {
            mountings.remove(0);
        }
        mountings.push((bits.to_vec(), forward.mounting()));
        Ok(forward)
    }

    /// What `of` reads of every observation of a test.
    fn read<T>(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
        of: impl Fn(&mut Reading<'_, '_>, &Observation) -> Result<T, ForwardError>,
    ) -> Result<Vec<T>, ForwardError> {
        let measured = &self.bench.tests[test];
        let effects = (self.effects)(parameters);
        let acting = (!effects.is_empty()).then(|| self.bench.acting(test, effects));
        // one history in a coefficient of the test's own serves all others
        let worn_with = if self.stretches {
            measured.wear.0
        } else {
            coefficient
        };
        let stretch = coefficient / worn_with;
        let bits: Vec<u64> = parameters.iter().map(|p| p.to_bits()).collect();
        let mut forward = self.forward(test, worn_with, &bits, acting.as_ref())?;
        let observed = |row: &usize| stretch * measured.observations[*row].cycles;
        let mut order: Vec<usize> = (0..measured.observations.len()).collect();
        order.sort_by(|a, b| observed(a).total_cmp(&observed(b)).then(a.cmp(b)));
        let Some(last) = order.last() else {
            return Ok(Vec::new());
        };
        let key = (test, bits, worn_with.to_bits());
        let history = self.history(&mut forward, key, observed(last))?;
        let mut values: Vec<(usize, T)> = Vec::with_capacity(order.len());
        for rows in order.chunk_by(|a, b| observed(a) == observed(b)) {
            let state = history.at(observed(&rows[0]));
            let mut reading = Reading::new(&mut forward, &state, self.bench.set());
            for &row in rows {
                values.push((row, of(&mut reading, &measured.observations[row])?));
            }
        }
        values.sort_by_key(|(row, _)| *row);
        Ok(values.into_iter().map(|(_, value)| value).collect())
    }

    /// What every observation of a test feels where and when it was made; none for what stands nowhere on a flank.
    ///
    /// # Errors
    /// As [`Predictor::predict`].
    pub(super) fn locals(
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
}
