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
    after_help = "Examples:\n  gearwear models study.toml\n  gearwear models study.toml -o results/models --json"
)]
pub struct ModelsArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
}

/// Checks the input and the folder, runs all three models, writes.
pub(super) fn execute(args: &ModelsArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "models"));
    folder::check(&target, &args.paths.study, &study)?;
    let comparison = compare_models(&study, &context.progress("models"))?;
    let written = report::write_models(&study.title, &comparison, &target)?;
    Ok(Outcome {
        json: report::models::document(&study.title, &comparison),
        text: report::models::summary(&study.title, &comparison, &written.folder),
        success: true,
    })
}

/// Radial misalignments at which the paper states results, mm.
const PUBLISHED: [f64; 3] = [0.0, 0.5, 1.0];

/// The models at the paper's misalignments and the study's own.
fn compare_models(study: &Study, progress: &Progress) -> Result<Comparison, CliError> {
    let mut misalignments = PUBLISHED.to_vec();
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
        conditions: study.operation.simulated(&study.wear),
        numerics: study.resolution(),
        misalignments: &misalignments,
        own,
    };
    let watch = |done: f64, doing: &'static str| progress.show(done, doing.to_owned());
    Ok(compare(task, &watch)?)
}
