//! `gearwear climb`: from a study up, one effect after the other.
//!
//! ```text
//! study -> fit -> diagnosis -> effect -> fit -> pays? -> … -> climbed study, ladder, last diagnosis
//! ```

mod alike;
mod ascent;
mod kept;
mod pace;
mod steps;
mod version;

use self::ascent::Climb;
use self::kept::Kept;
use self::version::Fitter;
use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome, folder, inputs, interrupt};
use crate::learn::contact_of;
use crate::learn::diagnose::Diagnosis;
use crate::report;
use crate::study::Study;
use clap::Args;
use serde_json::json;

/// Arguments of `climb`.
#[derive(Debug, Args)]
#[command(
    after_help = "Diagnoses, adds the effect that the diagnosis names (of several that it cannot tell apart, the one that does best by evidence and the error on tests that it was not fitted to combined), fits everything again, takes out what is no longer needed, and diagnoses again. A step is kept if it pays by evidence and on tests that it was not fitted to: the held-out ones or, where none is held out, each fit test left out in turn. The first step goes by the diagnosis in STUDYSTEM.out/diagnose if that is of the same study and measurements.\n\nExamples:\n  gearwear climb study.toml\n  gearwear climb study.toml --most 2 -o results/climb\n  gearwear climb study.toml --resume\n  gearwear climb study.toml --json --quiet | jq '.effects'"
)]
pub struct ClimbArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// Most effects to add
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=8))]
    most: u8,
    /// Go on from the last step of an interrupted climb
    #[arg(long)]
    resume: bool,
}

/// Checks the input and the folder, climbs, writes.
pub(super) fn execute(args: &ClimbArgs, context: &Context) -> Result<Outcome, CliError> {
    let path = &args.paths.study;
    let study = Study::load(path)?;
    contact_of(&study)?;
    let data = study.dataset_to_fit()?;
    context.tell_reading(&data);
    let default = || folder::default_path(path, "climb");
    let target = args.paths.output.clone().unwrap_or_else(default);
    let _reserved = folder::reserve(&target, path, &study)?;
    let kept = Kept::new(&target, inputs::identity(&study)?);
    let again = (args.paths.output.as_ref()).map(|target| format!(" -o {}", target.display()));
    interrupt::tells(
        kept.path().to_owned(),
        format!(
            "gearwear climb {}{} --resume goes on",
            path.display(),
            again.unwrap_or_default()
        ),
    );
    let climb = Climb {
        fitter: Fitter {
            study: &study,
            path,
            data: &data,
        },
        kept: &kept,
        context,
        progress: context.progress("climb").without_end(),
        pace: pace::Pace::new(usize::from(args.most)),
        most: usize::from(args.most),
    };
    let mut state = climb.begin(args.resume)?;
    climb.by_finished_diagnosis(&mut state)?;
    climb.tell(&state);
    let (diagnosis, stopped) = climb.to_the_top(&mut state)?;
    let fitter = climb.end();
    let climbed = fitter.moved(&state.rungs, &state.values, &target)?;
    let result = report::climb::Result {
        title: &study.title,
        steps: &state.steps,
        versions: &state.versions,
        effects: state
            .rungs
            .iter()
            .map(|rung| rung.effect.as_str())
            .collect(),
        diagnosis: &diagnosis,
        stopped: &stopped,
    };
    let document = report::climb::document(&result);
    let shown = target.join("climbed.toml").display().to_string();
    let page = report::climb::page(&result, &shown);
    let further = [
        ("climbed.toml", climbed.text().as_bytes().to_vec()),
        (
            "diagnosis.json",
            last_diagnosis(&diagnosis, inputs::identity_of(climbed.text(), &study)?)?,
        ),
    ];
    let written = report::write_page_with(&page, "climb.json", &document, &further, &target)?;
    kept.discard();
    Ok(Outcome {
        json: document,
        text: report::climb::summary(&result, &shown, &written.folder),
        success: true,
    })
}

/// The document of the last diagnosis, by which `plan` goes on from the climbed study.
fn last_diagnosis(diagnosis: &Diagnosis, identity: String) -> Result<Vec<u8>, CliError> {
    let mut document = json!(diagnosis);
    document[inputs::KEY] = json!(identity);
    Ok(report::json::text("diagnosis.json", &document)?)
}
