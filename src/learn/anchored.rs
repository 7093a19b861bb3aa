//! A cheap model's changes on top of what a better one gave at an anchor.
//!
//! ```text
//! f(k, θ) = cheap(k, θ) + [better(k₀, θ₀) − cheap(k₀, θ₀)]
//! ```
//! Exact at the anchor; away from it the cheap model's own error enters by its change only.

use super::predictor::{PredictError, Predictor};

/// A cheap model with an offset per test of the data set; none for a test without.
pub(super) struct Anchored<P> {
    model: P,
    offset: Vec<Vec<f64>>,
}

impl<P: Predictor> Anchored<P> {
    pub(super) fn new(model: P, offset: Vec<Vec<f64>>) -> Self {
        Self { model, offset }
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
}
