//! `gearwear climb`: from a study up, one effect after the other.
//!
//! ```text
//! study -> fit -> diagnosis -> effect -> fit -> pays? -> … -> climbed study, ladder, last diagnosis
//! ```

mod alike;
mod kept;
mod version;

use self::kept::{Kept, State};
use self::version::{Fitter, Rung};
use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome, folder, inputs, interrupt};
use crate::learn::climb::{Answer, DoesNotPay, Proposal, proposal};
use crate::learn::diagnose::{Diagnosis, Fidelity, Verdict, diagnose};
use crate::learn::{Measured, contact_of};
use crate::report;
use crate::study::{self, Study};
use clap::Args;
use serde_json::json;

/// Arguments of `climb`.
#[derive(Debug, Args)]
#[command(
    after_help = "Diagnoses, adds the effect that the diagnosis names (of several that it cannot tell apart, the one that does best on tests that\nit was not fitted to), fits everything again, takes out what is no longer needed, and diagnoses again. A step is kept\nif it pays by evidence and on tests that it was not fitted to: the held-out ones or, where none is held out, each fit test left\nout in turn. The first step goes by the diagnosis in STUDYSTEM.out/diagnose if that is of the same study and measurements.\n\nExamples:\n  gearwear climb study.toml\n  gearwear climb study.toml --most 2 -o results/climb\n  gearwear climb study.toml --resume\n  gearwear climb study.toml --json --quiet | jq '.effects'"
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
    let left = kept.read(args.resume)?;
    if args.resume && left.is_none() {
        context.tell(
            "note: no interrupted climb of this study is there to go on from; it begins anew",
        );
    }
    let mut state = match left {
        Some(state) => state,
        None => State::first(&fitter, &|doing| show(0, 0.0, doing))?,
    };
    let finished = match state.steps.len() {
        1 => inputs::finished::<Answer>(path, &study, fidelity(&study) != Fidelity::Screening)?,
        _ => None,
    };
    // where it names nothing the last diagnosis has to be made anyway
    let names_some =
        |answer: &Answer| !matches!(answer.verdict, Verdict::NothingMissing | Verdict::Unknown);
    if let Some(answer) = finished.filter(names_some) {
        context.tell("note: the first step goes by the finished diagnosis of this study");
        let watch = |doing| show(0, 0.6, doing);
        if step(&mut state, &fitter, &answer, false, most, &watch)?.is_none() {
            kept.keep(&state)?;
        } else {
            context.tell("note: nothing that it proposes pays; diagnosing anew");
            state.steps.truncate(1);
        }
    }
    let tell = |state: &State| {
        if !progress.is_seen() {
            let step = state.standing.step(None, names(&state.rungs));
            context.tell(&report::climb::step_in_words(&step));
        }
    };
    tell(&state);
    let (diagnosis, stopped) = loop {
        let rungs = state.rungs.len();
        let version = fitter.version(&state.rungs, &state.values)?;
        let diagnosis = diagnosis(&version, &fitter, &|done, what| {
            show(rungs, 0.6 * done, what);
        })?;
        let watch = |doing| show(rungs, 0.6, doing);
        let answer = Answer::from(&diagnosis);
        let sure = diagnosis.is_sure_of_nothing();
        match step(&mut state, &fitter, &answer, sure, most, &watch)? {
            None => {
                kept.keep(&state)?;
                tell(&state);
            }
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

/// What is missing of a version, by coarse elements for what effects change.
fn diagnosis(
    version: &Study,
    fitter: &Fitter<'_>,
    watch: &(dyn Fn(f64, String) + Sync),
) -> Result<Diagnosis, CliError> {
    let measured = Measured::new(version, fitter.data.clone());
    Ok(diagnose(&measured, fidelity(version), watch)?)
}

fn fidelity(study: &Study) -> Fidelity {
    match study.contact {
        study::ContactKind::Hertz => Fidelity::Screening,
        study::ContactKind::Fem | study::ContactKind::Paper => Fidelity::Middle,
    }
}

/// One step up if one pays; else why there is none. `is_sure`: a verdict that nothing is missing is no mere guess.
fn step(
    state: &mut State,
    fitter: &Fitter<'_>,
    answer: &Answer,
    is_sure: bool,
    most: usize,
    watch: &(dyn Fn(String) + Sync),
) -> Result<Option<String>, CliError> {
    match answer.verdict {
        Verdict::NothingMissing if is_sure => {
            return Ok(Some("nothing more is missing".to_owned()));
        }
        Verdict::NothingMissing => {
            return Ok(Some("no further effect is established".to_owned()));
        }
        Verdict::Unknown => {
            return Ok(Some(
                "what remains is nothing that the catalogue holds".to_owned(),
            ));
        }
        Verdict::Effect | Verdict::Effects | Verdict::Partial | Verdict::Ambiguous => {}
    }
    if state.rungs.len() >= most {
        let stopped = format!("--most {most} allows no more; something is still missing");
        return Ok(Some(stopped));
    }
    let (mut effects, alike) = match proposal(answer) {
        Proposal::InTurn(effects) => (effects, false),
        Proposal::BestOf(effects) => (effects, true),
    };
    effects.retain(|effect| !state.has(effect));
    // without a test that it is not fitted to, the most probable goes first
    if alike && effects.len() > 1 && state.standing.error().is_some() {
        if alike::best_of(&effects, state, fitter, answer, watch)? {
            return Ok(None);
        }
        effects.clear();
    }
    for effect in effects {
        let added = fitter.with_effect(&state.rungs, &state.values, &effect, answer, watch)?;
        let paid = added.standing.pays_over(&state.standing);
        let mut step = added
            .standing
            .step(Some(&state.standing), names(&added.rungs));
        step.added = Some(effect);
        refused(&mut step, paid);
        let kept = step.kept;
        state.steps.push(step);
        if kept {
            state.go_on(added);
            drop_needless(state, fitter, watch)?;
            return Ok(None);
        }
    }
    Ok(Some(
        "no effect that the diagnosis proposes pays".to_owned(),
    ))
}

/// Takes out effects, the newest excepted, without which the version stands as well.
fn drop_needless(
    state: &mut State,
    fitter: &Fitter<'_>,
    watch: &(dyn Fn(String) + Sync),
) -> Result<(), CliError> {
    let mut place = 0;
    while place + 1 < state.rungs.len() {
        let mut rungs = state.rungs.clone();
        let removed = rungs.remove(place);
        let without = fitter.fit(rungs, &state.values, &|doing| {
            watch(format!("without {}: {doing}", removed.effect));
        })?;
        if state.standing.pays_over(&without.standing).is_ok() {
            place += 1;
            continue;
        }
        let mut step = (without.standing).step(Some(&state.standing), names(&without.rungs));
        step.removed = Some(removed.effect);
        state.steps.push(step);
        state.go_on(without);
    }
    Ok(())
}

fn refused(step: &mut crate::learn::climb::ClimbStep, paid: Result<(), DoesNotPay>) {
    if let Err(why) = paid {
        step.kept = false;
        step.why = Some(why.to_string());
    }
}

fn names(rungs: &[Rung]) -> Vec<String> {
    rungs.iter().map(|rung| rung.effect.clone()).collect()
}
