//! `gearwear models`: the finite-element, Hertz and published models side by side.

use clap::Args;

use super::args::StudyAndOutput;
use super::folder;
use super::progress::Progress;
use super::{CliError, Context, Outcome};
use crate::report;
use crate::simulate::models::{Comparison, Task, compare};
use crate::study::Study;

/// Arguments of `models`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear models study.toml\n  gearwear models study.toml --misalignment 0,0.5,1\n  gearwear models study.toml -o results/models --json"
)]
pub struct ModelsArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// Radial misalignments, mm, at which to compare beside the study's own; of the published pair its paper has results at 0, 0.5 and 1
    #[arg(long, value_name = "MM", value_delimiter = ',')]
    misalignment: Vec<f64>,
}

/// Checks the input and the folder, runs all three models, writes.
pub(super) fn execute(args: &ModelsArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    study.one_section("models")?;
    study.teeth_alike("models")?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "models"));
    let _reserved = folder::reserve(&target, &args.paths.study, &study)?;
    if let Some(bad) = args
        .misalignment
        .iter()
        .find(|m| !(m.is_finite() && **m >= 0.0))
    {
        return Err(CliError::Unusable(format!(
            "--misalignment {bad}: it is added to the centre distance, 0 mm or more"
        )));
    }
    let comparison = compare_models(&study, &args.misalignment, &context.progress("models"))?;
    let written = report::write_models(&study.title, &comparison, &target)?;
    Ok(Outcome {
        json: report::models::document(&study.title, &comparison),
        text: report::models::summary(&study.title, &comparison, &written.folder),
        success: true,
    })
}

/// The models at the study's own misalignment and at those asked for.
fn compare_models(
    study: &Study,
    asked: &[f64],
    progress: &Progress,
) -> Result<Comparison, CliError> {
    let mut misalignments = asked.to_vec();
    misalignments.push(study.operation.misalignment_mm);
    misalignments.sort_by(f64::total_cmp);
    misalignments.dedup();
    let mut own = [None, None];
    for (slot, (member, path)) in own.iter_mut().zip(study.own_meshes()) {
        if let Some(path) = path {
            *slot = Some(super::mesh::read_own(study, member, path)?);
        }
    }
    let task = Task {
        set: &study.gear_set(),
        conditions: study.operation.simulated(&study.wear_at(&study.operation)),
        numerics: study.resolution(),
        misalignments: &misalignments,
        own,
    };
    let watch = |done: f64, doing: &'static str| progress.show(done, doing.to_owned());
    Ok(compare(task, &watch)?)
}
