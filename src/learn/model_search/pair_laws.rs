//! A law of the place or of the time instead of one effect of a pair that leads.
//!
//! Beside an effect that is there, whatever no effect does is taken by the one that comes nearest: a starved band beside a soft bearing by micropitting, a
//! rig that stops and starts beside a speed exponent by debris. So a free factor on k is fitted beside either effect instead of the other one: by the
//! cycles instead of what does nothing else than change k over time, by the place on the flank instead of any other.

use rayon::prelude::*;

use super::context::Context;
use super::law_instead::{FAR_BEHIND, LawInstead};
use super::learned_drivers::{self, PLACES, TIMES};
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::hypothesis::EffectSet;
use crate::learn::prediction::fidelity::Fidelity;

/// The laws of the place, and those of the time; none where a single effect leads, nor instead of waves along the flank, which have theirs. `fitted`: by
/// falling evidence.
pub(in crate::learn) fn instead_of_one(
    context: &Context<'_>,
    fitted: &[FittedCandidate],
) -> [Vec<LawInstead>; 2] {
    let pair =
        (fitted.first()).filter(|first| first.converged && first.candidate.effects.len() == 2);
    let Some(pair) = pair else {
        return Default::default();
    };
    let cards = pair.candidate.effects.cards().par_iter();
    let laws = cards
        .filter(|card| !card.is_wave_along_flank())
        .filter_map(|&card| {
            let is_of_time = card.changes_k_over_time_alone();
            let replaced = EffectSet::new([card]);
            let law = instead_of(
                context,
                fitted,
                pair,
                replaced,
                if is_of_time { TIMES } else { PLACES },
            )?;
            Some((is_of_time, law))
        });
    let (times, places): (Vec<_>, Vec<_>) = laws
        .collect::<Vec<_>>()
        .into_iter()
        .partition(|(is_of_time, _)| *is_of_time);
    [places, times].map(|laws| laws.into_iter().map(|(_, law)| law).collect())
}

/// The law of these `drivers` beside the other effect of the pair; none where the analytic model leaves it far behind the pair.
fn instead_of(
    context: &Context<'_>,
    fitted: &[FittedCandidate],
    pair: &FittedCandidate,
    replaced: EffectSet,
    drivers: &[&str],
) -> Option<LawInstead> {
    let rest = pair.candidate.effects.without(&replaced);
    // by a coarser model its evidence would hold that one's own error
    let least_fine = context.fidelity.min(Fidelity::Middle);
    let is_rest = |f: &&FittedCandidate| f.candidate.effects == rest && f.fidelity >= least_fine;
    let beside = fitted.iter().find(is_rest)?;
    let least = pair.log_evidence - beside.log_evidence - FAR_BEHIND;
    let (name, ahead) = learned_drivers::best_over(context, beside, drivers, (pair, least))?;
    Some(LawInstead {
        beside: rest,
        instead_of: replaced,
        name,
        log_evidence: pair.log_evidence + ahead,
    })
}
