//! What all candidates are judged on: the fit tests' observations with one covariance, and the search for a fit on them.

use std::ops::Deref;

use nalgebra::DMatrix;

use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::parameters::Parameter;
use crate::learn::hypothesis::version::parameter;
use crate::learn::inference::quadratic::{Layout, Normal, Quadratic, State};
use crate::learn::inference::scatter::marginal;
use crate::learn::inference::search::{Effort, Search, SearchEnd};
use crate::learn::inference::selection::Selection;
use crate::learn::noise::{Covariance, Discrepancy, ModelError, NoiseModel};
use crate::learn::prediction::predictor::{PredictError, Predictor};
use crate::measure::{FacePlace, Observation, Quantity};
use crate::study::{Role, Scatter, WEAR_COEFFICIENT};

/// How far an effect's own contribution may differ from its formula, relative: nature does not use our formulas.
///
/// ```text
/// K_ij = r² Δ_i Δ_j exp(−(s_i − s_j)²/(2 l²)) exp(−(ln(n_i/n_j))²/(2 g²))      Δ: what the effect changes after refitting
/// ```
/// A misfit of r² of the χ² that an effect explains then counts as noise: 0.36 %, within the 0.2 to 0.5 % that effects of
/// another form than the fitted one showed.
pub(in crate::learn) const OWN_FORM: ModelError = ModelError {
    relative: 0.06,
    along: 0.3,
    over_cycles: 1.0,
};

/// Standard deviations of χ² beyond its expectation from which rows count as missed.
const MISSED: f64 = 3.0;

/// Observations of the tests with one role, what they carry beyond a model, and the wear coefficient that all candidates share.
pub(in crate::learn) struct Likelihood<'a> {
    pub(in crate::learn) measured: &'a Measured<'a>,
    pub(in crate::learn) noise: NoiseModel,
    selection: Selection<'a>,
    /// What is integrated out with the noise.
    discrepancy: Option<Discrepancy>,
    coefficient: Option<Parameter>,
    fixed_log_k: f64,
}

impl<'a> Deref for Likelihood<'a> {
    type Target = Selection<'a>;

    fn deref(&self) -> &Selection<'a> {
        &self.selection
    }
}

impl<'a> Likelihood<'a> {
    /// Of the tests with `role`; nothing common to all tests is fitted to held-out ones.
    pub(in crate::learn) fn new(measured: &'a Measured<'a>, noise: NoiseModel, role: Role) -> Self {
        let study = measured.study();
        let free = study.free().iter().find(|f| f.name == WEAR_COEFFICIENT);
        Self {
            selection: Selection::new(&measured.data, &measured.roles, role, &noise),
            discrepancy: None,
            coefficient: free.filter(|_| role == Role::Fit).map(parameter),
            fixed_log_k: study.wear.coefficient.ln(),
            measured,
            noise,
        }
    }

    /// The state with the study's wear coefficient and these parameters.
    pub(in crate::learn) fn state(&self, parameters: &[Parameter], values: &[f64]) -> State {
        State {
            log_k: self
                .coefficient
                .as_ref()
                .map_or(self.fixed_log_k, |p| p.natural_start(p.start)),
            theta: parameters
                .iter()
                .zip(values)
                .map(|(p, &x)| p.natural_start(x))
                .collect(),
            epsilon: vec![0.0; self.tests.len()],
        }
    }

    /// Arguments of every test's prediction at a state.
    pub(in crate::learn) fn arguments(
        &self,
        parameters: &[Parameter],
        state: &State,
    ) -> (Vec<f64>, Vec<f64>) {
        let k = state.epsilon.iter().map(|e| (state.log_k + e).exp());
        let theta = parameters.iter().zip(&state.theta);
        (k.collect(), theta.map(|(p, &x)| p.value(x)).collect())
    }

    /// The most probable state from `start`, every common parameter held on held-out tests.
    pub(in crate::learn) fn fit(
        &self,
        predictor: &dyn Predictor,
        parameters: &[Parameter],
        start: State,
        effort: &Effort,
    ) -> Result<SearchEnd, PredictError> {
        let mut evaluator = self.evaluator(predictor);
        self.search(parameters).run(&mut evaluator, start, effort)
    }

