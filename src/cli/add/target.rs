//! Where the new study of `add` goes, and how it gets there: whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::{AddArgs, CliError};
use crate::study::Study;

/// Where the new study goes.
pub(super) fn target(args: &AddArgs, study: &Study) -> Result<PathBuf, CliError> {
    let target = args.output.clone().unwrap_or_else(|| {
        let mut name = args.study.file_stem().unwrap_or_default().to_owned();
        // no colon: some file systems take none
        name.push(format!("+{}.toml", args.effect.replace(':', "-")));
        args.study.with_file_name(name)
    });
    if target.is_dir() {
        return Err(CliError::Unusable(format!(
            "{} is a folder; add needs the name of the new study file",
            target.display()
        )));
    }
    let same = |a: &Path, b: &Path| {
        a.canonicalize()
            .is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
    };
    if same(&target, &args.study) {
        return Err(CliError::Unusable(format!(
            "{} is the study itself, which stays as it is; name another file for the new one",
            target.display()
        )));
    }
    if let Some(input) = study
        .inputs()
        .into_iter()
        .find(|input| same(&target, input))
    {
        return Err(CliError::Unusable(format!(
            "{} is a file that the study names; name another file for the new one",
            input.display()
        )));
    }
    Ok(target)
}

/// Refuses to overwrite unasked.
pub(super) fn is_free(target: &Path, args: &AddArgs) -> Result<(), CliError> {
    if target.exists() && !args.force {
        return Err(CliError::Exists {
            path: target.to_owned(),
        });
    }
    Ok(())
}

/// The file under which a target is written before it gets its name.
fn partial(target: &Path) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    target.with_file_name(format!(".{name}.partial-{}", std::process::id()))
}

/// Whether the target's folder, if it is there, takes a file: a fit takes a while, and its answer must have a place.
pub(super) fn writable(target: &Path) -> io::Result<()> {
    let folder = folder(target);
    if !folder.as_os_str().is_empty() && !folder.is_dir() {
        return Ok(());
    }
    let partial = partial(target);
    File::create(&partial)?;
    fs::remove_file(&partial)
}

/// Writes a file whole or not at all: under another name beside it, flushed, then renamed. Its folder is made if it is not there.
pub(super) fn write_whole(target: &Path, text: &str) -> io::Result<()> {
    let folder = folder(target);
    if !folder.as_os_str().is_empty() {
        fs::create_dir_all(folder)?;
    }
    let partial = partial(target);
    let written = File::create(&partial).and_then(|mut file| {
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        fs::rename(&partial, target)
    });
    if written.is_err() {
        // what remains of a failed attempt is nobody's
        let _ = fs::remove_file(&partial);
    }
    written
}

pub(super) fn folder(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}
