//! What the data cannot tell apart: the rivals, what they have in common, and what would tell them apart.

use super::findings::Findings;
use super::outlook::Outlook;
use super::wording::{Explanation, add_each, before, chance, of_attainable};
use crate::effects::Card;
use crate::learn::checks::identifiability::unidentified;
use crate::learn::decision::Decision;
use crate::learn::experiment::next::NextExperiment;
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::numeric::written::significant;

/// Probability below which a rival is not worth a word.
const IMPROBABLE: f64 = 0.01;
/// χ² between what two fits predict below which they do the same.
const ONE_LAW: f64 = 0.5;

/// Where several are as probable: what they are, what stands in all of them, and the next step.
pub(super) fn ambiguous(findings: &Findings<'_>, next: Option<&NextExperiment>) -> Explanation {
    let posterior = findings.posterior;
    let decision = &posterior.decision;
    let rivals = rivals(decision);
    let common = common_to(&rivals, decision);
    let list: Vec<String> = (rivals.iter())
        .map(|(hypothesis, p)| format!("{} ({})", rival(hypothesis), chance(*p)))
        .collect();
    let doubted = decision.group.contains(&Hypothesis::Unknown);
    let leader = decision.leading_effects().filter(|_| doubted);
    let leader = leader.and_then(|effects| posterior.best_form(effects));
    let unidentified = leader.and_then(|j| unidentified(&findings.context.likelihood, j));
    let is_common = |effects: &EffectSet| {
        let common = common.as_ref();
        common.is_some_and(|(common, _)| common.contains(effects))
    };
    let reason = match (unidentified, leader, posterior.falls_of_leader()) {
        (Some((card, parameter)), ..) => Some(format!(
            "These data do not determine {parameter}, the mark of {}: another cause with the same pattern would look alike. What would show it: {}.",
            card.name, card.separated_by
        )),
        (None, Some(leader), Some(falls)) if is_common(&leader.candidate.effects) => Some(format!(
            "{} accounts for {}: whether the rest is another cause, or a spoiled measurement, is open.",
            leader.candidate.effects,
            of_attainable(falls)
        )),
        (None, Some(leader), Some(falls)) => Some(format!(
            "{} accounts for {}: neither it nor an uncatalogued cause, or a spoiled measurement, can be ruled out.",
            leader.candidate.effects,
            of_attainable(falls)
        )),
        _ => None,
    };
    let in_all = common.as_ref().map(|(effects, probability)| {
        format!(
            "{} stands in all of them: that it is missing has probability {}.",
            effects.in_words(),
            chance(*probability)
        )
    });
    let single = common.as_ref().and_then(|(effects, _)| effects.single());
    // a test that hardly tells them apart is no reason to wait
    let next = next.filter(|next| Outlook::of(Some(next)).is_worth_a_test());
    let next_step = match (next, unidentified) {
        (Some(_), _) if single.is_some() => format!(
            "gearwear add STUDY {}, which stands in all of them; make the proposed test before adding what they differ in",
            single.map_or("", |card| card.name)
        ),
        (None, None) if single.is_some() => format!(
            "gearwear add STUDY {}, which stands in all of them, and diagnose the new study: that shows what is left with it in",
            single.map_or("", |card| card.name)
        ),
        (Some(_), _) => "make the proposed test before adding one of them".to_owned(),
        (None, Some((card, _))) => {
            format!("to show whether it is {}: {}", card.name, card.separated_by)
        }
        (None, None) => one_law(findings, &rivals).unwrap_or_else(|| {
            format!(
                "no test made like these tells them apart clearly: gearwear plan STUDY ranks others; or {}",
                add_each(findings)
            )
        }),
    };
    Explanation {
        sentence: format!(
            "The data cannot tell apart: {}. The base model stands at χ² {:.2} per point.",
            list.join(", "),
            before(findings)
        ),
        reasons: in_all.into_iter().chain(reason).collect(),
        next_step,
    }
}

/// That the two leading effects, as fitted, predict the same in all rows: other names of one law, of which no test tells.
fn one_law(findings: &Findings<'_>, rivals: &[(&Hypothesis, f64)]) -> Option<String> {
    let [(one, _), (other, _), ..] = rivals else {
        return None;
    };
    let fits = [one, other].map(|hypothesis| match hypothesis {
        Hypothesis::Effects(effects) => findings.posterior.best_form(effects),
        _ => None,
    });
    let [Some(first), Some(second)] = fits else {
        return None;
    };
    let models = first.found.model.iter().zip(&second.found.model);
    let apart: Vec<f64> = models.map(|(a, b)| a - b).collect();
    let white = findings.context.likelihood.covariance.whiten(&apart);
    let square: f64 = white.iter().map(|x| x * x).sum();
    (square < ONE_LAW).then(|| {
        format!(
            "{} and {} predict the same in all rows ({} of χ² apart): they may be two names of one law, which more tests of this kind do not tell apart. Add the one that makes sense for these \
             parts (`gearwear effects NAME` says what each stands for)",
            one.in_words(),
            other.in_words(),
            significant(square, 1)
        )
    })
}

