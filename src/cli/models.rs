//! `gearwear models`: the finite-element, Hertz and published models side by side.

use std::path::Path;

use clap::Args;

use super::args::StudyAndOutput;
use super::folder::{self, ResultFolder};
use super::progress::Progress;
use super::{CliError, Context, Outcome};
use crate::study::Study;

/// Arguments of `models`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear models study.toml\n  gearwear models study.toml -o results/models --json"
)]
pub struct ModelsArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
}

/// Checks the input, prepares the folder, and leaves the work to [`compare_models`].
pub(super) fn execute(args: &ModelsArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "models"));
    let folder = ResultFolder::fresh(&target)?;
    compare_models(&study, folder.path(), &context.progress("models"))?.in_folder(folder)
}

/// Runs all three models and writes their tables and plots into `folder`; the outcome's JSON is `models.json`.
fn compare_models(
    _study: &Study,
    _folder: &Path,
    _progress: &Progress,
) -> Result<Outcome, CliError> {
    Err(CliError::NotBuilt { command: "models" })
}
