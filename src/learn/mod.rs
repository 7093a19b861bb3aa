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

mod anchored;
mod bench;
mod candidate_model;
mod cheaper;
mod checks;
pub mod climb;
mod coefficient_trend;
mod collinear;
mod comparison;
mod decision;
pub mod diagnose;
mod discrepancy;
mod evaluate;
mod experiment;
mod explanation;
mod fidelity;
mod fit;
mod fitted;
mod fitted_candidate;
mod gaussian;
mod gear_model;
mod hypothesis;
mod learned_knots;
mod learned_law;
mod likelihood;
mod measured;
mod model_search;
mod noise;
mod observe;
mod parameters;
mod posterior;
mod predictor;
mod quadratic;
mod quantity_misfit;
mod region;
mod scatter;
mod search;
mod selection;
mod simulator;
mod standard_test;
mod starts;
mod strength_prior;
mod synthesize;
mod trajectory;

pub use bench::{Bench, MeasuredTest, Workshop};
pub use checks::noise_level::stated_sigma;
pub use comparison::{
    AddLearnedError, AddedForm, Addition, Cell, CompareError, Compared, Comparison, Curve,
    CurvePoint, Doing, Group, Improvement, Item, LadderStep, LearnedAddition, LeftOut, Outlier,
    ParameterRecord, Prospects, Ratio, Share, TestRecord, Tried, Validation, Version, Watch, add,
    add_learned, compare, compare_all, contact_of, curves, data_warnings, differences, ladder,
    left_out, precursors, prospects,
};
pub use fit::{Coefficient, FitError, Problem};
pub use fitted::{Fit, Jacobian, RowFit, TestFit};
pub use gear_model::{EffectsOf, GearModel};
pub use hypothesis::version::ModelVersion;
pub use learned_law::{LearnError, LearnedFit, TriedProcess, WantedLaw};
pub use measured::Measured;
pub use noise::{Datum, ModelError, NoiseModel, SigmaModel};
pub use parameters::{COEFFICIENT, Estimate, Parameter};
pub use posterior::{Density, Posterior, Scale};
pub use predictor::{Linearised, Move, PredictError, Predictor};
pub use quantity_misfit::misfit_of_one_quantity;
pub use search::Effort;
pub use simulator::{Place, Simulator};
pub use synthesize::{Synthetic, synthesize};
