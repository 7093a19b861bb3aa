//! The most probable state: Levenberg and Marquardt's damped Gauss-Newton steps within bounds.
//!
//! One round asks for the predictions of all tests at one state, or for all tests' derivatives, the model's own or by forward differences:
//! these run side by side. ∂f_t/∂ln k and ∂f_t/∂ε_t are one and the same. Close to where derivatives were taken they are kept up to date by
//! Broyden's formula instead of being taken anew. The scatter σ_k is chosen anew before each step (see [`crate::learn::scatter`]).
//!
//! Differences of predictions that are simulations are rough: contacts enter and leave a grid, steps are cut anew. Over a short move that roughness
//! outweighs the change itself; carried into derivatives it makes them too large, so that a fit seems to be at rest where it is not, and
//! its parameters better known than they are. So derivatives are not carried over moves shorter than a difference, and a fit settles:
//! where it comes to rest they are taken once more, central and over two posterior standard deviations to each side.

mod derivatives;
mod descent;

use std::sync::Arc;

use nalgebra::DMatrix;

use self::descent::Position;
use crate::learn::hypothesis::parameters::Parameter;
use crate::learn::inference::quadratic::{Layout, Normal, State};
use crate::learn::inference::selection::Selection;
use crate::learn::prediction::evaluate::{Evaluator, Point};
use crate::learn::prediction::predictor::PredictError;
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
    /// How far, in prior standard deviations (for ln k: 1), derivatives are carried before they are taken anew.
    pub carry: f64,
    /// How often, at most, derivatives are taken anew where a fit comes to rest; 0: it ends with those it has.
    pub settle: usize,
    /// Part of the misfit beyond noise by which the promise and the loss above may be larger: where a model is far from its measurements
    /// its last decimals say nothing, and the rounding of its predictions weighs more.
    pub share: f64,
    /// Part of what it promises that a step must gain to be taken.
    pub gain: f64,
}

/// [`Effort::gain`] of all fits but those of smooth functions.
const GAIN: f64 = 1e-3;

impl Default for Effort {
    fn default() -> Self {
        Self {
            iterations: 40,
            tolerance: 1e-4,
            floor: 0.05,
            carry: 0.1,
            settle: 0,
            share: 0.0,
            gain: GAIN,
        }
    }
}

impl Effort {
    /// Taking stock of a state without leaving it.
    pub const STAY: Self = Self {
        iterations: 0,
        tolerance: 0.0,
        floor: 0.0,
        carry: 0.0,
        settle: 0,
        share: 0.0,
        gain: GAIN,
    };

    /// For predictions that are simulations: costly, and with a rounding of their own from step control (about 1e-4 of the
    /// largest depth, which over thousands of points moves ln posterior by some tenths).
    pub fn for_simulations() -> Self {
        Self {
            iterations: 15,
            tolerance: 1e-2,
            floor: 0.3,
            carry: 0.3,
            settle: 3,
            share: 3e-4,
            gain: GAIN,
        }
    }

    /// The same for held-out tests. Each has one unknown, its own k, of which only the remaining misfit is reported, so it need not be
    /// followed into the roughness of simulations. Functions without roughness (no settling) are.
    pub(in crate::learn) fn of_held_out(self) -> Self {
        if self.settle == 0 {
            return self;
        }
        Self {
            iterations: self.iterations.min(4),
            tolerance: self.tolerance.max(0.1),
            floor: self.floor.max(0.5),
            settle: 1,
            gain: self.gain.max(0.1),
            ..self
        }
    }
}

/// One problem of some tests.
pub(in crate::learn) struct Search<'s> {
    pub(in crate::learn) selection: &'s Selection<'s>,
    pub(in crate::learn) layout: Layout,
    pub(in crate::learn) coefficient: Option<&'s Parameter>,
    pub(in crate::learn) parameters: &'s [Parameter],
    pub(in crate::learn) scatter: Scatter,
}

/// Where a search ended.
#[derive(Clone)]
pub(in crate::learn) struct SearchEnd {
    pub(in crate::learn) state: State,
    pub(in crate::learn) scatter: f64,
    /// Model values of the rows.
    pub(in crate::learn) model: Vec<f64>,
    pub(in crate::learn) normal: Normal,
    /// Derivatives of the rows with respect to (θ, ln k_t), without whitening.
    pub(in crate::learn) jacobian: DMatrix<f64>,
    pub(in crate::learn) objective: f64,
    /// By how much the derivatives promise to lower the objective further.
    pub(in crate::learn) promised: f64,
    pub(in crate::learn) iterations: usize,
    pub(in crate::learn) converged: bool,
}

/// By how much a first k is made smaller where the model has no answer, and how often at most.
const SMALLER: f64 = 3.0;
const SMALLER_STARTS: usize = 8;
/// By how much k is scaled to the measured wear at once, and how often at most.
const MOST_SCALED: f64 = 100.0;
const SCALINGS: usize = 5;
/// Step of the differences in ln k of a test.
const DIFFERENCE_K: f64 = 0.02;

/// Whitened sum of squares by which model values may have moved under derivatives that are kept.
const MOVED: f64 = 1.0;

/// Model values per test.
type Values = Vec<Arc<[f64]>>;
/// The model's own derivatives per test, as far as it has any.
type OwnDerivatives = Vec<Option<DMatrix<f64>>>;

