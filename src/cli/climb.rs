//! `gearwear climb`: from a study up, one effect after the other.
//!
//! ```text
//! study -> fit -> diagnosis -> effect -> fit -> pays? -> … -> climbed study, ladder, last diagnosis
//! ```

mod curve;
mod kept;
mod version;

use self::kept::{Kept, State};
use self::version::{Fitted, Fitter, Laws, Rung};
use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome, folder, inputs, interrupt};
use crate::learn::climb::{Standing, proposals};
use crate::learn::diagnose::{Diagnosis, Fidelity, Verdict, diagnose};
use crate::learn::{Measured, contact_of};
use crate::report;
use crate::study::{self, Study};
use clap::Args;

/// Arguments of `climb`.
#[derive(Debug, Args)]
#[command(
    after_help = "Diagnoses, adds the effect that the diagnosis names, or the law of one driver that it has learned where the catalogue holds\nnothing better, fits everything again, takes out what is no longer needed, and diagnoses again. A step is kept if it pays by evidence and on tests that it was not fitted to: the held-out ones or, where none is\nheld out, each fit test left out in turn.\n\nExamples:\n  gearwear climb study.toml\n  gearwear climb study.toml --most 2 -o results/climb\n  gearwear climb study.toml --resume\n  gearwear climb study.toml --json --quiet | jq '.effects'"
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
    folder::check(&target, path, &study)?;
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
    let progress = context.progress("climb");
    let most = usize::from(args.most);
    let show = |rungs: usize, done: f64, what: String| {
        let share = (rungs as f64 + done.min(1.0)) / (most as f64 + 1.0);
        progress.show(share, what);
    };
    let fitter = Fitter {
        study: &study,
        path,
        data: &data,
    };
    let mut state = match kept.read(args.resume)? {
        Some(state) => state,
        None => State::first(&fitter, &|doing| show(0, 0.0, doing))?,
    };
    let (diagnosis, stopped) = loop {
        let rungs = state.rungs.len();
        let version = fitter.version(&state.rungs, &state.values, Laws::Fixed)?;
        let diagnosis = diagnosis(&version, &fitter, &|done, what| {
            show(rungs, 0.6 * done, what);
        })?;
        let watch = |doing| show(rungs, 0.6, doing);
        match step(&mut state, &fitter, &diagnosis, most, &watch)? {
            None => kept.keep(&state)?,
            Some(stopped) => break (diagnosis, stopped),
        }
    };
    drop(progress);
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
            report::json::text("diagnosis.json", &diagnosis)?,
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

/// What is missing of a version, by coarse elements for what effects change.
fn diagnosis(
    version: &Study,
    fitter: &Fitter<'_>,
    watch: &(dyn Fn(f64, String) + Sync),
) -> Result<Diagnosis, CliError> {
    let fidelity = match version.contact {
        study::ContactKind::Hertz => Fidelity::Screening,
        study::ContactKind::Fem | study::ContactKind::Paper => Fidelity::Middle,
    };
    let measured = Measured::new(version, fitter.data.clone());
    Ok(diagnose(&measured, fidelity, watch)?)
}

/// One step up if one pays; else why there is none.
fn step(
    state: &mut State,
    fitter: &Fitter<'_>,
    diagnosis: &Diagnosis,
    most: usize,
    watch: &(dyn Fn(String) + Sync),
) -> Result<Option<String>, CliError> {
    if diagnosis.verdict == Verdict::NothingMissing {
        return Ok(Some("nothing more is missing".to_owned()));
    }
    let mut added = false;
    for effect in proposals(diagnosis) {
        if state.has(&effect) || state.rungs.len() >= most {
            continue;
        }
        let fitted = fitter.with_effect(&state.rungs, &state.values, &effect, watch)?;
        let kept = try_step(state, fitted, effect);
        added |= kept;
        // of a set that is named as one the others are tried at once; of what cannot be told apart one is enough
        if kept && diagnosis.verdict != Verdict::Effects {
            break;
        }
    }
    if let Some(law) = (diagnosis.learned.as_ref()).filter(|law| !added && !state.has(&law.name))
        && state.rungs.len() < most
    {
        let fitted = fitter.with_law(&state.rungs, &state.values, law, watch)?;
        added = try_step(state, fitted, law.name.clone());
    }
    if added {
        drop_needless(state, fitter, watch)?;
        return Ok(None);
    }
    Ok(Some(if state.rungs.len() >= most {
        format!("--most {most} allows no more; something is still missing")
    } else if diagnosis.verdict == Verdict::Unknown && diagnosis.learned.is_none() {
        "what remains is nothing that the catalogue holds, and no law of one driver is worth its freedom"
            .to_owned()
    } else {
        "nothing that the diagnosis proposes pays".to_owned()
    }))
}

/// Goes on from a version with one effect more if it pays.
fn try_step(state: &mut State, fitted: Fitted, added: String) -> bool {
    let mut told = (fitted.standing).step(Some(&state.standing), names(&fitted.rungs));
    told.added = Some(added);
    if let Err(why) = fitted.standing.pays_over(&state.standing) {
        told.kept = false;
        told.why = Some(why.to_string());
    }
    let kept = told.kept;
    state.steps.push(told);
    if kept {
        state.go_on(fitted);
    }
    kept
}

/// Takes out effects, the newest excepted, without which the evidence is as good.
fn drop_needless(
    state: &mut State,
    fitter: &Fitter<'_>,
    watch: &(dyn Fn(String) + Sync),
) -> Result<(), CliError> {
    let mut place = 0;
    while place + 1 < state.rungs.len() {
        let mut rungs = state.rungs.clone();
        let removed = rungs.remove(place);
        let watch = |doing| watch(format!("without {}: {doing}", removed.effect));
        let without = fitter.compared(&rungs, &state.values, &watch)?;
        if (state.standing).is_needed_beside(&Standing::new(&without, None)) {
            place += 1;
            continue;
        }
        let without = fitter.judged(rungs, without, &watch)?;
        let mut told = (without.standing).step(Some(&state.standing), names(&without.rungs));
        told.removed = Some(removed.effect);
        state.steps.push(told);
        state.go_on(without);
    }
    Ok(())
}

fn names(rungs: &[Rung]) -> Vec<String> {
    rungs.iter().map(|rung| rung.effect.clone()).collect()
}
