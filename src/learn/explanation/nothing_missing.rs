//! What is said where nothing is missing.

use super::findings::Findings;
use super::outlook::Outlook;
use super::scatter::{made_twice, of_scatter};
use super::wording::{Explanation, before, chance, chi2};
use crate::learn::checks::scatter_trend::trend_of_scatter;
use crate::learn::checks::sufficiency::{measured_once, too_few};
use crate::learn::decision::SURE;
use crate::learn::experiment::next::NextExperiment;
use crate::learn::hypothesis::Hypothesis;

/// Scatter of k between tests from which it is worth a sentence.
const LARGE_SCATTER: f64 = 0.2;
/// Probability of nothing missing from which the next effect is not worth a sentence.
const CERTAIN: f64 = 0.95;
/// Gain of ln evidence from which an effect comes nearer than one that does nothing.
const SOME_GAIN: f64 = 0.1;

pub(super) fn nothing_missing(
    findings: &Findings<'_>,
    next: Option<&NextExperiment>,
) -> Explanation {
    let likelihood = &findings.context.likelihood;
    let decision = &findings.posterior.decision;
    let chi2_before = before(findings);
    let nothing = decision.probability(&Hypothesis::NothingMissing);
    // where they follow a condition it is hardly chance
    let trend = trend_of_scatter(likelihood, &findings.base.fitted.found.state);
    let followed = trend.is_some();
    let shown = match (followed, nothing < SURE) {
        (false, true) => "Undecided: most likely nothing is missing, but a weak effect may be",
        (false, false) => "Nothing is missing that these data show",
        (true, true) => {
            "The tests' own k follow a condition; whether anything else is missing is undecided"
        }
        (true, false) => {
            "The tests' own k follow a condition; nothing else is missing that these data show"
        }
    };
    let too_few = too_few(likelihood, findings.base);
    let sentence = if too_few {
        format!(
            "Too few measured values ({}) to tell whether anything is missing: the base model stands at χ² {chi2_before:.2} per point (1 is the noise).",
            likelihood.len()
        )
    } else {
        format!(
            "{shown}: the base model stands at χ² {chi2_before:.2} per point (1 is the noise), probability of nothing missing {}.",
            chance(nothing)
        )
    };
    let base = findings.base.fitted.log_evidence;
    let leader = findings.posterior.leader();
    // what gains nothing comes no nearer than any other
    let leader = leader.filter(|l| nothing < CERTAIN && l.log_evidence > base + SOME_GAIN);
    let nearest = leader.map(|leader| {
        format!(
            "Of single effects {} comes nearest ({}): it lowers χ² per point to {:.3}, too little, given how many candidates were tried.",
            leader.candidate.effects,
            chance(decision.probability_of(&leader.candidate.effects)),
            chi2(findings, leader)
        )
    });
    let scatter = findings.base.fitted.found.scatter;
    let scatters = (scatter > LARGE_SCATTER && likelihood.tests.len() > 1).then(|| {
        let twice = made_twice(likelihood, &findings.base.fitted.found.state.epsilon);
        let other_question = next.is_some_and(|next| next.repeats.is_none());
        of_scatter(scatter, twice.as_ref(), other_question)
    });
    let scatters = trend.or(scatters);
    let next_step = if followed {
        "look at what the tests' k follow before adding an effect: a law of it is an [[effect]] with kind = \"formula\" (guide/own-effect.md; of the temperature guide/plastics.md), fitted by \
         gearwear compare and held against this study by gearwear ladder"
    } else if too_few {
        "measure more before concluding anything: gearwear plan STUDY proposes tests"
    } else if measured_once(likelihood).len() == likelihood.tests.len() {
        "no effect need be added for what these data show; what changes over life they cannot show: measure at several numbers of cycles"
    } else if nothing < SURE {
        Outlook::of(next).of_a_weak_effect()
    } else {
        "no effect need be added; a weak effect could still hide below the noise"
    };
    Explanation {
        sentence,
        reasons: match followed {
            true => scatters.into_iter().chain(nearest).collect(),
            false => nearest.into_iter().chain(scatters).collect(),
        },
        next_step: next_step.to_owned(),
    }
}
