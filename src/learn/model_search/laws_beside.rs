//! A free law of one variable beside each of several effects that something unknown stands beside.
//!
//! A discrepancy of the results follows most of what an effect does as well, so it may leave open which effect it stands beside. What nobody knows acts
//! through the mechanics, and mostly as a factor on k that follows one variable. Beside the right effect such a factor comes near the noise, beside a
//! wrong one it does not. Coarse finite elements tell that; the analytic model's own error is a law of the place.

use rayon::prelude::*;

use super::beside_unknown::BesideUnknown;
use super::context::Context;
use super::learned_drivers;
use crate::learn::candidates::fitted_candidate::BaseFit;
use crate::learn::hypothesis::EffectSet;

/// The best law beside an effect.
pub(in crate::learn) struct LawBeside {
    /// The effect; none of a law alone.
    pub(in crate::learn) effects: EffectSet,
    /// `learned:s`, `learned:radius:pinion`, `learned:cycles`.
    pub(in crate::learn) name: String,
    /// ln Z(effect and law) by coarse finite elements.
    pub(in crate::learn) log_evidence: f64,
    /// ln Z(effect and law) − ln Z(effect) by the same.
    pub(in crate::learn) gain: f64,
}

/// The best law beside no effect, as a curve or as a plain formula; None where the analytic model can fit none.
pub(in crate::learn) fn alone(context: &Context<'_>, base: &BaseFit) -> Option<LawBeside> {
    let (name, log_evidence, gain) = learned_drivers::place_or_time(context, &base.fitted)?;
    Some(LawBeside {
        effects: EffectSet::new([]),
        name,
        log_evidence,
        gain,
    })
}

/// The best law beside each of `effects`; none of one that the analytic model cannot fit.
pub(in crate::learn) fn of(context: &Context<'_>, effects: &[&BesideUnknown]) -> Vec<LawBeside> {
    let best = |beside: &&BesideUnknown| {
        let (name, log_evidence, gain) = learned_drivers::place_or_time(context, &beside.fitted)?;
        Some(LawBeside {
            effects: beside.fitted.candidate.effects.clone(),
            name,
            log_evidence,
            gain,
        })
    };
    effects.par_iter().filter_map(best).collect()
}
