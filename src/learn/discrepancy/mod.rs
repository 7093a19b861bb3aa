//! Stage 3, discrepancy: how much of what a fitted model leaves is more than noise, whatever its cause, and on what it depends.

mod basis;
mod binned;
pub(in crate::learn) mod dependence;
pub(in crate::learn) mod gaussian_process;
pub(in crate::learn) mod residual_drivers;
pub(in crate::learn) mod smooth;

pub use binned::{BinMean, Explained};
pub use dependence::Driver;
pub use residual_drivers::{
    DRIVER_KINDS, DRIVERS, DriverBin, DriverKind, DriverRow, ResidualDriver, ResidualDrivers,
};
pub use smooth::MapPoint;
