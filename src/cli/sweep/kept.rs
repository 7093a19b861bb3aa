//! Points that are done: one small file each, named by the point's key, until the sweep is whole; then the sweep's own document.
//!
//! A file holds the figures of a point, or the reason why it failed. Parts of a sweep that are computed elsewhere leave such a folder each, or
//! share one.

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

    /// The folder of parts that are computed by themselves, with what stands in it.
    ///
    /// # Errors
    /// [`CliError`] if the folder holds anything else.
    pub(super) fn part(folder: &Path) -> Result<Self, CliError> {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        let foreign = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .find(|name| !name.starts_with('.') && key_of(Path::new(name)).is_none());
        if folder.exists() && !folder.is_dir() {
            return Err(OutputError::NotAFolder {
                path: folder.to_owned(),
            }
            .into());
        }
        if let Some(found) = foreign {
            return Err(CliError::Unusable(format!(
                "{} is no folder of a sweep's points (it holds {found}); choose another with -o",
                folder.display()
            )));
        }
        Ok(Self {
            folder: folder.to_owned(),
            done: single(folder).collect(),
        })
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

    /// Keeps the reason why a point failed: another attempt replaces it.
    pub(super) fn keep_failure(&self, key: &str, why: &str) -> Result<(), OutputError> {
        let name = format!("{key}.json");
        let bytes = crate::report::json::text(&name, &serde_json::json!({"error": why}))?;
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

/// The key of a point from the name of its file.
fn key_of(path: &Path) -> Option<&str> {
    let key = path.file_name()?.to_str()?.strip_suffix(".json")?;
    (key.len() == 32 && key.bytes().all(|byte| byte.is_ascii_hexdigit())).then_some(key)
}

/// The points of an interrupted sweep.
fn single(folder: &Path) -> impl Iterator<Item = (String, Figures)> {
    files(folder).filter_map(|(key, bytes)| Some((key, serde_json::from_slice(&bytes).ok()?)))
}

/// Keys and contents of the files of a folder.
fn files(folder: &Path) -> impl Iterator<Item = (String, Vec<u8>)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let of = |path: PathBuf| Some((key_of(&path)?.to_owned(), fs::read(&path).ok()?));
    entries.filter_map(move |entry| of(entry.path()))
}

/// What parts have left in some folders, by key: each different content with the folder where it stands.
///
/// # Errors
/// [`CliError`] if one of them is no folder.
pub(super) fn left_in(folders: &[PathBuf]) -> Result<Left, CliError> {
    let mut left = Left::new();
    for folder in folders {
        if !folder.is_dir() {
            return Err(CliError::Unusable(format!(
                "--merge {}: there is no such folder; name the folders that --shard and --point have written",
                folder.display()
            )));
        }
        for (key, bytes) in files(folder) {
            let Some(result) = result_of(&bytes) else {
                // cut off on the way here: the point is missing
                continue;
            };
            let known: &mut Vec<(Found, PathBuf)> = left.entry(key).or_default();
            if known.iter().all(|(other, _)| *other != result) {
                known.push((result, folder.clone()));
            }
        }
    }
    Ok(left)
}

/// Figures or the reason of a failure.
pub(super) type Found = std::result::Result<Figures, String>;
/// By key.
pub(super) type Left = BTreeMap<String, Vec<(Found, PathBuf)>>;

fn result_of(bytes: &[u8]) -> Option<Found> {
    if let Ok(figures) = serde_json::from_slice::<Figures>(bytes) {
        return Some(Ok(figures));
    }
    let document = serde_json::from_slice::<serde_json::Value>(bytes).ok()?;
    Some(Err(document["error"].as_str()?.to_owned()))
}
