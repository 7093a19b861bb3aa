//! Richer forms of effects whose own form explains much, but not all: they are tried from where that one was fitted.

use rayon::prelude::*;

use super::context::Context;
use super::screening::SCREEN;
use crate::learn::candidates::candidate_model::{Anchored, model};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::discrepancy::smooth::SmoothDiscrepancy;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::prediction::fidelity::Fidelity;

/// Share of the attainable fall of χ² with which a form needs no richer one.
const ENOUGH: f64 = 0.97;
/// Share of the greatest gain of log evidence from which waves may lead once finite elements have looked for a second one.
const NEAR: f64 = 0.6;
/// Share of the best gain of log evidence from which a form is worth another, and the least gain.
const WORTH: f64 = 0.3;
const LEAST: f64 = 5.0;

/// Fits of the richer forms by the analytic model.
pub(in crate::learn) fn of(
    context: &Context<'_>,
    base: &BaseFit,
    screened: &[FittedCandidate],
    smooth: &SmoothDiscrepancy,
) -> Vec<FittedCandidate> {
    if !smooth.is_real() {
        return Vec::new();
    }
    let gain = |j: &FittedCandidate| j.log_evidence - base.fitted.log_evidence;
    let best = screened.iter().map(gain).fold(0.0, f64::max);
    let bar = LEAST.max(WORTH * best);
    let fallen = |j: &FittedCandidate| base.fitted.square - j.square;
    let wanting = screened
        .iter()
        .filter(|j| gain(j) > bar && fallen(j) < ENOUGH * smooth.drop);
    let candidates: Vec<_> = wanting.flat_map(|j| grown(context, base, j)).collect();
    context.screen(base, &candidates)
}

/// The forms that grow out of a fit.
fn grown(context: &Context<'_>, base: &BaseFit, fitted: &FittedCandidate) -> Vec<Candidate> {
    let candidate = &fitted.candidate;
    let own = candidate.parameters.iter().zip(&fitted.found.state.theta);
    let values: Vec<f64> = own.map(|(p, &x)| p.value(x)).collect();
    let study = context.likelihood.measured.study();
    let added = &values[candidate.inherited..];
    candidate.grown(study, &base.fitted.candidate, added)
}

/// All with the richer forms of a sum of waves that leads or is near it looked for by coarse finite elements too, from where these have fitted its own form: the
/// analytic model does not know how fast wear takes weak waves away, and leads the second one astray. Nothing more where some effect leaves next to nothing.
pub(in crate::learn) fn of_waves_by_elements(
    context: &Context<'_>,
    base: &BaseFit,
    mut refined: Vec<FittedCandidate>,
    smooth: &SmoothDiscrepancy,
) -> Vec<FittedCandidate> {
    let gain = |form: &FittedCandidate| form.log_evidence - base.fitted.log_evidence;
    let is_of_waves = |form: &&FittedCandidate| form.candidate.is_free_shape();
    let [most, most_by_waves] = [
        refined.iter().map(gain).fold(0.0, f64::max),
        (refined.iter().filter(is_of_waves).map(gain)).fold(0.0, f64::max),
    ];
    let leaves = |form: &FittedCandidate| base.fitted.square - form.square < ENOUGH * smooth.drop;
    let is_near = most_by_waves > LEAST.max(NEAR * most);
    if !smooth.is_real() || !is_near || !refined.iter().all(leaves) {
        return refined;
    }
    let own = refined.iter().filter(is_of_waves);
    let own = own.filter(|form| form.candidate.is_own_form());
    let own: Vec<&FittedCandidate> = own.collect();
    let fit = |candidate: &Candidate, from: Option<&State>| {
        let predictor = Anchored::new(model(context.middle, candidate), base.fitted.offset.clone());
        let starts = match from {
            Some(state) => vec![(0.0, state.clone())],
            None => context.starts(base, candidate, &predictor),
        };
        let found = context.look(candidate, &predictor, starts, &SCREEN)?;
        Some(context.refined(base, candidate.clone(), found))
    };
    let of_own = |own: &&FittedCandidate| -> Vec<FittedCandidate> {
        let by_elements = match own.fidelity {
            Fidelity::Screening => fit(&own.candidate, Some(&own.found.state)),
            Fidelity::Middle | Fidelity::Full => Some((*own).clone()),
        };
        let forms = by_elements.map_or_else(Vec::new, |own| grown(context, base, &own));
        (forms.par_iter())
            .filter_map(|candidate| fit(candidate, None))
            .collect()
    };
    let found: Vec<FittedCandidate> = own.par_iter().flat_map_iter(of_own).collect();
    for form in found {
        let same = |known: &&mut FittedCandidate| known.candidate.is_same_as(&form.candidate);
        match refined.iter_mut().find(same) {
            Some(known) if known.log_evidence >= form.log_evidence => {}
            Some(known) => *known = form,
            None => refined.push(form),
        }
    }
    refined
}
