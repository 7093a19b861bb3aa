//! Richer forms of effects whose own form explains much, but not all: they are tried from where that one was fitted.

use super::context::Context;
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::discrepancy::smooth::SmoothDiscrepancy;

/// Share of the attainable fall of χ² with which a form needs no richer one.
const ENOUGH: f64 = 0.97;
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
    let study = context.likelihood.measured.study();
    let gain = |j: &FittedCandidate| j.log_evidence - base.fitted.log_evidence;
    let best = screened.iter().map(gain).fold(0.0, f64::max);
    let bar = LEAST.max(WORTH * best);
    let fallen = |j: &FittedCandidate| base.fitted.square - j.square;
    let wanting = screened
        .iter()
        .filter(|j| gain(j) > bar && fallen(j) < ENOUGH * smooth.drop);
    let candidates: Vec<_> = wanting
        .flat_map(|j| {
            let own = j.candidate.parameters.iter().zip(&j.found.state.theta);
            let values: Vec<f64> = own.map(|(p, &x)| p.value(x)).collect();
            let added = &values[j.candidate.inherited..];
            j.candidate.grown(study, &base.fitted.candidate, added)
        })
        .collect();
    context.screen(base, &candidates)
}
