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

mod candidates;
mod checks;
pub mod climb;
mod comparison;
mod decision;
pub mod diagnose;
mod discrepancy;
mod experiment;
mod explanation;
mod fitting;
mod hypothesis;
mod inference;
mod learned;
mod model_search;
mod noise;
mod prediction;
mod sampling;

pub use checks::common_scatter::scatter_of_new_profile;
pub use checks::noise_level::stated_sigma;
pub use comparison::synthesize::{Synthetic, synthesize};
pub use comparison::{
    AddLearnedError, AddedForm, Addition, Cell, CompareError, CompareStage, Compared, Comparison,
    Curve, CurvePoint, FormFit, Group, Improvement, Item, LadderStep, LearnedAddition, LeftOut,
    Outlier, ParameterRecord, Prospects, Ratio, Share, TestRecord, Validation, Version, Watch, add,
    add_learned, compare, compare_all, contact_of, curves, cycles_in_another_unit, data_warnings,
    differences, differing_tests, is_among, ladder, left_out, precursors, prospects, questions,
};
pub use fitting::fit::{Coefficient, FitError, Problem};
pub use fitting::fitted::{Fit, PredictionUncertainty, RowFit, TestFit};
pub use fitting::measured::Measured;
pub use fitting::quantity_misfit::misfit_of_one_quantity;
pub use hypothesis::parameters::{COEFFICIENT, Estimate, Parameter};
pub use hypothesis::version::ModelVersion;
pub use inference::search::Effort;
pub use learned::law::{LearnError, LearnedFit, TriedProcess, WantedLaw};
pub use learned::plain_form::PlainForm;
pub use noise::{Datum, ModelError, NoiseModel, SigmaModel};
pub use prediction::bench::{Bench, MeasuredTest, Workshop};
pub use prediction::gear_model::{EffectsOf, GearModel};
pub use prediction::predictor::{Linearised, Move, PredictError, Predictor};
pub use sampling::posterior::{Density, Posterior, Scale};
pub use sampling::simulator::{Place, Simulator};
