//! Two effects at once: those that hide each other are found jointly, not one after the other.
//!
//! ```text
//! gain(a, b) = ½ rᵀP r       P onto the changes of a and b that k cannot make; amplitudes not negative
//! ```
//! The changes are those of the singly fitted effects. The most promising pairs are then fitted in full, by the middle fidelity,
//! and the best of these by finite elements. The best one's effects, as fitted in the pair, are then given other partners: what fits
//! an effect best alone may hide the right partner.

use nalgebra::DVector;
use rayon::prelude::*;

use super::anchored::{Anchored, model, predictions};
use super::candidate::Candidate;
use super::fidelity::Fidelity;
use super::judge::{Base, Judge, Judged, LEAST_AMPLITUDE, linear_gain};
use super::pair_fit::{self, PairStart};
use crate::learn::quadratic::State;

/// Log evidence by which a pair must promise to beat the best single effect to be looked at.
const PROMISE: f64 = 6.0;
/// The same as a share of the best one's own gain: what adds less is taken for a mending of its form (`SECOND` in `rank`).
const PROMISE_SHARE: f64 = 0.06;
/// Pairs fitted by the middle fidelity, and by finite elements.
const FITTED: [usize; 2] = [5, 2];
/// Other partners tried for each effect of the best pair, and the χ² per degree of freedom above 1, in standard deviations, that a
/// pair which does not lead must leave for that.
const PARTNERS: usize = 4;
const LEFT: f64 = 1.0;
/// The fitted pairs that promise more than the best single effect.
pub(super) fn pairs(judge: &Judge<'_>, base: &Base, singles: &[Judged]) -> Vec<Judged> {
    let Some(best) = singles
        .iter()
        .max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence))
    else {
        return Vec::new();
    };
    // What the best single effect leaves is all that a second one could explain.
    let left = 0.5 * (best.square - judge.ground.len() as f64);
    let spread = (0.5 * judge.ground.len() as f64).sqrt();
    if left < PROMISE.min(spread) && best.log_evidence - base.judged.log_evidence < PROMISE {
        return Vec::new();
    }
    let promising = promising(judge, base, singles, best);
    let starts = promising
        .iter()
        .map(|&(a, b)| PairStart::of(base, &singles[a], &singles[b]));
    let mut fitted = pair_fit::fit(judge, base, starts.collect());
    fitted.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    if let Some(pair) = fitted.first() {
        let more: Vec<Judged> = (kept(judge, singles, pair, best).into_iter())
            .flat_map(|kept| partners(judge, base, singles, &fitted, pair, kept))
            .collect();
        fitted.extend(more);
        fitted.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    }
    if let Some(leader) = fitted.first_mut().filter(|pair| !pair.converged) {
        let start = PairStart {
            candidate: leader.candidate.clone(),
            state: leader.found.state.clone(),
            offset: leader.offset.clone(),
        };
        let further = pair_fit::fit(judge, base, vec![start]).pop();
        if let Some(further) = further.filter(|f| f.log_evidence > leader.log_evidence) {
            *leader = further;
        }
    }
    let mut decided = Vec::with_capacity(fitted.len());
    for (i, pair) in fitted.into_iter().enumerate() {
        let better = pair.log_evidence > best.log_evidence;
        if i < FITTED[1] && better && judge.fidelity != Fidelity::Middle {
            let start = pair.found.state.clone();
            decided.push(
                judge
                    .decide(&pair.candidate, start, Some(base), best.found.objective)
                    .unwrap_or(pair),
            );
        } else {
            decided.push(pair);
        }
    }
    decided
}

