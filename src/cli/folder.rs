//! The result folder: written beside its place and moved there when it is complete, so that a result is whole or not there.
//!
//! ```text
//! OUT              absent or empty: used;  finished (has `.gearwear-result`): replaced whole;  anything else: refused
//! .NAME.part       beside it, while a command writes (has `.gearwear-unfinished`); kept after a failure if it has a checkpoint
//! ```

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Marks a folder that gearwear wrote to its end.
const FINISHED: &str = ".gearwear-result";
/// Marks a folder that gearwear is writing.
const UNFINISHED: &str = ".gearwear-unfinished";
/// How the names of files begin that `--resume` continues from; they do not go into the result.
pub(super) const CHECKPOINT: &str = "checkpoint";

/// Why a result folder cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// Something else stands there.
    #[error("{} is not empty and no gearwear result; choose another folder with -o", .path.display())]
    Foreign {
        /// The folder.
        path: PathBuf,
    },
    /// A file stands there.
    #[error("{} is a file, a folder is needed; choose another one with -o", .path.display())]
    File {
        /// The file.
        path: PathBuf,
    },
    /// The path has no last name: `/` or `..`.
    #[error("{} cannot be a result folder; choose another one with -o", .path.display())]
    Nameless {
        /// The path.
        path: PathBuf,
    },
    /// The system refuses.
    #[error("cannot {doing} {}: {source}", .path.display())]
    Io {
        /// What was tried, as a verb.
        doing: &'static str,
        /// With which file or folder.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
}

impl FolderError {
    /// Whether the user's choice is at fault, not the system.
    pub(super) fn is_unusable_input(&self) -> bool {
        !matches!(self, FolderError::Io { .. })
    }
}

/// Where results go by default: `STUDYSTEM.out/COMMAND` beside the study.
pub(super) fn default_path(study: &Path, command: &str) -> PathBuf {
    let mut name = study.file_stem().unwrap_or_default().to_owned();
    name.push(".out");
    study.with_file_name(name).join(command)
}

/// A result folder that is being written.
#[derive(Debug)]
pub(super) struct ResultFolder {
    target: PathBuf,
    part: PathBuf,
    finished: bool,
}

/// What [`ResultFolder::resume`] finds.
#[derive(Debug)]
pub(super) enum Resumed {
    /// A folder to write into, with the checkpoints of an interrupted command if there was one.
    Write(ResultFolder),
    /// The result is there: nothing is to be done.
    Finished(PathBuf),
}

impl ResultFolder {
    /// Prepares `target` from scratch; a finished result stays until the new one is complete.
    pub(super) fn fresh(target: &Path) -> Result<ResultFolder, FolderError> {
        ResultFolder::open(target, state(target)?, false)
    }

    /// Prepares `target`, keeping the checkpoints of an interrupted command; a finished result is left alone.
    pub(super) fn resume(target: &Path) -> Result<Resumed, FolderError> {
        match state(target)? {
            State::Finished => Ok(Resumed::Finished(target.to_owned())),
            state => ResultFolder::open(target, state, true).map(Resumed::Write),
        }
    }

    fn open(target: &Path, state: State, resume: bool) -> Result<ResultFolder, FolderError> {
        // A link or a relative way round is followed once, so that the neighbour lies on the same disk.
        let target = match state {
            State::Absent => target.to_owned(),
            State::Empty | State::Finished => {
                fs::canonicalize(target).map_err(io_error("open", target))?
            }
        };
        let Some(name) = target.file_name() else {
            return Err(FolderError::Nameless { path: target });
        };
        let part = target.with_file_name(format!(".{}.part", name.to_string_lossy()));
        if part.exists() {
            if !part.join(UNFINISHED).is_file() {
                return Err(FolderError::Foreign { path: part });
            }
            if !resume {
                fs::remove_dir_all(&part).map_err(io_error("remove", &part))?;
            }
        }
        fs::create_dir_all(&part).map_err(io_error("create", &part))?;
        let mark = part.join(UNFINISHED);
        fs::write(
            &mark,
            "gearwear writes here; the folder is moved when it is complete\n",
        )
        .map_err(io_error("write", &mark))?;
        Ok(ResultFolder {
            target,
            part,
            finished: false,
        })
    }

    /// Where to write.
    pub(super) fn path(&self) -> &Path {
        &self.part
    }

    /// Marks the folder as complete, without its checkpoints, and moves it to its place.
    pub(super) fn finish(mut self) -> Result<PathBuf, FolderError> {
        for file in entries(&self.part)? {
            let name = file
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            if name.starts_with(CHECKPOINT) || name == UNFINISHED {
                fs::remove_file(&file).map_err(io_error("remove", &file))?;
            }
        }
        let mark = self.part.join(FINISHED);
        let text = format!(
            "gearwear {}: this folder is replaced as a whole\n",
            env!("CARGO_PKG_VERSION")
        );
        fs::write(&mark, text).map_err(io_error("write", &mark))?;
        match state(&self.target)? {
            State::Absent => {}
            State::Empty => {
                fs::remove_dir(&self.target).map_err(io_error("replace", &self.target))?
            }
            State::Finished => {
                // Moved aside first: the old result is gone only when the new one is in its place.
                let old = self.part.with_extension("old");
                if old.exists() {
                    return Err(FolderError::Foreign { path: old });
                }
                fs::rename(&self.target, &old).map_err(io_error("replace", &self.target))?;
                fs::rename(&self.part, &self.target).map_err(io_error("move", &self.part))?;
                self.finished = true;
                fs::remove_dir_all(&old).map_err(io_error("remove", &old))?;
                return Ok(self.target.clone());
            }
        }
        fs::rename(&self.part, &self.target).map_err(io_error("move", &self.part))?;
        self.finished = true;
        Ok(self.target.clone())
    }

