//! How far a climb has come, and the file that an interrupted one leaves.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::CliError;
use super::version::{Fitted, Fitter, Rung};
use crate::cli::folder;
use crate::learn::Comparison;
use crate::learn::climb::{ClimbStep, Standing};
use crate::report::{self, OutputError, atomic};

/// The version that is gone on from, and the way to it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) rungs: Vec<Rung>,
    /// Fitted parameters by their full names.
    pub(super) values: Vec<(String, f64)>,
    pub(super) standing: Standing,
    /// Everything tried.
    pub(super) steps: Vec<ClimbStep>,
    /// What was kept, each with its effects.
    pub(super) versions: Vec<(Vec<String>, Comparison)>,
}

impl State {
    /// The study as it stands.
    pub(super) fn first(
        fitter: &Fitter<'_>,
        watch: &(dyn Fn(String) + Sync),
    ) -> Result<Self, CliError> {
        let fitted = fitter.fit(Vec::new(), &[], watch)?;
        Ok(Self {
            steps: vec![fitted.standing.step(None, Vec::new())],
            standing: fitted.standing,
            versions: vec![(Vec::new(), fitted.comparison)],
            rungs: fitted.rungs,
            values: fitted.values,
        })
    }

    /// Whether the version has this effect.
    pub(super) fn has(&self, effect: &str) -> bool {
        self.rungs.iter().any(|rung| rung.effect == effect)
    }

    /// Goes on from another version.
    pub(super) fn go_on(&mut self, fitted: Fitted) {
        let effects = fitted.rungs.iter().map(|rung| rung.effect.clone());
        self.versions.push((effects.collect(), fitted.comparison));
        self.standing = fitted.standing;
        self.values = fitted.values;
        self.rungs = fitted.rungs;
    }
}

/// The file beside the result folder that an interrupted climb leaves.
pub(super) struct Kept {
    path: PathBuf,
    identity: String,
}

#[derive(Serialize, Deserialize)]
struct File {
    inputs_sha256: String,
    state: State,
}

impl Kept {
    /// Of a climb into `target` from the input with this fingerprint.
    pub(super) fn new(target: &Path, identity: String) -> Self {
        Self {
            path: folder::checkpoint_path(target),
            identity,
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// What an earlier climb from the same input left, if `resume`.
    pub(super) fn read(&self, resume: bool) -> Result<Option<State>, CliError> {
        if !resume {
            return Ok(None);
        }
        let bytes = match fs::read(&self.path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(source) => {
                return Err(CliError::Io {
                    doing: "read",
                    path: self.path.clone(),
                    source,
                });
            }
        };
        match serde_json::from_slice::<File>(&bytes) {
            Ok(file) if file.inputs_sha256 == self.identity => Ok(Some(file.state)),
            _ => Err(CliError::Unusable(format!(
                "{} is not of this study and these measurements; climb without --resume begins anew",
                self.path.display()
            ))),
        }
    }

    /// Keeps the state: whole or not at all.
    pub(super) fn keep(&self, state: &State) -> Result<(), OutputError> {
        let file = File {
            inputs_sha256: self.identity.clone(),
            state: state.clone(),
        };
        let bytes = report::json::text("climb.checkpoint", &file)?;
        atomic::write_file(&self.path, &bytes)
    }

    /// Removes the file once the result is there.
    pub(super) fn discard(&self) {
        // it does no harm where it cannot be removed: without --resume it is not asked
        let _ = fs::remove_file(&self.path);
    }
}
