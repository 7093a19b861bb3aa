//! Versions of a model side by side: document and words.
mod text;

use serde_json::{Value, json};

use super::error::OutputError;
use crate::learn::diagnose::Fidelity;
use crate::learn::{Comparison, LadderStep};

pub use text::{beside_diagnosis, conclusion, summary};

/// All that `ladder` shows.
#[derive(Debug, Clone)]
pub struct Result<'a> {
    /// The first study's title.
    pub title: &'a str,
    /// The versions, each with what it gains over the one before.
    pub steps: Vec<LadderStep>,
    /// How each compares.
    pub comparisons: Vec<&'a Comparison>,
    /// The first of the studies that has been diagnosed, and by which model.
    pub diagnosed: Option<(&'a str, Fidelity)>,
    /// What keeps a version's error from being judged against the first's, in words; for each version.
    pub notes: Vec<Vec<&'static str>>,
}

/// `ladder.json`: a list of the versions.
///
/// # Errors
/// [`OutputError`] if a figure has no JSON form.
pub fn document(result: &Result<'_>) -> std::result::Result<Value, OutputError> {
    let mut list = Vec::new();
    for (step, notes) in result.steps.iter().zip(&result.notes) {
        let mut value = serde_json::to_value(step).map_err(|source| OutputError::Json {
            file: "ladder.json".to_owned(),
            source,
        })?;
        if !notes.is_empty() {
            value["notes"] = json!(notes);
        }
        list.push(value);
    }
    Ok(Value::Array(list))
}

/// The version's effects in words.
pub(super) fn effects(step: &LadderStep) -> String {
    if step.effects.is_empty() {
        "none".to_owned()
    } else {
        step.effects.join(", ")
    }
}

/// A factor by which an error falls, in words: `÷ 7.5`, `× 1.2`.
pub(super) fn factor(factor: Option<f64>) -> String {
    match factor.filter(|f| f.is_finite() && *f > 0.0) {
        None => String::new(),
        Some(f) if f >= 1.0 => format!("÷ {}", crate::numeric::written::significant(f, 3)),
        Some(f) => format!("× {}", crate::numeric::written::significant(1.0 / f, 3)),
    }
}
