//! The base model's fit.

use super::context::Context;
use super::high_fidelity::DECIDE;
use crate::learn::candidates::candidate_model::{model, offset, predictions};
use crate::learn::candidates::fitted_candidate::BaseFit;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::prediction::predictor::PredictError;

impl Context<'_> {
    /// Fits the base model.
    pub(in crate::learn) fn base(&self, candidate: Candidate) -> Result<BaseFit, PredictError> {
        let likelihood = &self.likelihood;
        let parameters = &candidate.parameters;
        let start: Vec<f64> = parameters.iter().map(|p| p.start).collect();
        let start = likelihood.state(parameters, &start);
        let predictor = model(self.middle, &candidate);
        let found = likelihood.fit(&predictor, parameters, start, &DECIDE)?;
        let fitted = self.decide(&candidate, found.state, None, f64::INFINITY)?;
        let state = &fitted.found.state;
        let of = |bench| predictions(likelihood, &model(bench, &candidate), &candidate, state);
        let hertz_offset = offset(likelihood, &of(self.exact)?, &of(self.hertz)?);
        Ok(BaseFit::new(likelihood, fitted, hertz_offset))
    }
}