/// Places of the pairs with the largest gain, one form each.
fn promising(
    judge: &Judge<'_>,
    base: &Base,
    singles: &[Judged],
    best: &Judged,
) -> Vec<(usize, usize)> {
    let seen: Vec<DVector<f64>> = singles
        .par_iter()
        .map(|s| judge.visible(base, &s.change))
        .collect();
    let along: Vec<f64> = seen.iter().map(|v| v.dot(&base.residual)).collect();
    let single = 0.5 * (base.judged.square - best.square);
    let promise = PROMISE.max(PROMISE_SHARE * single);
    let mut found: Vec<(f64, usize, usize)> = Vec::new();
    for a in 0..singles.len() {
        for b in a + 1..singles.len() {
            if singles[a].candidate.names == singles[b].candidate.names {
                continue;
            }
            let gain = joint_gain(&seen[a], &seen[b], along[a], along[b]);
            // A linear gain counts the fitted effects' own gain at least.
            let own = [a, b].map(|i| 0.5 * (base.judged.square - singles[i].square));
            let gain = gain.max(own[0]).max(own[1]);
            if gain > single + promise {
                found.push((gain, a, b));
            }
        }
    }
    // Second effects on top of the best one, as fitted: its change makes the residual smaller before the other is looked at.
    let leader = singles
        .iter()
        .position(|s| std::ptr::eq(s, best))
        .unwrap_or(0);
    let left = judge.ground.residual(&best.found.model);
    let left = DVector::from_vec(judge.ground.covariance.whiten(&left));
    let direction = &seen[leader];
    let length = direction.norm_squared();
    for b in (0..singles.len()).filter(|&b| singles[b].candidate.names != best.candidate.names) {
        let mut other = seen[b].clone();
        if length > 0.0 {
            let share = other.dot(direction) / length;
            other.axpy(-share, direction, 1.0);
        }
        let square = other.norm_squared();
        let gain = if square > 1e-9 {
            0.5 * other.dot(&left).powi(2) / square
        } else {
            0.0
        };
        if gain > promise {
            found.push((single + gain, leader.min(b), leader.max(b)));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut chosen: Vec<(usize, usize)> = Vec::new();
    for (_, a, b) in found {
        let names = |(a, b): (usize, usize)| {
            let mut names = [&singles[a].candidate.names, &singles[b].candidate.names];
            names.sort();
            names
        };
        if chosen.iter().all(|&known| names(known) != names((a, b))) {
            chosen.push((a, b));
        }
        if chosen.len() == FITTED[0] {
            break;
        }
    }
    chosen
}

/// The effects of a fitted pair that are to be tried with other partners: both if the pair beats the best single effect, for one
/// of them may stand for a look-alike that was not followed alone; the stronger one if the pair leaves more than noise.
fn kept<'j>(
    judge: &Judge<'_>,
    singles: &'j [Judged],
    pair: &Judged,
    best: &Judged,
) -> Vec<&'j Judged> {
    let part = |s: &&Judged| {
        let (own, joint) = (&s.candidate, &pair.candidate);
        let mut effects = joint.names.iter().zip(&joint.forms);
        effects.any(|effect| effect == (&own.names[0], &own.forms[0]))
    };
    let mut parts: Vec<&Judged> = singles.iter().filter(part).collect();
    parts.sort_by(|a, b| a.square.total_cmp(&b.square));
    let rows = judge.ground.len() as f64;
    let leaves = pair.square > rows + LEFT * (2.0 * rows).sqrt();
    parts.truncate(if pair.log_evidence > best.log_evidence {
        2
    } else {
        usize::from(leaves)
    });
    parts
}

