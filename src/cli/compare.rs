//! `gearwear compare`: the fitted model against the measurements.

use std::path::Path;

use clap::Args;

use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome, each, fitting, folder};
use crate::learn::{ModelVersion, contact_of};
use crate::report::{self, comparison};
use crate::study::Study;

/// Arguments of `compare`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear compare study.toml\n  gearwear compare study.toml -o results/base\n  gearwear compare study.toml --json --quiet | jq .holdout.chi2_per_point\n  gearwear compare --each archive"
)]
pub struct CompareArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// STUDY is a folder: compare every study in it (NAME.toml, NAME/study.toml), one table of all
    #[arg(long)]
    each: bool,
}

/// What the table of many studies says of each.
const COLUMNS: [each::Column; 6] = [
    ("points", |d| d["points"].clone()),
    ("chi2_per_point", |d| d["chi2_per_point"].clone()),
    ("fit_chi2_per_point", |d| d["fit"]["chi2_per_point"].clone()),
    ("holdout_chi2_per_point", |d| {
        d["holdout"]["chi2_per_point"].clone()
    }),
    ("rms_um", |d| d["rms_um"].clone()),
    ("parameters", |d| each::parameters(&d["parameters"])),
];

/// Checks the input and the folder, fits, writes.
pub(super) fn execute(args: &CompareArgs, context: &Context) -> Result<Outcome, CliError> {
    let path = &args.paths.study;
    if args.each {
        let output = args.paths.output.as_deref();
        return each::each(
            path,
            output,
            "compare",
            &COLUMNS,
            context,
            |study, target| one(study, target, context),
        );
    }
    let target =
        (args.paths.output.clone()).unwrap_or_else(|| folder::default_path(path, "compare"));
    one(path, &target, context)
}

/// Compares one study.
fn one(path: &Path, target: &Path, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(path)?;
    contact_of(&study)?;
    let data = study.dataset_to_fit()?;
    context.tell_reading(&data);
    let _reserved = folder::reserve(target, path, &study)?;
    let version = ModelVersion::of(&study);
    let compared = fitting::fitted(&study, &data, &version, context, "compare")?;
    let result = comparison::Result {
        study: &study,
        name: &path.display().to_string(),
        data: &data,
        fit: &compared.fit,
        comparison: &compared.comparison,
    };
    let written = report::write_comparison(&result, target)?;
    Ok(Outcome {
        json: comparison::document(&result)?,
        text: comparison::summary(&result, &written.folder),
        success: true,
    })
}
