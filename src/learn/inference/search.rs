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

use std::sync::Arc;

use nalgebra::DMatrix;

use crate::learn::hypothesis::parameters::Parameter;
use crate::learn::inference::quadratic::{Layout, Normal, Quadratic, State};
use crate::learn::inference::scatter::most_probable;
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
    pub(in crate::learn) iterations: usize,
    pub(in crate::learn) converged: bool,
}

/// By how much a first k is made smaller where the model has no answer, and how often at most.
const SMALLER: f64 = 3.0;
const SMALLER_STARTS: usize = 8;
/// By how much k is scaled to the measured wear at once, and how often at most.
const MOST_SCALED: f64 = 100.0;
const SCALINGS: usize = 5;
/// Promised gain of ln posterior up to which a step is short: two posterior standard deviations.
const SHORT: f64 = 2.0;
/// Step of the differences in ln k of a test.
const DIFFERENCE_K: f64 = 0.02;

/// How far a step goes at most, prior standard deviations (for ln k: 1): the derivatives say nothing of what lies beyond, and laws out there, a hundred times
/// as fast as they are measured, take minutes to wear.
const FARTHEST: f64 = 2.0;

/// Gain of ln posterior, in tolerances, up to which a step is none: a fit would creep on the predictions' own roughness.
const NOTHING: f64 = 0.1;

/// The same as a share of what the misfit beyond noise adds to the tolerance: far from the measurements, a fit that gains little in a step would need many.
const CREEP: f64 = 0.5;

/// Whitened sum of squares by which model values may have moved under derivatives that are kept.
const MOVED: f64 = 1.0;

