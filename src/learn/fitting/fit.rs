//! Fits what is free to the measurements of the fit tests, then judges the held-out ones.

use nalgebra::DMatrix;

use crate::learn::fitting::fitted::{Fit, PredictionUncertainty, RowFit, TestFit};
use crate::learn::fitting::held_out::HeldOut;
use crate::learn::hypothesis::parameters::{Estimate, Parameter};
use crate::learn::inference::quadratic::{Layout, Quadratic, State};
use crate::learn::inference::scatter::marginal;
use crate::learn::inference::search::{Effort, Search, SearchEnd};
use crate::learn::inference::selection::Selection;
use crate::learn::noise::{Datum, NoiseModel};
use crate::learn::prediction::evaluate::Evaluator;
use crate::learn::prediction::predictor::{PredictError, Predictor};
use crate::measure::Dataset;
use crate::numeric::halton::halton;
use crate::study::{Role, Scatter};

/// A model, what is free in it, and the measurements.
pub struct Problem<'a> {
    /// The measurements.
    pub data: &'a Dataset,
    /// The role of each test of the data set.
    pub roles: &'a [Role],
    /// The model.
    pub predictor: &'a dyn Predictor,
    /// The wear coefficient.
    pub coefficient: Coefficient,
    /// The model's free effect parameters, in its order.
    pub parameters: Vec<Parameter>,
    /// What the measurements carry beyond the model.
    pub noise: NoiseModel,
}

/// The wear coefficient common to all tests.
#[derive(Debug, Clone, PartialEq)]
pub enum Coefficient {
    /// Fitted.
    Free(Parameter),
    /// Known, mm²/N; single tests may still scatter about it.
    Fixed(f64),
}

/// A model at one place, with k, if free, scaled to the measurements.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::learn) struct ScaledPrediction {
    /// χ² of the fit tests.
    pub(in crate::learn) square: f64,
    /// k, mm²/N.
    pub(in crate::learn) coefficient: f64,
    /// Predictions of each fit test, by test of the data set.
    pub(in crate::learn) predictions: Vec<Vec<f64>>,
}

/// Why there is no fit.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FitError {
    /// The model has no answer at the start or in every direction from where the fit stands.
    #[error("the model cannot be fitted: {0}")]
    Predict(#[from] PredictError),
    /// Nothing to fit to.
    #[error("no test with role \"fit\" has a measurement")]
    NoObservations,
}

/// χ² above the number of points, in standard deviations of noise's own, up to which a model is within the noise.
const WITHIN_NOISE: f64 = 3.0;

/// Whether χ² of so many points is no more than noise makes.
pub(in crate::learn) fn is_within_noise(square: f64, points: usize) -> bool {
    let points = points as f64;
    square < points + WITHIN_NOISE * (2.0 * points).sqrt()
}

