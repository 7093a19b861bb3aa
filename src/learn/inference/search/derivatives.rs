//! Derivatives of predictions: the model's own where it has them; of those that are simulations without, forward differences on the way,
//! central ones where a search comes to rest, and Broyden's formula in between.

use std::sync::Arc;

use nalgebra::DMatrix;

use super::{DIFFERENCE_K, OwnDerivatives, Search, Values};
use crate::learn::inference::quadratic::{Quadratic, State};
use crate::learn::prediction::evaluate::{Evaluator, Point};
use crate::learn::prediction::predictor::{Move, PredictError};
use crate::study::Scatter;

/// Length of the moves along which a model gives its own derivatives, prior standard deviations: so short that every law is straight.
const MOVE: f64 = 1e-7;

/// Derivatives of the rows with respect to (θ, ln k_t), without whitening.
pub(super) struct Derivatives {
    pub(super) jacobian: DMatrix<f64>,
    /// Whether they are all the model's own.
    pub(super) exact: bool,
}

/// How much narrower a difference is where the model has no answer at either end.
const NARROWER: f64 = 0.125;

impl Search<'_> {
    /// The model's own derivatives of each test; none for those without.
    pub(in crate::learn) fn own(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
    ) -> OwnDerivatives {
        let a_move = |p: usize| {
            let prior = &self.layout.parameters[p];
            let length = MOVE * prior.scale();
            let at = state.theta[p];
            let step = if at + length <= prior.upper {
                length
            } else {
                -length
            };
            let mut theta = state.theta.clone();
            theta[p] += step;
            Move {
                parameters: self.values(&theta).to_vec(),
                step: self.parameters[p].divisor(step),
            }
        };
        let moves: Vec<Move> = (0..self.layout.parameters.len()).map(a_move).collect();
        let points: Vec<(Point, Vec<Move>)> = (0..self.selection.tests.len())
            .map(|test| (self.point(state, test), moves.clone()))
            .collect();
        evaluator.derivatives(&points)
    }

    /// The model's `own` derivatives of each test, and where there are none forward differences of all tests in one round; where a prediction
    /// fails, the other side is tried, then narrower ones.
    pub(super) fn with_differences(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
        values: &Values,
        own: OwnDerivatives,
    ) -> Result<Derivatives, PredictError> {
        let params = self.layout.parameters.len();
        let moves_k = self.moves_k();
        let mut jacobian = self.of_own(&own);
        let mut asked = Vec::new();
        for test in (0..own.len()).filter(|&test| own[test].is_none()) {
            for p in 0..params {
                let step = self.parameters[p].difference(state.theta[p]);
                asked.push((test, p, step));
            }
            if moves_k {
                asked.push((test, params + test, DIFFERENCE_K));
            }
        }
        let shifted =
            |&(test, column, step): &(usize, usize, f64)| self.shifted(state, test, column, step);
        let points: Vec<Point> = asked.iter().map(shifted).collect();
        let mut found = evaluator.all(&points);
        for factor in [-1.0, -NARROWER, -1.0] {
            let mut failed: Vec<usize> = (0..found.len()).filter(|&i| found[i].is_err()).collect();
            failed.iter().for_each(|&i| asked[i].2 *= factor);
            // beyond a bound the model is asked at the bound, where the search may stand
            failed.retain(|&i| self.is_within(state, asked[i].1, asked[i].2));
            let again: Vec<Point> = failed.iter().map(|&i| shifted(&asked[i])).collect();
            for (i, second) in failed.into_iter().zip(evaluator.all(&again)) {
                found[i] = second;
            }
        }
        for ((test, column, step), found) in asked.into_iter().zip(found) {
            let divisor = self.divisor(column, step);
            self.fill(
                &mut jacobian,
                (test, column),
                [&values[test], &found?],
                divisor,
            );
        }
        Ok(Derivatives {
            jacobian,
            exact: own.iter().all(Option::is_some),
        })
    }

    /// Whether a parameter moved by `step` lies within its bounds; ln k has none here.
    fn is_within(&self, state: &State, column: usize, step: f64) -> bool {
        let priors = self.layout.parameters.iter().zip(&state.theta);
        let mut own = priors.skip(column).take(1);
        own.all(|(prior, at)| (prior.lower..=prior.upper).contains(&(at + step)))
    }

    /// The model's `own` derivatives as rows; zeros for the tests without.
    fn of_own(&self, own: &OwnDerivatives) -> DMatrix<f64> {
        let params = self.layout.parameters.len();
        let mut jacobian =
            DMatrix::zeros(self.selection.len(), params + self.selection.tests.len());
        for (test, own) in own.iter().enumerate() {
            let Some(own) = own else { continue };
            for (from, &row) in self.selection.rows[test].iter().enumerate() {
                for p in 0..params {
                    jacobian[(row, p)] = own[(from, p)];
                }
                if self.moves_k() {
                    jacobian[(row, params + test)] = own[(from, params)];
                }
            }
        }
        jacobian
    }

    /// Whether the wear coefficient of a test may move.
    fn moves_k(&self) -> bool {
        self.layout.coefficient.is_some() || self.scatter != Scatter::Relative(0.0)
    }

    /// Where a search comes to rest: the model's own derivatives of the tests that have them, central differences of the others.
    pub(super) fn at_rest(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
        values: &Values,
        quadratic: &Quadratic,
    ) -> Result<DMatrix<f64>, PredictError> {
        let own = self.own(evaluator, state);
        self.central(evaluator, state, values, &own, quadratic)
    }

    /// The model's `own` derivatives of the tests that have them; of the others central differences in one round, over two posterior standard
    /// deviations to each side, but at least two and at most ten times as wide as a forward difference: a standard deviation that is too small
    /// because the last derivatives took roughness for change must not make the next ones as rough.
    fn central(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
        values: &Values,
        own: &OwnDerivatives,
        quadratic: &Quadratic,
    ) -> Result<DMatrix<f64>, PredictError> {
        let params = self.layout.parameters.len();
        let moves_k = self.moves_k();
        let covariance = quadratic.mapped_covariance();
        let mut asked = Vec::new();
        for test in (0..own.len()).filter(|&test| own[test].is_none()) {
            for p in 0..params {
                let (prior, at) = (&self.layout.parameters[p], state.theta[p]);
                let usual = self.parameters[p].difference(at).abs();
                let step = 2.0 * covariance[(p, p)].max(0.0).sqrt();
                let step = step.clamp(2.0 * usual, 10.0 * usual);
                let [low, high] =
                    [-step, step].map(|step| (at + step).clamp(prior.lower, prior.upper) - at);
                asked.push((test, p, low, high));
            }
            if moves_k {
                asked.push((test, params + test, -DIFFERENCE_K, DIFFERENCE_K));
            }
        }
        let sides = asked.iter().flat_map(|&(test, column, low, high)| {
            [low, high].map(|step| self.shifted(state, test, column, step))
        });
        let points: Vec<Point> = sides.collect();
        let mut found = evaluator.all(&points);
        for (i, ask) in asked.iter_mut().enumerate() {
            let sides = 2 * i..2 * i + 2;
            if found[sides.clone()].iter().all(Result::is_err) {
                (ask.2, ask.3) = (NARROWER * ask.2, NARROWER * ask.3);
                let again = [ask.2, ask.3].map(|step| self.shifted(state, ask.0, ask.1, step));
                found.splice(sides, evaluator.all(&again));
            }
        }
        let mut jacobian = self.of_own(own);
        for (&(test, column, low, high), pair) in asked.iter().zip(found.chunks_exact(2)) {
            // a side without an answer is replaced by the middle
            let ends = match (&pair[0], &pair[1]) {
                (Err(error), Err(_)) => return Err(error.clone()),
                (low_side, high_side) => {
                    [(low_side, low), (high_side, high)].map(|(side, step)| {
                        let known = side.as_ref().ok().map(|values| (Arc::clone(values), step));
                        known.unwrap_or_else(|| (Arc::clone(&values[test]), 0.0))
                    })
                }
            };
            let [(before, low), (after, high)] = ends;
            let divisor = self.divisor(column, high) - self.divisor(column, low);
            self.fill(&mut jacobian, (test, column), [&before, &after], divisor);
        }
        Ok(jacobian)
    }

    /// Where a test is asked for a difference: at `state`, moved by `step` along a parameter or, beyond those, along the test's own ln k.
    fn shifted(&self, state: &State, test: usize, column: usize, step: f64) -> Point {
        let mut state = state.clone();
        match state.theta.get_mut(column) {
            Some(theta) if column < self.layout.parameters.len() => *theta += step,
            _ => state.epsilon[test] += step,
        }
        self.point(&state, test)
    }

    /// What a difference over `step` is divided by, in the unit of the derivative.
    fn divisor(&self, column: usize, step: f64) -> f64 {
        match self.parameters.get(column) {
            Some(parameter) if column < self.layout.parameters.len() => parameter.divisor(step),
            _ => step.exp_m1(),
        }
    }

    /// Writes a test's difference quotients into a column.
    fn fill(
        &self,
        jacobian: &mut DMatrix<f64>,
        (test, column): (usize, usize),
        [before, after]: [&[f64]; 2],
        divisor: f64,
    ) {
        for (&row, (after, before)) in
            (self.selection.rows[test].iter()).zip(after.iter().zip(before))
        {
            jacobian[(row, column)] = (after - before) / divisor;
        }
    }

    /// The values of each test moved along its derivatives from one state to the next.
    pub(super) fn along(
        &self,
        jacobian: &DMatrix<f64>,
        states: [&State; 2],
        values: &Values,
    ) -> Values {
        let moved_test = |(test, rows): (usize, &Vec<usize>)| {
            let moved = self.moves(test, states);
            let row_moved = |(&row, before): (&usize, &f64)| {
                let by = moved
                    .iter()
                    .map(|&(column, by)| jacobian[(row, column)] * by);
                before + by.sum::<f64>()
            };
            rows.iter()
                .zip(values[test].iter())
                .map(row_moved)
                .collect()
        };
        self.selection
            .rows
            .iter()
            .enumerate()
            .map(moved_test)
            .collect()
    }

    /// How far a test's unknowns move from one state to the next: each with its column of derivatives.
    fn moves(&self, test: usize, states: [&State; 2]) -> Vec<(usize, f64)> {
        let params = self.layout.parameters.len();
        let log_k = |s: &State| s.log_k + s.epsilon[test];
        let own = (params + test, log_k(states[1]) - log_k(states[0]));
        let priors = self.layout.parameters.iter().enumerate();
        let common =
            priors.map(|(p, prior)| (p, prior.step(states[0].theta[p], states[1].theta[p])));
        common.chain([own]).collect()
    }

    /// Each test's derivatives changed least, in the priors' scales, so that they give the change seen from one state to the next.
    pub(super) fn broyden(
        &self,
        jacobian: &mut DMatrix<f64>,
        states: [&State; 2],
        values: [&Values; 2],
    ) {
        let scales = self.layout.parameters.iter().map(|prior| prior.scale());
        let scales: Vec<f64> = scales.chain([1.0]).collect();
        for (test, rows) in self.selection.rows.iter().enumerate() {
            let moved = self.moves(test, states);
            let moved: Vec<(usize, f64, f64)> = (moved.iter().zip(&scales))
                .map(|(&(column, by), &scale)| (column, by, scale))
                .collect();
            let length: f64 = moved
                .iter()
                .map(|(_, by, scale)| (by / scale).powi(2))
                .sum();
            if length == 0.0 {
                continue;
            }
            let [before, after] = values.map(|values| &values[test]);
            for (&row, (before, after)) in rows.iter().zip(before.iter().zip(after.iter())) {
                let told: f64 = moved
                    .iter()
                    .map(|&(column, by, _)| jacobian[(row, column)] * by)
                    .sum();
                for &(column, by, scale) in &moved {
                    jacobian[(row, column)] +=
                        (after - before - told) * by / (scale * scale) / length;
                }
            }
        }
    }
}
