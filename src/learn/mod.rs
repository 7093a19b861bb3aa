//! Floor 8: what measurements say about a model: fits of what is free, comparison, the missing effect.
//!
//! ```text
//! Dataset, Predictor, Parameter .. -> fit::Problem -> search (quadratic, scatter, noise) -> Fit -> Comparison -> LadderStep
//! ```

mod bench;
mod evaluate;
mod fit;
mod gaussian;
mod gear_model;
mod measured;
mod noise;
mod observe;
mod parameters;
mod predictor;
mod quadratic;
mod scatter;
mod search;

pub use bench::{Bench, MeasuredTest, Workshop};
pub use fit::{Coefficient, Fit, FitError, Jacobian, Problem, RowFit, TestFit};
pub use gear_model::{EffectsOf, GearModel};
pub use measured::{Measured, Version};
pub use noise::{Datum, ModelError, NoiseModel};
pub use parameters::{COEFFICIENT, Estimate, Parameter};
pub use predictor::{PredictError, Predictor};
pub use search::Effort;
