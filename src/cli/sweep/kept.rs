//! Points that are done: one small file each until the sweep is whole, then the sweep's own document.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::CliError;
use super::figures::Figures;
use crate::report::{OutputError, atomic};

/// The points that are done, by their keys.
pub(super) struct Kept {
    folder: PathBuf,
    done: BTreeMap<String, Figures>,
}

impl Kept {
    /// What an earlier sweep into `target` left, if `resume`; else what an interrupted one left is removed.
    pub(super) fn open(target: &Path, resume: bool) -> Result<Self, CliError> {
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let folder = target.with_file_name(format!(".{name}.points"));
        let mut done = BTreeMap::new();
        if resume {
            done.extend(finished(&target.join("sweep.json")));
            done.extend(single(&folder));
        } else if folder.is_dir() {
            fs::remove_dir_all(&folder).map_err(|source| CliError::Io {
                doing: "remove",
                path: folder.clone(),
                source,
            })?;
        }
        Ok(Self { folder, done })
    }

    /// The figures of the point with this key, if it is done.
    pub(super) fn get(&self, key: &str) -> Option<&Figures> {
        self.done.get(key)
    }

    /// Keeps a point: whole or not at all.
    pub(super) fn keep(&self, key: &str, figures: &Figures) -> Result<(), OutputError> {
        let name = format!("{key}.json");
        let bytes = crate::report::json::text(&name, figures)?;
        atomic::write_file(&self.folder.join(&name), &bytes)
    }

    /// Removes the single files once the sweep is whole.
    pub(super) fn discard(&self) {
        // they do no harm where they cannot be removed: the next sweep does it
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// The points of a finished sweep; none where there is no such document or it is of another version.
fn finished(path: &Path) -> Vec<(String, Figures)> {
    let document = fs::read(path)
        .ok()
        .and_then(|bytes| serde_json::from_slice::<serde_json::Value>(&bytes).ok());
    let points = document.as_ref().and_then(|d| d["points"].as_array());
    let of = |point: &serde_json::Value| {
        let key = point["key"].as_str()?.to_owned();
        Some((key, serde_json::from_value(point["figures"].clone()).ok()?))
    };
    points.into_iter().flatten().filter_map(of).collect()
}

/// The points of an interrupted sweep.
fn single(folder: &Path) -> Vec<(String, Figures)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let of = |path: PathBuf| {
        let key = path
            .file_name()?
            .to_str()?
            .strip_suffix(".json")?
            .to_owned();
        let bytes = fs::read(&path).ok()?;
        Some((key, serde_json::from_slice(&bytes).ok()?))
    };
    entries.filter_map(|entry| of(entry.path())).collect()
}
