//! What is left beside an effect that is established.

use serde::{Deserialize, Serialize};

use super::findings::Findings;
use super::ranked::form;
use super::wording::{
    Explanation, add_each, added, before, chance, change, chi2, of_attainable, percent, values,
};
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::decision::Verdict;
use crate::learn::discrepancy::dependence::{self, Driver};
use crate::learn::experiment::next::NextExperiment;
use crate::learn::hypothesis::{EffectSet, Hypothesis};

/// What remains once the established effect is in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Remainder {
    /// Mean squared standardised residual of the fit tests with the effect, fitted without a discrepancy beside it.
    pub chi2_per_point: f64,
    /// Share of the attainable fall of χ² that the effect leaves.
    pub share: f64,
    /// What the remainder depends on most.
    pub driver: Option<Driver>,
}

/// The effects beside something unknown, the most probable first; none unless the verdict is `partial`.
pub(super) fn established(findings: &Findings<'_>) -> Vec<EffectSet> {
    let decision = &findings.posterior.decision;
    if decision.verdict != Verdict::Partial {
        return Vec::new();
    }
    let effects = |hypothesis: &Hypothesis| match hypothesis {
        Hypothesis::EffectsAndUnknown(effects) => Some(effects.clone()),
        _ => None,
    };
    decision.group.iter().filter_map(effects).collect()
}

/// What remains beside the most probable effect; None unless the verdict is `partial`.
pub(super) fn remainder(findings: &Findings<'_>) -> Option<Remainder> {
    let effects = established(findings).into_iter().next()?;
    let fitted = findings.posterior.best_form(&effects)?;
    let [remaining, attainable] = falls(findings, &effects)?;
    let likelihood = &findings.context.likelihood;
    let model = &fitted.found.model;
    let drivers = dependence::drivers(likelihood, model, remaining);
    Some(Remainder {
        chi2_per_point: likelihood.chi2_per_point(model),
        share: remaining / attainable.max(f64::MIN_POSITIVE),
        driver: drivers.into_iter().next(),
    })
}

/// By how much χ² could still fall once the effects are in, and by how much with them and that.
fn falls(findings: &Findings<'_>, effects: &EffectSet) -> Option<[f64; 2]> {
    let mut all = findings.posterior.evidence.beside_unknown.iter();
    let figures = all.find(|beside| beside.effects == *effects)?;
    let remaining = figures.remaining_drop.max(0.0);
    Some([remaining, remaining + figures.chi2_drop.max(0.0)])
}

/// What of the catalogue may be the second cause, where a set with the established effect is nearly as probable as something unknown.
fn second_cause(findings: &Findings<'_>, established: &EffectSet) -> Option<String> {
    let decision = &findings.posterior.decision;
    let sets = decision.effects.iter().filter(|set| set.len() > 1);
    let set = sets.into_iter().find(|set| set.contains(established))?;
    let probability = decision.probability_of(set);
    let unknown = Hypothesis::EffectsAndUnknown(established.clone());
    (probability >= findings.posterior.rule.doubt).then(|| {
        format!(
            "The second cause is not established: {} has probability {}, {established} beside something unknown {}.",
            set.in_words(),
            chance(probability),
            chance(decision.probability(&unknown))
        )
    })
}

/// What is missing beside something else; established only where the fit that this rests on `converged`.
fn missing(effects: &EffectSet, probability: f64, converged: bool) -> String {
    let (effects, probability) = (effects.in_words(), chance(probability));
    if converged {
        format!(
            "Established: {effects} is missing (probability {probability}), but it is not all that is."
        )
    } else {
        format!(
            "Most likely {effects} is missing (probability {probability}), and not all that is; but the fit that decides did not converge, so this is not established."
        )
    }
}

/// Whether a fit says how far χ² falls with it: not one that did not converge and ended no better than it began.
fn has_ended(findings: &Findings<'_>, fitted: &FittedCandidate) -> bool {
    fitted.converged || chi2(findings, fitted) < before(findings)
}