/// Loss of ln posterior allowed to a fit for its misfit, from which on derivatives as they are serve as well as new ones.
const FAR: f64 = 3.0;

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
        let settled = taken.exact.then(|| state.clone());
        self.descend(evaluator, state, values, taken.jacobian, settled, effort)
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
        let settled = same.then(|| state.clone());
        self.descend(evaluator, state, values, jacobian, settled, effort)
    }

    fn descend(
        &self,
        evaluator: &mut Evaluator<'_>,
        mut state: State,
        mut values: Values,
        mut jacobian: DMatrix<f64>,
        mut settled_at: Option<State>,
        effort: &Effort,
    ) -> Result<SearchEnd, PredictError> {
        let mut taken_at = state.clone();
        let mut damping = 1e-3;
        let (mut iterations, mut rounds) = (0, 0);
        let (converged, scatter, normal) = loop {
            let model = self.selection.joined(&values);
            let covariance = &self.selection.covariance;
            let normal = self.selection.normal(&model, &jacobian, covariance);
            let scatter = most_probable(self.scatter, &self.layout, &normal, &state);
            let quadratic = Quadratic::new(&self.layout, &normal, &state, scatter);
            let fresh = taken_at == state;
            let promised = quadratic.step(0.0).decrease;
            let beyond = 0.5 * (normal.square - self.selection.len() as f64).max(0.0);
            let tolerance = effort.tolerance + effort.share * beyond;
            let floor = effort.floor + effort.share * beyond;
            let least = NOTHING * effort.tolerance + CREEP * effort.share * beyond;
            let settled = rounds == effort.settle
                || effort.share * beyond > FAR
                || settled_at.as_ref().is_some_and(|at| self.near(at, &state));
            if promised <= tolerance {
                if !settled {
                    jacobian = self.at_rest(evaluator, &state, &values, &quadratic)?;
                    (taken_at, settled_at) = (state.clone(), Some(state.clone()));
                    rounds += 1;
                    continue;
                }
                if effort.settle > 0 || fresh || self.distance(&taken_at, &state) <= effort.carry {
                    break (true, scatter, normal);
                }
                let own = self.own(evaluator, &state);
                (jacobian, settled_at) = self.anew(evaluator, &state, &values, own, settled_at)?;
                taken_at = state.clone();
                continue;
            }
            if iterations == effort.iterations {
                break (false, scatter, normal);
            }
            iterations += 1;
            if effort.settle > 0
                && settled
                && promised <= SHORT
                && let Some(next) = self.short_step(&quadratic, &state, scatter)
            {
                values = self.along(&jacobian, [&state, &next], &values);
                state = next;
                continue;
            }
            let tried = self.improve(
                evaluator,
                &quadratic,
                &state,
                scatter,
                (&mut damping, effort.gain, least),
                &|next| self.distance(&taken_at, next) > effort.carry,
            );
            let Some((next, next_values, own)) = tried else {
                if !settled {
                    jacobian = self.at_rest(evaluator, &state, &values, &quadratic)?;
                    (taken_at, settled_at) = (state.clone(), Some(state.clone()));
                    rounds += 1;
                    damping = 1e-3;
                    continue;
                }
                if promised <= floor {
                    break (true, scatter, normal);
                }
                if fresh {
                    break (false, scatter, normal);
                }
                let own = self.own(evaluator, &state);
                (jacobian, settled_at) = self.anew(evaluator, &state, &values, own, settled_at)?;
                taken_at = state.clone();
                damping = 1e-3;
                continue;
            };
            if effort.settle > 0 && self.near(&state, &next) {
                (state, values) = (next, next_values);
            } else if self.distance(&taken_at, &next) <= effort.carry {
                self.broyden(&mut jacobian, [&state, &next], [&values, &next_values]);
                (state, values) = (next, next_values);
            } else {
                (state, values) = (next, next_values);
                let own = own.unwrap_or_else(|| self.own(evaluator, &state));
                (jacobian, settled_at) = self.anew(evaluator, &state, &values, own, settled_at)?;
                taken_at = state.clone();
            }
        };
        Ok(SearchEnd {
            objective: self.layout.objective(normal.square, &state, scatter),
            model: self.selection.joined(&values),
            state,
            scatter,
            normal,
            jacobian,
            iterations,
            converged,
        })
    }

    /// The full step, if it goes no farther than a forward difference: so near, derivatives say as much as predictions do.
    fn short_step(&self, quadratic: &Quadratic, state: &State, scatter: f64) -> Option<State> {
        let next = (self.layout).moved(state, &quadratic.step(0.0).x, scatter);
        self.near(state, &next).then_some(next)
    }

    /// Derivatives taken anew, the model's `own` as far as it has them, and where a search has settled: exact ones leave nothing to be taken once more.
    fn anew(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
        values: &Values,
        own: OwnDerivatives,
        settled_at: Option<State>,
    ) -> Result<(DMatrix<f64>, Option<State>), PredictError> {
        let taken = self.with_differences(evaluator, state, values, own)?;
        let settled_at = taken.exact.then(|| state.clone()).or(settled_at);
        Ok((taken.jacobian, settled_at))
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

    /// A state with a posterior higher by `least` or more at this scatter, by ever shorter steps; None if there seems to be none. With the model's own derivatives
    /// there where `far` says that they will be taken anew: they bring the predictions with them.
    fn improve(
        &self,
        evaluator: &mut Evaluator<'_>,
        quadratic: &Quadratic,
        state: &State,
        scatter: f64,
        (damping, gain, least): (&mut f64, f64, f64),
        far: &dyn Fn(&State) -> bool,
    ) -> Option<(State, Values, Option<OwnDerivatives>)> {
        for trial in 0..8 {
            let mut step = quadratic.step(*damping);
            let mut next = self.layout.moved(state, &step.x, scatter);
            while self.distance(state, &next) > FARTHEST && *damping < 1e6 {
                *damping = (*damping * 10.0).max(0.1);
                step = quadratic.step(*damping);
                next = self.layout.moved(state, &step.x, scatter);
            }
            if trial > 0 && step.decrease < least {
                return None;
            }
            // a second trial is for steps that often fail
            let own = (trial == 0 && far(&next)).then(|| self.own(evaluator, &next));
            if let Ok(values) = self.predict(evaluator, &next) {
                let square = self.square(&values);
                let gained = quadratic.value - self.layout.objective(square, &next, scatter);
                if gained > (gain * step.decrease).max(least) {
                    let good = gained > 0.75 * step.decrease;
                    *damping = if good { *damping * 0.1 } else { *damping };
                    *damping = damping.max(1e-6);
                    return Some((next, values, own));
                }
            }
            *damping = (*damping * 10.0).max(0.1);
        }
        None
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
        let theta = self.parameters.iter().zip(a.theta.iter().zip(&b.theta));
        let mut theta = theta.map(|(p, (a, b))| (a - b).abs() <= p.difference(*a).abs());
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
        let theta = theta.map(|(prior, (a, b))| (a - b).abs() / prior.scale());
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
