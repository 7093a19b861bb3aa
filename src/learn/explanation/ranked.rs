//! The ranking: every candidate worth telling, with its fit and its error on held-out tests.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::learn::candidates::candidate_model::{Anchored, model, predictions};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::decision::judged_candidates::JudgedCandidates;
use crate::learn::experiment::decided::{DecidedCandidate, DecidedValue};
use crate::learn::hypothesis::Hypothesis;
use crate::learn::inference::search::Effort;
use crate::learn::model_search::context::Context;
use crate::learn::prediction::fidelity::Fidelity;
use crate::study::{Role, Scatter};

/// Entries of the ranking.
const LISTED: usize = 12;
/// Rise of χ² from which an entry is left out: its parameters are where the search began.
const WORSE: f64 = 20.0;
/// Leaders whose held-out error is computed beside those that cannot be told apart, and the log probability from which those behind the first are worth
/// that: e^-14 is about a millionth.
const JUDGED_ON_HOLDOUT: usize = 3;
const WORTH_JUDGING: f64 = -14.0;

/// One entry of the ranking.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ranked {
    /// Effect, set, or `nothing_missing`.
    pub effect: Hypothesis,
    /// The most probable of its accepted forms; empty for the card's own.
    pub form: String,
    /// Probability.
    pub probability: f64,
    /// Log evidence over the base model's.
    pub evidence_gain: f64,
    /// Fitted parameters.
    pub parameters: Vec<ParameterValue>,
    /// The wear coefficient common to the tests, mm²/N.
    pub wear_coefficient: f64,
    /// Mean squared standardised residual of the fit tests.
    pub fit_chi2_per_point: f64,
    /// Of the held-out tests; None without, and for candidates far behind.
    pub holdout_chi2_per_point: Option<f64>,
    /// Angle between what it and what leads change, deg, in the metric of the noise, after k is refitted; below some 10 they
    /// do the same. None for `nothing_missing`.
    pub angle_to_leader: Option<f64>,
    /// `fem`, `coarse_fem` or `hertz`: by what it was judged in the end.
    pub decided_by: Fidelity,
    /// Whether its fit converged.
    pub converged: bool,
}

impl Ranked {
    /// As a later command reads it from the document.
    pub(in crate::learn) fn decided(&self) -> DecidedCandidate {
        let value = |p: &ParameterValue| DecidedValue {
            name: p.name.clone(),
            value: p.value,
        };
        DecidedCandidate {
            effect: self.effect.to_string(),
            form: self.form.clone(),
            probability: self.probability,
            parameters: self.parameters.iter().map(value).collect(),
            wear_coefficient: Some(self.wear_coefficient),
        }
    }
}

/// σ over the value from which ± hides more than it says.
const WIDE: f64 = 0.5;

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParameterValue {
    /// Its name; with its effect's where there are several effects.
    pub name: String,
    /// Most probable value.
    pub value: f64,
    /// One standard deviation; on a logarithmic scale the value times that of its logarithm.
    pub sigma: f64,
    /// The central 95 %, on the parameter's natural scale; None in documents of older programs.
    #[serde(default)]
    pub interval_95: Option<[f64; 2]>,
    /// Unit.
    pub unit: String,
    /// Whether it lies on a bound.
    pub at_bound: bool,
}

impl ParameterValue {
    /// The ends of its interval where value ± σ would say less: a positive quantity that is known by its size only.
    pub fn skewed_interval(&self) -> Option<[f64; 2]> {
        let one_sign = |[low, high]: &[f64; 2]| low * high > 0.0;
        let wide = self.sigma > WIDE * self.value.abs();
        self.interval_95.filter(|ends| wide && one_sign(ends))
    }
}

