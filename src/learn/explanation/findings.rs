//! What the stages before the explanation have found.

use crate::learn::candidates::fitted_candidate::BaseFit;
use crate::learn::decision::judged_candidates::JudgedCandidates;
use crate::learn::discrepancy::smooth::SmoothDiscrepancy;
use crate::learn::hypothesis::Hypothesis;
use crate::learn::hypothesis::candidate::NotJudged;
use crate::learn::model_search::context::Context;
use crate::learn::prediction::bench::Workshop;

/// What the stages before have found, to be put together.
pub(in crate::learn) struct Findings<'f> {
    pub(in crate::learn) context: &'f Context<'f>,
    /// The analytic model's, for tests that have not been made.
    pub(in crate::learn) workshop: &'f Workshop,
    pub(in crate::learn) base: &'f BaseFit,
    pub(in crate::learn) smooth: &'f SmoothDiscrepancy,
    pub(in crate::learn) posterior: &'f JudgedCandidates,
    pub(in crate::learn) sparse_regression: Vec<Hypothesis>,
    pub(in crate::learn) not_judged: Vec<NotJudged>,
    /// Effects of which no form could be fitted.
    pub(in crate::learn) not_fitted: Vec<Hypothesis>,
}
