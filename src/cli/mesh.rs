//! `gearwear mesh`: the meshes of both members and their quality, without a run.

use std::path::Path;

use clap::Args;

use super::args::StudyAndOutput;
use super::folder::{self, ResultFolder};
use super::progress::Progress;
use super::{CliError, Context, Outcome};
use crate::study::Study;

/// Arguments of `mesh`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear mesh study.toml\n  gearwear mesh study.toml -o meshes --json"
)]
pub struct MeshArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
}

/// Checks the input, prepares the folder, and leaves the work to [`make_meshes`].
pub(super) fn execute(args: &MeshArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "mesh"));
    let folder = ResultFolder::fresh(&target)?;
    make_meshes(&study, folder.path(), &context.progress("mesh"))?.in_folder(folder)
}

/// Meshes both members (or reads the study's own meshes), writes them into `folder` and reports nodes, elements, smallest
/// angle and flank spacing; the outcome's JSON has the `mesh` block of `summary.json` for each member.
fn make_meshes(_study: &Study, _folder: &Path, _progress: &Progress) -> Result<Outcome, CliError> {
    Err(CliError::NotBuilt { command: "mesh" })
}
