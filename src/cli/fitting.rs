//! Fits for commands: the study's measurements, a fit with its progress on standard error.

use super::progress::Progress;
use super::{CliError, Context};
use crate::learn::{CompareError, CompareStage, Compared, ModelVersion, compare};
use crate::measure::Dataset;
use crate::study::Study;

/// Fits a version of the study's model to the measurements, with a progress bar named `what`.
pub(super) fn fitted(
    study: &Study,
    data: &Dataset,
    version: &ModelVersion,
    context: &Context,
    what: &'static str,
) -> Result<Compared, CliError> {
    let progress = context.progress(what);
    Ok(compare(study, data, version, &|doing| {
        show(&progress, doing)
    })?)
}

/// Share of the time that members and tests take.
const PREPARING: f64 = 0.15;

/// Shows what a comparison is at.
pub(super) fn show(progress: &Progress, doing: CompareStage) {
    let (done, what) = state(doing);
    progress.show(done, what);
}

/// Shows what fitting one form of an effect is at.
pub(super) fn show_form(progress: &Progress, doing: CompareStage, form: &str) {
    let (done, what) = state(doing);
    progress.show(done, format!("form {form}: {what}"));
}

/// Shows what the comparison `number` (from 0) of `count` is at.
pub(super) fn show_one_of(progress: &Progress, doing: CompareStage, number: usize, count: usize) {
    let (done, what) = state(doing);
    let done = (number as f64 + done) / count.max(1) as f64;
    progress.show(done, format!("version {} of {count}: {what}", number + 1));
}

/// Share done, and what is being done.
pub(super) fn state(doing: CompareStage) -> (f64, String) {
    match doing {
        CompareStage::Members => (0.0, "meshing and condensing the members".to_owned()),
        CompareStage::Tests => (0.1, "preparing the tests".to_owned()),
        CompareStage::Fitting {
            histories,
            expected,
        } => {
            // the number of steps is not known before; the bar never claims to be at its end
            let share = (histories as f64 / expected.max(1) as f64).min(0.98);
            let done = PREPARING + (1.0 - PREPARING) * share;
            (done, format!("{histories} wear histories"))
        }
    }
}

impl From<CompareError> for CliError {
    fn from(error: CompareError) -> Self {
        match error {
            CompareError::Study(error) => error.into(),
            CompareError::Forward(error) => error.into(),
            CompareError::Fit(error) => CliError::Fit(error),
        }
    }
}
