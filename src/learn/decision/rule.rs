//! The thresholds of the decision, and where each was chosen.

use serde::{Deserialize, Serialize};

/// Probability of nothing missing below which that is undecided. Of the blind sets of the second and third series with 0.8 or more,
/// 65 of 72 hide nothing and the others an effect of d < 6; of those with 0.5 to 0.8, 31 of 48, and one an effect of d ≥ 6.
pub(in crate::learn) const SURE: f64 = 0.8;

/// The thresholds of [`super::decide`].
///
/// "Series 1 to 5" are sets of measurements with known causes, made by a program that shares no code with this one
/// (`validation/blind`; what each threshold trades is in `validation/blind/THRESHOLDS.md`). Priors are set by calibration, not by
/// belief: with equal priors over all hypotheses 26 to 100 % of the sets that hide nothing raise a false alarm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DecisionRule {
    /// Prior probability of `nothing_missing`. 0.5: no false alarm at 2 % noise, 2 % at 10 %.
    pub prior_nothing: f64,
    /// Prior probability of `unknown`.
    pub prior_unknown: f64,
    /// Prior probability of all single effects together, shared evenly, by each evenly among its forms.
    pub prior_singles: f64,
    /// Prior probability of all pairs together, shared evenly.
    pub prior_pairs: f64,
    /// Added to the log evidence of the unknown, a mean over many kinds and sizes of discrepancy of which few fit anything: where nothing
    /// is missing its odds must average 1, and did 0.12 over 70 sets of series 1 (largest gain 0.3). No false alarm follows from it.
    pub unknown_offset: f64,
    /// T: differences of log evidence between effects are divided by it, because forms and noise are not known exactly (Grünwald & van
    /// Ommen, Bayesian Analysis 12, 2017: posteriors of misspecified models are too sure of themselves). Of series 1 to 5.
    pub temper: f64,
    /// Least share of the attainable fall of χ² for one effect. On 95 sets of d ≥ 6 by coarse elements single effects accounted for at most
    /// 83 % of 41 of 44 discrepancies that the catalogue lacks, and the catalogue's own, in other forms too, for at least 86 % of 47 of 51.
    pub single_share: f64,
    /// How sharply, in units of the share: the width of the logistic.
    pub single_share_width: f64,
    /// Standard deviations of the share that count in a single effect's favour.
    pub single_share_spreads: f64,
    /// ln Z(effect and discrepancy) − ln Z(effect) up to which evidence denies a remainder beside a single effect. The ln odds that a small share
    /// speaks against the effect are at most what the evidence lies above this, and at least even: noise alone moves the share of a weak
    /// discrepancy. In three diagnoses of one set, effects that left nothing had −1 to −4, wrong ones 5 to 15; no series has been judged with it.
    pub remainder_denied: f64,
    /// Least share for two effects together: with twice the freedom they come nearer to anything; pairs that were really there
    /// accounted for all of it.
    pub pair_share: f64,
    /// Its width.
    pub pair_share_width: f64,
    /// Standard deviations of the share that count in a pair's favour: in 20 of 21 sets the pairs that were really there left at most
    /// 1.5, the best pairs of outer causes 2.6 and more.
    pub pair_share_spreads: f64,
    /// Least fall of χ² by the weaker effect of a pair, over that by the stronger one alone; with less it mends the form of the stronger
    /// one and is no effect: an effect in a form of its own left up to 8 %.
    pub second_share: f64,
    /// Its width.
    pub second_share_width: f64,
    /// Odds of another cause of the same pattern where the data do not determine the parameter that an effect is known by: neither is then
    /// to be named.
    pub unidentified_odds: f64,
    /// Odds of another cause of the same pattern where a sum of waves along the flank stands beside something unknown: six of the ten outer causes of the
    /// series act by the place on the flank, and one effect of the catalogue's 32 is such a sum.
    pub free_shape_odds: f64,
    /// Prior odds of one effect beside something unknown, shared evenly among the single effects, to something unknown alone.
    pub remainder_odds: f64,
    /// Share of the discrepancy's own gain of log evidence that an effect beside it must gain more than: a discrepancy of a slightly other kind gains as much. A free
    /// parameter of any kind did, in measurements whose base model was another one (DECISIONS.md, "A base model that is far off").
    pub discrepancy_tolerance: f64,
    /// Share of what an effect and the remainder bring together from which the remainder is more than another form of the effect leaves.
    pub remainder_share: f64,
    /// Its width.
    pub remainder_share_width: f64,
    /// ln Z(effect and discrepancy) − ln Z(discrepancy alone) from which an effect that by itself brings a smaller share is no mend of the discrepancy's form:
    /// four that were not there gained 14 to 21 and brought 1 to 8 %, those that were there brought 38 % and more.
    pub remainder_mended: f64,
    /// Probability from which a single effect or set is named.
    pub claim: f64,
    /// Probability of nothing missing from which no effect is claimed; of that or of the unknown, from which a group holds it.
    pub doubt: f64,
    /// Effects with less than this share of the leader's probability are no look-alikes of it.
    pub alike: f64,
}

impl Default for DecisionRule {
    fn default() -> Self {
        Self {
            prior_nothing: 0.5,
            prior_unknown: 0.1,
            prior_singles: 0.35,
            prior_pairs: 0.05,
            unknown_offset: 1.2,
            temper: 1.8,
            single_share: 0.85,
            single_share_width: 0.03,
            single_share_spreads: 1.0,
            remainder_denied: -1.0,
            pair_share: 0.95,
            pair_share_width: 0.025,
            pair_share_spreads: 1.5,
            second_share: 0.10,
            second_share_width: 0.012,
            unidentified_odds: 0.5,
            free_shape_odds: 4.0,
            remainder_odds: 0.5,
            discrepancy_tolerance: 0.01,
            remainder_share: 0.08,
            remainder_share_width: 0.012,
            remainder_mended: 30.0,
            claim: 0.85,
            doubt: 0.2,
            alike: 0.03,
        }
    }
}

impl DecisionRule {
    /// Where the analytic model decides in place of finite elements: what it leaves of an effect is partly its own error (the hidden
    /// running-in of the example accounts for 87 % by it and for all by finite elements).
    pub fn of_analytic_model() -> Self {
        Self {
            single_share: 0.75,
            ..Self::default()
        }
    }
}
