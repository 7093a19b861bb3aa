//! The steps from a start to the most probable state.

use nalgebra::DMatrix;

use super::{Effort, OwnDerivatives, Search, SearchEnd, Values};
use crate::learn::inference::quadratic::{Quadratic, State};
use crate::learn::inference::scatter::most_probable;
use crate::learn::prediction::evaluate::Evaluator;
use crate::learn::prediction::predictor::PredictError;

/// Promised gain of ln posterior up to which a step is short: two posterior standard deviations.
const SHORT: f64 = 2.0;

/// How far a step goes at most, prior standard deviations (for ln k: 1): the derivatives say nothing of what lies beyond, and laws out there, a hundred times
/// as fast as they are measured, take minutes to wear.
const FARTHEST: f64 = 2.0;

/// Gain of ln posterior, in tolerances, up to which a step is none: a fit would creep on the predictions' own roughness.
const NOTHING: f64 = 0.1;
/// The same as a share of what the misfit beyond noise adds to the tolerance: far from the measurements, a fit that gains little in a step would need many.
const CREEP: f64 = 0.5;

/// Loss of ln posterior allowed to a fit for its misfit, from which on derivatives as they are serve as well as new ones.
const FAR: f64 = 3.0;

/// Damping of the first step, and of the first one with derivatives taken anew.
const DAMPING: f64 = 1e-3;

/// Where a search is.
pub(super) struct Position {
    state: State,
    values: Values,
    jacobian: DMatrix<f64>,
    /// Where the derivatives were taken.
    taken_at: State,
    /// Where derivatives taken once more would say nothing new.
    settled_at: Option<State>,
    /// How often they were taken anew where the search came to rest.
    rounds: usize,
    damping: f64,
}

impl Position {
    /// A start with its derivatives; `settled` if no better ones can be had there.
    pub(super) fn new(state: State, values: Values, jacobian: DMatrix<f64>, settled: bool) -> Self {
        Self {
            taken_at: state.clone(),
            settled_at: settled.then(|| state.clone()),
            state,
            values,
            jacobian,
            rounds: 0,
            damping: DAMPING,
        }
    }

    fn is_fresh(&self) -> bool {
        self.taken_at == self.state
    }
}

/// What counts as rest, ln posterior.
struct Limits {
    /// A search is at rest where a step promises no more.
    tolerance: f64,
    /// A search that fails to better its state is at rest where a step had promised no more.
    floor: f64,
    /// A step that gains less is none.
    least: f64,
    /// Whether the misfit is so large that the last decimals say nothing.
    far: bool,
}

impl Limits {
    fn new(effort: &Effort, square: f64, rows: usize) -> Self {
        let beyond = 0.5 * (square - rows as f64).max(0.0);
        let allowed = effort.share * beyond;
        Self {
            tolerance: effort.tolerance + allowed,
            floor: effort.floor + allowed,
            least: NOTHING * effort.tolerance + CREEP * allowed,
            far: allowed > FAR,
        }
    }
}

/// A better state, its predictions, and the model's own derivatives if they came along.
type Step = (State, Values, Option<OwnDerivatives>);

