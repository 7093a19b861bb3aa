//! What a decision is taken on: figures only, as they stand in `diagnosis.json`.

use serde::{Deserialize, Serialize};

use crate::learn::discrepancy::smooth::is_significant;
use crate::learn::hypothesis::EffectSet;

/// All that the decision rule knows of the fits to a set of measurements. It can be read from a `diagnosis.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// Everything that was fitted beside the base model, in any order.
    #[serde(rename = "screened")]
    pub candidates: Vec<CandidateEvidence>,
    /// A: fall of χ² that anything smooth could bring, beyond what as many terms gain on noise.
    pub attainable_drop: f64,
    /// Whether A is twice the gain of log evidence in place of a fall of χ² within the tests: the agreement of the tests' own k counts in it.
    #[serde(default)]
    pub attainable_by_evidence: bool,
    /// Standard deviation of A on noise alone.
    pub attainable_spread: f64,
    /// ln Z of a Gaussian-process discrepancy over ln Z of the base model.
    pub unknown_evidence_gain: f64,
    /// Effects fitted together with a discrepancy; none where nothing smooth is missed.
    #[serde(default)]
    pub beside_unknown: Vec<RemainderEvidence>,
    /// Free factors on k by the place on the flank, fitted instead of a sum of waves that leads; none where none does.
    #[serde(default)]
    pub place_laws: Vec<LawInsteadEvidence>,
    /// Free factors on k by the time, fitted instead of an effect that leads and changes k over time alone; none where none does, or it leaves nothing.
    #[serde(default)]
    pub time_laws: Vec<LawInsteadEvidence>,
    /// Free factors on k beside each of several effects that something unknown stands beside; none where one of them is established without.
    #[serde(default)]
    pub laws_beside: Vec<LawBesideEvidence>,
    /// The best law of the place or the time beside no effect; None where effects beside something unknown are improbable.
    #[serde(default)]
    pub law_alone: Option<LawAloneEvidence>,
}

/// A factor on k by the place or the time as what nobody knows, beside no effect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LawAloneEvidence {
    /// `learned:s`, or with its plain form: `learned:s as step_from_a_moment`.
    pub law: String,
    /// ln Z(law) over the base model's, by coarse finite elements.
    pub evidence_gain: f64,
    /// The most of ln Z(effect and law) over the same, of the effects that laws were fitted beside; None of none.
    pub beside_effects: Option<f64>,
}

/// A factor on k as a free smooth function of one variable, fitted beside an effect as what nobody knows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LawBesideEvidence {
    /// The effect.
    pub effects: EffectSet,
    /// The best law of the place or the time, such as `learned:cycles`.
    pub law: String,
    /// ln Z(effect and law) over the smallest of these by coarse finite elements.
    pub evidence_gain: f64,
    /// ln Z(effect and law) − ln Z(effect) by the same.
    pub law_gain: f64,
    /// ln Z(effect and law) over the base model's by the same; None where no law alone was fitted, which that is known by.
    #[serde(default)]
    pub gain_over_base: Option<f64>,
}

/// A factor on k as a free smooth function of one variable, fitted instead of an effect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LawInsteadEvidence {
    /// The effects that it was fitted beside; empty: none.
    pub beside: EffectSet,
    /// The effect, such as a sum of waves.
    pub instead_of: EffectSet,
    /// `learned:s`, `learned:radius:pinion`, `learned:cycles`.
    pub law: String,
    /// ln Z(effects and law) over the base model's.
    pub evidence_gain: f64,
}

/// An effect judged beside something unknown.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RemainderEvidence {
    /// The effect or pair, in its form of the largest evidence beside the discrepancy.
    pub effects: EffectSet,
    /// Whether the data determine the parameter by which the effect is known.
    pub identified: bool,
    /// Whether it is a sum of waves along the flank, which follows whatever is smooth there.
    #[serde(default)]
    pub free_shape: bool,
    /// ln Z(effect and discrepancy) − ln Z(discrepancy alone): the smaller of the two below.
    pub gain_over_unknown: f64,
    /// The same with the discrepancy that is most probable without the effect; None in documents of older programs.
    #[serde(default)]
    pub gain_with_one: Option<f64>,
    /// The same with every kind and size of discrepancy.
    #[serde(default)]
    pub gain_with_any: Option<f64>,
    /// ln Z(effect and discrepancy) − ln Z(effect).
    pub remainder_gain: f64,
    /// Fall of χ² by the effect alone.
    pub chi2_drop: f64,
    /// Fall of χ² that anything smooth could still bring once the effect is in.
    pub remaining_drop: f64,
    /// Standard deviation of that on noise alone.
    pub remaining_spread: f64,
}

