//! Richer forms of effects whose own form explains much, but not all: they are tried from where that one was fitted.

use super::flexible::Flexible;
use super::judge::{Base, Judge, Judged};

/// Share of the attainable fall of χ² with which a form needs no richer one.
const ENOUGH: f64 = 0.97;
/// Share of the best gain of log evidence from which a form is worth another, and the least gain.
const WORTH: f64 = 0.3;
const LEAST: f64 = 5.0;

/// Fits of the richer forms by the analytic model.
pub(super) fn of(
    judge: &Judge<'_>,
    base: &Base,
    screened: &[Judged],
    flexible: &Flexible,
) -> Vec<Judged> {
    if !flexible.is_real() {
        return Vec::new();
    }
    let study = judge.ground.measured.study();
    let gain = |j: &Judged| j.log_evidence - base.judged.log_evidence;
    let best = screened.iter().map(gain).fold(0.0, f64::max);
    let bar = LEAST.max(WORTH * best);
    let fallen = |j: &Judged| base.judged.square - j.square;
    let wanting = screened
        .iter()
        .filter(|j| gain(j) > bar && fallen(j) < ENOUGH * flexible.drop);
    let candidates: Vec<_> = wanting
        .flat_map(|j| {
            let own = j.candidate.parameters.iter().zip(&j.found.state.theta);
            let values: Vec<f64> = own.map(|(p, &x)| p.value(x)).collect();
            let added = &values[j.candidate.inherited..];
            j.candidate.grown(study, &base.judged.candidate, added)
        })
        .collect();
    judge.screen(base, &candidates)
}
