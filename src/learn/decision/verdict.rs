//! From evidence to probabilities and a verdict.
//!
//! Candidates c are the fitted forms of effects and pairs. All log evidence is over the base model's.
//!
//! ```text
//! q(c) = exp(Δ ln Z_c) π_c/forms_c              π_c: prior of singles (pairs) over the number of single effects (pairs)
//! t(c) = q* (q(c)/q*)^(1/T)                     q* the largest q
//! s(c) = Δχ²_c/A,  δ = sd(A)/max(A, 1)          A: attainable fall of χ²; s = 1 if A < 5 sd(A)
//! x(c) = (s_min − s(c) − m δ)/width             ln odds that such a share is not the missing effect's own; of a single effect at most
//!        max(0, ln Z_R(c) − ln Z_c − r)         R(c): the same beside a discrepancy. Evidence that denies a remainder leaves even odds
//! y(c) = (r_min − r(c))/width                   for pairs: r the fall of χ² added to the stronger effect's alone, over that fall
//! S(x) = 1/(1 + eˣ)
//!
//! weight of   nothing_missing     π_0
//!             a single effect     Σ_forms t S(x)              + Σ_pairs of which it is the stronger t S(x) S(−y)
//!             a pair              Σ_forms t S(x) S(y)
//!             unknown             W + Σ_c not identified t S(x) o             W: Σ_c t S(−x) + min(u, cap)
//! u = Z_GP/Z_base e^offset π_u,     ln cap = ln t* + max(x*, Δ ln Z_GP − Δ ln Z*)          *: the candidate with the largest t; of a pair
//!                                   max(x*, ln u − ln q*)                                no cap where nothing smooth is missed
//! ```
//! A free discrepancy follows what remains of an effect in another form too. It counts only as far as the leader's share leaves room
//! for it, or its evidence exceeds the leader's: effects that were really there never let that happen (97 of 99 sets gained at least 1.8
//! more; the other two had not been found). Pairs are held against it with their priors: two effects of wavelike shapes follow anything smooth as well as
//! it does (a starved band gave 9 of log evidence to a load and a profile of two waves each; pairs that were really there gained 49 and more).
//!
//! W, which is not the effects' own, is shared between something unknown alone and effects beside something unknown, and where an effect
//! leaves more than a tolerance of its form explains, so is what is its own (R: what the effects brought fitted beside a discrepancy,
//! `n` single effects, r the share of all that is left once the effect is in, if that is more than noise):
//!
//! ```text
//! v(R) = exp(Δ ln Z_R/T) o_R/n                  Δ ln Z_R: over that of the discrepancy alone
//! unknown: W/(1 + Σ v),  R and unknown: W w Σ v/(1 + Σ v)      of which o/(1 + o) is unknown's if R is not identified or a free shape
//! R and unknown besides:  weight(R) S((r_min − r)/width),      taken from R
//! ```
//! Δ ln Z_R is the smaller of two figures: with the discrepancy that is most probable without the effect, and with every kind and size of it. By the
//! first the discrepancy has taken what it can of the effect already, by the second anything that mends the discrepancy is an effect. The share w of
//! R among the named is the mean of what both give, e^(Δ ln Z_R/T) over its sum, where both are above 0.
//!
//! With p(0), p(u), and the effects' p of which p₁ is the largest and Σ the sum, the first that holds is the verdict:
//!
//! ```text
//! nothing_missing   p(0) ≥ p(u) and p(0) ≥ Σ,  or  p(0) ≥ doubt and p(u) < Σ and p(0) > p₁
//! effect, effects   p(0) < doubt and p₁ ≥ claim
//! partial           p(0) < doubt, and what holds the most probable effect beside something unknown (that, the effect alone, and every set
//!                   with it) ≥ claim, unless its own is at most alike · p₁; or the same of all those beside something unknown that are alike (> alike ·
//!                   the most probable of them), and not of several of them alone, or all those beside something unknown together: then they are a group
//! unknown           p(u) ≥ Σ and p(u) ≥ p(0), unless what holds the most probable effect beside something unknown is more probable than
//!                   something unknown alone                   p(u): with all that stands beside something unknown
//! ambiguous         else: all with p > alike · p₁, and nothing or unknown where ≥ doubt (the larger of them if the leader stands alone);
//!                   if that exception holds, the effect beside something unknown and something unknown alone
//! ```

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::evidence::{CandidateEvidence, Evidence, RemainderEvidence};
use super::rule::DecisionRule;
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::numeric::logarithm::{log_sum_exp, softplus};

