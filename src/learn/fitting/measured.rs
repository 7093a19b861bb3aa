//! A study with its measurements: the bench on which its models are fitted.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::learn::fitting::fit::{Coefficient, FitError, Problem, is_within_noise};
use crate::learn::fitting::fitted::Fit;
use crate::learn::hypothesis::parameters::Parameter;
use crate::learn::hypothesis::version::{ModelVersion, parameter};
use crate::learn::inference::search::Effort;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::bench::{Bench, MeasuredTest, Workshop};
use crate::learn::prediction::gear_model::GearModel;
use crate::learn::prediction::predictor::{Linearised, Move, PredictError, Predictor};
use crate::measure::Dataset;
use crate::simulate::forward::{ContactKind, ForwardError};
use crate::study::{FreeParameter, Role, Study, WEAR_COEFFICIENT};

/// Measurements of a study's tests.
pub struct Measured<'a> {
    study: &'a Study,
    /// The measurements.
    pub data: Dataset,
    /// Role of each test.
    pub roles: Vec<Role>,
    tests: Vec<MeasuredTest>,
    /// Members of the cheaper models (analytic contact, coarse elements), made when one is first asked; None where they cannot be.
    pub(in crate::learn) cheaper: [OnceLock<Option<Workshop>>; 2],
}

impl<'a> Measured<'a> {
    /// Sorts `data` by the study's tests.
    pub fn new(study: &'a Study, data: Dataset) -> Self {
        let of_test = |number: usize| {
            let rows = data.observations.iter();
            rows.filter(|o| o.test == number).cloned().collect()
        };
        let tests = study
            .tests
            .iter()
            .enumerate()
            .map(|(number, test)| MeasuredTest {
                id: test.id.clone(),
                conditions: (test.conditions).simulated(&study.wear_at(&test.conditions)),
                wear: (
                    study.wear.coefficient,
                    study.wear_at(&test.conditions).members,
                ),
                materials: study.elastic_at(&test.conditions),
                surroundings: study.surroundings(&test.conditions),
                reversed: test.conditions.reversed,
                observations: of_test(number),
            });
        Self {
            tests: tests.collect(),
            roles: study.tests.iter().map(|test| test.role).collect(),
            study,
            data,
            cheaper: Default::default(),
        }
    }

