//! Single files: whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

use super::paths::{PARTIAL, io_error, parent_of, partials, resolved, sibling, sync_folder};
use crate::report::error::OutputError;

/// Writes one file whole or not at all: beside the target, flushed, then renamed over it. Parents are created.
pub fn write_file(target: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let target = resolved(target)?;
    let parent = parent_of(&target);
    fs::create_dir_all(&parent).map_err(io_error("create", &parent))?;
    remove_dead_files(&target);
    let partial = sibling(&target, &format!("{PARTIAL}{}", std::process::id()));
    let outcome = File::create(&partial)
        .and_then(|mut file| {
            // held while the file is in the making; a file system without locks works too
            let _ = file.try_lock();
            file.write_all(bytes)?;
            file.sync_all()?;
            Ok(file)
        })
        .map_err(io_error("write", &partial))
        .and_then(|_held| fs::rename(&partial, &target).map_err(io_error("write", &target)));
    if outcome.is_err() {
        let _ = fs::remove_file(&partial);
    }
    outcome?;
    sync_folder(&parent).map_err(io_error("flush", &parent))
}

/// Removes a file that [`write_file`] wrote, and what killed programs left of their attempts at it.
pub fn remove_file(target: &Path) -> Result<(), OutputError> {
    let target = resolved(target)?;
    remove_dead_files(&target);
    match fs::remove_file(&target) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(io_error("remove", &target)(error))
        }
        _ => Ok(()),
    }
}

/// Removes files in the making whose program is gone.
fn remove_dead_files(target: &Path) {
    for path in partials(target) {
        let dead = File::open(&path).is_ok_and(|file| file.try_lock().is_ok());
        if dead && path.is_file() {
            let _ = fs::remove_file(&path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dead_partial_files_are_swept_and_live_ones_kept() {
        let dir = tempfile::tempdir().unwrap();
        let target = dir.path().join(".run.checkpoint");
        let [dead, live] = ["partial-1", "partial-2"].map(|suffix| sibling(&target, suffix));
        fs::write(&dead, b"half").unwrap();
        let held = File::create(&live).unwrap();
        held.try_lock().unwrap();
        write_file(&target, b"whole").unwrap();
        assert!(!dead.exists() && live.exists());
        assert_eq!(fs::read(&target).unwrap(), b"whole");
        drop(held);
        remove_file(&target).unwrap();
        remove_file(&target).unwrap();
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
    }
}
