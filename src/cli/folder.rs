//! Where results and checkpoints go. That results appear whole or not at all is the report floor's business.

use std::path::{Path, PathBuf};

use super::CliError;
use crate::report::atomic::{self, Reservation};
use crate::study::Study;

/// Where results go by default: `STUDYSTEM.out/COMMAND` beside the study.
pub(super) fn default_path(study: &Path, command: &str) -> PathBuf {
    let mut name = study.file_stem().unwrap_or_default().to_owned();
    name.push(".out");
    study.with_file_name(name).join(command)
}

/// Reserves `target` for results until what comes back is dropped: a result folder is replaced whole, and what is read from `file`
/// must not go with it.
///
/// # Errors
/// [`CliError`] if the folder is foreign, in use by another program, or holds the study or a file that it names.
pub(super) fn reserve(target: &Path, file: &Path, study: &Study) -> Result<Reservation, CliError> {
    let reservation = atomic::reserve(target)?;
    apart(target, file, study)?;
    Ok(reservation)
}

/// Whether what is read from `file` stands outside the result folder `target`.
///
/// # Errors
/// [`CliError`] if it would go with an old result.
pub(super) fn apart(target: &Path, file: &Path, study: &Study) -> Result<(), CliError> {
    let Ok(real) = target.canonicalize() else {
        return Ok(());
    };
    let inside = |input: &&Path| {
        input
            .canonicalize()
            .is_ok_and(|input| input.starts_with(&real))
    };
    let inputs = study.inputs().into_iter().chain([file]);
    match inputs.into_iter().find(inside) {
        Some(input) => Err(CliError::Unusable(format!(
            "{} would be replaced by the results, and {} stands in it; name another folder",
            target.display(),
            input.display()
        ))),
        None => Ok(()),
    }
}

/// The checkpoint of an unfinished run into `target`: `.NAME.checkpoint` beside it.
pub(super) fn checkpoint_path(target: &Path) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    target.with_file_name(format!(".{name}.checkpoint"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_stands_beside_the_study() {
        assert_eq!(
            default_path(Path::new("a/b.toml"), "run"),
            Path::new("a/b.out/run")
        );
        assert_eq!(
            checkpoint_path(Path::new("a/b.out/run")),
            Path::new("a/b.out/.run.checkpoint")
        );
    }
}
