//! The place of a result, held while its program computes.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

use super::paths::{io_error, parent_of, resolved, sibling};
use super::{MOST_ATTEMPTS, check_target};
use crate::report::error::OutputError;

/// The right to put results at one place, from before a computation until its results stand there.
#[derive(Debug)]
pub struct Reservation {
    path: PathBuf,
    /// The lock file, once it is this program's.
    held: Option<File>,
    /// Folders made for the lock file, the innermost first.
    made: Vec<PathBuf>,
}

/// Reserves `target` for this program. Refused, as by [`check`](super::check), where something else stands, and while
/// another program holds it. Parents are created.
pub fn reserve(target: &Path) -> Result<Reservation, OutputError> {
    let target = resolved(target)?;
    check_target(&target)?;
    let parent = parent_of(&target);
    let absent = parent.ancestors().take_while(|folder| !folder.exists());
    let made: Vec<PathBuf> = absent.map(Path::to_owned).collect();
    fs::create_dir_all(&parent).map_err(io_error("create", &parent))?;
    let path = sibling(&target, "lock");
    let mut reservation = Reservation {
        path: path.clone(),
        held: None,
        made,
    };
    for _ in 0..MOST_ATTEMPTS {
        let mut options = OpenOptions::new();
        let file = (options.create(true).truncate(false).write(true).open(&path))
            .map_err(io_error("lock", &path))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(OutputError::Taken { folder: target }),
            Ok(()) if !is_at(&file, &path) => continue,
            // a file system without locks (some network ones) still works, unguarded
            Ok(()) | Err(TryLockError::Error(_)) => reservation.held = Some(file),
        }
        return Ok(reservation);
    }
    Err(OutputError::Taken { folder: target })
}

impl Drop for Reservation {
    fn drop(&mut self) {
        // while the lock is held: who opened the file before it went finds another one, or none, under its name
        if self
            .held
            .as_ref()
            .is_some_and(|file| is_at(file, &self.path))
        {
            let _ = fs::remove_file(&self.path);
        }
        self.held = None;
        for folder in &self.made {
            // only those that stayed empty go
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Whether the open file still stands under its name: its former holder may have removed it between opening and locking.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (file.metadata(), fs::metadata(path)) {
        (Ok(open), Ok(named)) => open.ino() == named.ino() && open.dev() == named.dev(),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_at(_file: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::atomic::Staging;

    #[test]
    fn a_place_is_reserved_once() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("new").join("out");
        let held = reserve(&target).unwrap();
        assert!(matches!(reserve(&target), Err(OutputError::Taken { .. })));
        drop(held);
        assert!(!home.path().join("new").exists(), "nothing stays");
        // a killed program's lock file is free
        fs::create_dir(home.path().join("new")).unwrap();
        fs::write(home.path().join("new/.out.lock"), "").unwrap();
        let held = reserve(&target).unwrap();
        let mut staging = Staging::begin(&target).unwrap();
        staging.write("a", b"1").unwrap();
        staging.commit().unwrap();
        drop(held);
        let left: Vec<_> = fs::read_dir(home.path().join("new")).unwrap().collect();
        assert_eq!(left.len(), 1, "{left:?}");
    }
}
