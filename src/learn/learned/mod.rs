//! Laws learned from the measurements: a smooth factor of one driver, fitted through the wear history.

pub(super) mod knots;
pub(super) mod law;
pub(super) mod plain;
pub(super) mod plain_form;
pub(super) mod shapes;
