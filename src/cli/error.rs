//! Why a command failed, and with which exit code the program then ends.

use std::io;
use std::path::PathBuf;

use crate::effects::EffectError;
use crate::learn::FitError;
use crate::learn::diagnose::DiagnoseError;
use crate::report::OutputError;
use crate::simulate::checkpoint::CheckpointError;
use crate::simulate::forward::ForwardError;
use crate::simulate::run::RunError;
use crate::study::StudyError;

/// A failed command.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CliError {
    /// The study cannot be used.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The catalogue has no such effect.
    #[error(transparent)]
    Effect(#[from] EffectError),
    /// The result folder cannot be used, or a file not written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// There is no diagnosis.
    #[error(transparent)]
    Diagnose(#[from] DiagnoseError),
    /// The simulation did not come to a result.
    #[error(transparent)]
    Run(#[from] RunError),
    /// What is free cannot be fitted to the measurements.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A checkpoint cannot be used.
    #[error("{source}: {}; run without --resume to start afresh", .path.display())]
    Checkpoint {
        /// Its file.
        path: PathBuf,
        /// Why not.
        source: CheckpointError,
    },
    /// Files that `init` would overwrite, or a file where its folder should be.
    #[error("{} is there already; --force overwrites it", .path.display())]
    Exists {
        /// The first of them.
        path: PathBuf,
    },
    /// `init` was given a file instead of a folder.
    #[error("{} is a file; init needs a folder", .path.display())]
    NotAFolder {
        /// The file.
        path: PathBuf,
    },
    /// Arguments that cannot be used, and why.
    #[error("{0}")]
    Unusable(String),
    /// Input that cannot be used, and why, after what was understood of it.
    #[error("{why}")]
    Shown {
        /// What was understood, lines for people.
        shown: String,
        /// Why it cannot be used.
        why: String,
    },
    /// Points of a sweep that no part has computed.
    #[error("{0}")]
    Missing(String),
    /// Reading or writing failed.
    #[error("cannot {doing} {}: {source}", .path.display())]
    Io {
        /// What was tried, as a verb.
        doing: &'static str,
        /// With which file or folder.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
    /// Standard output does not take the result.
    #[error("cannot print the result: {0}")]
    Print(io::Error),
    /// The server cannot go on.
    #[error("the server cannot go on: {source}")]
    Serve {
        /// The system's answer.
        source: io::Error,
    },
    /// The threads cannot be started.
    #[error("cannot start {threads} threads: {source}")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// Why not.
        source: rayon::ThreadPoolBuildError,
    },
}

impl From<ForwardError> for CliError {
    fn from(error: ForwardError) -> Self {
        CliError::Run(error.into())
    }
}

impl CliError {
    /// 2 for unusable input (nothing was written), 3 for parts of a sweep that are missing, 1 for any other failure.
    pub(super) fn exit_code(&self) -> u8 {
        match self {
            CliError::Study(_)
            | CliError::Effect(_)
            | CliError::Unusable(_)
            | CliError::Shown { .. }
            | CliError::Exists { .. }
            | CliError::NotAFolder { .. } => 2,
            CliError::Missing(_) => 3,
            CliError::Output(
                OutputError::Foreign { .. }
                | OutputError::NotAFolder { .. }
                | OutputError::Nameless { .. },
            ) => 2,
            CliError::Checkpoint { .. }
            | CliError::Fit(FitError::NoObservations)
            | CliError::Diagnose(DiagnoseError::NoObservations)
            | CliError::Run(RunError::Forward(ForwardError::TooFine { .. })) => 2,
            CliError::Output(_)
            | CliError::Run(_)
            | CliError::Fit(_)
            | CliError::Diagnose(_)
            | CliError::Io { .. }
            | CliError::Print(_)
            | CliError::Serve { .. }
            | CliError::Threads { .. } => 1,
        }
    }

    /// The whole message for standard error.
    pub(super) fn render(&self, coloured: bool) -> String {
        match self {
            CliError::Study(error) => error.render(coloured),
            CliError::Shown { shown, why } => format!("{shown}\nerror: {why}"),
            other => format!("error: {other}"),
        }
    }
}
