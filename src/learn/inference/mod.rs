//! The statistics of a fit: which rows, the posterior's parabola, the scatter of k, the search for its mode.

pub(super) mod quadratic;
pub(super) mod scatter;
pub(super) mod search;
pub(super) mod selection;
