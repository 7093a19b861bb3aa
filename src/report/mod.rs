//! Floor 9: results in, files out.
pub mod atomic;
pub mod csv;
mod error;
pub mod json;
pub mod vtk;

pub use error::OutputError;