/// The ranking, the most probable first.
pub(in crate::learn) fn ranked(
    context: &Context<'_>,
    base: &BaseFit,
    posterior: &JudgedCandidates,
) -> Vec<Ranked> {
    let likelihood = &context.likelihood;
    let decision = &posterior.decision;
    let all = decision.log_probabilities.iter();
    let mut fitted: Vec<(&Hypothesis, f64, &FittedCandidate)> = all
        .filter_map(|(hypothesis, log)| {
            let fitted = posterior.fitted(base, hypothesis)?;
            // a first look that was worse than nothing is no fit worth listing
            (fitted.square < base.fitted.square + WORSE).then_some((hypothesis, *log, fitted))
        })
        .collect();
    fitted.sort_by(|a, b| {
        b.1.total_cmp(&a.1)
            .then(b.2.log_evidence.total_cmp(&a.2.log_evidence))
    });
    let seen = |fitted: &FittedCandidate| base.visible(likelihood, &fitted.change);
    let leading = posterior.leading_fit(base).map(seen);
    let angle = |fitted: &FittedCandidate| {
        let (own, leading) = (seen(fitted), leading.as_ref()?);
        let lengths = own.norm() * leading.norm();
        (lengths > 0.0).then(|| {
            (own.dot(leading) / lengths)
                .clamp(-1.0, 1.0)
                .acos()
                .to_degrees()
        })
    };
    let held = Likelihood::new(likelihood.measured, likelihood.noise, Role::Holdout);
    let mut listed: Vec<_> = fitted.iter().take(LISTED).collect();
    let nothing = |h: &Hypothesis| *h == Hypothesis::NothingMissing;
    if !listed.iter().any(|l| nothing(l.0)) {
        listed.extend(fitted.iter().filter(|l| nothing(l.0)));
    }
    let entry =
        |(i, &(hypothesis, log, fitted)): (usize, &(&Hypothesis, f64, &FittedCandidate))| {
            let is_base = nothing(hypothesis);
            let leads = i == 0 || i < JUDGED_ON_HOLDOUT && log > WORTH_JUDGING;
            let leads = leads || decision.group.contains(hypothesis);
            let wanted = !held.tests.is_empty() && (leads || is_base);
            Ranked {
                effect: hypothesis.clone(),
                form: form(fitted),
                probability: log.exp(),
                evidence_gain: fitted.log_evidence - base.fitted.log_evidence,
                parameters: parameters(fitted),
                wear_coefficient: fitted.found.state.log_k.exp(),
                fit_chi2_per_point: likelihood.chi2_per_point(&fitted.found.model),
                holdout_chi2_per_point: (wanted.then(|| held_out(context, &held, fitted)))
                    .flatten(),
                angle_to_leader: if is_base { None } else { angle(fitted) },
                // a study of the analytic model has no finer one of its own
                decided_by: fitted.fidelity.min(context.fidelity),
                converged: fitted.converged,
            }
        };
    listed.into_par_iter().enumerate().map(entry).collect()
}

/// The other forms than the cards' own.
pub(in crate::learn) fn form(fitted: &FittedCandidate) -> String {
    let forms = fitted.candidate.forms.iter().flatten();
    forms.map(|form| form.name).collect::<Vec<_>>().join(", ")
}

/// Values and standard deviations of a candidate's own parameters.
pub(in crate::learn) fn parameters(fitted: &FittedCandidate) -> Vec<ParameterValue> {
    let candidate = &fitted.candidate;
    let several = candidate.effects.len() > 1;
    let first = fitted.covariance.nrows() - candidate.parameters.len();
    (candidate.inherited..candidate.parameters.len())
        .map(|i| {
            let parameter = &candidate.parameters[i];
            let mode = fitted.found.state.theta[i];
            let sd = fitted.covariance[(first + i, first + i)].max(0.0).sqrt();
            let estimate = parameter.estimate(mode, mode, sd);
            let short = estimate.name.split_once('.').map_or("", |(_, short)| short);
            ParameterValue {
                name: if several {
                    estimate.name.clone()
                } else {
                    short.to_owned()
                },
                value: estimate.value,
                sigma: estimate.sigma,
                interval_95: Some(estimate.interval),
                unit: estimate.unit,
                at_bound: estimate.at_bound,
            }
        })
        .collect()
}

/// χ² per point of the held-out tests, all that is common to tests as fitted, their own k free.
fn held_out(context: &Context<'_>, held: &Likelihood<'_>, fitted: &FittedCandidate) -> Option<f64> {
    let candidate = &fitted.candidate;
    let bench = context.exact;
    let predictor = Anchored::new(model(bench, candidate), Vec::new());
    let state = crate::learn::inference::quadratic::State {
        epsilon: vec![0.0; held.tests.len()],
        ..fitted.found.state.clone()
    };
    if context.likelihood.noise.scatter == Scatter::Relative(0.0) {
        let values = predictions(held, &predictor, candidate, &state).ok()?;
        return Some(held.chi2_per_point(&held.joined(&values)));
    }
    let found = held
        .fit_held(
            &predictor,
            &candidate.parameters,
            state,
            fitted.found.scatter,
            &Effort::for_simulations().of_held_out(),
        )
        .ok()?;
    Some(held.chi2_per_point(&found.model))
}
