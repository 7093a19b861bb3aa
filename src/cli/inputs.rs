//! Which input a result was made from, so that one command can go on from another's answer to the same question.

use std::fs;
use std::path::Path;

use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use super::{CliError, folder};
use crate::learn::diagnose::{Decided, Fidelity};
use crate::simulate::checkpoint::fingerprint;
use crate::study::Study;

/// Key of a document that tells its input.
pub(super) const KEY: &str = "inputs_sha256";

/// The file that holds a diagnosis.
const NAME: &str = "diagnosis.json";

/// Fingerprint of the study's text and of all files that it names.
///
/// # Errors
/// [`CliError::Io`] if one of them cannot be read.
pub(super) fn identity(study: &Study) -> Result<String, CliError> {
    identity_of(study.text(), study)
}

/// The same of another text that names the files of `study`.
///
/// # Errors
/// As of [`identity`].
pub(super) fn identity_of(text: &str, study: &Study) -> Result<String, CliError> {
    let mut parts = vec![without_rig(text).into_bytes()];
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

/// A study's text without its table `[rig]`, which bounds the tests that are suggested and changes no answer.
fn without_rig(text: &str) -> String {
    let mut is_of_rig = false;
    let own = text.split_inclusive('\n').filter(|line| {
        let line = line.trim();
        if line.starts_with('[') {
            is_of_rig = line.starts_with("[rig]");
        }
        !is_of_rig
    });
    own.collect()
}

/// The diagnosis in the study's own result folder, or beside it as `climb` leaves one, if it was made from the same input.
///
/// # Errors
/// [`CliError::Io`] if the study's files cannot be read; a diagnosis that cannot be is none.
pub(super) fn decided(path: &Path, study: &Study) -> Result<Option<Decided>, CliError> {
    finished(path, study, false)
}

/// What another command needs of the diagnosis that [`decided`] finds; `by_elements` takes none that the analytic model decided.
///
/// # Errors
/// As of [`decided`].
pub(super) fn finished<T: DeserializeOwned>(
    path: &Path,
    study: &Study,
    by_elements: bool,
) -> Result<Option<T>, CliError> {
    let own = identity(study)?;
    let places = [
        folder::default_path(path, "diagnose").join(NAME),
        path.with_file_name(NAME),
    ];
    let documents = places.iter().filter_map(|file| {
        let text = fs::read_to_string(file).ok()?;
        serde_json::from_str::<Value>(&text).ok()
    });
    let analytic = json!(Fidelity::Screening);
    let mut usable = documents.filter(|document| {
        let by_analytic = document["ranking"][0]["decided_by"] == analytic;
        document[KEY] == own && !(by_elements && by_analytic)
    });
    Ok(usable.find_map(|document| serde_json::from_value(document).ok()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rig_is_no_part_of_what_a_diagnosis_was_made_from() {
        let text = "[wear]\ncycles = 1e6\n[rig]\ntorque_max = 90 # N m\n\n[[test]]\nid = \"A\"\n";
        assert_eq!(
            without_rig(text),
            "[wear]\ncycles = 1e6\n[[test]]\nid = \"A\"\n"
        );
    }
}
