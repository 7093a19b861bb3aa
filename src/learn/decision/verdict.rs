//! From probabilities to a verdict.
//!
//! With p(0), p(u), and the effects' p of which p₁ is the largest and Σ the sum, the first that holds is the verdict:
//!
//! ```text
//! nothing_missing   p(0) ≥ p(u) and p(0) ≥ Σ,  or  p(0) ≥ doubt and p(u) < Σ and p(0) > p₁
//! effect, effects   p(0) < doubt and p₁ ≥ claim
//! partial           p(0) < doubt, and what holds the most probable effect beside something unknown (that, the effect alone, and every set
//!                   with it) ≥ claim, unless its own is at most alike · p₁; or the same of all those beside something unknown that are alike (> alike ·
//!                   the most probable of them), and not of several of them alone, or all those beside something unknown together: then they are a group
//! unknown           p(u) ≥ Σ and p(u) ≥ p(0), and p(u) ≥ claim where nothing smooth stands out of the noise, unless what holds the most probable effect beside something unknown is more probable than
//!                   something unknown alone                   p(u): with all that stands beside something unknown
//! ambiguous         else: all with p > alike · p₁, and nothing or unknown where ≥ doubt (the larger of them if the leader stands alone);
//!                   if that exception holds, the effect beside something unknown and something unknown alone
//! ```

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::evidence::{CandidateEvidence, Evidence};
use super::posterior::log_probabilities;
use super::rule::DecisionRule;
use crate::learn::hypothesis::{EffectSet, Hypothesis};

/// What is missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Nothing that these data show.
    NothingMissing,
    /// One effect.
    Effect,
    /// Several at once.
    Effects,
    /// Two or more that the data cannot tell apart.
    Ambiguous,
    /// An effect is established, and something else remains.
    Partial,
    /// Something that the catalogue does not hold.
    Unknown,
}

/// What the rule says.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// What is missing.
    pub verdict: Verdict,
    /// ln probability of every hypothesis; finite also where the probability itself is below what a number can hold.
    pub log_probabilities: BTreeMap<Hypothesis, f64>,
    /// Effects and sets by falling probability; equal ones by the evidence of their best form, then by the fall of χ².
    pub effects: Vec<EffectSet>,
    /// What the data cannot tell apart, the leader first; of one or none where there is no such group.
    pub group: Vec<Hypothesis>,
}

impl Decision {
    /// The probability of a hypothesis; 0 of one that was not judged.
    pub fn probability(&self, hypothesis: &Hypothesis) -> f64 {
        let log = self.log_probabilities.get(hypothesis);
        log.map_or(0.0, |log| log.exp())
    }

    /// The probability of effects.
    pub fn probability_of(&self, effects: &EffectSet) -> f64 {
        self.probability(&Hypothesis::Effects(effects.clone()))
    }

    /// The probability that `effects` are missing, alone, beside others of the catalogue or beside something unknown.
    pub fn probability_in_all(&self, effects: &EffectSet) -> f64 {
        held(&self.log_probabilities, &[effects])
    }

    /// The most probable effect or set that alone is missing.
    pub fn leader(&self) -> Option<&EffectSet> {
        self.effects.first()
    }

    /// The effects that a person is shown as the leading ones: those that something unknown stands beside where such lead the group, else
    /// the most probable effect or set.
    pub fn leading_effects(&self) -> Option<&EffectSet> {
        match self.group.first() {
            Some(Hypothesis::EffectsAndUnknown(effects)) => Some(effects),
            _ => self.leader(),
        }
    }
}

