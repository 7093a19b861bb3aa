//! A climb under way: diagnosis and step in turn, until none pays.

use super::kept::{Kept, State};
use super::pace::Pace;
use super::steps::{names, step};
use super::version::Fitter;
use crate::cli::progress::Progress;
use crate::cli::{CliError, Context, inputs};
use crate::learn::Measured;
use crate::learn::climb::Answer;
use crate::learn::diagnose::{Diagnosis, Fidelity, Verdict, diagnose};
use crate::report;
use crate::study::{self, Study};

/// Share of a step that its diagnosis takes; the fits take the rest.
const DIAGNOSED: f64 = 0.6;

/// What a climb goes up from, where its steps are kept, and who is told of them.
pub(super) struct Climb<'a> {
    pub(super) fitter: Fitter<'a>,
    pub(super) kept: &'a Kept,
    pub(super) context: &'a Context,
    pub(super) progress: Progress,
    pub(super) pace: Pace,
    /// Most effects to add.
    pub(super) most: usize,
}

impl<'a> Climb<'a> {
    /// Where an interrupted climb stood, if `resume` and there is one; else the study as it is, fitted.
    pub(super) fn begin(&self, resume: bool) -> Result<State, CliError> {
        let left = self.kept.read(resume)?;
        if resume && left.is_none() {
            self.context.tell(
                "note: no interrupted climb of this study is there to go on from; it begins anew",
            );
        }
        match left {
            Some(state) => Ok(state),
            None => State::first(&self.fitter, &|doing| self.show(0, 0.0, doing)),
        }
    }

    /// The first step by the finished diagnosis of the study, where there is one that names something.
    pub(super) fn by_finished_diagnosis(&self, state: &mut State) -> Result<(), CliError> {
        let Fitter { study, path, .. } = self.fitter;
        let finished = match state.steps.len() {
            1 => inputs::finished::<Answer>(path, study, fidelity(study) != Fidelity::Screening)?,
            _ => None,
        };
        // where it names nothing the last diagnosis has to be made anyway
        let names_some =
            |answer: &Answer| !matches!(answer.verdict, Verdict::NothingMissing | Verdict::Unknown);
        let Some(answer) = finished.filter(names_some) else {
            return Ok(());
        };
        self.context
            .tell("note: the first step goes by the finished diagnosis of this study");
        let watch = |doing| self.show(0, DIAGNOSED, doing);
        let none = step(state, &self.fitter, &answer, false, self.most, &watch)?;
        self.pace.step(false);
        if none.is_none() {
            self.kept.keep(state)?;
        } else {
            self.context
                .tell("note: nothing that it proposes pays; diagnosing anew");
            state.steps.truncate(1);
        }
        Ok(())
    }

    /// Diagnoses and steps up until no step is left; the last diagnosis, and why there is none.
    pub(super) fn to_the_top(&self, state: &mut State) -> Result<(Diagnosis, String), CliError> {
        loop {
            let rungs = state.rungs.len();
            let version = self.fitter.version(&state.rungs, &state.values)?;
            let diagnosis = diagnosis(&version, &self.fitter, &|done, what| {
                self.show(rungs, DIAGNOSED * done, what);
            })?;
            let watch = |doing| self.show(rungs, DIAGNOSED, doing);
            let answer = Answer::from(&diagnosis);
            let sure = diagnosis.is_sure_of_nothing();
            match step(state, &self.fitter, &answer, sure, self.most, &watch)? {
                None => {
                    self.pace.step(true);
                    self.kept.keep(state)?;
                    self.tell(state);
                }
                Some(stopped) => return Ok((diagnosis, stopped)),
            }
        }
    }

    /// Tells how the state stands, where no progress bar does.
    pub(super) fn tell(&self, state: &State) {
        if !self.progress.is_seen() {
            let step = state.standing.step(None, names(&state.rungs));
            self.context.tell(&report::climb::step_in_words(&step));
        }
    }

    /// Takes the progress bar away.
    pub(super) fn end(self) -> Fitter<'a> {
        self.fitter
    }

    /// Shows progress within the step above so many `rungs`, of which the share `done` is done.
    fn show(&self, rungs: usize, done: f64, what: String) {
        let stands = self.pace.at(rungs, done);
        self.progress.show(0.0, format!("{stands}: {what}"));
    }
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
