//! The lock beside a partial folder, and what killed programs left behind.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::paths::partials;

/// The lock file of a partial folder, held while the folder is in use.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _held: File,
}

impl Lock {
    /// Takes the lock of `folder`; none if another program has it.
    pub(super) fn take(folder: &Path) -> io::Result<Option<Lock>> {
        let path = lock_path(folder);
        let file = match OpenOptions::new().create_new(true).write(true).open(&path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => return Ok(None),
            Err(error) => return Err(error),
        };
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => Ok(None),
            // A file system without locks (some network ones) still works; it only keeps dead partial folders.
            Ok(()) | Err(TryLockError::Error(_)) => {
                Ok(path.exists().then_some(Lock { path, _held: file }))
            }
        }
    }

    pub(super) fn release(&self) {
        let _ = fs::remove_file(&self.path);
    }
}

pub(super) fn lock_path(folder: &Path) -> PathBuf {
    let mut name = folder.as_os_str().to_owned();
    name.push(".lock");
    PathBuf::from(name)
}

/// Removes partial folders whose program is gone, and the old halves of exchanges that were cut short.
pub(super) fn remove_dead(target: &Path) {
    for path in partials(target) {
        let folder = if path.extension().is_some_and(|e| e == "lock") {
            path.with_extension("")
        } else {
            path
        };
        let lock = lock_path(&folder);
        let _held = match OpenOptions::new().write(true).open(&lock) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Ok(file) if file.try_lock().is_ok() => Some(file),
            _ => continue,
        };
        let _ = fs::remove_dir_all(&folder);
        let _ = fs::remove_file(&lock);
    }
}
