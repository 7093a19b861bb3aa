//! Comparison, beside the stages of a diagnosis: how wrong a fitted model is and where, and versions of a model side by side.
//!
//! ```text
//! fit -> residual statistics, ratios, location of the misfit, validation uncertainty, fit warnings -> Comparison -> ladder
//! ```

mod add;
mod add_learned;
mod coefficients_in_order;
mod compare;
mod curves;
mod far_datums;
mod fit_warnings;
mod ladder;
mod left_out;
mod lone_row;
mod misfit_location;
mod misfit_ranking;
mod missed;
mod own_coefficient;
mod prospects;
mod questions;
mod ratio;
mod record;
mod residual_statistics;
mod sanity;
mod shifted_places;
pub(in crate::learn) mod synthesize;
mod together;
mod uncertainty;
mod unlike_tests;
mod versions;

pub use add::{AddedForm, Addition, FormFit, add};
pub use add_learned::{AddLearnedError, LearnedAddition, add_learned};
pub use compare::{CompareError, CompareStage, Compared, Watch, compare, contact_of};
pub use curves::{Curve, CurvePoint, curves};
pub use fit_warnings::data_warnings;
pub use ladder::{Improvement, LadderStep, Version, is_among, ladder, precursors};
pub use left_out::{LeftOut, left_out};
pub use prospects::{Prospects, prospects};
pub use questions::questions;
pub use ratio::Ratio;
pub use record::{Comparison, Outlier, ParameterRecord, TestRecord};
pub use residual_statistics::{Cell, Group, Share};
pub use sanity::cycles_in_another_unit;
pub use uncertainty::Validation;
pub use unlike_tests::differing_tests;
pub use versions::{Item, compare_all, differences};
