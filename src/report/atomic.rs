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
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

use super::error::OutputError;

/// File that marks a folder as a result of this program.
pub const MARKER: &str = ".gearwear-result";

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

/// Whether `folder` is a finished result of this program.
pub fn is_result(folder: &Path) -> bool {
    folder.join(MARKER).is_file()
}

/// Whether results may be put at `target`: it is absent, empty, or an earlier result. Call it before a long run.
pub fn check(target: &Path) -> Result<(), OutputError> {
    check_target(&resolved(target)?)
}

/// The right to put results at one place, from before a computation until its results stand there.
#[derive(Debug)]
pub struct Reservation {
    path: PathBuf,
    /// The lock file, once it is this program's.
    held: Option<File>,
    /// Folders made for the lock file, the innermost first.
    made: Vec<PathBuf>,
}

/// Reserves `target` for this program: as [`check`], and refused while another program holds it. Parents are created.
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

const PARTIAL: &str = "partial-";
const MOST_ATTEMPTS: usize = 1000;

/// The lock file of a partial folder, held while the folder is in use.
#[derive(Debug)]
struct Lock {
    path: PathBuf,
    _held: File,
}

impl Lock {
    /// Takes the lock of `folder`; none if another program has it.
    fn take(folder: &Path) -> io::Result<Option<Lock>> {
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

    fn release(&self) {
        let _ = fs::remove_file(&self.path);
    }
}

fn lock_path(folder: &Path) -> PathBuf {
    let mut name = folder.as_os_str().to_owned();
    name.push(".lock");
    PathBuf::from(name)
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

/// An absolute path to the folder itself, links followed, so that the rename replaces the folder and not a link to it.
fn resolved(target: &Path) -> Result<PathBuf, OutputError> {
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

fn parent_of(path: &Path) -> PathBuf {
    path.parent()
        .map_or_else(|| PathBuf::from("."), Path::to_owned)
}

/// `.NAME.suffix` beside `target`.
fn sibling(target: &Path, suffix: &str) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    target.with_file_name(format!(".{name}.{suffix}"))
}

fn io_error(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> OutputError {
    let path = path.to_owned();
    move |source| OutputError::Io {
        action,
        path,
        source,
    }
}

fn flushed(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Removes partial folders whose program is gone, and the old halves of exchanges that were cut short.
fn remove_dead(target: &Path) {
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

/// Removes files in the making whose program is gone.
fn remove_dead_files(target: &Path) {
    for path in partials(target) {
        let dead = File::open(&path).is_ok_and(|file| file.try_lock().is_ok());
        if dead && path.is_file() {
            let _ = fs::remove_file(&path);
        }
    }
}

/// What stands beside `target` under the names that its own attempts use.
fn partials(target: &Path) -> Vec<PathBuf> {
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

#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
fn sync_folder(_folder: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

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
