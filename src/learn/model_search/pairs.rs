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

use super::changes_alone::ChangesAlone;
use super::context::Context;
use super::moved_centres;
use super::pair_exchange;
use super::pair_fit::{self, PROMISE, PairStart};
use super::second_effects;
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::prediction::fidelity::Fidelity;

/// [`PROMISE`] as a share of the best one's own gain: what adds less is taken for a mending of its form (`second_share` of the decision rule).
const PROMISE_SHARE: f64 = 0.06;
/// Pairs fitted by the middle fidelity, and by finite elements.
const FITTED: [usize; 2] = [5, 2];
/// Pairs that overtake those when these are fitted by finite elements, and are fitted so too.
const OVERTAKING: usize = 2;
/// Other forms of each effect of the leading pair that are fitted too, and the share of what the form in it gains alone from which one is.
const FORMS: usize = 2;
const NEARLY: f64 = 0.8;

/// The fitted pairs that promise more than the best single effect.
pub(in crate::learn) fn pairs(
    context: &Context<'_>,
    base: &BaseFit,
    singles: &[FittedCandidate],
) -> Vec<FittedCandidate> {
    let Some(best) = singles
        .iter()
        .max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence))
    else {
        return Vec::new();
    };
    // What the best single effect leaves is all that a second one could explain.
    let left = 0.5 * (best.square - context.likelihood.len() as f64);
    let spread = (0.5 * context.likelihood.len() as f64).sqrt();
    if left < PROMISE.min(spread) && best.log_evidence - base.fitted.log_evidence < PROMISE {
        return Vec::new();
    }
    let promising = promising(context, base, singles, best);
    let starts = promising
        .iter()
        .map(|&(a, b)| PairStart::of(base, &singles[a], &singles[b]));
    let mut fitted = pair_fit::fit(context, base, starts.collect());
    if fitted.is_empty() && left > promise(base, best) {
        // What a law with a threshold was fitted to alone says little of what it would be beside another effect.
        let alone = ChangesAlone::new(context, base, singles);
        fitted = pair_exchange::fit(context, base, (singles, &alone), &[], best, best);
        fitted.retain(|pair| pair.log_evidence > best.log_evidence + promise(base, best));
    }
    fitted.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    if let Some(pair) = fitted.first() {
        let kept = pair_exchange::kept(context, singles, pair, best);
        if !kept.is_empty() {
            let alone = ChangesAlone::new(context, base, singles);
            let with_others =
                |kept| pair_exchange::fit(context, base, (singles, &alone), &fitted, pair, kept);
            let more: Vec<FittedCandidate> = kept.into_iter().flat_map(with_others).collect();
            fitted.extend(more);
            fitted.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
        }
    }
    if let Some(pair) = fitted.first() {
        let starts = moved_centres::in_pair(context, singles, pair);
        for other in pair_fit::fit(context, base, starts) {
            let same = |known: &&mut FittedCandidate| known.candidate.is_same_as(&other.candidate);
            match fitted.iter_mut().find(same) {
                Some(known) if known.found.objective <= other.found.objective => {}
                Some(known) => *known = other,
                None => fitted.push(other),
            }
        }
        fitted.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    }
    if let Some(pair) = (fitted.first()).filter(|pair| pair.log_evidence > best.log_evidence) {
        let starts = in_other_forms(base, singles, pair);
        for other in pair_fit::fit(context, base, starts) {
            let same = |known: &FittedCandidate| known.candidate.is_same_as(&other.candidate);
            if !fitted.iter().any(same) {
                fitted.push(other);
            }
        }
        fitted.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    }
    if let Some(leader) = fitted.first_mut().filter(|pair| !pair.converged) {
        let start = PairStart {
            candidate: leader.candidate.clone(),
            state: leader.found.state.clone(),
            offset: leader.offset.clone(),
        };
        let further = pair_fit::fit(context, base, vec![start]).pop();
        if let Some(further) = further.filter(|f| f.log_evidence > leader.log_evidence) {
            *leader = further;
        }
    }
    // what the effects' own forms do as well is told of these
    let own = fitted.first().and_then(|best| {
        let forms = fitted.iter().enumerate();
        let mut forms = forms.filter(|(_, pair)| pair.candidate.effects == best.candidate.effects);
        forms.find(|(_, pair)| pair.candidate.is_own_form() && pair.does_as_well_as(best))
    });
    let own = own.map(|(place, _)| place);
    if context.fidelity == Fidelity::Middle {
        return fitted;
    }
    let by_elements = |pair: &FittedCandidate| {
        let start = pair.found.state.clone();
        let found = context.decide(&pair.candidate, start, Some(base), best.found.objective);
        found.ok()
    };
    for (i, pair) in fitted.iter_mut().enumerate() {
        if (i < FITTED[1] || own == Some(i))
            && pair.log_evidence > best.log_evidence
            && let Some(found) = by_elements(pair)
        {
            *pair = found;
        }
    }
    // what comes first now may be a pair that these have not judged
    for _ in 0..OVERTAKING {
        let first = (fitted.iter_mut()).max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence));
        let first = first.filter(|first| first.log_evidence > best.log_evidence);
        let Some(first) = first.filter(|first| first.fidelity < context.fidelity) else {
            break;
        };
        let Some(found) = by_elements(first) else {
            break;
        };
        *first = found;
    }
    fitted
}