impl Search<'_> {
    pub(super) fn descend(
        &self,
        evaluator: &mut Evaluator<'_>,
        mut at: Position,
        effort: &Effort,
    ) -> Result<SearchEnd, PredictError> {
        let mut iterations = 0;
        let (converged, promised, scatter, normal) = loop {
            let model = self.selection.joined(&at.values);
            let covariance = &self.selection.covariance;
            let normal = self.selection.normal(&model, &at.jacobian, covariance);
            let scatter = most_probable(self.scatter, &self.layout, &normal, &at.state);
            let quadratic = Quadratic::new(&self.layout, &normal, &at.state, scatter);
            let promised = quadratic.step(0.0).decrease;
            let limits = Limits::new(effort, normal.square, self.selection.len());
            let settled = limits.far
                || at.rounds == effort.settle
                || (at.settled_at.as_ref()).is_some_and(|settled| self.near(settled, &at.state));
            if promised <= limits.tolerance {
                if !settled {
                    self.settle(evaluator, &mut at, &quadratic)?;
                } else if effort.settle > 0
                    || at.is_fresh()
                    || self.distance(&at.taken_at, &at.state) <= effort.carry
                {
                    break (true, promised, scatter, normal);
                } else {
                    self.differentiate(evaluator, &mut at, None)?;
                }
                continue;
            }
            if iterations == effort.iterations {
                break (false, promised, scatter, normal);
            }
            iterations += 1;
            if effort.settle > 0
                && settled
                && promised <= SHORT
                && let Some(next) = self.short_step(&quadratic, &at.state, scatter)
            {
                at.values = self.along(&at.jacobian, [&at.state, &next], &at.values);
                at.state = next;
                continue;
            }
            match self.improve(
                evaluator,
                &quadratic,
                &mut at,
                scatter,
                effort,
                limits.least,
            ) {
                Some(step) => self.advance(evaluator, &mut at, step, effort)?,
                None if !settled => {
                    self.settle(evaluator, &mut at, &quadratic)?;
                    at.damping = DAMPING;
                }
                None if promised <= limits.floor => break (true, promised, scatter, normal),
                None if at.is_fresh() => break (false, promised, scatter, normal),
                None => {
                    self.differentiate(evaluator, &mut at, None)?;
                    at.damping = DAMPING;
                }
            }
        };
        Ok(SearchEnd {
            objective: self.layout.objective(normal.square, &at.state, scatter),
            promised,
            model: self.selection.joined(&at.values),
            state: at.state,
            scatter,
            normal,
            jacobian: at.jacobian,
            iterations,
            converged,
        })
    }

    /// Derivatives taken once more where the search has come to rest.
    fn settle(
        &self,
        evaluator: &mut Evaluator<'_>,
        at: &mut Position,
        quadratic: &Quadratic,
    ) -> Result<(), PredictError> {
        at.jacobian = self.at_rest(evaluator, &at.state, &at.values, quadratic)?;
        at.taken_at = at.state.clone();
        at.settled_at = Some(at.state.clone());
        at.rounds += 1;
        Ok(())
    }

    /// Derivatives taken anew, the model's `own` as far as it has them: exact ones leave nothing to be taken once more.
    fn differentiate(
        &self,
        evaluator: &mut Evaluator<'_>,
        at: &mut Position,
        own: Option<OwnDerivatives>,
    ) -> Result<(), PredictError> {
        let own = own.unwrap_or_else(|| self.own(evaluator, &at.state));
        let taken = self.with_differences(evaluator, &at.state, &at.values, own)?;
        at.jacobian = taken.jacobian;
        at.taken_at = at.state.clone();
        if taken.exact {
            at.settled_at = Some(at.state.clone());
        }
        Ok(())
    }

    /// Goes to a better state, with derivatives that are kept over a move shorter than a difference, carried over a short one, and else taken anew.
    fn advance(
        &self,
        evaluator: &mut Evaluator<'_>,
        at: &mut Position,
        (next, next_values, own): Step,
        effort: &Effort,
    ) -> Result<(), PredictError> {
        let kept = effort.settle > 0 && self.near(&at.state, &next);
        let carried = !kept && self.distance(&at.taken_at, &next) <= effort.carry;
        if carried {
            self.broyden(
                &mut at.jacobian,
                [&at.state, &next],
                [&at.values, &next_values],
            );
        }
        (at.state, at.values) = (next, next_values);
        if kept || carried {
            return Ok(());
        }
        self.differentiate(evaluator, at, own)
    }

    /// The full step, if it goes no farther than a forward difference: so near, derivatives say as much as predictions do.
    fn short_step(&self, quadratic: &Quadratic, state: &State, scatter: f64) -> Option<State> {
        let next = (self.layout).moved(state, &quadratic.step(0.0).x, scatter);
        self.near(state, &next).then_some(next)
    }

    /// A state with a posterior higher by `least` or more at this scatter, by ever shorter steps; None if there seems to be none. With the model's own
    /// derivatives where they will be taken anew: they bring the predictions with them.
    fn improve(
        &self,
        evaluator: &mut Evaluator<'_>,
        quadratic: &Quadratic,
        at: &mut Position,
        scatter: f64,
        effort: &Effort,
        least: f64,
    ) -> Option<Step> {
        let state = &at.state;
        let damping = &mut at.damping;
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
            let own = (trial == 0 && self.distance(&at.taken_at, &next) > effort.carry)
                .then(|| self.own(evaluator, &next));
            if let Ok(values) = self.predict(evaluator, &next) {
                let square = self.square(&values);
                let gained = quadratic.value - self.layout.objective(square, &next, scatter);
                if gained > (effort.gain * step.decrease).max(least) {
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
}