impl Search<'_> {
    /// Searches from `state`; `theta` of the state is also what the predictor is given where no parameter is free.
    pub(in crate::learn) fn run(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: State,
        effort: &Effort,
    ) -> Result<SearchEnd, PredictError> {
        // the model's own derivatives bring the predictions with them
        let own = self.own(evaluator, &state);
        let asked = state.clone();
        let (state, values) = self.scaled_start(evaluator, state)?;
        let own = if state == asked {
            own
        } else {
            self.own(evaluator, &state)
        };
        let taken = self.with_differences(evaluator, &state, &values, own)?;
        let exact = taken.exact;
        let start = Position::new(state, values, taken.jacobian, exact);
        self.descend(evaluator, start, effort)
    }

    /// Goes on from `state`, where another search settled with these derivatives and model values: if the derivatives promise
    /// nothing, it ends there, unless the values have moved so much that derivatives will have too.
    pub(in crate::learn) fn go_on(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: State,
        jacobian: DMatrix<f64>,
        before: &[f64],
        effort: &Effort,
    ) -> Result<SearchEnd, PredictError> {
        let values = self.predict(evaluator, &state)?;
        let joined = self.selection.joined(&values);
        let moved: Vec<f64> = joined.iter().zip(before).map(|(now, b)| now - b).collect();
        let same = squared(&self.selection.covariance.whiten(&moved)) < MOVED;
        let start = Position::new(state, values, jacobian, same);
        self.descend(evaluator, start, effort)
    }

    /// Derivatives of the rows with respect to (θ, ln k_t) at `state`, without whitening.
    pub(in crate::learn) fn derivatives(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
    ) -> Result<DMatrix<f64>, PredictError> {
        let own = self.own(evaluator, state);
        let values = self.predict(evaluator, state)?;
        Ok(self
            .with_differences(evaluator, state, &values, own)?
            .jacobian)
    }

    /// Sum of the squared whitened residuals at `state`, with k (if free) scaled to the measured size.
    pub(in crate::learn) fn misfit(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: State,
    ) -> Result<f64, PredictError> {
        let (_, values) = self.scaled_start(evaluator, state)?;
        Ok(self.square(&values))
    }

    /// The start with k (if free) scaled so that wear has the size of the measured one.
    pub(in crate::learn) fn scaled_start(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: State,
    ) -> Result<(State, Values), PredictError> {
        let (mut state, mut values) = self.first(evaluator, state)?;
        let Some(prior) = &self.layout.coefficient else {
            return Ok((state, values));
        };
        // from a k of another unit it takes several
        for _ in 0..SCALINGS {
            let ratio = self.selection.wear_ratio(&self.selection.joined(&values));
            let factor = ratio.clamp(1.0 / MOST_SCALED, MOST_SCALED);
            if !factor.is_finite() || ratio <= 0.0 || factor.ln().abs() < 0.1 {
                break;
            }
            let before = state.log_k;
            state.log_k = (before + factor.ln()).clamp(prior.lower, prior.upper);
            match self.predict(evaluator, &state) {
                Ok(scaled) if self.square(&scaled) < self.square(&values) => values = scaled,
                _ => {
                    state.log_k = before;
                    break;
                }
            }
            if factor == ratio {
                break;
            }
        }
        Ok((state, values))
    }

    /// The predictions at a start, with k (if free) so much smaller that there are any: a first guess of k, or an effect at its first
    /// values, may wear the flanks beyond what a model can follow.
    fn first(
        &self,
        evaluator: &mut Evaluator<'_>,
        mut state: State,
    ) -> Result<(State, Values), PredictError> {
        let mut found = self.predict(evaluator, &state);
        if let Some(prior) = &self.layout.coefficient {
            let mut smaller = state.clone();
            for _ in 0..SMALLER_STARTS {
                smaller.log_k -= SMALLER.ln();
                if found.is_ok() || smaller.log_k < prior.lower {
                    break;
                }
                if let Ok(values) = self.predict(evaluator, &smaller) {
                    (state, found) = (smaller.clone(), Ok(values));
                }
            }
        }
        Ok((state, found?))
    }

    fn point(&self, state: &State, test: usize) -> Point {
        let log_k = state.log_k + state.epsilon[test];
        Point {
            test: self.selection.tests[test],
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

    fn predict(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
    ) -> Result<Values, PredictError> {
        let points: Vec<Point> = (0..self.selection.tests.len())
            .map(|t| self.point(state, t))
            .collect();
        evaluator.all(&points).into_iter().collect()
    }

    /// Whether two states are no farther apart than a forward difference, in any unknown.
    fn near(&self, a: &State, b: &State) -> bool {
        let priors = self.parameters.iter().zip(&self.layout.parameters);
        let theta = priors.zip(a.theta.iter().zip(&b.theta));
        let mut theta =
            theta.map(|((p, prior), (a, b))| prior.step(*a, *b).abs() <= p.difference(*a).abs());
        let tests = a.epsilon.iter().zip(&b.epsilon);
        let mut tests = tests.map(|(e, f)| (a.log_k + e - b.log_k - f).abs() <= DIFFERENCE_K);
        theta.all(|near| near) && tests.all(|near| near)
    }

    /// How far two states are apart in the priors' scales.
    pub(in crate::learn) fn distance(&self, a: &State, b: &State) -> f64 {
        let theta = self
            .layout
            .parameters
            .iter()
            .zip(a.theta.iter().zip(&b.theta));
        let theta = theta.map(|(prior, (a, b))| prior.step(*a, *b).abs() / prior.scale());
        let tests = a.epsilon.iter().zip(&b.epsilon);
        let tests = tests.map(|(e, f)| (a.log_k + e - b.log_k - f).abs());
        theta.chain(tests).fold(0.0, f64::max)
    }

    /// χ² of the predictions.
    pub(in crate::learn) fn square(&self, values: &Values) -> f64 {
        self.selection.square(&self.selection.joined(values))
    }
}

fn squared(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum()
}
