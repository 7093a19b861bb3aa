//! Predictions on demand: each asked for once, those of one round side by side.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use rayon::prelude::*;

use super::predictor::{Linearised, Move, PredictError, Predictor};

/// Arguments of one prediction.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Point {
    pub(super) test: usize,
    pub(super) coefficient: f64,
    pub(super) parameters: Arc<[f64]>,
}

type Key = (usize, Vec<u64>);
/// A prediction, or why there is none.
pub(super) type Prediction = Result<Arc<[f64]>, PredictError>;

/// A prediction with its derivatives, or why there is none.
pub(super) type Linearisation = Result<Arc<Linearised>, PredictError>;

/// A predictor with a memory.
pub(super) struct Evaluator<'a> {
    predictor: &'a dyn Predictor,
    /// Id and number of observations of each test.
    tests: Vec<(&'a str, usize)>,
    known: HashMap<Key, Prediction>,
    linearised: HashMap<Key, Linearisation>,
}

impl<'a> Evaluator<'a> {
    pub(super) fn new(predictor: &'a dyn Predictor, tests: Vec<(&'a str, usize)>) -> Self {
        Self {
            predictor,
            tests,
            known: HashMap::new(),
            linearised: HashMap::new(),
        }
    }

    /// How many predictions have been made.
    pub(super) fn evaluations(&self) -> usize {
        self.known.len() + self.linearised.len()
    }

    /// The predictions at all points, in their order.
    pub(super) fn all(&mut self, points: &[Point]) -> Vec<Prediction> {
        let mut asked = BTreeSet::new();
        let new: Vec<&Point> = points
            .iter()
            .filter(|point| !self.known.contains_key(&key(point)) && asked.insert(key(point)))
            .collect();
        let found: Vec<Prediction> = new.par_iter().map(|point| self.predict(point)).collect();
        for (point, found) in new.into_iter().zip(found) {
            self.known.insert(key(point), found);
        }
        points
            .iter()
            .map(|point| self.known[&key(point)].clone())
            .collect()
    }

    /// The same with derivatives along `moves`, which belong to the parameters of all points; None if the predictor has none.
    pub(super) fn all_linearised(
        &mut self,
        points: &[Point],
        moves: &[Move],
    ) -> Option<Vec<Linearisation>> {
        let new: Vec<&Point> = (points.iter())
            .filter(|point| !self.linearised.contains_key(&key(point)))
            .collect();
        let found: Vec<Option<Linearisation>> = (new.par_iter())
            .map(|point| self.linearise(point, moves))
            .collect();
        for (point, found) in new.into_iter().zip(found) {
            self.linearised.insert(key(point), found?);
        }
        let known = points
            .iter()
            .map(|point| self.linearised[&key(point)].clone());
        Some(known.collect())
    }

    fn linearise(&self, point: &Point, moves: &[Move]) -> Option<Linearisation> {
        let Point {
            test, coefficient, ..
        } = *point;
        let found = (self.predictor).linearise(test, coefficient, &point.parameters, moves)?;
        Some(found.and_then(|found| {
            self.checked(test, &found.values)?;
            match found.derivatives.iter().all(|slope| slope.is_finite()) {
                true => Ok(Arc::new(found)),
                false => Err(PredictError {
                    test: self.tests[test].0.to_owned(),
                    reason: "a derivative of the predictions is not finite".to_owned(),
                }),
            }
        }))
    }

    fn predict(&self, point: &Point) -> Prediction {
        let found = self
            .predictor
            .predict(point.test, point.coefficient, &point.parameters)?;
        self.checked(point.test, &found)?;
        Ok(found.into())
    }

    /// Whether a test's predictions are as many as its observations, and finite.
    fn checked(&self, test: usize, found: &[f64]) -> Result<(), PredictError> {
        let (id, count) = self.tests[test];
        let fault = |reason: String| PredictError {
            test: id.to_owned(),
            reason,
        };
        if found.len() != count {
            let found = found.len();
            return Err(fault(format!(
                "{found} values predicted for {count} observations"
            )));
        }
        match found.iter().position(|value| !value.is_finite()) {
            Some(row) => Err(fault(format!(
                "the prediction of its observation {} is not finite",
                row + 1
            ))),
            None => Ok(()),
        }
    }
}

fn key(point: &Point) -> Key {
    let mut bits = vec![point.coefficient.to_bits()];
    bits.extend(point.parameters.iter().map(|value| value.to_bits()));
    (point.test, bits)
}