/// One effect of a fitted pair with other partners: those whose starts gain most, in the linearised analytic model, on what it
/// leaves with its values of the pair.
fn partners(
    judge: &Judge<'_>,
    base: &Base,
    singles: &[Judged],
    fitted: &[Judged],
    pair: &Judged,
    kept: &Judged,
) -> Vec<Judged> {
    let Some(state) = state_in(&kept.candidate, pair) else {
        return Vec::new();
    };
    let predicted = |bench, offset: &[Vec<f64>], candidate: &Candidate, state: &State| {
        let predictor = Anchored::new(model(bench, candidate), offset.to_vec());
        let values = predictions(&judge.ground, &predictor, candidate, state).ok()?;
        Some(judge.ground.joined(&values))
    };
    let alone = predicted(judge.middle, &base.judged.offset, &kept.candidate, &state);
    let analytic = predicted(judge.hertz, &[], &kept.candidate, &state);
    let analytic = analytic.map(|model| judge.ground.rescaled(&model));
    let (Some(alone), Some(analytic)) = (alone, analytic) else {
        return Vec::new();
    };
    let left = judge.ground.residual(&alone);
    let left = DVector::from_vec(judge.ground.covariance.whiten(&left));
    let known = |s: &Judged| {
        let both = [s.candidate.names[0], kept.candidate.names[0]];
        (fitted.iter()).any(|f| both.iter().all(|name| f.candidate.names.contains(name)))
    };
    let mut gains: Vec<(f64, Candidate, State)> = (singles.par_iter())
        .filter(|s| s.candidate.names != kept.candidate.names && !known(s))
        .flat_map_iter(|s| s.candidate.starts.iter().map(move |values| (s, values)))
        .filter_map(|(s, values)| {
            let both = kept.candidate.with(&s.candidate);
            let own = &s.candidate.parameters[s.candidate.inherited..];
            let with = |values: &[f64]| State {
                theta: (state.theta.iter().copied())
                    .chain(own.iter().zip(values).map(|(p, &x)| p.natural_start(x)))
                    .collect(),
                ..state.clone()
            };
            let predicted =
                judge
                    .ground
                    .rescaled(&predicted(judge.hertz, &[], &both, &with(values))?);
            let change: Vec<f64> = predicted
                .iter()
                .zip(&analytic)
                .map(|(f, a)| f - a)
                .collect();
            let (gain, amplitude) = linear_gain(&judge.visible(base, &change), &left);
            let scaled = s.candidate.scaled(values, amplitude.max(LEAST_AMPLITUDE));
            (gain > PROMISE).then(|| (gain, both, with(&scaled)))
        })
        .collect();
    gains.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<(f64, Candidate, State)> = Vec::new();
    for gain in gains {
        if chosen.len() < PARTNERS && chosen.iter().all(|c| c.1.names != gain.1.names) {
            chosen.push(gain);
        }
    }
    let starts = chosen.into_iter().map(|(_, candidate, state)| PairStart {
        candidate,
        state,
        offset: base.judged.offset.clone(),
    });
    pair_fit::fit(judge, base, starts.collect())
}

/// A fitted pair's state with the parameters of one of its effects only.
fn state_in(candidate: &Candidate, pair: &Judged) -> Option<State> {
    let value = |name: &str| {
        let at = (pair.candidate.parameters.iter()).position(|p| p.name == name)?;
        Some(pair.found.state.theta[at])
    };
    let theta: Option<Vec<f64>> = (candidate.parameters.iter())
        .map(|p| value(&p.name))
        .collect();
    Some(State {
        theta: theta?,
        ..pair.found.state.clone()
    })
}

/// ½ of the fall of χ² by two changes with amplitudes that are not negative.
fn joint_gain(a: &DVector<f64>, b: &DVector<f64>, ra: f64, rb: f64) -> f64 {
    let (aa, bb, ab) = (a.norm_squared(), b.norm_squared(), a.dot(b));
    let alone = |r: f64, square: f64| {
        if square > 1e-9 {
            0.5 * r.max(0.0).powi(2) / square
        } else {
            0.0
        }
    };
    let determinant = aa * bb - ab * ab;
    if determinant > 1e-6 * aa * bb {
        let x = (bb * ra - ab * rb) / determinant;
        let y = (aa * rb - ab * ra) / determinant;
        if x > 0.0 && y > 0.0 {
            return 0.5 * (x * ra + y * rb);
        }
    }
    alone(ra, aa).max(alone(rb, bb))
}
