//! Predictions on demand: each asked for once, those of one round side by side.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use rayon::prelude::*;

use super::predictor::{PredictError, Predictor};

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

/// A predictor with a memory.
pub(super) struct Evaluator<'a> {
    predictor: &'a dyn Predictor,
    /// Id and number of observations of each test.
    tests: Vec<(&'a str, usize)>,
    known: HashMap<Key, Prediction>,
}

impl<'a> Evaluator<'a> {
    pub(super) fn new(predictor: &'a dyn Predictor, tests: Vec<(&'a str, usize)>) -> Self {
        Self {
            predictor,
            tests,
            known: HashMap::new(),
        }
    }

    /// How many predictions have been made.
    pub(super) fn evaluations(&self) -> usize {
        self.known.len()
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

    fn predict(&self, point: &Point) -> Prediction {
        let (id, count) = self.tests[point.test];
        let found = self
            .predictor
            .predict(point.test, point.coefficient, &point.parameters)?;
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
            None => Ok(found.into()),
        }
    }
}

fn key(point: &Point) -> Key {
    let mut bits = vec![point.coefficient.to_bits()];
    bits.extend(point.parameters.iter().map(|value| value.to_bits()));
    (point.test, bits)
}
