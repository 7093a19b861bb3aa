//! A free law of one variable, fitted instead of an effect that leads.

use crate::learn::hypothesis::EffectSet;

/// ln evidence by which the first law may be behind for a second to be fitted beside other effects, and a law behind a pair by the analytic model for finite
/// elements to be asked.
pub(super) const FAR_BEHIND: f64 = 30.0;

/// A factor on k by the place on the flank or by the time, fitted instead of an effect.
pub(in crate::learn) struct LawInstead {
    /// The effects beside it; empty: none.
    pub(in crate::learn) beside: EffectSet,
    /// The effect that it replaces.
    pub(in crate::learn) instead_of: EffectSet,
    /// `learned:s`, `learned:radius:pinion`, `learned:cycles`.
    pub(in crate::learn) name: String,
    /// Log evidence with the effects and it.
    pub(in crate::learn) log_evidence: f64,
}