    /// The study.
    pub fn study(&self) -> &'a Study {
        self.study
    }

    /// The tests.
    pub fn tests(&self) -> &[MeasuredTest] {
        &self.tests
    }

    /// The members for all tests, by `kind`.
    ///
    /// # Errors
    /// [`ForwardError`] if a pair cannot run or a member cannot be built.
    pub fn workshop(&self, kind: ContactKind) -> Result<Workshop, ForwardError> {
        let (set, numerics) = (self.study.gear_set(), self.study.resolution());
        Workshop::new(set, numerics, kind, &self.tests)
    }

    /// The bench in a workshop.
    ///
    /// # Errors
    /// [`ForwardError`] of the first test that cannot run.
    pub fn bench<'b>(&self, workshop: &'b Workshop) -> Result<Bench<'b>, ForwardError> {
        workshop.bench(self.tests.clone())
    }

    /// The bench in a workshop, with the finest wear steps.
    ///
    /// # Errors
    /// As [`Measured::bench`].
    pub fn finest_bench<'b>(&self, workshop: &'b Workshop) -> Result<Bench<'b>, ForwardError> {
        workshop.finest(self.tests.clone())
    }

    /// Fits a version of the model from each of `starts`, which hold a value for every free parameter but k; `watch` hears after each
    /// wear history of a test how many there have been.
    ///
    /// # Errors
    /// [`FitError`]
    pub fn fit(
        &self,
        bench: &Bench,
        version: &ModelVersion,
        noise: NoiseModel,
        starts: &[Vec<f64>],
        effort: &Effort,
        watch: &(dyn Fn(usize) + Sync),
    ) -> Result<Fit, FitError> {
        self.with_problem(bench, version, noise, watch, |problem| {
            problem.judged(problem.fit_from(starts, effort)?, effort)
        })
    }

    /// A version's fit as a problem, for `act`.
    pub(in crate::learn) fn with_problem<T>(
        &self,
        bench: &Bench,
        version: &ModelVersion,
        noise: NoiseModel,
        watch: &(dyn Fn(usize) + Sync),
        act: impl FnOnce(&Problem<'_>) -> T,
    ) -> T {
        let is_k = |free: &&FreeParameter| free.name == WEAR_COEFFICIENT;
        let coefficient = match version.free.iter().find(is_k) {
            Some(free) => Coefficient::Free(parameter(free)),
            None => Coefficient::Fixed(self.study.wear.coefficient),
        };
        let parameters: Vec<Parameter> = (version.free.iter().filter(|free| !is_k(free)))
            .map(parameter)
            .collect();
        let names: Vec<String> = parameters.iter().map(|p| p.name.clone()).collect();
        let model = GearModel::of_effects(bench, &version.effects, names).giving_up();
        let problem = Problem {
            data: &self.data,
            roles: &self.roles,
            predictor: &Counted {
                model,
                count: AtomicUsize::new(0),
                watch,
            },
            coefficient,
            parameters,
            noise,
        };
        act(&problem)
    }

    /// Number of measurements of the fit tests.
    pub(in crate::learn) fn fitted_points(&self) -> usize {
        let rows = self.data.observations.iter();
        rows.filter(|o| self.roles[o.test] == Role::Fit).count()
    }

    /// What a fit leaves of the fit tests.
    pub(in crate::learn) fn misfit(&self, fit: &Fit) -> Misfit {
        self.misfit_of(Role::Fit, fit)
    }

    /// χ² of the tests of a role, and their points.
    pub(in crate::learn) fn misfit_of(&self, role: Role, fit: &Fit) -> Misfit {
        let rows = self.data.observations.iter().zip(&fit.rows);
        let fitted = rows.filter(|(o, _)| self.roles[o.test] == role && fit.judges(o.test));
        let none = Misfit {
            square: 0.0,
            points: 0.0,
        };
        fitted.fold(none, |sum, (_, row)| Misfit {
            square: sum.square + row.standardised.powi(2),
            points: sum.points + 1.0,
        })
    }
}

/// How far a fit is from the measurements of its tests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::learn) struct Misfit {
    /// χ².
    pub(in crate::learn) square: f64,
    /// Points, which is what noise leaves of it.
    pub(in crate::learn) points: f64,
}

/// χ² per point beyond that of noise from which a fit is far from the measurements.
const FAR: f64 = 1.0;

impl Misfit {
    /// χ² beyond that of noise.
    pub(in crate::learn) fn beyond_noise(&self) -> f64 {
        (self.square - self.points).max(0.0)
    }

    /// Whether far more than noise is left: the last decimals of such a fit say nothing.
    pub(in crate::learn) fn is_far(&self) -> bool {
        self.beyond_noise() > FAR * self.points
    }

    /// Whether no more than noise is left.
    pub(in crate::learn) fn is_noise(&self) -> bool {
        is_within_noise(self.square, self.points as usize)
    }
}

/// A model that tells how often it was asked.
struct Counted<'w, P> {
    model: P,
    count: AtomicUsize,
    watch: &'w (dyn Fn(usize) + Sync),
}

impl<P: Predictor> Predictor for Counted<'_, P> {
    fn predict(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, PredictError> {
        let found = self.model.predict(test, coefficient, parameters);
        (self.watch)(self.count.fetch_add(1, Ordering::Relaxed) + 1);
        found
    }

    fn has_derivatives(&self) -> bool {
        self.model.has_derivatives()
    }

    fn linearise(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
        moves: &[Move],
    ) -> Option<Result<Linearised, PredictError>> {
        let found = (self.model).linearise(test, coefficient, parameters, moves);
        (self.watch)(self.count.fetch_add(1, Ordering::Relaxed) + 1);
        found
    }
}

#[cfg(test)]
mod tests;