impl Problem<'_> {
    /// The fit from the parameters' starts, the held-out tests judged.
    ///
    /// # Errors
    /// [`FitError`].
    pub fn fit(&self, effort: &Effort) -> Result<Fit, FitError> {
        let start: Vec<f64> = self.parameters.iter().map(|p| p.start).collect();
        self.judged(self.fit_from(&[start], effort)?, effort)
    }

    /// The best fit from several starts: each the values of all effect parameters. The held-out tests are left for [`Problem::judged`].
    ///
    /// # Errors
    /// [`FitError`] if no start leads to a fit.
    pub fn fit_from(&self, starts: &[Vec<f64>], effort: &Effort) -> Result<Fit, FitError> {
        let selection = self.selection(Role::Fit);
        let fit = self.search(&selection, Some(&self.coefficient));
        if selection.tests.is_empty() {
            return Err(FitError::NoObservations);
        }
        let mut evaluator = selection.evaluator(self.predictor);
        // by evidence: the density at a mode does not count what it costs to let the tests' own k take up a misfit
        let evidence = |end: &SearchEnd| {
            let found = marginal(self.noise.scatter, &fit.layout, &end.normal, &end.state);
            found.log_integral - end.promised
        };
        let mut best: Option<(f64, SearchEnd)> = None;
        let mut failure = None;
        for start in starts {
            let state = self.state(start, selection.tests.len());
            match fit.run(&mut evaluator, state, effort) {
                // A later start must be better by more than the tolerance, so that equals keep their order.
                Ok(found) => {
                    let own = evidence(&found);
                    if best
                        .as_ref()
                        .is_none_or(|(b, _)| own > b + effort.tolerance)
                    {
                        best = Some((own, found));
                    }
                }
                Err(error) => failure = failure.or(Some(error)),
            }
        }
        let found = match (best, failure) {
            (Some((_, found)), _) => found,
            (None, Some(error)) => return Err(error.into()),
            (None, None) => return Err(FitError::NoObservations),
        };
        Ok(self.finish(&fit, found, &evaluator))
    }

    /// The same problem, its searches beginning with another k (mm²/N) if that is free; None: the same.
    pub(in crate::learn) fn beginning_at(&self, coefficient: Option<f64>) -> Problem<'_> {
        let mut begins = self.coefficient.clone();
        if let (Coefficient::Free(k), Some(value)) = (&mut begins, coefficient) {
            k.start = value.clamp(k.lower, k.upper);
        }
        Problem {
            coefficient: begins,
            parameters: self.parameters.clone(),
            ..*self
        }
    }

    /// Places spread over the priors.
    pub fn places(&self, count: usize) -> Vec<Vec<f64>> {
        let place = |i: usize| -> Vec<f64> {
            let point = halton(i, self.parameters.len());
            let each = self.parameters.iter().zip(point);
            each.map(|(p, share)| p.quantile(share)).collect()
        };
        (0..count).map(place).collect()
    }

    /// Of some places, those from which a search is worth while: up to `keep` at which the model is nearest to the measurements,
    /// with k scaled to fit, and nearer than at the parameters' starts.
    ///
    /// A search goes downhill. Phases, wave numbers and resonances have several valleys.
    pub fn nearest(&self, places: Vec<Vec<f64>>, keep: usize) -> Vec<Vec<f64>> {
        let selection = self.selection(Role::Fit);
        let search = self.search(&selection, Some(&self.coefficient));
        let mut evaluator = selection.evaluator(self.predictor);
        let mut misfit = |start: &[f64]| {
            let state = self.state(start, selection.tests.len());
            search.misfit(&mut evaluator, state).ok()
        };
        let own: Vec<f64> = self.parameters.iter().map(|p| p.start).collect();
        let most = misfit(&own).unwrap_or(f64::INFINITY);
        let mut found: Vec<(f64, Vec<f64>)> = places
            .into_iter()
            .filter_map(|start| Some((misfit(&start)?, start)))
            .filter(|(misfit, _)| *misfit < most)
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.truncate(keep);
        found.into_iter().map(|(_, start)| start).collect()
    }

    /// The model at a place, with k scaled to the measurements; None if it has no answer there.
    pub(in crate::learn) fn scaled(&self, place: &[f64]) -> Option<ScaledPrediction> {
        let selection = self.selection(Role::Fit);
        let search = self.search(&selection, Some(&self.coefficient));
        let state = self.state(place, selection.tests.len());
        let mut evaluator = selection.evaluator(self.predictor);
        let (state, values) = search.scaled_start(&mut evaluator, state).ok()?;
        let mut predictions = vec![Vec::new(); self.data.tests.len()];
        for (&test, values) in selection.tests.iter().zip(&values) {
            predictions[test] = values.to_vec();
        }
        Some(ScaledPrediction {
            square: search.square(&values),
            coefficient: state.log_k.exp(),
            predictions,
        })
    }

    /// Whether the model at `start`, with k (if free) scaled to fit, is as near to the measurements as their noise lets it be: nothing is to be found
    /// elsewhere then.
    pub(in crate::learn) fn is_within_noise(&self, start: &[f64]) -> bool {
        let selection = self.selection(Role::Fit);
        let search = self.search(&selection, Some(&self.coefficient));
        let state = self.state(start, selection.tests.len());
        let mut evaluator = selection.evaluator(self.predictor);
        // a fit from here will ask for the derivatives, which bring the predictions along
        search.own(&mut evaluator, &state);
        let misfit = search.misfit(&mut evaluator, state);
        misfit.is_ok_and(|square| is_within_noise(square, selection.len()))
    }

    /// The fit from where another to the same measurements ended, with the derivatives that it ended with. The held-out tests are left for
    /// [`Problem::judged`].
    ///
    /// # Errors
    /// [`FitError`].
    pub fn go_on(&self, from: &Fit, effort: &Effort) -> Result<Fit, FitError> {
        let selection = self.selection(Role::Fit);
        let fit = self.search(&selection, Some(&self.coefficient));
        let mut state = self.state_of(from, selection.tests.len());
        let params = self.parameters.len();
        let mut jacobian = DMatrix::zeros(selection.len(), params + selection.tests.len());
        for (i, test) in selection.tests.iter().enumerate() {
            let Some(known) = from.tests.iter().find(|known| known.test == *test) else {
                continue;
            };
            state.epsilon[i] = known.deviation;
            let derivatives = &known.uncertainty.derivatives;
            for (&row, values) in selection.rows[i].iter().zip(derivatives.row_iter()) {
                for p in 0..params {
                    jacobian[(row, p)] = values[p];
                }
                jacobian[(row, params + i)] = values[params];
            }
        }
        let numbers = selection.numbers.iter();
        let before: Vec<f64> = numbers.map(|&row| from.rows[row].model).collect();
        let mut evaluator = selection.evaluator(self.predictor);
        let found = fit.go_on(&mut evaluator, state, jacobian, &before, effort)?;
        Ok(self.finish(&fit, found, &evaluator))
    }

    /// The state at which `fit` ended, its tests' own coefficients aside.
    fn state_of(&self, fit: &Fit, tests: usize) -> State {
        let mut theta: Vec<f64> = self.parameters.iter().map(|p| p.start).collect();
        for (value, parameter) in theta.iter_mut().zip(&self.parameters) {
            let known = fit.parameters.iter().find(|p| p.name == parameter.name);
            *value = known.map_or(*value, |known| known.value);
        }
        let mut state = self.state(&theta, tests);
        state.log_k = fit.coefficient.ln();
        state
    }

    /// `fit` with the held-out tests: their predictions, each with its own most probable wear coefficient and datums.
    ///
    /// # Errors
    /// [`FitError`] if the model has no answer for one of them.
    pub fn judged(&self, mut fit: Fit, effort: &Effort) -> Result<Fit, FitError> {
        let held_out = self.selection(Role::Holdout);
        if held_out.tests.is_empty() {
            return Ok(fit);
        }
        let mut held = self.search(&held_out, None);
        held.scatter = Scatter::Relative(fit.scatter);
        let mut evaluator = held_out.evaluator(self.predictor);
        let state = self.state_of(&fit, held_out.tests.len());
        let found = held.run(&mut evaluator, state, &effort.of_held_out())?;
        self.rows_of(&held, &found, &mut fit.rows, &mut fit.datums);
        // the test does not move the parameters, but what they may be moves its k
        let all = self.search(&held_out, Some(&self.coefficient));
        let jacobian = all.derivatives(&mut evaluator, &found.state)?;
        let normal = held_out.normal(&found.model, &jacobian, &held_out.covariance);
        let known = HeldOut {
            known: &fit.covariance,
            params: self.parameters.len(),
            gram: &normal.gram,
            scatter: found.scatter,
        };
        let covariance = |test: usize| known.covariance(test);
        let tests = self.tests_of(&held_out, &found.state, &jacobian, covariance);
        fit.tests.extend(tests);
        fit.tests.sort_by_key(|test| test.test);
        fit.datums.sort_by_key(|datum| datum.trace);
        fit.evaluations += evaluator.evaluations();
        Ok(fit)
    }

    /// What was found, put together.
    fn finish(&self, fit: &Search<'_>, found: SearchEnd, evaluator: &Evaluator<'_>) -> Fit {
        let posterior = marginal(self.noise.scatter, &fit.layout, &found.normal, &found.state);
        let constant = fit.selection.log_norm(&fit.selection.covariance);
        let nothing = RowFit {
            model: 0.0,
            datum: 0.0,
            residual: 0.0,
            standardised: 0.0,
        };
        let mut rows = vec![nothing; self.data.observations.len()];
        let mut datums = Vec::new();
        self.rows_of(fit, &found, &mut rows, &mut datums);
        let quadratic = Quadratic::new(&fit.layout, &found.normal, &found.state, found.scatter);
        let covariance = quadratic.mapped_covariance();
        let params = self.parameters.len();
        let of_test = |test: usize| {
            let own: Vec<usize> = (0..params).chain([params + test]).collect();
            covariance.select_rows(&own).select_columns(&own)
        };
        let tests = self.tests_of(fit.selection, &found.state, &found.jacobian, of_test);
        Fit {
            parameters: self.estimates(fit, &found, &posterior.covariance),
            coefficient: found.state.log_k.exp(),
            covariance: posterior.covariance,
            scatter: found.scatter,
            scatter_interval: posterior.interval,
            tests,
            datums,
            rows,
            log_posterior: -found.objective - constant,
            log_evidence: posterior.log_integral - constant,
            promised: found.promised,
            converged: found.converged,
            iterations: found.iterations,
            evaluations: evaluator.evaluations(),
        }
    }

    fn estimates(
        &self,
        fit: &Search<'_>,
        found: &SearchEnd,
        covariance: &DMatrix<f64>,
    ) -> Vec<Estimate> {
        // A mode held by a bound is not the centre of its normal: that lies where the parabola is least without bounds.
        let quadratic = Quadratic::new(&fit.layout, &found.normal, &found.state, found.scatter);
        let free = quadratic.least(&fit.layout);
        let coefficient = fit.coefficient.map(|p| (p, found.state.log_k));
        let all = coefficient.into_iter().chain(
            self.parameters
                .iter()
                .zip(found.state.theta.iter().copied()),
        );
        all.enumerate()
            .map(|(i, (parameter, mode))| {
                let sd = covariance[(i, i)].sqrt();
                parameter.estimate(mode, mode + free[i], sd)
            })
            .collect()
    }

    fn rows_of(
        &self,
        search: &Search<'_>,
        found: &SearchEnd,
        rows: &mut [RowFit],
        datums: &mut Vec<Datum>,
    ) {
        let selection = search.selection;
        let residual = selection.residual(&found.model);
        let (errors, found_datums) = selection.covariance.trace_errors(&residual);
        for (i, &row) in selection.numbers.iter().enumerate() {
            let observation = &self.data.observations[row];
            let datum = errors[i];
            let off = found.model[i] + datum - observation.value;
            rows[row] = RowFit {
                model: found.model[i],
                datum,
                residual: off,
                standardised: off / observation.sigma,
            };
        }
        datums.extend(found_datums);
    }

    /// The tests of a selection at a state; `covariance` is that of (θ, ln k_t) for each of them.
    fn tests_of(
        &self,
        selection: &Selection<'_>,
        state: &State,
        jacobian: &DMatrix<f64>,
        covariance: impl Fn(usize) -> DMatrix<f64>,
    ) -> Vec<TestFit> {
        let params = self.parameters.len();
        let of_test = |(i, &test): (usize, &usize)| {
            let columns: Vec<usize> = (0..params).chain([params + i]).collect();
            let rows = &selection.rows[i];
            let deviation = state.epsilon[i];
            let covariance = covariance(i);
            TestFit {
                test,
                role: self.roles[test],
                coefficient: (state.log_k + deviation).exp(),
                sigma: covariance[(params, params)].max(0.0).sqrt(),
                deviation,
                uncertainty: PredictionUncertainty {
                    rows: rows.iter().map(|&row| selection.numbers[row]).collect(),
                    derivatives: jacobian.select_rows(rows).select_columns(&columns),
                    covariance,
                },
            }
        };
        selection.tests.iter().enumerate().map(of_test).collect()
    }

    fn selection(&self, role: Role) -> Selection<'_> {
        Selection::new(self.data, self.roles, role, &self.noise)
    }

    /// The problem of some tests; without a coefficient everything common to the tests is held.
    fn search<'s>(
        &'s self,
        selection: &'s Selection<'s>,
        coefficient: Option<&'s Coefficient>,
    ) -> Search<'s> {
        let free = match coefficient {
            Some(Coefficient::Free(parameter)) => Some(parameter),
            _ => None,
        };
        let priors = self.parameters.iter().map(Parameter::natural_prior);
        Search {
            layout: Layout {
                coefficient: free.map(Parameter::natural_prior),
                parameters: if coefficient.is_some() {
                    priors.collect()
                } else {
                    Vec::new()
                },
                tests: selection.tests.len(),
            },
            selection,
            coefficient: free,
            parameters: &self.parameters,
            scatter: self.noise.scatter,
        }
    }

    fn state(&self, theta: &[f64], tests: usize) -> State {
        State {
            log_k: match &self.coefficient {
                Coefficient::Free(parameter) => parameter.natural_start(parameter.start),
                Coefficient::Fixed(value) => value.ln(),
            },
            theta: self
                .parameters
                .iter()
                .zip(theta)
                .map(|(p, &x)| p.natural_start(x))
                .collect(),
            epsilon: vec![0.0; tests],
        }
    }
}