/// Fall of χ² by which another form of an effect may be behind and leave as much.
const LEAVES_AS_MUCH: f64 = 1.0;

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
    let verdict = verdict(&mass, &effects, &remainders, &log_probabilities, rule);
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
    if mass.is_unnamed() && !remainders.first().is_some_and(alone_is_less) {
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

/// Effects beside something unknown with their probability, the most probable first.
fn with_remainder<'e>(
    evidence: &'e Evidence,
    logs: &BTreeMap<Hypothesis, f64>,
) -> Vec<(&'e EffectSet, f64)> {
    let mut all: Vec<(&EffectSet, f64)> = (evidence.beside_unknown.iter())
        .map(|r| {
            let hypothesis = Hypothesis::EffectsAndUnknown(r.effects.clone());
            (&r.effects, logs[&hypothesis].exp())
        })
        .collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(b.0)));
    all
}

/// Posterior probabilities of all hypotheses.
fn log_probabilities(evidence: &Evidence, rule: &DecisionRule) -> BTreeMap<Hypothesis, f64> {
    let candidates = sorted(evidence);
    let singles: BTreeSet<&'static str> = (candidates.iter())
        .filter_map(|c| Some(c.effects.single()?.name))
        .collect();
    let count = singles.len().max(1) as f64;
    let pairs = (0.5 * count * (count - 1.0)).max(1.0);
    let log_posterior = |c: &CandidateEvidence| {
        let prior = match c.effects.single() {
            Some(_) => rule.prior_singles / count,
            None => rule.prior_pairs / pairs,
        };
        c.evidence_gain + (prior / c.accepted_forms as f64).ln()
    };
    let most = (candidates.iter().map(|c| log_posterior(c))).fold(f64::NEG_INFINITY, f64::max);
    let doubt = evidence.attainable_spread / evidence.attainable_drop.max(1.0);
    let unknown = evidence.unknown_evidence_gain;
    let alone = unknown + rule.unknown_offset + rule.prior_unknown.ln();
    let mut logs: BTreeMap<Hypothesis, Vec<f64>> = BTreeMap::new();
    let mut add = |hypothesis, log| logs.entry(hypothesis).or_default().push(log);
    add(Hypothesis::NothingMissing, rule.prior_nothing.ln());
    // of the same pattern as an effect: not shared with that effect beside something else
    let mut other_causes = vec![f64::NEG_INFINITY];
    let (mut leading, mut cap) = (f64::NEG_INFINITY, f64::INFINITY);
    for c in &candidates {
        let log = most - (most - log_posterior(c)) / rule.temper;
        let share = evidence.share(c);
        let odds = match c.effects.single() {
            Some(_) => {
                let odds = (rule.single_share - share - rule.single_share_spreads * doubt)
                    / rule.single_share_width;
                match remainder_gain(evidence, c) {
                    Some(gain) => odds.min((gain - rule.remainder_denied).max(0.0)),
                    None => odds,
                }
            }
            None => {
                (rule.pair_share - share - rule.pair_share_spreads * doubt) / rule.pair_share_width
            }
        };
        let own = Hypothesis::Effects(c.effects.clone());
        match stronger_alone(&candidates, c) {
            Some((stronger, second)) => {
                let mends = (rule.second_share - second) / rule.second_share_width;
                add(own, log - softplus(odds) - softplus(mends));
                let stronger = Hypothesis::Effects(stronger.clone());
                add(stronger, log - softplus(odds) - softplus(-mends));
            }
            None => add(own, log - softplus(odds)),
        }
        add(Hypothesis::Unknown, log - softplus(-odds));
        if !c.identified {
            other_causes.push(log - softplus(odds) + rule.unidentified_odds.ln());
        }
        if evidence.is_discrepant() && log > leading {
            leading = log;
            let ahead = match c.effects.single() {
                Some(_) => unknown - c.evidence_gain,
                None => alone - log_posterior(c),
            };
            cap = log + odds.max(ahead);
        }
    }
    add(Hypothesis::Unknown, alone.min(cap));
    let mut logs: BTreeMap<Hypothesis, f64> = (logs.into_iter())
        .map(|(hypothesis, logs)| (hypothesis, log_sum_exp(&logs)))
        .collect();
    share_with_remainders(&mut logs, evidence, rule, count);
    let unknown = [logs[&Hypothesis::Unknown], log_sum_exp(&other_causes)];
    logs.insert(Hypothesis::Unknown, log_sum_exp(&unknown));
    let all: Vec<f64> = logs.values().copied().collect();
    let total = log_sum_exp(&all);
    (logs.into_iter())
        .map(|(hypothesis, log)| (hypothesis, log - total))
        .collect()
}

/// ln evidence for a remainder beside a form of a single effect, where one that leaves as much or more was fitted beside a discrepancy.
fn remainder_gain(evidence: &Evidence, c: &CandidateEvidence) -> Option<f64> {
    let mut fitted = evidence.beside_unknown.iter();
    let own =
        fitted.find(|r| r.effects == c.effects && r.chi2_drop <= c.chi2_drop + LEAVES_AS_MUCH);
    own.map(|r| r.remainder_gain)
}

