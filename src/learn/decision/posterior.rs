//! From evidence to the probability of every hypothesis.
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
//! v(R) = exp((Δ ln Z_R − ε Δ ln Z_GP)/T) o_R/n    Δ ln Z_R: over that of the discrepancy alone;  ε: `discrepancy_tolerance`
//! unknown: W/(1 + Σ v),  R and unknown: W w Σ v/(1 + Σ v)      of which o/(1 + o) is unknown's if R is not identified or a free shape
//! R and unknown besides:  weight(R) S((r_min − r)/width),      taken from R
//! ```
//! As another form of an effect leaves a little of what it explains, so something unknown leaves a little of it to an effect that mends the form of the
//! discrepancy. After all this the weight of R and unknown is multiplied, where a law alone was fitted and A is a fall of χ² (g: `remainder_mended`), by
//!
//! ```text
//! S(min((r_min − Δχ²_R/A)/width, g − Δ ln Z_R))
//! ```
//! Where two effects were fitted beside a discrepancy, they have a v of their own, o_R/n their prior as pairs have it, which is lent to the single
//! effects: one of the two is there, and the other may but follow the unknown. Each gets a part in proportion to the square of its own Δ ln Z_R alone (a half where
//! both gain nothing); of a free shape's part, of which o/(1 + o) would be unknown's, that goes to the other one.
//!
//! A sum of waves along the profile follows whatever acts by its place on the flank, and a profile wears away where a factor on k at that place does not.
//! A load in waves changes with the speed, and two effects that differ along the flank follow together what neither does alone.
//! Of what is a form's own that holds such waves, or such a pair, a law of the place fitted instead takes its part, and what it stands beside (R, or nothing) is
//! then beside something unknown. The odds of a law alone are those of something unknown alone to one effect beside it:
//!
//! ```text
//! from c to R and unknown, to unknown:   ln odds = (Δ ln Z_law − Δ ln Z_c)/T + (effects of R + 1 − effects of c) ln(o_R/n)
//! ```
//! A law instead of one effect of a pair, which is no sum of waves, is held to be another form of that effect if it brings no more than a share ε of what the pair
//! does (L: ln of how many laws were tried, π_u the prior of the unknown):
//!
//! ```text
//! from c to R and unknown:   ln odds = (Δ ln Z_law − (1 + ε) Δ ln Z_c)/T + ln(π_u o_R/n) − ln π_c − L
//! ```
//! An effect that changes k over time alone follows any slow change of k in part. Where it leads and leaves something, a law of the time fitted instead
//! of it takes its part likewise, ε Δ ln Z_c less for another form of the effect.
//!
//! Where several R are left that way, the best law of the place or the time beside each, by coarse finite elements, tells them apart, if beside the best R it does at least half of what a
//! discrepancy does. They share what they have together in proportion to
//!
//! ```text
//! exp(ln Z(R and law)/T) o_R/n
//! ```
//! A law of the place or the time beside no effect, by the same, is something unknown alone that acts through the mechanics: of what is R's beside something
//! unknown it takes its part (L: ln of how many laws were tried; the largest of all R)
//!
//! ```text
//! from R and unknown to unknown:   ln odds = (ln Z_law − max_R(ln Z(R and discrepancy), ln Z(R and law)))/T + ln(n/o_R) − L
//! ```
//! Where an effect and a law do more than anything unknown alone, weight goes the opposite way (o_other: of another cause of the same pattern, where R is a free
//! shape or is not identified)
//!
//! ```text
//! from unknown to R and unknown:   ln odds = (ln Z(R and law) − max((1 + ε) Δ ln Z_GP + L T, ln Z_law))/T + ln(o_R/n) − Σ ln(1 + o_other)
//! ```
//! Δ ln Z_R is the smaller of two figures: with the discrepancy that is most probable without the effect, and with every kind and size of it. By the
//! first the discrepancy has taken what it can of the effect already, by the second anything that mends the discrepancy is an effect. The share w of
//! R among the named is the mean of what both give, e^(Δ ln Z_R/T) over its sum, where both are above 0.