/// The verdict `partial` in words, with the proposed test.
pub(super) fn partial(findings: &Findings<'_>, next: Option<&NextExperiment>) -> Explanation {
    let posterior = findings.posterior;
    let group = established(findings);
    // the hypothesis that is established has the rest beside it: alone the effect would take a part of that too
    let beside_fit = |effects: &EffectSet| {
        let hypothesis = Hypothesis::EffectsAndUnknown(effects.clone());
        let fitted = posterior.fitted(findings.base, &hypothesis);
        fitted.or_else(|| posterior.best_form(effects))
    };
    let sentence = match &group[..] {
        [effects] => {
            let alone = posterior.best_form(effects);
            let with = alone
                .zip(beside_fit(effects))
                .map_or(String::new(), |(alone, beside)| {
                    let differ = form(alone) != form(beside);
                    let of_form = |fitted| match form(fitted) {
                        _ if !differ => String::new(),
                        own if own.is_empty() => " (in its own form)".to_owned(),
                        other => format!(" (in the form {other})"),
                    };
                    let by_itself = match has_ended(findings, alone) {
                        true => format!(
                            "With it alone{} χ² per point {}",
                            of_form(alone),
                            change(before(findings), chi2(findings, alone))
                        ),
                        false => "Its fit without what is left did not converge".to_owned(),
                    };
                    format!(
                        " {by_itself}; beside what is left{}, {}.",
                        of_form(beside),
                        values(beside)
                    )
                });
            let converged = beside_fit(effects).is_none_or(|beside| beside.converged);
            let probability = posterior.decision.probability_in_all(effects);
            missing(effects, probability, converged) + &with
        }
        _ => {
            let list: Vec<String> = (group.iter())
                .map(|effects| {
                    let probability = posterior.decision.probability_in_all(effects);
                    format!("{effects} ({})", chance(probability))
                })
                .collect();
            format!(
                "One of these effects is missing, and something else beside it: {}. The base model stands at χ² {:.2} per point.",
                list.join(", "),
                before(findings)
            )
        }
    };
    let leading = group.first();
    let second = leading.and_then(|effects| second_cause(findings, effects));
    let mut reasons: Vec<String> = second.into_iter().collect();
    // of a fit that came to no end the rest is not known
    let ended = |effects: &&EffectSet| {
        let alone = posterior.best_form(effects);
        alone.is_none_or(|alone| has_ended(findings, alone))
    };
    let left = (leading.filter(ended)).and_then(|effects| falls(findings, effects));
    if let Some((remainder, falls)) = remainder(findings).zip(left) {
        reasons.push(format!(
            "What remains beside {} is {}; χ² {:.2} per point is left.",
            group[0].in_words(),
            of_attainable(falls),
            remainder.chi2_per_point
        ));
        if let Some(driver) = remainder.driver {
            reasons.push(format!(
                "With the effect in, what remains depends most on {}: {} of its variance.",
                driver.in_words(),
                percent(driver.variance_share)
            ));
        }
    }
    let next_step = match &group[..] {
        [effects] => format!(
            "{}, then diagnose the new study: what remains is judged with the effect in; `gearwear climb STUDY` goes on so step by step",
            beside_fit(effects).map_or_else(
                || format!("gearwear add STUDY {effects}"),
                |fit| added(&fit.candidate)
            )
        ),
        _ => {
            let test = match next {
                Some(_) => "make the proposed test",
                None => "make a test that tells them apart (gearwear plan STUDY ranks some)",
            };
            format!(
                "{test}, or {}, as gearwear climb STUDY does; then diagnose the new study",
                add_each(findings)
            )
        }
    };
    Explanation {
        sentence,
        reasons,
        next_step,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;

    #[test]
    fn a_fit_that_did_not_converge_establishes_nothing() {
        let effects = EffectSet::new([find("tip_relief").unwrap()]);
        assert!(missing(&effects, 0.99, true).starts_with("Established: tip_relief is missing"));
        let rough = missing(&effects, 0.99, false);
        assert!(
            rough.starts_with("Most likely tip_relief is missing"),
            "{rough}"
        );
        assert!(rough.ends_with("so this is not established."), "{rough}");
    }
}
