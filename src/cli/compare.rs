//! `gearwear compare`: the fitted model against the measurements.

use clap::Args;

use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome, fitting, folder};
use crate::learn::{ModelVersion, contact_of};
use crate::report::{self, comparison};
use crate::study::Study;

/// Arguments of `compare`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear compare study.toml\n  gearwear compare study.toml -o results/base\n  gearwear compare study.toml --json --quiet | jq .holdout.chi2_per_point"
)]
pub struct CompareArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
}

/// Checks the input and the folder, fits, writes.
pub(super) fn execute(args: &CompareArgs, context: &Context) -> Result<Outcome, CliError> {
    let path = &args.paths.study;
    let study = Study::load(path)?;
    contact_of(&study)?;
    let data = study.dataset_to_fit()?;
    context.tell_reading(&data);
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(path, "compare"));
    folder::check(&target, path, &study)?;
    let version = ModelVersion::of(&study);
    let compared = fitting::fitted(&study, &data, &version, context, "compare")?;
    let result = comparison::Result {
        study: &study,
        name: &path.display().to_string(),
        data: &data,
        fit: &compared.fit,
        comparison: &compared.comparison,
    };
    let written = report::write_comparison(&result, &target)?;
    Ok(Outcome {
        json: comparison::document(&compared.comparison)?,
        text: comparison::summary(&result, &written.folder),
        success: true,
    })
}