use std::collections::{BTreeMap, BTreeSet};

use super::evidence::{
    CandidateEvidence, Evidence, LawBesideEvidence, LawInsteadEvidence, RemainderEvidence,
};
use super::rule::DecisionRule;
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::numeric::logarithm::{log_sum_exp, softplus};

/// Fall of χ² by which another form of an effect may be behind and leave as much.
const LEAVES_AS_MUCH: f64 = 1.0;

/// ln of the laws and forms of which the best law alone is the best.
const LAWS_TRIED: f64 = 5.0;

/// Gain of ln evidence beside something unknown below which effects gain alike.
const LEAST_GAIN: f64 = 1.0;

/// Posterior probabilities of all hypotheses.
pub(super) fn log_probabilities(
    evidence: &Evidence,
    rule: &DecisionRule,
) -> BTreeMap<Hypothesis, f64> {
    let candidates = sorted(evidence);
    let singles: BTreeSet<&'static str> = (candidates.iter())
        .filter_map(|c| Some(c.effects.single()?.name))
        .collect();
    let count = singles.len().max(1) as f64;
    let pairs = (0.5 * count * (count - 1.0)).max(1.0);
    let log_prior = |c: &CandidateEvidence| match c.effects.single() {
        Some(_) => (rule.prior_singles / count).ln(),
        None => (rule.prior_pairs / pairs).ln(),
    };
    let log_posterior =
        |c: &CandidateEvidence| c.evidence_gain + log_prior(c) - (c.accepted_forms as f64).ln();
    let most = (candidates.iter().map(|c| log_posterior(c))).fold(f64::NEG_INFINITY, f64::max);
    let doubt = evidence.attainable_spread / evidence.attainable_drop.max(1.0);
    let unknown = evidence.unknown_evidence_gain;
    let alone = unknown + rule.unknown_offset + rule.prior_unknown.ln();
    let mut logs: BTreeMap<Hypothesis, Vec<f64>> = BTreeMap::new();
    let mut add = |hypothesis, log| logs.entry(hypothesis).or_default().push(log);
    add(Hypothesis::NothingMissing, rule.prior_nothing.ln());
    // of the same pattern as an effect: not shared with that effect beside something else
    let mut other_causes = vec![f64::NEG_INFINITY];
    let mut by_place: Vec<(Hypothesis, f64)> = Vec::new();
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
        let instead = laws_instead_of(c, evidence, rule, (count, &log_prior));
        let taken = softplus(log_sum_exp(
            &instead.iter().map(|law| law.1).collect::<Vec<_>>(),
        ));
        let own_part = log - softplus(odds) - taken;
        by_place.extend((instead.into_iter()).map(|(h, odds)| (h, own_part + odds)));
        let own = Hypothesis::Effects(c.effects.clone());
        match stronger_alone(&candidates, c) {
            Some((stronger, second)) => {
                let mends = (rule.second_share - second) / rule.second_share_width;
                add(own, own_part - softplus(mends));
                let stronger = Hypothesis::Effects(stronger.clone());
                add(stronger, own_part - softplus(-mends));
            }
            None => add(own, own_part),
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
    share_with_remainders(&mut logs, evidence, rule, [count, pairs]);
    share_by_laws(&mut logs, evidence, rule);
    share_with_law_alone(&mut logs, evidence, rule, count);
    share_unknown_by_laws(&mut logs, evidence, rule, count);
    discount_mends(&mut logs, evidence, rule);
    let unknown = [logs[&Hypothesis::Unknown], log_sum_exp(&other_causes)];
    logs.insert(Hypothesis::Unknown, log_sum_exp(&unknown));
    for (hypothesis, log) in by_place {
        // what was not fitted beside something unknown has no weight there
        let to = if logs.contains_key(&hypothesis) {
            hypothesis
        } else {
            Hypothesis::Unknown
        };
        let both = log_sum_exp(&[logs[&to], log]);
        logs.insert(to, both);
    }
    let all: Vec<f64> = logs.values().copied().collect();
    let total = log_sum_exp(&all);
    (logs.into_iter())
        .map(|(hypothesis, log)| (hypothesis, log - total))
        .collect()
}

/// The hypotheses that laws make of a form that holds the effect which they replace, with the ln odds of each to that form.
fn laws_instead_of(
    c: &CandidateEvidence,
    evidence: &Evidence,
    rule: &DecisionRule,
    (singles, log_prior): (f64, &dyn Fn(&CandidateEvidence) -> f64),
) -> Vec<(Hypothesis, f64)> {
    let replaces = |law: &&LawInsteadEvidence| c.effects.contains(&law.instead_of);
    // a slightly other form of an effect is still the effect; waves follow anything in their own
    let replaces_effect = |law: &LawInsteadEvidence| {
        let card = law.instead_of.single();
        card.is_some_and(|card| !card.is_wave_along_flank())
    };
    let odds = |law: &LawInsteadEvidence| {
        let tolerated = match replaces_effect(law) {
            true => rule.discrepancy_tolerance * c.evidence_gain.max(0.0),
            false => 0.0,
        };
        let gain = (law.evidence_gain - c.evidence_gain - tolerated) / rule.temper;
        let [own, beside] = [&c.effects, &law.beside].map(|set| set.len() as f64);
        let prior = if replaces_effect(law) && beside > 0.0 {
            (rule.prior_unknown * rule.remainder_odds / singles).ln() - log_prior(c) - LAWS_TRIED
        } else {
            (beside + 1.0 - own) * (rule.remainder_odds / singles).ln()
        };
        let hypothesis = if law.beside.is_empty() {
            Hypothesis::Unknown
        } else {
            Hypothesis::EffectsAndUnknown(law.beside.clone())
        };
        (hypothesis, gain + prior)
    };
    let laws = evidence.place_laws.iter().chain(&evidence.time_laws);
    laws.filter(replaces).map(odds).collect()
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
    [singles, pairs]: [f64; 2],
) {
    let remainders = by_effects(evidence);
    let log_prior = |r: &RemainderEvidence| match r.effects.single() {
        Some(_) => (rule.remainder_odds / singles).ln(),
        None => (rule.remainder_odds * rule.prior_pairs / rule.prior_singles / pairs).ln(),
    };
    let prior: Vec<f64> = remainders.iter().map(|r| log_prior(r)).collect();
    let tolerated = rule.discrepancy_tolerance * evidence.unknown_evidence_gain.max(0.0);
    let odds = |(r, prior): (&&RemainderEvidence, &f64)| {
        (r.gain_over_unknown - tolerated) / rule.temper + prior
    };
    let named: Vec<f64> = remainders.iter().zip(&prior).map(odds).collect();
    let named = log_sum_exp(&named);
    let total = softplus(named);
    let shares = shares_of_remainders(&remainders, &prior, rule);
    let lent = lent_by_pairs(&remainders, &shares, rule);
    let unknown = logs[&Hypothesis::Unknown];
    logs.insert(Hypothesis::Unknown, unknown - total);
    for (i, r) in remainders.into_iter().enumerate() {
        if r.effects.single().is_none() {
            continue;
        }
        let scale = unknown + named - total;
        let mut beside = vec![scale + shares[i], scale + lent[i]];
        // another cause of the same pattern is as good, and unknown
        let mut to_unknown = |log: &mut f64, odds: f64| {
            let of_other = *log - softplus(-odds.ln());
            *log -= softplus(odds.ln());
            let unknown = log_sum_exp(&[logs[&Hypothesis::Unknown], of_other]);
            logs.insert(Hypothesis::Unknown, unknown);
        };
        if r.free_shape {
            to_unknown(&mut beside[0], rule.free_shape_odds);
        }
        if !r.identified {
            for log in &mut beside {
                to_unknown(log, rule.unidentified_odds);
            }
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

/// Shares what effects beside something unknown have together by the laws that were fitted beside each, if these do much of what a discrepancy does.
fn share_by_laws(logs: &mut BTreeMap<Hypothesis, f64>, evidence: &Evidence, rule: &DecisionRule) {
    let mut laws: Vec<(Hypothesis, &LawBesideEvidence)> = (evidence.laws_beside.iter())
        .map(|law| (Hypothesis::EffectsAndUnknown(law.effects.clone()), law))
        .filter(|(hypothesis, _)| logs.contains_key(hypothesis))
        .collect();
    laws.sort_by(|a, b| a.1.effects.cmp(&b.1.effects));
    if evidence.telling_law().is_none() {
        return;
    }
    let together = log_sum_exp(&laws.iter().map(|(h, _)| logs[h]).collect::<Vec<_>>());
    let weights: Vec<f64> = (laws.iter())
        .map(|(_, law)| law.evidence_gain / rule.temper)
        .collect();
    let all = log_sum_exp(&weights);
    for ((hypothesis, _), weight) in laws.into_iter().zip(weights) {
        logs.insert(hypothesis, together + weight - all);
    }
}

/// Gives something unknown alone its part of effects beside something unknown, where a law alone does more than these.
fn share_with_law_alone(
    logs: &mut BTreeMap<Hypothesis, f64>,
    evidence: &Evidence,
    rule: &DecisionRule,
    singles: f64,
) {
    let remainders = by_effects(evidence);
    let Some(ahead) = evidence.law_ahead() else {
        return;
    };
    let odds = ahead / rule.temper + (singles / rule.remainder_odds).ln() - LAWS_TRIED;
    let mut unknown = vec![logs[&Hypothesis::Unknown]];
    for remainder in remainders {
        let hypothesis = Hypothesis::EffectsAndUnknown(remainder.effects.clone());
        if let Some(beside) = logs.get_mut(&hypothesis) {
            unknown.push(*beside - softplus(-odds));
            *beside -= softplus(odds);
        }
    }
    logs.insert(Hypothesis::Unknown, log_sum_exp(&unknown));
}

/// Gives effects beside something unknown their part of what is unknown alone, where an effect and a law do more than a discrepancy and than a law alone.
fn share_unknown_by_laws(
    logs: &mut BTreeMap<Hypothesis, f64>,
    evidence: &Evidence,
    rule: &DecisionRule,
    singles: f64,
) {
    let alone = evidence.unknown_alone(rule.discrepancy_tolerance, rule.temper * LAWS_TRIED);
    let mut odds: Vec<(Hypothesis, f64)> = Vec::new();
    for remainder in by_effects(evidence) {
        let mut laws = evidence.laws_beside.iter();
        let law = laws.find(|law| law.effects == remainder.effects);
        let hypothesis = Hypothesis::EffectsAndUnknown(remainder.effects.clone());
        let gain = law.and_then(|law| law.gain_over_base);
        if let Some(gain) = gain.filter(|_| logs.contains_key(&hypothesis)) {
            // another cause of the same pattern is as good, and unknown
            let other = [
                (remainder.free_shape, rule.free_shape_odds),
                (!remainder.identified, rule.unidentified_odds),
            ];
            let other = other.iter().filter(|(is_open, _)| *is_open);
            let kept: f64 = other.map(|(_, odds)| -odds.ln_1p()).sum();
            let prior = (rule.remainder_odds / singles).ln();
            odds.push((hypothesis, (gain - alone) / rule.temper + prior + kept));
        }
    }
    let unknown = logs[&Hypothesis::Unknown];
    let total = softplus(log_sum_exp(
        &odds.iter().map(|(_, odds)| *odds).collect::<Vec<_>>(),
    ));
    logs.insert(Hypothesis::Unknown, unknown - total);
    for (hypothesis, odds) in odds {
        let both = log_sum_exp(&[logs[&hypothesis], unknown + odds - total]);
        logs.insert(hypothesis, both);
    }
}

/// Takes from effects beside something unknown what they have for mending the form of the discrepancy: they bring next to nothing by themselves. Only
/// where a law alone was looked for: until then such an effect says that something beside another one is worth the look.
fn discount_mends(logs: &mut BTreeMap<Hypothesis, f64>, evidence: &Evidence, rule: &DecisionRule) {
    let counts = evidence.is_discrepant() && !evidence.attainable_by_evidence;
    if !counts || evidence.law_alone.is_none() {
        return;
    }
    for remainder in &evidence.beside_unknown {
        let share = remainder.chi2_drop.max(0.0) / evidence.attainable_drop;
        let odds = ((rule.remainder_share - share) / rule.remainder_share_width)
            .min(rule.remainder_mended - remainder.gain_over_unknown);
        let hypothesis = Hypothesis::EffectsAndUnknown(remainder.effects.clone());
        if let Some(beside) = logs.get_mut(&hypothesis) {
            *beside -= softplus(odds);
        }
    }
}

/// What was fitted beside something unknown, in an order that does not depend on theirs.
fn by_effects(evidence: &Evidence) -> Vec<&RemainderEvidence> {
    let mut all: Vec<&RemainderEvidence> = evidence.beside_unknown.iter().collect();
    all.sort_by(|a, b| a.effects.cmp(&b.effects));
    all
}

/// ln of what pairs beside something unknown lend to each single effect, as a share of what all beside something unknown have. A pair says that one of
/// its effects is missing: the other one may but follow the unknown. Each gets a part in proportion to the square of what it gains alone; of a free shape's part what
/// `free_shape_odds` takes from it is the other one's.
fn lent_by_pairs(
    remainders: &[&RemainderEvidence],
    shares: &[f64],
    rule: &DecisionRule,
) -> Vec<f64> {
    let mut lent = vec![vec![f64::NEG_INFINITY]; remainders.len()];
    let ln_kept = |r: &RemainderEvidence| match r.free_shape {
        true => -softplus(rule.free_shape_odds.ln()),
        false => 0.0,
    };
    let pairs = (remainders.iter().zip(shares)).filter(|(r, _)| r.effects.len() == 2);
    for (pair, share) in pairs {
        let members: Vec<usize> = (0..remainders.len())
            .filter(|&i| remainders[i].effects.single().is_some())
            .filter(|&i| pair.effects.contains(&remainders[i].effects))
            .collect();
        let alone = |i: usize| remainders[i].gain_over_unknown.max(LEAST_GAIN).powi(2);
        let all: f64 = members.iter().map(|&i| alone(i)).sum();
        for &i in &members {
            let part = share + (alone(i) / all).ln();
            lent[i].push(part + ln_kept(remainders[i]));
            if remainders[i].free_shape {
                for &other in members.iter().filter(|&&other| other != i) {
                    lent[other].push(part - softplus(-rule.free_shape_odds.ln()));
                }
            }
        }
    }
    lent.iter().map(|logs| log_sum_exp(logs)).collect()
}

/// ln of each one's share of what all beside something unknown have: the mean of its shares by the two figures of what it gains, if both speak for it;
/// else by the smaller one.
fn shares_of_remainders(
    remainders: &[&RemainderEvidence],
    prior: &[f64],
    rule: &DecisionRule,
) -> Vec<f64> {
    let by = |gain: fn(&RemainderEvidence) -> f64| -> Vec<f64> {
        let of = |(r, prior): (&&RemainderEvidence, &f64)| {
            let gain = if r.gain_over_unknown > 0.0 {
                gain(r)
            } else {
                r.gain_over_unknown
            };
            gain / rule.temper + prior
        };
        let logs: Vec<f64> = remainders.iter().zip(prior).map(of).collect();
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
