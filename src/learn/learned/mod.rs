//! Laws learned from the measurements: a smooth factor of one driver, fitted through the wear history.

pub(super) mod knots;
pub(super) mod law;
mod nearest_shape;
pub(super) mod plain;
pub(super) mod plain_form;
pub(super) mod shape_parameter;
pub(super) mod shapes;
