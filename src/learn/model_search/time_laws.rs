//! A law of the time instead of an effect that leads and changes k over time alone.
//!
//! Running-in, ageing oil and debris each follow in part whatever changes k slowly: a step after some cycles, a change of oil, a rig that was taken apart.
//! So where one of them leads alone and leaves something that a smooth discrepancy would take up, or that does as well without it, a free factor on k by the
//! cycles is fitted instead.

use super::context::Context;
use super::law_instead::LawInstead;
use super::learned_drivers::{self, TIMES};
use crate::effects::Card;
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::EffectSet;
use crate::learn::model_search::beside_unknown::{BesideUnknown, WithDiscrepancy};

/// ln evidence for something beside the effect from which a law is worth its fits: effects that were there had -2 to -4.
const LEFT: f64 = 3.0;

/// ln evidence that a discrepancy alone may be behind the effect for a law to be worth its fits too.
const AS_GOOD: f64 = 5.0;

/// The law instead of what leads, and of every other effect that changes k over time alone: what it does better than the first it does better than them;
/// none where what leads does more than that, or leaves nothing. `fitted`: by falling evidence.
pub(in crate::learn) fn instead_of_slow_change(
    context: &Context<'_>,
    base: &BaseFit,
    fitted: &[FittedCandidate],
    beside: &WithDiscrepancy,
) -> Vec<LawInstead> {
    let slow = |fitted: &FittedCandidate| {
        let card = fitted.candidate.effects.single();
        card.filter(|card| card.changes_k_over_time_alone())
    };
    let Some(first) = fitted.first().filter(|first| slow(first).is_some()) else {
        return Vec::new();
    };
    let is_own =
        |beside: &&BesideUnknown| beside.fitted.candidate.effects == first.candidate.effects;
    let own = beside.effects.iter().find(is_own);
    let is_as_good_alone = beside.alone > first.log_evidence - AS_GOOD;
    if own.is_none_or(|own| own.remainder_gain < LEFT && !is_as_good_alone) {
        return Vec::new();
    }
    let Some((name, gain)) = learned_drivers::best_of(context, &base.fitted, TIMES) else {
        return Vec::new();
    };
    let mut replaced: Vec<&'static Card> = Vec::new();
    for card in fitted.iter().filter_map(slow) {
        if !replaced.iter().any(|known| known.name == card.name) {
            replaced.push(card);
        }
    }
    let instead_of = |card: &'static Card| LawInstead {
        beside: EffectSet::new([]),
        instead_of: EffectSet::new([card]),
        name: name.clone(),
        log_evidence: base.fitted.log_evidence + gain,
    };
    replaced.into_iter().map(instead_of).collect()
}