/// The decision on `evidence` by `rule`: a function of nothing else, and of no order or name of the candidates.
pub fn decide(evidence: &Evidence, rule: &DecisionRule) -> Decision {
    let log_probabilities = log_probabilities(evidence, rule);
    let effects = by_probability(evidence, &log_probabilities);
    let log = |hypothesis: &Hypothesis| log_probabilities[hypothesis];
    let (log_nothing, log_unknown) = (log(&Hypothesis::NothingMissing), log(&Hypothesis::Unknown));
    let log_of: Vec<f64> = (effects.iter())
        .map(|effects| log(&Hypothesis::Effects(effects.clone())))
        .collect();
    let remainders = with_remainder(evidence, &log_probabilities);
    let mass = Mass {
        nothing: log_nothing.exp(),
        unknown: log_unknown.exp(),
        named: log_of.iter().map(|log| log.exp()).sum(),
        leading: log_of.first().map_or(0.0, |log| log.exp()),
        partial: remainders.iter().map(|(_, p)| p).sum(),
    };
    let verdict = verdict(
        evidence,
        &mass,
        &effects,
        &remainders,
        &log_probabilities,
        rule,
    );
    let group = match verdict {
        Verdict::NothingMissing | Verdict::Unknown => Vec::new(),
        Verdict::Effect | Verdict::Effects | Verdict::Ambiguous => match remainders.first() {
            Some((leader, p))
                if verdict == Verdict::Ambiguous && mass.is_unnamed() && *p > mass.leading =>
            {
                let leader = Hypothesis::EffectsAndUnknown((*leader).clone());
                vec![leader, Hypothesis::Unknown]
            }
            _ => look_alikes(verdict, &mass, &effects, &log_of, rule),
        },
        Verdict::Partial => {
            // as with effects alone, one that is probable enough has no look-alikes
            let leader = remainders[0].0;
            let own = if held(&log_probabilities, &[leader]) >= rule.claim {
                vec![leader]
            } else {
                alike(&remainders, rule)
            };
            (own.into_iter())
                .map(|effects| Hypothesis::EffectsAndUnknown(effects.clone()))
                .collect()
        }
    };
    Decision {
        verdict,
        log_probabilities,
        effects,
        group,
    }
}

/// Probabilities by kind of hypothesis.
struct Mass {
    nothing: f64,
    /// Something unknown alone.
    unknown: f64,
    /// All effects and sets that alone are missing, and the most probable of them.
    named: f64,
    leading: f64,
    /// All effects beside something unknown.
    partial: f64,
}

impl Mass {
    /// Whether something unknown, alone or beside an effect, is more probable than nothing missing and than all that the catalogue names alone.
    fn is_unnamed(&self) -> bool {
        let unknown = self.unknown + self.partial;
        unknown >= self.named && unknown >= self.nothing
    }
}

/// The first verdict of which the condition holds.
fn verdict(
    evidence: &Evidence,
    mass: &Mass,
    effects: &[EffectSet],
    remainders: &[(&EffectSet, f64)],
    logs: &BTreeMap<Hypothesis, f64>,
    rule: &DecisionRule,
) -> Verdict {
    let &Mass {
        nothing,
        named,
        leading,
        partial,
        ..
    } = mass;
    let unknown = mass.unknown + partial;
    if nothing >= unknown && nothing >= named
        || nothing >= rule.doubt && unknown < named && nothing > leading
    {
        return Verdict::NothingMissing;
    }
    let all = named + nothing + unknown;
    if nothing < rule.doubt && leading >= rule.claim * all {
        return match effects[0].single() {
            Some(_) => Verdict::Effect,
            None => Verdict::Effects,
        };
    }
    if let Some((first, p)) = remainders.first() {
        // one or more effects of which one is missing, and more often beside something unknown than alone
        let is_established = |effects: &[&EffectSet]| {
            let sum = |of: fn(EffectSet) -> Hypothesis| -> f64 {
                let logs = effects.iter().filter_map(|&own| logs.get(&of(own.clone())));
                logs.map(|log| log.exp()).sum()
            };
            sum(Hypothesis::EffectsAndUnknown) >= sum(Hypothesis::Effects)
                && partial >= of_these_alone(logs, effects)
                && held(logs, effects) >= rule.claim * all
        };
        let is_partial = *p > rule.alike * leading
            && (is_established(&[first]) || is_established(&alike(remainders, rule)));
        if nothing < rule.doubt && (is_partial || partial >= rule.claim * all) {
            return Verdict::Partial;
        }
    }
    let alone_is_less = |&(effect, _): &(&EffectSet, f64)| held(logs, &[effect]) > mass.unknown;
    let is_shown = evidence.is_discrepant() || unknown >= rule.claim;
    if mass.is_unnamed() && is_shown && !remainders.first().is_some_and(alone_is_less) {
        Verdict::Unknown
    } else {
        Verdict::Ambiguous
    }
}

