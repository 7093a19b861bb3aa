//! `gearwear validate`: the verification and validation cases.

use std::path::PathBuf;

use clap::Args;

use super::folder::ResultFolder;
use super::progress::Progress;
use super::{CliError, Context, Outcome};

/// Arguments of `validate`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear validate\n  gearwear validate -o results/validation\n  gearwear validate A1 B3 --json"
)]
pub struct ValidateArgs {
    /// Cases to run [default: all]
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Folder for validation.json and the tables [default: nothing is written]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Prepares the folder, if one is wanted, and leaves the work to [`run_cases`].
pub(super) fn execute(args: &ValidateArgs, context: &Context) -> Result<Outcome, CliError> {
    let folder = args
        .output
        .as_deref()
        .map(ResultFolder::fresh)
        .transpose()?;
    let path = folder.as_ref().map(ResultFolder::path);
    let outcome = run_cases(&args.cases, path, &context.progress("cases"))?;
    match folder {
        Some(folder) => outcome.in_folder(folder),
        None => Ok(outcome),
    }
}

/// Runs the named cases, all if none is named, and writes `validation.json` into `folder` if there is one; the outcome's JSON
/// is that document, and it is no success if a case fails. An unknown name is unusable input.
fn run_cases(
    _cases: &[String],
    _folder: Option<&std::path::Path>,
    _progress: &Progress,
) -> Result<Outcome, CliError> {
    Err(CliError::NotBuilt {
        command: "validate",
    })
}
