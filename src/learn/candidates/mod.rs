//! Candidates of a diagnosis, fitted: the likelihood that all of them share, each one's model, its evidence.

pub(super) mod candidate_model;
pub(super) mod fitted_candidate;
pub(super) mod likelihood;
pub(super) mod strength_prior;
