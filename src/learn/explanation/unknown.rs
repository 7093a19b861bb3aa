//! What is said where something is missing that the catalogue does not hold.

use super::findings::Findings;
use super::laws_instead;
use super::wording::{Explanation, before, chance, of_attainable, percent};
use crate::effects::Card;
use crate::learn::decision::Decision;
use crate::learn::hypothesis::{EffectSet, Hypothesis};

/// Share of the attainable fall of χ² below which no effect is worth naming.
const NEGLIGIBLE: f64 = 0.01;
/// Share of the attainable fall of χ² from which it has to be said why an effect is not named.
const NEARLY_ALL: f64 = 0.9;
/// Probability from which effects are worth a sentence where an unknown cause leads.
const POSSIBLE: f64 = 0.05;
/// Pairs of effects that are looked at for one that they have in common.
const BEST_PAIRS: usize = 3;

pub(super) fn unknown(findings: &Findings<'_>) -> Explanation {
    let decision = &findings.posterior.decision;
    let possible = not_ruled_out(decision);
    let next_step = if findings.context.approximate {
        "repeat with --fidelity middle: what is left may be the analytic model's own error"
            .to_owned()
    } else {
        let by_hand =
            "write the suspected law as an [[effect]] with kind = \"formula\" and diagnose again";
        let or = (possible.as_ref()).map_or(String::new(), |(_, effects, _)| {
            let [first, ..] = effects.cards() else {
                return String::new();
            };
            format!("see what gearwear add STUDY {} leaves, or ", first.name)
        });
        format!("look at the measurements named in the warnings, if any; else {or}{by_hand}")
    };
    let possible = possible.map(|(hypothesis, _, probability)| {
        format!(
            "{} is not ruled out ({}).",
            hypothesis.in_words(),
            chance(probability)
        )
    });
    Explanation {
        sentence: format!(
            "Something is missing that the catalogue does not hold (probability {}): the base model stands at χ² {:.2} per point.",
            chance(decision.probability(&Hypothesis::Unknown)),
            before(findings)
        ),
        reasons: best_of_catalogue(findings)
            // what a free law replaces is told with that law, and would be the best
            .filter(|_| laws_instead::instead(findings).is_empty())
            .into_iter()
            .chain(possible)
            .collect(),
        next_step,
    }
}

/// The most probable effects beside an unknown cause, with or without something unknown beside them, if they are worth a sentence.
fn not_ruled_out(decision: &Decision) -> Option<(&Hypothesis, &EffectSet, f64)> {
    let all = decision.log_probabilities.iter();
    let of_effects = all.filter_map(|(hypothesis, log)| match hypothesis {
        Hypothesis::Effects(effects) | Hypothesis::EffectsAndUnknown(effects) => {
            Some((hypothesis, effects, log.exp()))
        }
        _ => None,
    });
    of_effects
        .max_by(|a, b| a.2.total_cmp(&b.2))
        .filter(|(_, _, probability)| *probability >= POSSIBLE)
}

/// How much of the discrepancy the best of the catalogue accounts for.
pub(super) fn best_of_catalogue(findings: &Findings<'_>) -> Option<String> {
    let posterior = findings.posterior;
    let (leader, falls) = (posterior.decision.leader()?, posterior.falls_of_leader()?);
    let share = falls[0] / falls[1];
    if share < NEGLIGIBLE {
        return Some(format!(
            "No effect of the catalogue accounts for even {} of the attainable reduction of χ².",
            percent(NEGLIGIBLE)
        ));
    }
    let common = common_to_pairs(&posterior.decision.effects).map_or(String::new(), |card| {
        format!(" {} stands in all of the best pairs.", card.name)
    });
    let why_not = if share < NEARLY_ALL {
        String::new()
    } else {
        " It needs values, or leaves a pattern, for which something unknown is more probable."
            .to_owned()
    };
    Some(format!(
        "The best of the catalogue, {}, accounts for {}.{why_not}{common}",
        leader.in_words(),
        of_attainable(falls)
    ))
}

/// The effect that the most probable pairs have in common.
fn common_to_pairs(by_probability: &[EffectSet]) -> Option<&'static Card> {
    let pairs = by_probability.iter().filter(|effects| effects.len() > 1);
    let best: Vec<&EffectSet> = pairs.take(BEST_PAIRS).collect();
    let [first, others @ ..] = &best[..] else {
        return None;
    };
    let everywhere = |card: &&&'static Card| {
        let alone = EffectSet::new([**card]);
        others.iter().all(|pair| pair.contains(&alone))
    };
    let mut common = first.cards().iter().filter(everywhere);
    common.next().filter(|_| !others.is_empty()).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;
    use crate::learn::decision::Verdict;

    #[test]
    fn what_the_best_pairs_have_in_common_is_said() {
        let set = |names: &[&str]| EffectSet::new(names.iter().map(|name| find(name).unwrap()));
        let pairs = [
            set(&["approach_recess"]),
            set(&["micropitting", "running_in"]),
            set(&["coating", "micropitting"]),
            set(&["micropitting", "tip_relief"]),
            set(&["coating", "tip_relief"]),
        ];
        assert_eq!(common_to_pairs(&pairs).unwrap().name, "micropitting");
        assert!(common_to_pairs(&pairs[..2]).is_none());
        assert!(common_to_pairs(&pairs[2..]).is_none());
    }

    #[test]
    fn beside_an_unknown_cause_the_most_probable_effect_is_said_unless_it_is_ruled_out() {
        let set = |name| EffectSet::new([find(name).unwrap()]);
        let of = |beside: f64| Decision {
            verdict: Verdict::Unknown,
            log_probabilities: [
                (Hypothesis::Unknown, 0.8_f64),
                (Hypothesis::Effects(set("coating")), 0.02),
                (Hypothesis::EffectsAndUnknown(set("oxidative")), beside),
            ]
            .map(|(hypothesis, p)| (hypothesis, p.ln()))
            .into(),
            effects: Vec::new(),
            group: Vec::new(),
        };
        let decision = of(0.18);
        let (hypothesis, effects, probability) = not_ruled_out(&decision).unwrap();
        assert_eq!(hypothesis.in_words(), "oxidative beside something unknown");
        assert_eq!(effects.cards()[0].name, "oxidative");
        assert!((probability - 0.18).abs() < 1e-12);
        assert!(not_ruled_out(&of(0.03)).is_none());
    }
}
