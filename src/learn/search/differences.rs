//! Derivatives of predictors that have none of their own: forward differences.

use nalgebra::DMatrix;

use super::{Search, Values};
use crate::learn::evaluate::{Evaluator, Point};
use crate::learn::predictor::PredictError;
use crate::learn::quadratic::State;
use crate::study::Scatter;

/// Step in ln k of a test.
const DIFFERENCE_K: f64 = 0.02;
/// How much narrower a difference is where the model has no answer at either end.
const NARROWER: f64 = 0.125;

impl Search<'_> {
    /// All tests in one round; where a prediction fails, the other side is tried, then narrower ones.
    pub(super) fn differences(
        &self,
        evaluator: &mut Evaluator<'_>,
        state: &State,
        values: &Values,
    ) -> Result<DMatrix<f64>, PredictError> {
        let params = self.layout.parameters.len();
        let moves_k = self.layout.coefficient.is_some() || self.scatter != Scatter::Relative(0.0);
        let mut asked = Vec::new();
        for test in 0..self.tests.len() {
            for p in 0..params {
                let step = self.parameters[p].difference(state.theta[p]);
                asked.push((test, p, step));
            }
            if moves_k {
                asked.push((test, params + test, DIFFERENCE_K));
            }
        }
        let shifted = |&(test, column, step): &(usize, usize, f64)| {
            let mut state = state.clone();
            match state.theta.get_mut(column).filter(|_| column < params) {
                Some(theta) => *theta += step,
                None => state.epsilon[test] += step,
            }
            self.point(&state, test)
        };
        let points: Vec<Point> = asked.iter().map(shifted).collect();
        let mut found = evaluator.all(&points);
        for factor in [-1.0, -NARROWER, -1.0] {
            let failed: Vec<usize> = (0..found.len()).filter(|&i| found[i].is_err()).collect();
            failed.iter().for_each(|&i| asked[i].2 *= factor);
            let again: Vec<Point> = failed.iter().map(|&i| shifted(&asked[i])).collect();
            for (i, second) in failed.into_iter().zip(evaluator.all(&again)) {
                found[i] = second;
            }
        }
        let mut jacobian = DMatrix::zeros(self.measured.len(), params + self.tests.len());
        for ((test, column, step), found) in asked.into_iter().zip(found) {
            let divisor = match self.parameters.get(column).filter(|_| column < params) {
                Some(parameter) => parameter.divisor(step),
                None => step.exp_m1(),
            };
            for ((&row, after), before) in self.rows[test]
                .iter()
                .zip(found?.iter())
                .zip(values[test].iter())
            {
                jacobian[(row, column)] = (after - before) / divisor;
            }
        }
        Ok(jacobian)
    }
}