/// The leader, what the data cannot tell from it, and what keeps it from being named.
fn look_alikes(
    verdict: Verdict,
    mass: &Mass,
    effects: &[EffectSet],
    log_of: &[f64],
    rule: &DecisionRule,
) -> Vec<Hypothesis> {
    let log_leading = log_of.first().copied().unwrap_or(f64::NEG_INFINITY);
    let mut group: Vec<Hypothesis> = (effects.iter().zip(log_of))
        .filter(|(_, log)| **log > rule.alike.ln() + log_leading)
        .map(|(effects, _)| Hypothesis::Effects(effects.clone()))
        .collect();
    if verdict == Verdict::Ambiguous {
        let unknown = mass.unknown + mass.partial;
        let others = [
            (Hypothesis::NothingMissing, mass.nothing),
            (Hypothesis::Unknown, unknown),
        ];
        let doubted = others.iter().filter(|other| other.1 >= rule.doubt);
        group.extend(doubted.map(|other| other.0.clone()));
        if group.len() < 2 {
            // What keeps the leader from being named is then the more probable of these.
            let [zero, one] = others;
            group.push(if mass.nothing > unknown {
                zero.0
            } else {
                one.0
            });
        }
    }
    group
}

/// Of what stands beside something unknown, the most probable and all that the data cannot tell from it.
fn alike<'e>(remainders: &[(&'e EffectSet, f64)], rule: &DecisionRule) -> Vec<&'e EffectSet> {
    let most = remainders.first().map_or(0.0, |(_, p)| *p);
    let own = remainders.iter().filter(|(_, p)| *p >= rule.alike * most);
    own.map(|(effects, _)| *effects).collect()
}

/// The probability of all hypotheses that hold any of `effects`.
fn held(logs: &BTreeMap<Hypothesis, f64>, effects: &[&EffectSet]) -> f64 {
    let holds = |hypothesis: &Hypothesis| match hypothesis {
        Hypothesis::Effects(own) | Hypothesis::EffectsAndUnknown(own) => {
            effects.iter().any(|effects| own.contains(effects))
        }
        Hypothesis::NothingMissing | Hypothesis::Unknown => false,
    };
    let all = logs.iter().filter(|(hypothesis, _)| holds(hypothesis));
    all.map(|(_, log)| log.exp()).sum()
}

/// The probability of all sets of two and more of `effects`, with nothing beside.
fn of_these_alone(logs: &BTreeMap<Hypothesis, f64>, effects: &[&EffectSet]) -> f64 {
    let is_of_these = |set: &EffectSet| {
        let mut cards = set.cards().iter();
        set.len() > 1 && cards.all(|&card| effects.contains(&&EffectSet::new([card])))
    };
    let all = logs.iter().filter(|(hypothesis, _)| match hypothesis {
        Hypothesis::Effects(set) => is_of_these(set),
        _ => false,
    });
    all.map(|(_, log)| log.exp()).sum()
}

/// Single effects beside something unknown with their probability, the most probable first.
fn with_remainder<'e>(
    evidence: &'e Evidence,
    logs: &BTreeMap<Hypothesis, f64>,
) -> Vec<(&'e EffectSet, f64)> {
    let mut all: Vec<(&EffectSet, f64)> = (evidence.beside_unknown.iter())
        .filter_map(|r| {
            let hypothesis = Hypothesis::EffectsAndUnknown(r.effects.clone());
            Some((&r.effects, logs.get(&hypothesis)?.exp()))
        })
        .collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(b.0)));
    all
}

/// Effects and sets by falling probability. By its logarithm: far behind, probabilities themselves are all 0, and no name may be chosen
/// by its place in the alphabet.
fn by_probability(evidence: &Evidence, logs: &BTreeMap<Hypothesis, f64>) -> Vec<EffectSet> {
    let best = |effects: &EffectSet, of: fn(&CandidateEvidence) -> f64| {
        let own = evidence.candidates.iter().filter(|c| c.effects == *effects);
        own.map(of).fold(f64::NEG_INFINITY, f64::max)
    };
    let mut all: Vec<(f64, [f64; 2], &EffectSet)> = (logs.iter())
        .filter_map(|(hypothesis, log)| {
            let effects = hypothesis.effects()?;
            let best = [
                best(effects, |c| c.evidence_gain),
                best(effects, |c| c.chi2_drop),
            ];
            Some((*log, best, effects))
        })
        .collect();
    all.sort_by(|a, b| {
        (b.0.total_cmp(&a.0))
            .then(b.1[0].total_cmp(&a.1[0]))
            .then(b.1[1].total_cmp(&a.1[1]))
    });
    all.into_iter()
        .map(|(.., effects)| effects.clone())
        .collect()
}
