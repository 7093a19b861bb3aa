//! Stage 7, experiment: which tests would tell apart what the measurements leave, or show most effects before there are any.

mod after_diagnosis;
mod campaign;
pub(in crate::learn) mod candidate_tests;
pub(in crate::learn) mod decided;
mod discrimination;
pub(in crate::learn) mod made_tests;
mod measurement_design;
pub(in crate::learn) mod next;
mod order;
mod plan;
mod table;
mod wording;

pub use campaign::plan_first;
pub use candidate_tests::{ENOUGH, NextTest, made_up_chi2};
pub use decided::Decided;
pub use next::NextExperiment;
pub use order::SETTLES;
pub use plan::{
    AloneTest, Campaign, ChosenTest, EffectVisibility, Leader, NextTests, Plan, RankedTest,
    Separated,
};
pub use table::plan_after;