impl RemainderEvidence {
    /// Whether something is left beside the effect.
    pub fn is_remaining(&self) -> bool {
        is_significant(self.remaining_drop, self.remaining_spread)
    }
}

/// One form of one effect, or of several together, as fitted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CandidateEvidence {
    /// The effects added to the base model.
    pub effects: EffectSet,
    /// Number of accepted forms that share the prior of these effects.
    pub accepted_forms: usize,
    /// Whether the data determine the parameter by which the effect is known.
    pub identified: bool,
    /// ln Z over the base model's.
    pub evidence_gain: f64,
    /// Fall of the whole χ² against the base model.
    pub chi2_drop: f64,
    /// How much more probable the tests' own deviations of k are than with the base model, ln of the density under their scatter.
    #[serde(default)]
    pub scatter_gain: f64,
}

/// Share of what a discrepancy gains beside an effect from which a law beside it stands for what is unknown.
const LAW_IS_ENOUGH: f64 = 0.5;

impl Evidence {
    /// The best law beside an effect, if what it does there is enough to tell by the laws which effect it is that something unknown stands beside.
    pub fn telling_law(&self) -> Option<&LawBesideEvidence> {
        let laws = self.laws_beside.iter();
        let best = laws.max_by(|a, b| a.evidence_gain.total_cmp(&b.evidence_gain))?;
        let own = (self.beside_unknown.iter()).find(|r| r.effects == best.effects)?;
        (best.law_gain >= LAW_IS_ENOUGH * own.remainder_gain).then_some(best)
    }

    /// ln evidence by which the best law alone is ahead of the best of effects beside something unknown, a discrepancy or a law; None without either.
    pub fn law_ahead(&self) -> Option<f64> {
        let law = self.law_alone.as_ref()?;
        let best = law
            .beside_effects
            .into_iter()
            .chain(self.beside_discrepancy());
        Some(law.evidence_gain - best.reduce(f64::max)?)
    }

    /// ln evidence over the base model's of something unknown alone, a discrepancy or a law of those that were tried: what an effect and a law beside it must
    /// gain more than. `tolerance`: of a discrepancy's gain, the share that one of another kind gains as well; `tried`: ln of how many laws were tried.
    pub fn unknown_alone(&self, tolerance: f64, tried: f64) -> f64 {
        let discrepancy = self.unknown_evidence_gain * (1.0 + tolerance) + tried;
        let law = self.law_alone.as_ref().map(|law| law.evidence_gain);
        law.map_or(discrepancy, |law| law.max(discrepancy))
    }

    /// The most of ln Z(effect and discrepancy) over the base model's; None where none was fitted.
    pub fn beside_discrepancy(&self) -> Option<f64> {
        let all = self.beside_unknown.iter();
        let gains = all.map(|r| r.gain_over_unknown + self.unknown_evidence_gain);
        gains.reduce(f64::max)
    }

    /// Whether there is a discrepancy to be accounted for.
    pub fn is_discrepant(&self) -> bool {
        is_significant(self.attainable_drop, self.attainable_spread)
    }

    /// The share of the attainable fall of χ² that a candidate accounts for; 1 where there is no discrepancy.
    pub fn share(&self, candidate: &CandidateEvidence) -> f64 {
        if self.is_discrepant() {
            self.fall(candidate) / self.attainable_drop
        } else {
            1.0
        }
    }

    /// What a candidate brings of what A counts: the fall of χ², and with the agreement of the tests' own k that of −2 ln of their density too.
    pub fn fall(&self, candidate: &CandidateEvidence) -> f64 {
        if self.attainable_by_evidence {
            candidate.chi2_drop + 2.0 * candidate.scatter_gain
        } else {
            candidate.chi2_drop
        }
    }
}
