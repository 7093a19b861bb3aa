//! A law of the place on the flank instead of a sum of waves that leads.
//!
//! A sum of waves along the profile follows whatever is smooth along the flank, so also what acts there by its place and is no profile: a band where the
//! oil fails, a groove, a soft zone. But a profile wears away, and a factor on k at that place does not. So where such a sum stands in what leads, a free
//! factor on k by the place is fitted instead, beside none and beside the other effect, or the next best one where the waves lead alone.

use super::context::Context;
use super::law_instead::LawInstead;
use super::learned_drivers::{self, PLACES};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::EffectSet;
use crate::learn::hypothesis::candidate::Candidate;

/// ln evidence by which the first law may be behind for a second to be fitted beside other effects.
const FAR_BEHIND: f64 = 30.0;

/// The laws instead of the sum of waves in what leads; none where there is none in it. `fitted`: by falling evidence.
pub(in crate::learn) fn instead_of_waves(
    context: &Context<'_>,
    base: &BaseFit,
    singles: &[Candidate],
    fitted: &[FittedCandidate],
) -> Vec<LawInstead> {
    // a fit that came to no end says nothing of how much of it is a profile
    let Some(leading) = fitted.first().filter(|first| first.converged) else {
        return Vec::new();
    };
    let leader = &leading.candidate.effects;
    let mut cards = leader.cards().iter().map(|&card| EffectSet::new([card]));
    let is_free_shape =
        |set: &EffectSet| (singles.iter()).any(|c| c.is_free_shape() && c.effects == *set);
    let Some(waves) = cards.find(is_free_shape) else {
        return Vec::new();
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
