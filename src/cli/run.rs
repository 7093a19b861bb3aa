//! `gearwear run`: mesh, contact and wear history of one study at its operation or at a test's conditions.

use std::path::Path;

use clap::Args;

use super::args::StudyAndOutput;
use super::folder::{self, ResultFolder, Resumed};
use super::progress::Progress;
use super::{CliError, Context, Outcome};
use crate::study::{Operation, Study};

/// Arguments of `run`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear run study.toml\n  gearwear run study.toml --test A -o results/A\n  gearwear run study.toml --resume\n  gearwear run study.toml --json --quiet | jq .wear"
)]
pub struct RunArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// Run at the conditions of the test with this id instead of the study's operation
    #[arg(long, value_name = "ID")]
    test: Option<String>,
    /// Continue from the checkpoint of an interrupted run; a finished run is left alone
    #[arg(long)]
    resume: bool,
}

/// Checks the input, prepares the folder, and leaves the work to [`simulate_and_report`].
pub(super) fn execute(args: &RunArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    let conditions = study.conditions(args.test.as_deref())?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "run"));
    let folder = if args.resume {
        match ResultFolder::resume(&target)? {
            Resumed::Finished(path) => return already_finished(&path),
            Resumed::Write(folder) => folder,
        }
    } else {
        ResultFolder::fresh(&target)?
    };
    simulate_and_report(&study, conditions, folder.path(), &context.progress("wear"))?
        .in_folder(folder)
}

/// Simulates and writes all result files into `folder` (`checkpoint*` files there are what `--resume` continues from); the
/// outcome's JSON is `summary.json`.
fn simulate_and_report(
    _study: &Study,
    _conditions: &Operation,
    _folder: &Path,
    _progress: &Progress,
) -> Result<Outcome, CliError> {
    Err(CliError::NotBuilt { command: "run" })
}

fn already_finished(folder: &Path) -> Result<Outcome, CliError> {
    let path = folder.join("summary.json");
    let unreadable = |source| CliError::Io {
        doing: "read",
        path: path.clone(),
        source,
    };
    let text = std::fs::read_to_string(&path).map_err(unreadable)?;
    let json = serde_json::from_str(&text).map_err(|error| unreadable(error.into()))?;
    let text = format!("finished already: {}\n", folder.display());
    Ok(Outcome {
        json,
        text,
        success: true,
    })
}
