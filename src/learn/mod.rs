//! Floor 8: what measurements say about a model: fits of what is free, comparison, the missing effect.
//!
//! ```text
//! Dataset, Predictor, Parameter .. -> Problem -> search (quadratic, scatter, noise) -> Fit -> Comparison -> LadderStep
//!                                                                                       |-> Curve (pictures)
//!                                                                                       `-> add: an effect more, in the form that fits
//! ```
//!
//! The probability model, on natural scales (logarithms of positive parameters):
//!
//! ```text
//! y = f(k_t, θ) + datum of the trace + noise (+ a correlated model error)       k_t = k exp(ε_t),  ε_t ~ N(0, σ_k)
//! ```
//! Datums are marginalised in closed form, k_t and θ by a parabola about the most probable state, σ_k by quadrature.

mod add;
mod anchored;
mod bench;
mod compare;
mod comparison;
mod curves;
pub mod diagnose;
mod doubts;
mod evaluate;
mod fit;
mod fitted;
mod gaussian;
mod gear_model;
mod ladder;
mod measured;
mod noise;
mod observe;
mod parameters;
mod predictor;
mod quadratic;
mod ratio;
mod region;
mod scatter;
mod search;
mod starts;
mod synthesize;
mod tally;
mod trajectory;
mod uncertainty;
mod versions;
mod worst;

pub use add::{AddedForm, Addition, Tried, add};
pub use bench::{Bench, MeasuredTest, Workshop};
pub use compare::{CompareError, Compared, Doing, Watch, compare, contact_of};
pub use comparison::{Comparison, Outlier, ParameterRecord, TestRecord};
pub use curves::{Curve, CurvePoint, curves};
pub use fit::{Coefficient, FitError, Problem};
pub use fitted::{Fit, Jacobian, RowFit, TestFit};
pub use gear_model::{EffectsOf, GearModel};
pub use ladder::{Improvement, LadderStep, Version, ladder};
pub use measured::{Measured, ModelVersion};
pub use noise::{Datum, ModelError, NoiseModel};
pub use parameters::{COEFFICIENT, Estimate, Parameter};
pub use predictor::{Linearised, Move, PredictError, Predictor};
pub use ratio::Ratio;
pub use search::Effort;
pub use synthesize::{Synthetic, synthesize};
pub use tally::{Cell, Group, Share};
pub use uncertainty::Validation;
pub use versions::{Item, compare_all, differences};
