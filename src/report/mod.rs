//! Floor 9: results in, files out.
//!
//! ```text
//! Run ─► write_run ─► summary.json report.html wear.csv contact.csv transmission_error.csv
//!                     plots/*.svg,png fields/*.vtu fields/*.pvd fields/loads.json        all of them or none (atomic)
//! ```
//! Every command that writes a folder does so through [`Staging`], every single file through [`write_file`].
pub mod atomic;
mod bitmap;
pub mod climb;
pub mod comparison;
pub mod csv;
pub mod diagnosis;
pub mod discrepancy;
pub mod drawings;
pub mod drivers;
mod error;
pub mod guide;
pub mod html;
pub mod json;
pub mod ladder;
mod learned;
mod measured_curves;
pub mod models;
pub mod plan;
pub mod plots;
mod run;
pub mod text;
pub mod vtk;

pub use atomic::{Staging, write_file};
pub use error::OutputError;
pub use run::{
    FieldsWritten, Written, write_comparison, write_ladder, write_models, write_page,
    write_page_with, write_run, write_run_with, write_validation,
};
