//! Result folders: written aside, then put in place in one step.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

use super::lock::{Lock, remove_dead};
use super::paths::{PARTIAL, io_error, parent_of, resolved, sibling, sync_folder};
use super::{MARKER, MOST_ATTEMPTS, check_target, is_result};
use crate::report::error::OutputError;

/// A result folder in the making.
#[derive(Debug)]
pub struct Staging {
    target: PathBuf,
    folder: PathBuf,
    written: Vec<String>,
    lock: Lock,
    committed: bool,
}

impl Staging {
    /// Prepares to replace or create the folder `target`; refuses a foreign one that is not empty.
    ///
    /// The parents of `target` are created. Nothing under `target` itself changes before [`Staging::commit`].
    pub fn begin(target: &Path) -> Result<Staging, OutputError> {
        let target = resolved(target)?;
        let parent = parent_of(&target);
        fs::create_dir_all(&parent).map_err(io_error("create", &parent))?;
        recover(&target)?;
        check_target(&target)?;
        remove_dead(&target);
        for attempt in 1..=MOST_ATTEMPTS {
            let folder = sibling(&target, &format!("{PARTIAL}{attempt}"));
            let Some(lock) = Lock::take(&folder).map_err(io_error("lock", &folder))? else {
                continue;
            };
            match fs::create_dir(&folder) {
                Ok(()) => {
                    return Ok(Staging {
                        target,
                        folder,
                        written: Vec::new(),
                        lock,
                        committed: false,
                    });
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => lock.release(),
                Err(error) => {
                    lock.release();
                    return Err(io_error("create", &folder)(error));
                }
            }
        }
        Err(OutputError::Busy { folder: target })
    }

    /// Writes one file; `name` is relative to the result folder, with `/` between folders, which are created.
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        let mut parts = Path::new(name).components();
        if name.is_empty() || !parts.all(|part| matches!(part, Component::Normal(_))) {
            return Err(OutputError::OutsideFolder {
                name: name.to_owned(),
            });
        }
        let path = self.folder.join(name);
        let parent = parent_of(&path);
        fs::create_dir_all(&parent).map_err(io_error("create", &parent))?;
        flushed(&path, bytes).map_err(io_error("write", &path))?;
        self.written.push(name.to_owned());
        Ok(())
    }

    /// Names written so far, in order.
    pub fn written(&self) -> &[String] {
        &self.written
    }

    /// Puts the folder under its final name and returns that.
    pub fn commit(mut self) -> Result<PathBuf, OutputError> {
        let mut list = String::from(
            "This folder was written by gearwear and is replaced whole by the next run.\n",
        );
        for name in &self.written {
            list.push_str(name);
            list.push('\n');
        }
        // somebody may have emptied the folder: half a result must not get the name of a whole one
        for name in &self.written {
            let path = self.folder.join(name);
            fs::metadata(&path).map_err(io_error("find what was written to", &path))?;
        }
        let marker = self.folder.join(MARKER);
        flushed(&marker, list.as_bytes()).map_err(io_error("write", &marker))?;
        sync_folders(&self.folder).map_err(io_error("flush", &self.folder))?;
        // The target may have changed while the run was on its way.
        check_target(&self.target)?;
        let old = put_in_place(&self.folder, &self.target)?;
        self.committed = true;
        let parent = parent_of(&self.target);
        sync_folder(&parent).map_err(io_error("flush", &parent))?;
        if let Some(old) = old {
            // The new result stands; an old one that resists is swept by the next run.
            let _ = fs::remove_dir_all(old);
        }
        self.lock.release();
        Ok(self.target.clone())
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        if !self.committed {
            let _ = fs::remove_dir_all(&self.folder);
            self.lock.release();
        }
    }
}

fn flushed(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Undoes a crash between the two renames: the previous result gets its name back.
fn recover(target: &Path) -> Result<(), OutputError> {
    let previous = sibling(target, "previous");
    if is_result(&previous) {
        if target.exists() {
            let _ = fs::remove_dir_all(&previous);
        } else {
            fs::rename(&previous, target).map_err(io_error("restore", target))?;
        }
    }
    Ok(())
}

/// Gives `new` the name `target`; returns where the old folder went.
fn put_in_place(new: &Path, target: &Path) -> Result<Option<PathBuf>, OutputError> {
    if !target.exists() {
        fs::rename(new, target).map_err(io_error("create", target))?;
        return Ok(None);
    }
    if exchange(new, target) {
        return Ok(Some(new.to_owned()));
    }
    let previous = sibling(target, "previous");
    fs::rename(target, &previous).map_err(io_error("replace", target))?;
    if let Err(error) = fs::rename(new, target) {
        let _ = fs::rename(&previous, target);
        return Err(io_error("replace", target)(error));
    }
    Ok(Some(previous))
}

#[cfg(target_os = "linux")]
fn exchange(one: &Path, other: &Path) -> bool {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE).is_ok()
}

#[cfg(not(target_os = "linux"))]
fn exchange(_one: &Path, _other: &Path) -> bool {
    false
}

fn sync_folders(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            sync_folders(&entry.path())?;
        }
    }
    sync_folder(folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::atomic::lock::lock_path;

    #[test]
    fn a_folder_emptied_in_the_making_is_no_result() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("out");
        let write = |name: &str, text: &[u8]| {
            let mut staging = Staging::begin(&target).unwrap();
            staging.write(name, text).unwrap();
            staging
        };
        write("a", b"first").commit().unwrap();
        let mut staging = write("a", b"second");
        fs::remove_dir_all(&staging.folder).unwrap();
        staging.write("b", b"second").unwrap();
        let error = staging.commit().unwrap_err();
        assert!(
            error.to_string().contains("cannot find what was written"),
            "{error}"
        );
        assert_eq!(fs::read(target.join("a")).unwrap(), b"first");
    }

    /// The two-rename way, which Linux does not take by itself, interrupted after its first rename.
    #[test]
    fn crash_between_the_renames_is_undone() {
        let dir = tempfile::tempdir().unwrap();
        let target = dir.path().join("run");
        let mut staging = Staging::begin(&target).unwrap();
        staging.write("summary.json", b"{}").unwrap();
        staging.commit().unwrap();
        fs::rename(&target, sibling(&target, "previous")).unwrap();
        drop(Staging::begin(&target).unwrap());
        assert_eq!(fs::read(target.join("summary.json")).unwrap(), b"{}");
    }

    #[test]
    fn dead_partial_folders_are_swept_and_live_ones_kept() {
        let dir = tempfile::tempdir().unwrap();
        let target = dir.path().join("run");
        let dead = sibling(&target, "partial-1");
        fs::create_dir(&dead).unwrap();
        fs::write(lock_path(&dead), b"").unwrap();
        fs::create_dir(sibling(&target, "partial-7")).unwrap();
        let live = Staging::begin(&target).unwrap();
        let second = Staging::begin(&target).unwrap();
        assert!(live.folder.is_dir() && second.folder.is_dir() && live.folder != second.folder);
        drop((live, second));
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
    }
}