    /// Where one full step leads from where a fit ended.
    pub(in crate::learn) fn next_state(
        &self,
        found: &SearchEnd,
        parameters: &[Parameter],
    ) -> State {
        let layout = self.layout(parameters);
        let quadratic = Quadratic::new(&layout, &found.normal, &found.state, found.scatter);
        layout.moved(&found.state, &quadratic.step(0.0).x, found.scatter)
    }

    /// How far two states are apart in the priors' scales (for ln k: 1), in the unknown that differs most.
    pub(in crate::learn) fn distance(&self, parameters: &[Parameter], a: &State, b: &State) -> f64 {
        self.search(parameters).distance(a, b)
    }

    /// Lets a model that keeps its histories take them with their derivatives, which bring the predictions along.
    pub(in crate::learn) fn prepare(
        &self,
        model: &dyn Predictor,
        parameters: &[Parameter],
        state: &State,
    ) {
        self.search(parameters)
            .own(&mut self.evaluator(model), state);
    }

    /// Each test's own coefficient at a given scatter; everything common to the tests is held. For held-out tests.
    pub(in crate::learn) fn fit_held(
        &self,
        predictor: &dyn Predictor,
        parameters: &[Parameter],
        state: State,
        scatter: f64,
        effort: &Effort,
    ) -> Result<SearchEnd, PredictError> {
        let mut search = self.search(parameters);
        search.coefficient = None;
        search.layout.coefficient = None;
        search.layout.parameters.clear();
        search.scatter = Scatter::Relative(scatter);
        search.run(&mut self.evaluator(predictor), state, effort)
    }

    fn search<'s>(&'s self, parameters: &'s [Parameter]) -> Search<'s> {
        Search {
            selection: &self.selection,
            layout: self.layout(parameters),
            coefficient: self.coefficient.as_ref(),
            parameters,
            scatter: self.noise.scatter,
        }
    }

    fn layout(&self, parameters: &[Parameter]) -> Layout {
        Layout {
            coefficient: self.coefficient.as_ref().map(Parameter::natural_prior),
            parameters: parameters.iter().map(Parameter::natural_prior).collect(),
            tests: self.tests.len(),
        }
    }

    /// Whether another k would do more than scale all rows: something is measured that is no wear, or wear meets a changed contact.
    pub(in crate::learn) fn k_does_more_than_scale(&self, contact_changes: bool) -> bool {
        self.coefficient.is_some() && (contact_changes || self.others() > 0)
    }

    /// Whether all that is measured at places of a flank says where across the face, so that no form of an effect has to.
    pub(in crate::learn) fn states_places_across_the_face(&self) -> bool {
        let all = &self.measured.data.observations;
        let across = |o: &&Observation| {
            matches!(o.quantity, Quantity::WearDepth | Quantity::ContactPressure)
        };
        let mut of_flanks = all.iter().filter(across);
        of_flanks.all(|o| o.face.is_some())
    }

    /// Whether anything is measured at a stated place of the face off its middle: a small lead is felt there in its first order.
    pub(in crate::learn) fn states_places_off_mid_face(&self) -> bool {
        let mut faces = (self.measured.data.observations.iter()).filter_map(|o| o.face);
        faces.any(|face| matches!(face, FacePlace::At(place) if place != 0.0))
    }

    /// Whether what is measured besides wear is missed by more than its noise.
    pub(in crate::learn) fn misses_more_than_wear(&self, model: &[f64]) -> bool {
        let rows = self.others() as f64;
        self.square_of_others(model) > rows + MISSED * (2.0 * rows).sqrt()
    }

    /// The factor that brings all wear of the model to the size of what was measured.
    pub(in crate::learn) fn wear_scale(&self, model: &[f64]) -> f64 {
        let factor = self.wear_ratio(model);
        if factor.is_finite() {
            factor.clamp(0.01, 100.0)
        } else {
            1.0
        }
    }