/// What cannot be told apart, the most probable first: the decision's group, in which something unknown stands for itself alone and beside each
/// effect. Improbable ones are left out unless fewer than two would be left.
fn rivals(decision: &Decision) -> Vec<(&Hypothesis, f64)> {
    let of_unknown = |hypothesis: &Hypothesis| {
        matches!(
            hypothesis,
            Hypothesis::Unknown | Hypothesis::EffectsAndUnknown(_)
        )
    };
    let doubted = decision.group.contains(&Hypothesis::Unknown);
    let mut all: Vec<(&Hypothesis, f64)> = (decision.log_probabilities.iter())
        .filter(|(hypothesis, _)| {
            decision.group.contains(hypothesis) || (doubted && of_unknown(hypothesis))
        })
        .map(|(hypothesis, log)| (hypothesis, log.exp()))
        .collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let probable = all.iter().filter(|(_, p)| *p >= IMPROBABLE).count();
    all.truncate(probable.max(2));
    all
}

/// A rival as the end of "the data cannot tell apart".
fn rival(hypothesis: &Hypothesis) -> String {
    match hypothesis {
        Hypothesis::Unknown => "a cause that is not in the catalogue".to_owned(),
        Hypothesis::NothingMissing => "nothing missing".to_owned(),
        effects => effects.in_words(),
    }
}

/// The effects that stand in all rivals, alone, beside others or beside something unknown, and the probability that they are missing.
fn common_to(rivals: &[(&Hypothesis, f64)], decision: &Decision) -> Option<(EffectSet, f64)> {
    let sets: Option<Vec<&EffectSet>> = (rivals.iter())
        .map(|(hypothesis, _)| match hypothesis {
            Hypothesis::Effects(effects) | Hypothesis::EffectsAndUnknown(effects) => Some(effects),
            Hypothesis::NothingMissing | Hypothesis::Unknown => None,
        })
        .collect();
    let [first, others @ ..] = &sets?[..] else {
        return None;
    };
    let everywhere = |card: &&&'static Card| {
        let alone = EffectSet::new([**card]);
        others.iter().all(|set| set.contains(&alone))
    };
    let common = EffectSet::new(first.cards().iter().filter(everywhere).copied());
    (!common.is_empty()).then(|| {
        let probability = decision.probability_in_all(&common);
        (common, probability)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;
    use crate::learn::decision::Verdict;

    #[test]
    fn rivals_stand_by_size_and_improbable_ones_not_at_all() {
        let set = |names: &[&str]| EffectSet::new(names.iter().map(|name| find(name).unwrap()));
        let effects = |name| Hypothesis::Effects(set(&[name]));
        let beside = |name| Hypothesis::EffectsAndUnknown(set(&[name]));
        let decided = |of: &[(Hypothesis, f64)], group: &[Hypothesis]| Decision {
            verdict: Verdict::Ambiguous,
            log_probabilities: of.iter().map(|(h, p)| (h.clone(), p.ln())).collect(),
            effects: Vec::new(),
            group: group.to_vec(),
        };
        let all = [
            (effects("running_in"), 0.5),
            (beside("running_in"), 0.3),
            (beside("coating"), 0.15),
            (Hypothesis::Unknown, 0.009),
            (effects("tip_relief"), 0.04),
        ];
        let group = [effects("running_in"), Hypothesis::Unknown];
        let decision = decided(&all, &group);
        let names: Vec<String> = rivals(&decision)
            .iter()
            .map(|(h, _)| h.to_string())
            .collect();
        assert_eq!(
            names,
            ["running_in", "running_in+unknown", "coating+unknown"]
        );
        assert_eq!(common_to(&rivals(&decision), &decision), None);
        // one effect in all of them, alone and beside something unknown
        let one = decided(&all[..2], &group);
        let (common, probability) = common_to(&rivals(&one), &one).unwrap();
        assert_eq!(common.to_string(), "running_in");
        assert!((probability - 0.8).abs() < 1e-12, "{probability}");
        // nothing else is left: the two most probable stand there all the same
        let few = [(effects("running_in"), 0.9), (Hypothesis::Unknown, 4e-4)];
        assert_eq!(rivals(&decided(&few, &group)).len(), 2);
    }

    #[test]
    fn a_cause_outside_the_catalogue_is_not_called_by_its_key() {
        assert_eq!(
            rival(&Hypothesis::Unknown),
            "a cause that is not in the catalogue"
        );
        assert_eq!(rival(&Hypothesis::NothingMissing), "nothing missing");
        let set = EffectSet::new([find("tip_relief").unwrap()]);
        assert_eq!(
            rival(&Hypothesis::EffectsAndUnknown(set)),
            "tip_relief beside something unknown"
        );
    }
}
