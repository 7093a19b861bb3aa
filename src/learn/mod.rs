//! Floor 8: what measurements say about a model: fits of what is free, comparison, the missing effect.

mod bench;
mod gear_model;
mod observe;
mod predictor;

pub use bench::{Bench, MeasuredTest, Workshop};
pub use gear_model::{EffectsOf, GearModel};
pub use predictor::{PredictError, Predictor};
