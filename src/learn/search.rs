//! The most probable state: Levenberg and Marquardt's damped Gauss-Newton steps within bounds.
//!
//! Every state that is tried is predicted with its derivatives, exact for the gears ([`crate::wear::tangent`]); a predictor without any is
//! differenced where a step was accepted. All tests run side by side. ∂f_t/∂ln k and ∂f_t/∂ε_t are one and the same. The scatter σ_k is
//! chosen anew before each step (see [`super::scatter`]).
//!
//! Derivatives hold for the steps that a wear history takes. Another state's history takes others, so that predictions carry the rounding of
//! their step control, which no derivative sees: where a fit finds no better state although one is promised, that rounding may be all that is left
//! ([`Effort::floor`]).

mod differences;

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::evaluate::{Evaluator, Point};
use super::noise::Covariance;
use super::parameters::Parameter;
use super::predictor::{Move, PredictError};
use super::quadratic::{Layout, Normal, Quadratic, State};
use super::scatter::most_probable;
use crate::study::Scatter;

/// How long and how finely a fit searches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Most steps.
    pub iterations: usize,
    /// A fit has converged when a further step promises less than this of ln posterior.
    pub tolerance: f64,
    /// Loss of ln posterior that a step which fails to better it may have promised and the fit still counts as converged:
    /// the predictions' own rounding then hides the rest. 0.05 is a third of a standard deviation.
    pub floor: f64,
    /// Part of the misfit beyond noise by which the promise and the loss above may be larger: where a model is far from its measurements
    /// its last decimals say nothing, and the rounding of its predictions weighs more.
    pub share: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            iterations: 40,
            tolerance: 1e-4,
            floor: 0.05,
            share: 0.0,
        }
    }
}

impl Effort {
    /// Taking stock of a state without leaving it.
    pub const STAY: Self = Self {
        iterations: 0,
        tolerance: 0.0,
        floor: 0.0,
        share: 0.0,
    };

    /// For predictions that are simulations: costly, and with a rounding of their own from step control (about 1e-4 of the
    /// largest depth, which over thousands of points moves ln posterior by some tenths).
    pub fn for_simulations() -> Self {
        Self {
            iterations: 15,
            tolerance: 1e-2,
            floor: 0.3,
            share: 3e-4,
        }
    }
}

/// One problem of some tests.
pub(super) struct Search<'s> {
    /// The tests, by their number in the data set.
    pub(super) tests: Vec<usize>,
    /// Rows of each of them among those of `measured`.
    pub(super) rows: Vec<Vec<usize>>,
    pub(super) measured: Vec<f64>,
    /// Rows whose prediction grows with the wear coefficient.
    pub(super) worn: Vec<bool>,
    pub(super) covariance: Arc<Covariance>,
    pub(super) layout: Layout,
    pub(super) coefficient: Option<&'s Parameter>,
    pub(super) parameters: &'s [Parameter],
    pub(super) scatter: Scatter,
}

/// Where a search ended.
pub(super) struct Found {
    pub(super) state: State,
    pub(super) scatter: f64,
    /// Model values of the rows.
    pub(super) model: Vec<f64>,
    pub(super) normal: Normal,
    /// Derivatives of the rows with respect to (θ, ln k_t), without whitening.
    pub(super) jacobian: DMatrix<f64>,
    pub(super) objective: f64,
    pub(super) iterations: usize,
    pub(super) converged: bool,
}

/// By how much a first k is made smaller where the model has no answer, and how often at most.
const SMALLER: f64 = 3.0;
const SMALLER_STARTS: usize = 8;
/// Length of the moves along which predictors are asked for derivatives, in the prior's scale.
const MOVE: f64 = 1e-7;

/// Model values per test.
type Values = Vec<Arc<[f64]>>;

/// What the model says at a state.
pub(super) struct Answer {
    pub(super) values: Values,
    /// Derivatives of the rows with respect to (θ, ln k_t), if the predictor has any.
    jacobian: Option<DMatrix<f64>>,
}

