//! A fitted model against its measurements: document, table, words.
mod residuals;
mod text;

use serde_json::Value;

use super::error::OutputError;
use crate::learn::{Comparison, Fit};
use crate::measure::Dataset;
use crate::study::Study;

pub(crate) use residuals::quoted;
pub use residuals::residuals;
pub(crate) use text::{NO_INTERVAL, estimate, interval, members, scatter, what, with_unit};
pub use text::{conclusion, summary};

/// All that `compare` shows.
#[derive(Debug, Clone, Copy)]
pub struct Result<'a> {
    /// The study.
    pub study: &'a Study,
    /// Its file as the user named it.
    pub name: &'a str,
    /// The measurements.
    pub data: &'a Dataset,
    /// The fit.
    pub fit: &'a Fit,
    /// What it says.
    pub comparison: &'a Comparison,
}

/// `comparison.json`. χ² without dimension, depths µm, cycles in pinion revolutions; signs are model minus measured.
///
/// # Errors
/// [`OutputError`] if a figure has no JSON form.
pub fn document(result: &Result<'_>) -> std::result::Result<Value, OutputError> {
    let figures = serde_json::to_value(result.comparison);
    let mut document = figures.map_err(|source| OutputError::Json {
        file: "comparison.json".to_owned(),
        source,
    })?;
    document["next_step"] = Value::String(text::next_step(result));
    Ok(document)
}