    fn has_checkpoint(&self) -> bool {
        let files = entries(&self.part).unwrap_or_default();
        files.iter().any(|file| {
            file.file_name()
                .is_some_and(|name| name.to_string_lossy().starts_with(CHECKPOINT))
        })
    }
}

impl Drop for ResultFolder {
    /// A failed command leaves nothing but what `--resume` can use.
    fn drop(&mut self) {
        if !self.finished && !self.has_checkpoint() {
            let _ = fs::remove_dir_all(&self.part);
            if let Some(parent) = self
                .part
                .parent()
                .filter(|parent| parent.extension().is_some_and(|end| end == "out"))
            {
                // Only removes an empty one.
                let _ = fs::remove_dir(parent);
            }
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Absent,
    Empty,
    Finished,
}

fn state(path: &Path) -> Result<State, FolderError> {
    if !path.exists() {
        return Ok(State::Absent);
    }
    if !path.is_dir() {
        return Err(FolderError::File {
            path: path.to_owned(),
        });
    }
    if path.join(FINISHED).is_file() {
        return Ok(State::Finished);
    }
    if entries(path)?.is_empty() {
        Ok(State::Empty)
    } else {
        Err(FolderError::Foreign {
            path: path.to_owned(),
        })
    }
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, FolderError> {
    let read = || {
        fs::read_dir(folder)?
            .map(|entry| entry.map(|entry| entry.path()))
            .collect::<io::Result<Vec<_>>>()
    };
    read().map_err(io_error("read", folder))
}

fn io_error(doing: &'static str, path: &Path) -> impl Fn(io::Error) -> FolderError {
    let path = path.to_owned();
    move |source| FolderError::Io {
        doing,
        path: path.clone(),
        source,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(target: &Path, text: &str) -> PathBuf {
        let folder = ResultFolder::fresh(target).unwrap();
        fs::write(folder.path().join("a.txt"), text).unwrap();
        folder.finish().unwrap()
    }

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = entries(folder)
            .unwrap()
            .iter()
            .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn the_default_stands_beside_the_study() {
        assert_eq!(
            default_path(Path::new("a/b/my.study.toml"), "run"),
            Path::new("a/b/my.study.out/run")
        );
        assert_eq!(
            default_path(Path::new("study.toml"), "mesh"),
            Path::new("study.out/mesh")
        );
    }

    #[test]
    fn a_finished_folder_is_replaced_whole() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("s.out/run");
        write(&target, "one");
        fs::write(target.join("stray.txt"), "left by the old result").unwrap();
        write(&target, "two");
        assert_eq!(fs::read_to_string(target.join("a.txt")).unwrap(), "two");
        assert_eq!(names(&target), [FINISHED, "a.txt"]);
        assert_eq!(
            names(target.parent().unwrap()),
            ["run"],
            "nothing is left beside it"
        );
    }

    #[test]
    fn an_empty_folder_is_used_and_a_foreign_one_refused() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("results");
        fs::create_dir(&target).unwrap();
        write(&target, "one");
        let foreign = home.path().join("mine");
        fs::create_dir(&foreign).unwrap();
        fs::write(foreign.join("thesis.txt"), "precious").unwrap();
        let error = ResultFolder::fresh(&foreign).unwrap_err();
        assert!(matches!(error, FolderError::Foreign { .. }) && error.is_unusable_input());
        let error = ResultFolder::fresh(&foreign.join("thesis.txt")).unwrap_err();
        assert!(matches!(error, FolderError::File { .. }));
        assert_eq!(names(&foreign), ["thesis.txt"]);
        assert_eq!(names(home.path()), ["mine", "results"]);
    }

    #[test]
    fn a_failure_leaves_nothing_but_a_checkpoint() {
        let home = tempfile::tempdir().unwrap();
        let target = home.path().join("s.out/run");
        let folder = ResultFolder::fresh(&target).unwrap();
        fs::write(folder.path().join("a.txt"), "half").unwrap();
        drop(folder);
        assert!(names(home.path()).is_empty());

        let Resumed::Write(folder) = ResultFolder::resume(&target).unwrap() else {
            panic!("finished")
        };
        fs::write(folder.path().join("checkpoint.bin"), "7").unwrap();
        drop(folder);
        let Resumed::Write(folder) = ResultFolder::resume(&target).unwrap() else {
            panic!("finished")
        };
        assert_eq!(
            fs::read_to_string(folder.path().join("checkpoint.bin")).unwrap(),
            "7"
        );
        folder.finish().unwrap();
        assert_eq!(names(&target), [FINISHED]);
        assert!(matches!(
            ResultFolder::resume(&target).unwrap(),
            Resumed::Finished(_)
        ));

        let folder = ResultFolder::fresh(&target).unwrap();
        assert_eq!(
            names(folder.path()),
            [UNFINISHED],
            "without resume it starts afresh"
        );
    }
}
