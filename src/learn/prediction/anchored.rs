//! A cheap model's changes on top of what a better one gave at an anchor.
//!
//! ```text
//! f(k, θ) = cheap(k, θ) + [better(k₀, θ₀) − cheap(k₀, θ₀)]
//! ```
//! Exact at the anchor; away from it the cheap model's own error enters by its change only.

use crate::learn::prediction::predictor::{Linearised, Move, PredictError, Predictor};

/// A cheap model with an offset per test of the data set; none for a test without.
pub(in crate::learn) struct Anchored<P> {
    model: P,
    offset: Vec<Vec<f64>>,
}

impl<P: Predictor> Anchored<P> {
    pub(in crate::learn) fn new(model: P, offset: Vec<Vec<f64>>) -> Self {
        Self { model, offset }
    }

    /// Anchored where a better model gives `better`, by test of the data set (nothing for tests that it was not asked for).
    ///
    /// # Errors
    /// [`PredictError`] if the cheap model has no answer there.
    pub(in crate::learn) fn at(
        model: P,
        k: f64,
        parameters: &[f64],
        mut better: Vec<Vec<f64>>,
    ) -> Result<Self, PredictError> {
        for (test, values) in better.iter_mut().enumerate() {
            if !values.is_empty() {
                let cheap = model.predict(test, k, parameters)?;
                values.iter_mut().zip(cheap).for_each(|(v, c)| *v -= c);
            }
        }
        Ok(Self::new(model, better))
    }
}

impl<P: Predictor> Predictor for Anchored<P> {
    fn predict(&self, test: usize, k: f64, parameters: &[f64]) -> Result<Vec<f64>, PredictError> {
        let mut values = self.model.predict(test, k, parameters)?;
        if let Some(offset) = self.offset.get(test) {
            values.iter_mut().zip(offset).for_each(|(v, o)| *v += o);
        }
        Ok(values)
    }

    fn has_derivatives(&self) -> bool {
        self.model.has_derivatives()
    }

    /// Those of the cheap model.
    fn linearise(
        &self,
        test: usize,
        k: f64,
        parameters: &[f64],
        moves: &[Move],
    ) -> Option<Result<Linearised, PredictError>> {
        let mut found = self.model.linearise(test, k, parameters, moves);
        if let (Some(Ok(found)), Some(offset)) = (&mut found, self.offset.get(test)) {
            found
                .values
                .iter_mut()
                .zip(offset)
                .for_each(|(v, o)| *v += o);
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// k (1 + θ) + the test's number.
    struct Cheap;

    impl Predictor for Cheap {
        fn predict(&self, test: usize, k: f64, theta: &[f64]) -> Result<Vec<f64>, PredictError> {
            Ok(vec![k * (1.0 + theta[0]) + test as f64])
        }
    }

    #[test]
    fn it_is_the_better_model_at_the_anchor_and_changes_as_the_cheap_one() {
        let better = vec![vec![10.0], Vec::new(), vec![20.0]];
        let anchored = Anchored::at(Cheap, 2.0, &[0.5], better).unwrap();
        let at = |test, k, theta| anchored.predict(test, k, &[theta]).unwrap()[0];
        assert_eq!([at(0, 2.0, 0.5), at(2, 2.0, 0.5)], [10.0, 20.0]);
        // the cheap model goes from 3 to 4, and a test without an anchor is its own
        assert_eq!([at(0, 2.0, 1.0), at(1, 2.0, 1.0)], [11.0, 5.0]);
    }
}
