//! A law of the place on the flank instead of a sum of waves, or of a pair, that leads.
//!
//! A sum of waves along the profile follows whatever is smooth along the flank, so also what acts there by its place and is no profile: a band where the
//! oil fails, a groove, a soft zone. But a profile wears away, and a factor on k at that place does not. A load in waves follows them too, but it changes
//! with the speed, as its resonance has it. So where either stands in what leads, a free
//! factor on k by the place is fitted instead, beside none and beside the other effect, or the next best one where the waves lead alone.
//!
//! Two effects of any kind that each differ along the flank follow together what one alone does not, the same band or soft zone among it. So where a pair
//! without waves leads, such a factor is fitted instead of both.

use super::context::Context;
use super::law_instead::{FAR_BEHIND, LawInstead};
use super::learned_drivers::{self, PLACES};
use crate::effects::Hook;
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::EffectSet;

/// The laws instead of the sum of waves in what leads, or of a pair that leads without one; none where there is neither. `fitted`: by falling evidence.
pub(in crate::learn) fn instead_of_leader(
    context: &Context<'_>,
    base: &BaseFit,
    fitted: &[FittedCandidate],
) -> Vec<LawInstead> {
    // a fit that came to no end says nothing of how much of it is a profile
    let Some(leading) = fitted.first().filter(|first| first.converged) else {
        return Vec::new();
    };
    let leader = &leading.candidate.effects;
    // of a profile and a load the profile: it takes the less of physics to follow anything
    let waves = (leader
        .cards()
        .iter()
        .filter(|card| card.is_wave_along_flank()))
    .max_by_key(|card| card.hook == Hook::Profile);
    let Some(waves) = waves.map(|&card| EffectSet::new([card])) else {
        return instead_of_pair(context, base, leading)
            .into_iter()
            .collect();
    };
    let rest = leader.without(&waves);
    // where the waves lead alone, they may stand for another effect and what acts by its place
    let is_meant = |f: &&FittedCandidate| match rest.is_empty() {
        true => f.candidate.effects.single().is_some() && f.candidate.effects != waves,
        false => f.candidate.effects == rest,
    };
    let beside = fitted.iter().find(is_meant);
    let law = |known: &FittedCandidate| {
        let (name, gain) = learned_drivers::best_of(context, known, PLACES)?;
        Some(LawInstead {
            beside: known.candidate.effects.clone(),
            instead_of: waves.clone(),
            name,
            log_evidence: known.log_evidence + gain,
        })
    };
    // beside the rest of a set first, beside nothing where the waves lead alone
    let order = match rest.is_empty() {
        true => [Some(&base.fitted), beside],
        false => [beside, Some(&base.fitted)],
    };
    let mut laws: Vec<LawInstead> = Vec::new();
    for known in order.into_iter().flatten() {
        let is_far = |law: &LawInstead| law.log_evidence < leading.log_evidence - FAR_BEHIND;
        if laws.iter().any(is_far) {
            break;
        }
        laws.extend(law(known));
    }
    laws
}

/// The law instead of a pair that leads; none where a single effect does, or where the analytic model leaves the law far behind.
fn instead_of_pair(
    context: &Context<'_>,
    base: &BaseFit,
    leading: &FittedCandidate,
) -> Option<LawInstead> {
    let pair = &leading.candidate.effects;
    if pair.single().is_some() {
        return None;
    }
    let least = leading.log_evidence - base.fitted.log_evidence - FAR_BEHIND;
    let (name, gain) = learned_drivers::best_of_worth(context, &base.fitted, PLACES, least)?;
    Some(LawInstead {
        beside: EffectSet::new([]),
        instead_of: pair.clone(),
        name,
        log_evidence: base.fitted.log_evidence + gain,
    })
}
