//! The ranking: every candidate worth telling, with its fit and its error on held-out tests.

use serde::{Deserialize, Serialize};

use super::anchored::{Anchored, model, predictions};
use super::fidelity::Fidelity;
use super::ground::Ground;
use super::judge::{Base, Judge, Judged};
use super::rank::Ranking;
use super::{NOTHING, UNKNOWN};
use crate::learn::search::Effort;
use crate::study::{Role, Scatter};

/// Entries of the ranking.
const LISTED: usize = 12;
/// Rise of χ² from which an entry is left out: its parameters are where the search began.
const WORSE: f64 = 20.0;
/// Leaders whose held-out error is computed.
const JUDGED_ON_HOLDOUT: usize = 3;

/// One entry of the ranking.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ranked {
    /// Effect, set, or `nothing_missing`.
    pub effect: String,
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
    /// Angle between what it and the leading effect change, deg, in the metric of the noise, after k is refitted; below some 10 they
    /// do the same. None for `nothing_missing`.
    pub angle_to_leader: Option<f64>,
    /// `fem`, `coarse_fem` or `hertz`: by what it was judged in the end.
    pub decided_by: Fidelity,
    /// Whether its fit converged.
    pub converged: bool,
}

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParameterValue {
    /// Its name; with its effect's where there are several effects.
    pub name: String,
    /// Most probable value.
    pub value: f64,
    /// One standard deviation.
    pub sigma: f64,
    /// Unit.
    pub unit: String,
    /// Whether it lies on a bound.
    pub at_bound: bool,
}

/// The ranking, the most probable first.
pub(super) fn ranked(judge: &Judge<'_>, base: &Base, ranking: &Ranking) -> Vec<Ranked> {
    let mut names: Vec<(&str, f64)> = (ranking.probabilities.iter())
        .map(|(name, p)| (name.as_str(), *p))
        .filter(|(name, _)| *name != UNKNOWN)
        .collect();
    let evidence = |name: &str| {
        ranking
            .best_of(name)
            .map_or(base.judged.log_evidence, |i| ranking.judged[i].log_evidence)
    };
    // a first look that was worse than nothing is no fit worth telling
    names.retain(|(name, _)| {
        (ranking.best_of(name))
            .is_none_or(|i| ranking.judged[i].square < base.judged.square + WORSE)
    });
    names.sort_by(|a, b| {
        b.1.total_cmp(&a.1)
            .then(evidence(b.0).total_cmp(&evidence(a.0)))
    });
    let leader = ranking.effects().first().and_then(|e| ranking.best_of(e.0));
    let seen = |place: usize| judge.visible(base, &ranking.judged[place].change);
    let leading = leader.map(seen);
    let angle = |name: &str| {
        let (own, leading) = (seen(ranking.best_of(name)?), leading.as_ref()?);
        let lengths = own.norm() * leading.norm();
        (lengths > 0.0).then(|| {
            (own.dot(leading) / lengths)
                .clamp(-1.0, 1.0)
                .acos()
                .to_degrees()
        })
    };
    let held = Ground::new(judge.ground.measured, judge.ground.noise, Role::Holdout);
    let mut listed: Vec<(&str, f64)> = names.iter().copied().take(LISTED).collect();
    if !listed.iter().any(|l| l.0 == NOTHING) {
        listed.extend(names.iter().copied().filter(|n| n.0 == NOTHING));
    }
    listed
        .into_iter()
        .enumerate()
        .filter_map(|(i, (name, probability))| {
            let judged = match ranking.best_of(name) {
                Some(place) => &ranking.judged[place],
                None if name == NOTHING => &base.judged,
                None => return None,
            };
            let wanted = !held.tests.is_empty() && (i < JUDGED_ON_HOLDOUT || name == NOTHING);
            Some(Ranked {
                effect: name.to_owned(),
                form: form(judged),
                probability,
                evidence_gain: judged.log_evidence - base.judged.log_evidence,
                parameters: parameters(judged),
                wear_coefficient: judged.found.state.log_k.exp(),
                fit_chi2_per_point: judge.ground.chi2_per_point(&judged.found.model),
                holdout_chi2_per_point: if wanted {
                    held_out(judge, &held, judged)
                } else {
                    None
                },
                angle_to_leader: angle(name),
                decided_by: judged.fidelity,
                converged: judged.converged,
            })
        })
        .collect()
}

/// The other forms than the cards' own.
pub(super) fn form(judged: &Judged) -> String {
    let forms = judged.candidate.forms.iter().copied();
    forms
        .filter(|f| !f.is_empty())
        .collect::<Vec<_>>()
        .join(", ")
}

/// Values and standard deviations of a candidate's own parameters.
pub(super) fn parameters(judged: &Judged) -> Vec<ParameterValue> {
    let candidate = &judged.candidate;
    let several = candidate.names.len() > 1;
    let first = judged.covariance.nrows() - candidate.parameters.len();
    (candidate.inherited..candidate.parameters.len())
        .map(|i| {
            let parameter = &candidate.parameters[i];
            let mode = judged.found.state.theta[i];
            let sd = judged.covariance[(first + i, first + i)].max(0.0).sqrt();
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
                unit: estimate.unit,
                at_bound: estimate.at_bound,
            }
        })
        .collect()
}

/// χ² per point of the held-out tests, all that is common to tests as fitted, their own k free.
fn held_out(judge: &Judge<'_>, held: &Ground<'_>, judged: &Judged) -> Option<f64> {
    let candidate = &judged.candidate;
    let bench = judge.exact;
    let predictor = Anchored::new(model(bench, candidate), Vec::new());
    let state = crate::learn::quadratic::State {
        epsilon: vec![0.0; held.tests.len()],
        ..judged.found.state.clone()
    };
    if judge.ground.noise.scatter == Scatter::Relative(0.0) {
        let values = predictions(held, &predictor, candidate, &state).ok()?;
        return Some(held.chi2_per_point(&held.joined(&values)));
    }
    let found = held
        .fit_held(
            &predictor,
            candidate,
            state,
            judged.found.scatter,
            &Effort::default(),
        )
        .ok()?;
    Some(held.chi2_per_point(&found.model))
}
