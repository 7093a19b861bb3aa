//! Names beside a target, and what becomes durable on the disk.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use crate::report::error::OutputError;

/// How the names of what is in the making go on.
pub(super) const PARTIAL: &str = "partial-";

/// An absolute path to the folder itself, links followed, so that the rename replaces the folder and not a link to it.
pub(super) fn resolved(target: &Path) -> Result<PathBuf, OutputError> {
    let path = if target.exists() {
        target.canonicalize().map_err(io_error("read", target))?
    } else {
        std::path::absolute(target).map_err(io_error("read", target))?
    };
    match path.file_name() {
        Some(_) => Ok(path),
        None => Err(OutputError::Nameless {
            path: target.to_owned(),
        }),
    }
}

pub(super) fn parent_of(path: &Path) -> PathBuf {
    path.parent()
        .map_or_else(|| PathBuf::from("."), Path::to_owned)
}

/// `.NAME.suffix` beside `target`.
pub(super) fn sibling(target: &Path, suffix: &str) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    target.with_file_name(format!(".{name}.{suffix}"))
}

pub(super) fn io_error(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> OutputError {
    let path = path.to_owned();
    move |source| OutputError::Io {
        action,
        path,
        source,
    }
}

/// What stands beside `target` under the names that its own attempts use.
pub(super) fn partials(target: &Path) -> Vec<PathBuf> {
    let prefix = sibling(target, PARTIAL)
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let own = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.strip_prefix(&prefix)
            .is_some_and(|rest| rest.bytes().next().is_some_and(|c| c.is_ascii_digit()))
    };
    let Ok(entries) = fs::read_dir(parent_of(target)) else {
        return Vec::new();
    };
    entries
        .flatten()
        .map(|entry| entry.path())
        .filter(own)
        .collect()
}

#[cfg(unix)]
pub(super) fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
pub(super) fn sync_folder(_folder: &Path) -> io::Result<()> {
    Ok(())
}
