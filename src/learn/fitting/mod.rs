//! Fits of what is free in a study to its measurements.

pub(super) mod cheaper;
pub(super) mod coefficient_trend;
pub(super) mod collinear;
pub(super) mod fit;
pub(super) mod fitted;
mod held_out;
pub(super) mod measured;
pub(super) mod quantity_misfit;
pub(super) mod region;
pub(super) mod starts;
pub(super) mod test_apart;
