//! Which input a result was made from, so that one command can go on from another's answer to the same question.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{CliError, folder};
use crate::learn::diagnose::Decided;
use crate::simulate::checkpoint::fingerprint;
use crate::study::Study;

/// Key of a document that tells its input.
pub(super) const KEY: &str = "inputs_sha256";

/// Fingerprint of the study's text and of all files that it names.
///
/// # Errors
/// [`CliError::Io`] if one of them cannot be read.
pub(super) fn identity(study: &Study) -> Result<String, CliError> {
    let mut parts = vec![study.text().as_bytes().to_vec()];
    for path in study.inputs() {
        parts.push(fs::read(path).map_err(|source| CliError::Io {
            doing: "read",
            path: path.to_owned(),
            source,
        })?);
    }
    let parts: Vec<&[u8]> = parts.iter().map(Vec::as_slice).collect();
    let bytes = fingerprint(&parts);
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// The diagnosis in the study's own result folder, if it was made from the same input.
///
/// # Errors
/// [`CliError::Io`] if the study's files cannot be read; a diagnosis that cannot be is none.
pub(super) fn decided(path: &Path, study: &Study) -> Result<Option<Decided>, CliError> {
    let file = folder::default_path(path, "diagnose").join("diagnosis.json");
    let Ok(text) = fs::read_to_string(file) else {
        return Ok(None);
    };
    let Ok(document) = serde_json::from_str::<Value>(&text) else {
        return Ok(None);
    };
    if document[KEY] != identity(study)? {
        return Ok(None);
    }
    Ok(serde_json::from_value(document).ok())
}