/// Shares the weight of the unknown, and of effects that leave something, with effects beside something unknown.
fn share_with_remainders(
    logs: &mut BTreeMap<Hypothesis, f64>,
    evidence: &Evidence,
    rule: &DecisionRule,
    singles: f64,
) {
    let mut remainders: Vec<&RemainderEvidence> = evidence.beside_unknown.iter().collect();
    remainders.sort_by(|a, b| a.effects.cmp(&b.effects));
    let odds = |r: &RemainderEvidence| {
        r.gain_over_unknown / rule.temper + (rule.remainder_odds / singles).ln()
    };
    let named: Vec<f64> = remainders.iter().map(|r| odds(r)).collect();
    let named = log_sum_exp(&named);
    let total = softplus(named);
    let shares = shares_of_remainders(&remainders, rule);
    let unknown = logs[&Hypothesis::Unknown];
    logs.insert(Hypothesis::Unknown, unknown - total);
    for (r, share) in remainders.into_iter().zip(shares) {
        let mut beside = vec![unknown + named - total + share];
        let objections = [
            (!r.identified, rule.unidentified_odds),
            (r.free_shape, rule.free_shape_odds),
        ];
        for (_, odds) in objections.into_iter().filter(|(holds, _)| *holds) {
            // another cause of the same pattern is as good, and unknown
            let of_other = beside[0] - softplus(-odds.ln());
            beside[0] -= softplus(odds.ln());
            let unknown = log_sum_exp(&[logs[&Hypothesis::Unknown], of_other]);
            logs.insert(Hypothesis::Unknown, unknown);
        }
        if let Some(alone) = logs.get_mut(&Hypothesis::Effects(r.effects.clone()))
            && r.is_remaining()
        {
            let left = r.remaining_drop / (r.remaining_drop + r.chi2_drop.max(0.0));
            let within = (rule.remainder_share - left) / rule.remainder_share_width;
            beside.push(*alone - softplus(within));
            *alone -= softplus(-within);
        }
        let beside = log_sum_exp(&beside);
        logs.insert(Hypothesis::EffectsAndUnknown(r.effects.clone()), beside);
    }
}

/// ln of each effect's share of what all of them beside something unknown have: the mean of its shares by the two figures of what it gains, if both
/// speak for it; else by the smaller one.
fn shares_of_remainders(remainders: &[&RemainderEvidence], rule: &DecisionRule) -> Vec<f64> {
    let by = |gain: fn(&RemainderEvidence) -> f64| -> Vec<f64> {
        let of = |r: &&RemainderEvidence| {
            let gain = if r.gain_over_unknown > 0.0 {
                gain(r)
            } else {
                r.gain_over_unknown
            };
            gain / rule.temper
        };
        let logs: Vec<f64> = remainders.iter().map(of).collect();
        let all = log_sum_exp(&logs);
        logs.into_iter().map(|log| log - all).collect()
    };
    let with_one = by(|r| r.gain_with_one.unwrap_or(r.gain_over_unknown));
    let with_any = by(|r| r.gain_with_any.unwrap_or(r.gain_over_unknown));
    let mean = |(one, any): (f64, f64)| log_sum_exp(&[one, any]) - std::f64::consts::LN_2;
    with_one.into_iter().zip(with_any).map(mean).collect()
}

/// The candidates in an order that does not depend on theirs, so that sums are the same to the last bit.
fn sorted(evidence: &Evidence) -> Vec<&CandidateEvidence> {
    let mut candidates: Vec<&CandidateEvidence> = evidence.candidates.iter().collect();
    candidates.sort_by(|a, b| {
        (b.evidence_gain.total_cmp(&a.evidence_gain))
            .then(b.chi2_drop.total_cmp(&a.chi2_drop))
            .then(a.effects.cmp(&b.effects))
            .then(a.accepted_forms.cmp(&b.accepted_forms))
            .then(a.identified.cmp(&b.identified))
    });
    candidates
}

/// The stronger effect of a pair, and the fall of χ² that the other one adds to what it brings alone, as a share of that; None for
/// single effects.
fn stronger_alone<'e>(
    candidates: &[&'e CandidateEvidence],
    pair: &CandidateEvidence,
) -> Option<(&'e EffectSet, f64)> {
    if pair.effects.len() < 2 {
        return None;
    }
    let parts = (candidates.iter())
        .filter(|c| c.effects.single().is_some() && pair.effects.contains(&c.effects));
    let stronger = parts.reduce(|a, b| if b.chi2_drop > a.chi2_drop { b } else { a })?;
    let alone = stronger.chi2_drop;
    (alone > 0.0).then(|| (&stronger.effects, (pair.chi2_drop - alone) / alone))
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
