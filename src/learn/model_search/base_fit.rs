//! The base model's fit.

use super::context::Context;
use super::high_fidelity::DECIDE;
use crate::learn::candidates::candidate_model::{Anchored, model, offset, predictions};
use crate::learn::candidates::fitted_candidate::BaseFit;
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::checks::noise_level;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::search::Effort;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::predictor::PredictError;
use crate::study::Role;

impl Context<'_> {
    /// Fits the base model, once more where the scatter about it calls for another σ than the stated one; the likelihood then has that.
    pub(in crate::learn) fn base_by_scatter(&mut self) -> Result<BaseFit, PredictError> {
        let measured = self.likelihood.measured;
        let candidate = || Candidate::base(measured.study());
        let base = self.base(candidate())?;
        let sigma = noise_level::sigma_model(&self.likelihood, &base.fitted.found.model);
        let noise = self.likelihood.noise;
        if sigma == noise.sigma {
            return Ok(base);
        }
        self.likelihood = Likelihood::new(measured, NoiseModel { sigma, ..noise }, Role::Fit);
        self.base(candidate())
    }

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
        let anchored = Anchored::new(model(self.hertz, &candidate), hertz_offset.clone());
        let screened = likelihood.fit(&anchored, parameters, state.clone(), &Effort::STAY)?;
        let (screened_evidence, _) = likelihood.evidence(&screened, parameters, None);
        Ok(BaseFit::new(
            likelihood,
            fitted,
            hertz_offset,
            screened_evidence,
        ))
    }
}