    /// Model values with all wear scaled to the size of what was measured, as another k would.
    pub(in crate::learn) fn rescaled(&self, model: &[f64]) -> Vec<f64> {
        self.scaled(model, self.wear_scale(model))
    }

    /// Logarithm of the marginal likelihood about a fit, and the covariance of (ln k, θ); with `change`, the effect's own
    /// contribution to every row, its form is uncertain.
    pub(in crate::learn) fn evidence(
        &self,
        found: &SearchEnd,
        parameters: &[Parameter],
        change: Option<&[f64]>,
    ) -> (f64, DMatrix<f64>) {
        self.evidence_with(found, parameters, change.map(|c| (c, OWN_FORM)))
    }

    /// As [`Self::evidence`] with any correlated error.
    pub(in crate::learn) fn evidence_with(
        &self,
        found: &SearchEnd,
        parameters: &[Parameter],
        error: Option<(&[f64], ModelError)>,
    ) -> (f64, DMatrix<f64>) {
        match error {
            None => self.evidence_of(found, parameters, &self.covariance, &found.normal),
            Some(error) => self.evidence_in(&self.covariance_with(&[error]), found, parameters),
        }
    }

    /// The covariance with further correlated errors, each with its amplitude at every row.
    pub(in crate::learn) fn covariance_with(&self, errors: &[(&[f64], ModelError)]) -> Covariance {
        let mut errors = errors.to_vec();
        if let Some(Discrepancy::EachCurve(size, error)) = &self.discrepancy {
            errors.push((size, *error));
        }
        let covariance =
            Covariance::with_errors(&self.measured.data, &self.numbers, &self.noise, &errors);
        match &self.discrepancy {
            Some(Discrepancy::Shared(functions)) => covariance.with_shared(functions),
            _ => covariance,
        }
    }

    /// The same observations with a discrepancy beside every model.
    pub(in crate::learn) fn beside(&self, discrepancy: Discrepancy) -> Self {
        let mut beside = Self {
            selection: self.selection.clone(),
            discrepancy: Some(discrepancy),
            coefficient: self.coefficient.clone(),
            ..*self
        };
        let covariance = beside.covariance_with(&[]);
        beside.selection = beside.selection.with_covariance(covariance);
        beside
    }

    /// As [`Self::evidence`] with any covariance, linearised about the fit.
    pub(in crate::learn) fn evidence_in(
        &self,
        covariance: &Covariance,
        found: &SearchEnd,
        parameters: &[Parameter],
    ) -> (f64, DMatrix<f64>) {
        let normal = self.normal(&found.model, &found.jacobian, covariance);
        self.evidence_of(found, parameters, covariance, &normal)
    }

    fn evidence_of(
        &self,
        found: &SearchEnd,
        parameters: &[Parameter],
        covariance: &Covariance,
        normal: &Normal,
    ) -> (f64, DMatrix<f64>) {
        let layout = self.layout(parameters);
        let posterior = marginal(self.noise.scatter, &layout, normal, &found.state);
        let log_evidence = posterior.log_integral - self.log_norm(covariance);
        (log_evidence, posterior.covariance)
    }

    /// Mean squared standardised residual with each trace's most probable datum.
    pub(in crate::learn) fn chi2_per_point(&self, model: &[f64]) -> f64 {
        let off = self.standardised(model);
        off.iter().map(|z| z * z).sum::<f64>() / self.len() as f64
    }

    /// (measured − model − m)/sigma, m: each trace's most probable datum, tilt and shift; with the scatter of a new profile, the deviation from what
    /// all other rows predict in its standard deviation.
    pub(in crate::learn) fn standardised(&self, model: &[f64]) -> Vec<f64> {
        let residual = self.residual(model);
        let (errors, _) = self.covariance.trace_errors(&residual);
        (0..self.len())
            .map(|row| (residual[row] - errors[row]) / self.observation(row).sigma)
            .collect()
    }
}
