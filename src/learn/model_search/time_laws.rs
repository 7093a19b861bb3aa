//! A law of the time instead of an effect that leads and changes k over time alone.
//!
//! Running-in, ageing oil and debris each follow in part whatever changes k slowly: a step after some cycles, a change of oil, a rig that was taken apart.
//! So where one of them leads alone and leaves something that a smooth discrepancy would take up, a free factor on k by the cycles is fitted instead.

use super::context::Context;
use super::law_instead::LawInstead;
use super::learned_drivers::{self, TIMES};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::EffectSet;
use crate::learn::model_search::beside_unknown::BesideUnknown;

/// ln evidence for something beside the effect from which a law is worth its fits: effects that were there had -2 to -4.
const LEFT: f64 = 3.0;

/// The law instead of what leads; none where it does more than change k over time, or leaves nothing. `fitted`: by falling evidence.
pub(in crate::learn) fn instead_of_slow_change(
    context: &Context<'_>,
    base: &BaseFit,
    fitted: &[FittedCandidate],
    beside_unknown: &[BesideUnknown],
) -> Option<LawInstead> {
    let leader = &fitted.first()?.candidate.effects;
    let card = leader
        .single()
        .filter(|card| card.changes_k_over_time_alone())?;
    let own = beside_unknown
        .iter()
        .find(|beside| beside.fitted.candidate.effects == *leader)?;
    if own.remainder_gain < LEFT {
        return None;
    }
    let (name, gain) = learned_drivers::best_of(context, &base.fitted, TIMES)?;
    Some(LawInstead {
        beside: EffectSet::new([]),
        instead_of: EffectSet::new([card]),
        name,
        log_evidence: base.fitted.log_evidence + gain,
    })
}
