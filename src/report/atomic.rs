//! Results appear whole or not at all.
//!
//! ```text
//! begin    lock .NAME.partial-1.lock, make .NAME.partial-1    NAME: the old result or nothing
//! write    files into it
//! commit   flush every file and folder to the disk, then
//!          NAME absent:   rename .NAME.partial-1 to NAME
//!          NAME present:  exchange the two names in one step (Linux), or, where the file system cannot,
//!                         NAME to .NAME.previous, .NAME.partial-1 to NAME; a crash between the two is undone by the next begin
//! drop     without commit: .NAME.partial-1 is removed
//! ```
//! [`reserve`] keeps other programs away from NAME for as long as its holder computes (`.NAME.lock`).
//! A killed program leaves its partial folder; the next `begin` for the same name removes it. The lock on the file beside it
//! tells a dead folder from that of a running program: the system frees the lock with the process.

mod file;
mod folder;
mod lock;
mod paths;
mod reservation;

use std::fs;
use std::path::Path;

use super::error::OutputError;
use paths::{io_error, resolved};

pub use file::{remove_file, write_file};
pub use folder::Staging;
pub use reservation::{Reservation, reserve};

/// File that marks a folder as a result of this program.
pub const MARKER: &str = ".gearwear-result";

/// Attempts at a name that others may hold.
const MOST_ATTEMPTS: usize = 1000;

/// Whether `folder` is a finished result of this program.
pub fn is_result(folder: &Path) -> bool {
    folder.join(MARKER).is_file()
}

/// Whether results may be put at `target`: it is absent, empty, or an earlier result. Call it before a long run.
pub fn check(target: &Path) -> Result<(), OutputError> {
    check_target(&resolved(target)?)
}

fn check_target(target: &Path) -> Result<(), OutputError> {
    if !target.exists() {
        return Ok(());
    }
    if !target.is_dir() {
        return Err(OutputError::NotAFolder {
            path: target.to_owned(),
        });
    }
    if is_result(target) {
        return Ok(());
    }
    let mut entries = fs::read_dir(target).map_err(io_error("read", target))?;
    match entries.next() {
        None => Ok(()),
        Some(entry) => {
            let found = entry
                .map_err(io_error("read", target))?
                .file_name()
                .to_string_lossy()
                .into_owned();
            Err(OutputError::Foreign {
                folder: target.to_owned(),
                found,
            })
        }
    }
}