/// Starts of a pair with either effect in the other forms that do nearly as well alone: which one is right may show beside the other effect only.
fn in_other_forms(
    base: &BaseFit,
    singles: &[FittedCandidate],
    pair: &FittedCandidate,
) -> Vec<PairStart> {
    let gain = |single: &FittedCandidate| single.log_evidence - base.fitted.log_evidence;
    let parts = singles.iter().filter(|s| pair_exchange::is_part(s, pair));
    let parts: Vec<&FittedCandidate> = parts.collect();
    let [one, other] = parts[..] else {
        return Vec::new();
    };
    let with = |kept: &FittedCandidate, changed: &FittedCandidate| -> Vec<PairStart> {
        let is_form = |s: &&FittedCandidate| {
            s.candidate.effects == changed.candidate.effects
                && !s.candidate.is_same_as(&changed.candidate)
                && gain(s) > NEARLY * gain(changed)
        };
        let mut forms: Vec<&FittedCandidate> = singles.iter().filter(is_form).collect();
        forms.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
        let nearest = forms.into_iter().take(FORMS);
        nearest
            .map(|form| PairStart::of(base, kept, form))
            .collect()
    };
    [with(one, other), with(other, one)].concat()
}

/// What a pair must promise beyond the best single effect to be fitted.
fn promise(base: &BaseFit, best: &FittedCandidate) -> f64 {
    let single = 0.5 * (base.fitted.square - best.square);
    PROMISE.max(PROMISE_SHARE * single)
}

/// Places of the pairs with the largest gain, one form each.
fn promising(
    context: &Context<'_>,
    base: &BaseFit,
    singles: &[FittedCandidate],
    best: &FittedCandidate,
) -> Vec<(usize, usize)> {
    let seen: Vec<DVector<f64>> = singles
        .par_iter()
        .map(|s| base.visible(&context.likelihood, &s.change))
        .collect();
    let along: Vec<f64> = seen.iter().map(|v| v.dot(&base.residual)).collect();
    let single = 0.5 * (base.fitted.square - best.square);
    let promise = promise(base, best);
    let mut found: Vec<(f64, usize, usize)> = Vec::new();
    for a in 0..singles.len() {
        for b in a + 1..singles.len() {
            if singles[a].candidate.effects == singles[b].candidate.effects {
                continue;
            }
            let gain = joint_gain(&seen[a], &seen[b], along[a], along[b]);
            // A linear gain counts the fitted effects' own gain at least.
            let own = [a, b].map(|i| 0.5 * (base.fitted.square - singles[i].square));
            let gain = gain.max(own[0]).max(own[1]);
            if gain > single + promise {
                found.push((gain, a, b));
            }
        }
    }
    // second effects on top of the best one: its change makes the residual smaller before the other is looked at
    let leader = singles
        .iter()
        .position(|s| std::ptr::eq(s, best))
        .unwrap_or(0);
    let all: Vec<&FittedCandidate> = singles.iter().collect();
    for (gain, b) in second_effects::on_top(context, base, &all, &seen, leader) {
        if gain > promise {
            found.push((single + gain, leader.min(b), leader.max(b)));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut chosen: Vec<(usize, usize)> = Vec::new();
    for (_, a, b) in found {
        let names = |(a, b): (usize, usize)| {
            let mut names = [&singles[a].candidate.effects, &singles[b].candidate.effects];
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
