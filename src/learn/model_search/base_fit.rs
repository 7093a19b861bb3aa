//! The base model's fit.

use super::context::Context;
use super::high_fidelity::DECIDE;
use crate::learn::candidates::candidate_model::{Anchored, model, offset, predictions};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::checks::common_scatter::shared_scatter;
use crate::learn::checks::noise_level;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::search::Effort;
use crate::learn::prediction::predictor::{PredictError, Predictor};
use crate::study::Role;

impl Context<'_> {
    /// Fits the base model, once more where the scatter about it calls for another σ than the stated one or for that of a new profile; the
    /// likelihood then has them.
    pub(in crate::learn) fn base_by_scatter(&mut self) -> Result<BaseFit, PredictError> {
        let measured = self.likelihood.measured;
        let candidate = || Candidate::base(measured.study());
        let base = self.base(candidate())?;
        let model = &base.fitted.found.model;
        let stated = self.likelihood.noise;
        let mut noise = stated;
        if noise.new_profile_um == 0.0
            && let Some(new_profile_um) = shared_scatter(&self.likelihood, model)
        {
            noise.new_profile_um = new_profile_um;
            self.likelihood = Likelihood::new(measured, noise, Role::Fit);
        }
        noise.sigma = noise_level::sigma_model(&self.likelihood, model);
        if noise == stated {
            return Ok(base);
        }
        self.likelihood = Likelihood::new(measured, noise, Role::Fit);
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
        self.anchored(fitted, &model(self.exact, &candidate))
    }

    /// A fit of the base model, to which the analytic model is brought in its state; `by`: what it was fitted by.
    pub(super) fn anchored(
        &self,
        fitted: FittedCandidate,
        by: &dyn Predictor,
    ) -> Result<BaseFit, PredictError> {
        let (hertz_offset, screened_evidence) = self.analytic_anchor(&fitted, by)?;
        Ok(BaseFit::new(
            &self.likelihood,
            fitted,
            hertz_offset,
            screened_evidence,
        ))
    }

    /// What `by` and the analytic model differ by at a fit, per test of the data set; and the fit's log evidence by the analytic model so moved.
    fn analytic_anchor(
        &self,
        fitted: &FittedCandidate,
        by: &dyn Predictor,
    ) -> Result<(Vec<Vec<f64>>, f64), PredictError> {
        let likelihood = &self.likelihood;
        let (candidate, state) = (&fitted.candidate, &fitted.found.state);
        let of = |predictor: &dyn Predictor| predictions(likelihood, predictor, candidate, state);
        let hertz_offset = offset(likelihood, &of(by)?, &of(&model(self.hertz, candidate))?);
        let anchored = Anchored::new(model(self.hertz, candidate), hertz_offset.clone());
        let parameters = &candidate.parameters;
        let screened = likelihood.fit(&anchored, parameters, state.clone(), &Effort::STAY)?;
        let (screened_evidence, _) = likelihood.evidence(&screened, parameters, None);
        Ok((hertz_offset, screened_evidence))
    }
}
