//! What a search works with: the likelihood, and the model at three fidelities.

use super::stages::Stages;
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::fidelity::Fidelity;
use crate::learn::prediction::predictor::PredictError;
use crate::simulate::forward::ForwardError;

/// Why there is no diagnosis.
#[derive(Debug, thiserror::Error)]
pub enum DiagnoseError {
    /// No test with role fit has a measurement.
    #[error("no test with role \"fit\" has a measurement")]
    NoObservations,
    /// The gears cannot run.
    #[error(transparent)]
    Forward(#[from] ForwardError),
    /// The base model has no answer.
    #[error("the base model cannot be fitted: {0}")]
    BaseFit(#[from] PredictError),
}

/// What is judged on, and the benches: the analytic one to screen, coarse finite elements for changes, the exact one that decides.
pub(in crate::learn) struct Context<'a> {
    pub(in crate::learn) likelihood: Likelihood<'a>,
    pub(in crate::learn) hertz: &'a Bench<'a>,
    pub(in crate::learn) middle: &'a Bench<'a>,
    pub(in crate::learn) exact: &'a Bench<'a>,
    /// Told of every fit.
    pub(in crate::learn) stages: &'a Stages<'a>,
    /// By which candidates are compared at last.
    pub(in crate::learn) fidelity: Fidelity,
    /// Whether that is the analytic model in place of the study's finite elements.
    pub(in crate::learn) approximate: bool,
}
