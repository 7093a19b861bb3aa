//! Floor 8: what measurements say about a model: fits of what is free, comparison, the missing effect.

mod predictor;

pub use predictor::{PredictError, Predictor};
