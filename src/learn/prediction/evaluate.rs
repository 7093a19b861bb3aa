//! Predictions on demand: each asked for once, those of one round side by side.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::learn::prediction::predictor::{Linearised, Move, PredictError, Predictor};

/// Arguments of one prediction.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::learn) struct Point {
    pub(in crate::learn) test: usize,
    pub(in crate::learn) coefficient: f64,
    pub(in crate::learn) parameters: Arc<[f64]>,
}

type Key = (usize, Vec<u64>);
/// A prediction, or why there is none.
pub(in crate::learn) type Prediction = Result<Arc<[f64]>, PredictError>;

/// A predictor with a memory.
pub(in crate::learn) struct Evaluator<'a> {
    predictor: &'a dyn Predictor,
    /// Id and number of observations of each test.
    tests: Vec<(&'a str, usize)>,
    known: HashMap<Key, Prediction>,
    /// Predictions made, with derivatives or without.
    evaluations: usize,
}

impl<'a> Evaluator<'a> {
    pub(in crate::learn) fn new(
        predictor: &'a dyn Predictor,
        tests: Vec<(&'a str, usize)>,
    ) -> Self {
        Self {
            predictor,
            tests,
            known: HashMap::new(),
            evaluations: 0,
        }
    }

    /// How many predictions have been made, with derivatives or without.
    pub(in crate::learn) fn evaluations(&self) -> usize {
        self.evaluations
    }

    /// The predictions at all points, in their order.
    pub(in crate::learn) fn all(&mut self, points: &[Point]) -> Vec<Prediction> {
        let mut asked = BTreeSet::new();
        let new: Vec<&Point> = points
            .iter()
            .filter(|point| !self.known.contains_key(&key(point)) && asked.insert(key(point)))
            .collect();
        self.evaluations += new.len();
        let found: Vec<Prediction> = new.par_iter().map(|point| self.predict(point)).collect();
        for (point, found) in new.into_iter().zip(found) {
            self.known.insert(key(point), found);
        }
        points
            .iter()
            .map(|point| self.known[&key(point)].clone())
            .collect()
    }

    /// The model's own derivatives at all points, along each point's moves and by ln k; none where it has none, or none that are finite. The
    /// predictions that come with them are kept.
    pub(in crate::learn) fn derivatives(
        &mut self,
        points: &[(Point, Vec<Move>)],
    ) -> Vec<Option<DMatrix<f64>>> {
        if !self.predictor.has_derivatives() {
            return vec![None; points.len()];
        }
        self.evaluations += points.len();
        let (predictor, tests) = (self.predictor, &self.tests);
        let own = |(point, moves): &(Point, Vec<Move>)| {
            let (test, k) = (point.test, point.coefficient);
            let found = predictor
                .linearise(test, k, &point.parameters, moves)?
                .ok()?;
            let all = [&found.values[..], found.derivatives.as_slice()].concat();
            let is_whole = found.derivatives.nrows() == tests[test].1;
            (is_whole && all.iter().all(|d| d.is_finite())).then_some(found)
        };
        let found: Vec<Option<Linearised>> = points.par_iter().map(own).collect();
        (points.iter().zip(found))
            .map(|((point, _), found)| {
                let found = found?;
                let values = || Ok(found.values.into());
                self.known.entry(key(point)).or_insert_with(values);
                Some(found.derivatives)
            })
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