impl Search<'_> {
    /// Searches from `state`; `theta` of the state is also what the predictor is given where no parameter is free.
    pub(super) fn run(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: State,
        effort: &Effort,
    ) -> Result<Found, PredictError> {
        let (state, answer) = self.scaled_start(evaluator, state, true)?;
        self.descend(evaluator, state, answer, effort)
    }

    /// Searches from where another search ended: as [`Search::run`], with k as it is.
    pub(super) fn go_on(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: State,
        effort: &Effort,
    ) -> Result<Found, PredictError> {
        let answer = self.ask(evaluator, &state, true)?;
        self.descend(evaluator, state, answer, effort)
    }

    fn descend(
        &self,
        evaluator: &mut Evaluator<'_>,
        mut state: State,
        answer: Answer,
        effort: &Effort,
    ) -> Result<Found, PredictError> {
        let mut jacobian = self.jacobian(evaluator, &state, &answer)?;
        let mut values = answer.values;
        let mut damping = 1e-3;
        let mut iterations = 0;
        let (converged, scatter, normal) = loop {
            let normal = self.normal(&values, &jacobian);
            let scatter = most_probable(self.scatter, &self.layout, &normal, &state);
            let quadratic = Quadratic::new(&self.layout, &normal, &state, scatter);
            let promised = quadratic.step(0.0).decrease;
            let beyond = 0.5 * (normal.square - self.measured.len() as f64).max(0.0);
            if promised <= effort.tolerance + effort.share * beyond {
                break (true, scatter, normal);
            }
            if iterations == effort.iterations {
                break (false, scatter, normal);
            }
            iterations += 1;
            let tried = self.improve(evaluator, &quadratic, &state, scatter, &mut damping);
            let Some((next, answer)) = tried else {
                let floor = effort.floor + effort.share * beyond;
                break (promised <= floor, scatter, normal);
            };
            jacobian = self.jacobian(evaluator, &next, &answer)?;
            (state, values) = (next, answer.values);
        };
        Ok(Found {
            objective: self.layout.objective(normal.square, &state, scatter),
            model: self.joined(&values),
            state,
            scatter,
            normal,
            jacobian,
            iterations,
            converged,
        })
    }

    /// Sum of the squared whitened residuals at `state`, with k (if free) scaled to the measured size.
    pub(super) fn misfit(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: State,
    ) -> Result<f64, PredictError> {
        let (_, answer) = self.scaled_start(evaluator, state, false)?;
        Ok(self.square(&answer.values))
    }

    /// A state with a higher posterior at this scatter, by ever shorter steps; None if there seems to be none.
    fn improve(
        &self,
        evaluator: &mut Evaluator<'_>,
        quadratic: &Quadratic,
        state: &State,
        scatter: f64,
        damping: &mut f64,
    ) -> Option<(State, Answer)> {
        for _ in 0..8 {
            let step = quadratic.step(*damping);
            let next = self.layout.moved(state, &step.x, scatter);
            if let Ok(answer) = self.ask(evaluator, &next, true) {
                let square = self.square(&answer.values);
                let gained = quadratic.value - self.layout.objective(square, &next, scatter);
                if gained > 1e-3 * step.decrease {
                    let good = gained > 0.75 * step.decrease;
                    *damping = if good { *damping * 0.1 } else { *damping };
                    *damping = damping.max(1e-6);
                    return Some((next, answer));
                }
            }
            *damping = (*damping * 10.0).max(0.1);
        }
        None
    }

    /// The start with k (if free) scaled so that wear has the size of the measured one, and what the model says there.
    pub(super) fn scaled_start(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: State,
        differentiated: bool,
    ) -> Result<(State, Answer), PredictError> {
        let (mut state, answer) = self.first(evaluator, state, differentiated)?;
        let Some(prior) = &self.layout.coefficient else {
            return Ok((state, answer));
        };
        let only_worn = |v: Vec<f64>| -> Vec<f64> {
            v.iter()
                .zip(&self.worn)
                .map(|(v, &worn)| if worn { *v } else { 0.0 })
                .collect()
        };
        let model = self
            .covariance
            .whiten(&only_worn(self.joined(&answer.values)));
        let measured = self.covariance.whiten(&only_worn(self.measured.clone()));
        let product: f64 = model.iter().zip(&measured).map(|(f, y)| f * y).sum();
        let factor = (product / squared(&model)).clamp(0.01, 100.0);
        if !factor.is_finite() || product <= 0.0 || factor.ln().abs() < 0.1 {
            return Ok((state, answer));
        }
        let before = state.log_k;
        state.log_k = (before + factor.ln()).clamp(prior.lower, prior.upper);
        if let Ok(scaled) = self.ask(evaluator, &state, differentiated)
            && self.square(&scaled.values) < self.square(&answer.values)
        {
            return Ok((state, scaled));
        }
        state.log_k = before;
        Ok((state, answer))
    }

    /// What the model says at a start, with k (if free) so much smaller that it says anything: a first guess of k, or an effect at its first
    /// values, may wear the flanks beyond what a model can follow.
    fn first(
        &self,
        evaluator: &mut Evaluator<'_>,
        mut state: State,
        differentiated: bool,
    ) -> Result<(State, Answer), PredictError> {
        let mut found = self.ask(evaluator, &state, differentiated);
        if let Some(prior) = &self.layout.coefficient {
            let mut smaller = state.clone();
            for _ in 0..SMALLER_STARTS {
                smaller.log_k -= SMALLER.ln();
                if found.is_ok() || smaller.log_k < prior.lower {
                    break;
                }
                if let Ok(answer) = self.ask(evaluator, &smaller, differentiated) {
                    (state, found) = (smaller.clone(), Ok(answer));
                }
            }
        }
        Ok((state, found?))
    }

    /// What the model says at a state; with derivatives if they are wanted and the predictor has any.
    fn ask(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
        differentiated: bool,
    ) -> Result<Answer, PredictError> {
        let tests = 0..self.tests.len();
        let points: Vec<Point> = tests.map(|test| self.point(state, test)).collect();
        let linearised = if differentiated {
            evaluator.all_linearised(&points, &self.moves(state))
        } else {
            None
        };
        let Some(linearised) = linearised else {
            let values: Result<Values, _> = evaluator.all(&points).into_iter().collect();
            return Ok(Answer {
                values: values?,
                jacobian: None,
            });
        };
        let params = self.layout.parameters.len();
        let mut jacobian = DMatrix::zeros(self.measured.len(), params + self.tests.len());
        let mut values = Vec::with_capacity(self.tests.len());
        for (test, found) in linearised.into_iter().enumerate() {
            let found = found?;
            for (&row, slopes) in self.rows[test].iter().zip(found.derivatives.row_iter()) {
                for p in 0..params {
                    jacobian[(row, p)] = slopes[p];
                }
                jacobian[(row, params + test)] = slopes[params];
            }
            values.push(found.values.as_slice().into());
        }
        Ok(Answer {
            values,
            jacobian: Some(jacobian),
        })
    }

    /// The derivatives that came with an answer, else differences.
    fn jacobian(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
        answer: &Answer,
    ) -> Result<DMatrix<f64>, PredictError> {
        match &answer.jacobian {
            Some(jacobian) => Ok(jacobian.clone()),
            None => self.differences(evaluator, state, &answer.values),
        }
    }

    /// A small move of each parameter that is searched, away from a near bound; its length is told on the natural scale.
    fn moves(&self, state: &State) -> Vec<Move> {
        let here = self.values(&state.theta);
        let of = |p: usize| {
            let prior = &self.layout.parameters[p];
            let step = MOVE * prior.scale();
            let inside = state.theta[p] + step <= prior.upper;
            let step = if inside { step } else { -step };
            let mut parameters = here.to_vec();
            parameters[p] = self.parameters[p].value(state.theta[p] + step);
            Move { parameters, step }
        };
        (0..self.layout.parameters.len()).map(of).collect()
    }

    fn point(&self, state: &State, test: usize) -> Point {
        let log_k = state.log_k + state.epsilon[test];
        Point {
            test: self.tests[test],
            coefficient: log_k.exp(),
            parameters: self.values(&state.theta),
        }
    }

    fn values(&self, theta: &[f64]) -> Arc<[f64]> {
        self.parameters
            .iter()
            .zip(theta)
            .map(|(p, &x)| p.value(x))
            .collect()
    }

    fn normal(&self, values: &Values, jacobian: &DMatrix<f64>) -> Normal {
        let residual = DVector::from_vec(self.covariance.whiten(&self.residual(values)));
        let mut white = DMatrix::zeros(jacobian.nrows(), jacobian.ncols());
        for column in 0..jacobian.ncols() {
            let whitened = self.covariance.whiten(jacobian.column(column).as_slice());
            white.column_mut(column).copy_from_slice(&whitened);
        }
        Normal {
            gram: white.transpose() * &white,
            rhs: white.transpose() * &residual,
            square: squared(residual.as_slice()),
        }
    }

    fn joined(&self, values: &Values) -> Vec<f64> {
        let mut joined = vec![0.0; self.measured.len()];
        for (rows, values) in self.rows.iter().zip(values) {
            for (&row, value) in rows.iter().zip(values.iter()) {
                joined[row] = *value;
            }
        }
        joined
    }

    /// Sum of the squared whitened residuals.
    fn square(&self, values: &Values) -> f64 {
        squared(&self.covariance.whiten(&self.residual(values)))
    }

    fn residual(&self, values: &Values) -> Vec<f64> {
        self.measured
            .iter()
            .zip(self.joined(values))
            .map(|(y, f)| y - f)
            .collect()
    }
}

fn squared(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum()
}
