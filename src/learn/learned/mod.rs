//! Laws learned from the measurements: a smooth factor of one driver, fitted through the wear history.

pub(super) mod knots;
pub(super) mod law;
