//! The answer: what `diagnosis.json` is written from.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::findings::Findings;
use super::held_out::better_on_held_out;
use super::ranked::{Ranked, form, parameters, ranked};
use super::remainder::{Remainder, established, remainder};
use super::undecided::{is_within_analytic_error, undecided};
use super::warnings::warnings;
use super::wording::Explanation;
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::checks::goodness_of_fit::GoodnessOfFit;
use crate::learn::checks::sufficiency::few;
use crate::learn::decision::judged_candidates::JudgedCandidates;
use crate::learn::decision::{
    Decision, DecisionRule, LawAloneEvidence, LawBesideEvidence, LawInsteadEvidence,
    RemainderEvidence, SURE, Verdict,
};
use crate::learn::discrepancy::dependence::{self, Driver};
use crate::learn::discrepancy::residual_drivers::{self, ResidualDrivers};
use crate::learn::discrepancy::smooth::MapPoint;
use crate::learn::experiment::next::{NextExperiment, separating};
use crate::learn::fitting::fit::is_within_noise;
use crate::learn::hypothesis::Hypothesis;
use crate::learn::hypothesis::candidate::NotJudged;
use crate::learn::model_search::context::Context;
use crate::learn::model_search::learned_drivers::LearnedAnswer;
use crate::study::Role;

/// How a warning begins that is a question about the measurements.
pub const CHECK_FIRST: &str = "check first: ";

/// One effect, or several.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Named {
    /// One.
    One(String),
    /// Several.
    Several(Vec<String>),
}

/// A diagnosis. [`crate::learn::diagnose::Evidence`] can be read from its document.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Diagnosis {
    /// What is missing.
    pub verdict: Verdict,
    /// Whether the analytic model decided in place of finite elements and cannot: probabilities of the unknown are then of its own error too.
    pub undecided: bool,
    /// The named effect or effects; None unless the verdict names some.
    pub effect: Option<Named>,
    /// The verdict in a sentence, and why.
    pub sentence: String,
    /// How well the base model fits; None unless the verdict is `nothing_missing`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub goodness_of_fit: Option<GoodnessOfFit>,
    /// Further sentences: why not the runner-up, what cannot be concluded.
    pub reasons: Vec<String>,
    /// What to do next.
    pub next_step: String,
    /// Sum to 1 over effects, sets, `nothing_missing` and `unknown`.
    pub probabilities: BTreeMap<String, f64>,
    /// The most probable first.
    pub ranking: Vec<Ranked>,
    /// What remains beside the effect; None unless the verdict is `partial`.
    pub remainder: Option<Remainder>,
    /// What nothing of the catalogue explains, as a law of one driver; None unless the verdict is `unknown` and one is worth it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub learned: Option<LearnedAnswer>,
    /// Groups that the data cannot tell apart.
    pub indistinguishable: Vec<Vec<String>>,
    /// What the discrepancy depends on most; None without a discrepancy.
    pub driver: Option<Driver>,
    /// All drivers.
    pub drivers: Vec<Driver>,
    /// The smooth discrepancy at every fitted row; not part of the document, but a table of its own.
    #[serde(skip)]
    pub discrepancy: Vec<MapPoint>,
    /// What the base model and the leading one leave, against each physical driver.
    pub residual_drivers: ResidualDrivers,
    /// Share of the attainable fall of χ² that the leading effect accounts for; None without a discrepancy.
    pub explained_share: Option<f64>,
    /// Fall of χ² that anything smooth could bring.
    pub attainable_drop: f64,
    /// Whether that is twice the gain of log evidence: the agreement of the tests' own k counts in it (`scatter_gain` of the effects).
    pub attainable_by_evidence: bool,
    /// Standard deviation of that on noise alone.
    pub attainable_spread: f64,
    /// Log evidence of a smooth discrepancy of unknown cause over the base model.
    pub unknown_evidence_gain: f64,
    /// What a sparse regression on the effects' linear signatures picks, the strongest first: a second opinion that refits nothing.
    pub sparse_regression: Vec<String>,
    /// The test that would best separate what is left.
    pub next_experiment: Option<NextExperiment>,
    /// Everything fitted, by falling evidence.
    pub screened: Vec<Screened>,
    /// Effects fitted beside something unknown.
    pub beside_unknown: Vec<RemainderEvidence>,
    /// Factors on k by the place on the flank, fitted instead of a sum of waves along the profile that leads.
    #[serde(default)]
    pub place_laws: Vec<LawInsteadEvidence>,
    /// Factors on k by the time, fitted instead of an effect that leads and changes k over time alone.
    #[serde(default)]
    pub time_laws: Vec<LawInsteadEvidence>,
    /// Free factors on k beside each of several effects that something unknown stands beside; none where one of them is established without.
    #[serde(default)]
    pub laws_beside: Vec<LawBesideEvidence>,
    /// The best law of the place or the time beside no effect; None where effects beside something unknown are improbable.
    #[serde(default)]
    pub law_alone: Option<LawAloneEvidence>,
    /// The thresholds by which this was decided.
    pub rule: DecisionRule,
    /// Whether effects are named, if only as a group, of which the first leaves no more than noise, or than the analytic model's own error where that decides in
    /// place of finite elements; not part of the document.
    #[serde(skip)]
    pub leaves_only_noise: bool,
    /// Effects that could not be judged.
    pub not_judged: Vec<NotJudged>,
    /// What is doubtful.
    pub warnings: Vec<String>,
}

/// One form of one effect or set as fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Screened {
    /// Effect or set.
    pub effect: Hypothesis,
    /// The same as a list.
    pub effects: Vec<String>,
    /// Forms.
    pub form: String,
    /// Number of accepted forms that share the prior of these effects.
    pub accepted_forms: usize,
    /// Whether the data determine the parameter by which the effect is known.
    pub identified: bool,
    /// Log evidence over the base model's.
    pub evidence_gain: f64,
    /// Fall of the whole χ² against the base model.
    pub chi2_drop: f64,
    /// How much more probable the tests' own deviations of k are than with the base model, ln of the density under their scatter: an effect of the
    /// tests' conditions makes the scatter smaller.
    pub scatter_gain: f64,
    /// What of these counts against `attainable_drop`: the fall of χ², and where that is taken by evidence twice the gain of the scatter too.
    pub attained_drop: f64,
    /// Whether the deciding model was used.
    pub decided: bool,
    /// Whether it was fitted to the end; what a first look leaves far behind is not, and its χ² is that of the look.
    pub converged: bool,
    /// Fitted values in the order of its parameters.
    pub values: Vec<f64>,
}

impl Diagnosis {
    /// Whether nothing is missing, and that is no mere guess.
    pub fn is_sure_of_nothing(&self) -> bool {
        let nothing = self.probabilities.get("nothing_missing");
        self.verdict == Verdict::NothingMissing && nothing.is_some_and(|&p| p >= SURE)
    }

    /// The same, to be made again once rows that are slips in writing are put right.
    pub fn beside_slips(mut self) -> Self {
        self.next_step = format!(
            "look at the rows that stand far apart from their neighbours (gearwear check STUDY lists them), put right what is wrong there, or state \
             [noise] outliers = \"robust\", then gearwear diagnose STUDY; if nothing is wrong, {}",
            self.next_step
        );
        self
    }

    /// The same with questions about the measurements before all other warnings: no effect is to be trusted until they are answered.
    pub fn asking_first(mut self, questions: Vec<String>) -> Self {
        if !questions.is_empty() {
            self.next_step = format!(
                "look at what stands under `check first` and put right what is wrong there, then gearwear diagnose STUDY; if nothing is wrong, {}",
                self.next_step
            );
        }
        let asked = questions.into_iter();
        let asked = asked.map(|question| format!("{CHECK_FIRST}{question}"));
        self.warnings.splice(0..0, asked);
        self
    }

    /// Puts the answer together.
    pub(in crate::learn) fn new(findings: Findings<'_>) -> Self {
        let Findings {
            context,
            base,
            smooth,
            posterior,
            ..
        } = findings;
        let likelihood = &context.likelihood;
        let decision = &posterior.decision;
        let nothing_missing = decision.verdict == Verdict::NothingMissing;
        // of what acts on whole tests alone nothing is left between rows that could follow anything
        let follows = smooth.is_real() || !nothing_missing && smooth.drop > smooth.spread();
        let drivers = if follows && !few(likelihood, base) {
            dependence::drivers(likelihood, &base.fitted.found.model, smooth.drop)
        } else {
            Vec::new()
        };
        let leader = posterior.leader();
        let next_experiment = separating(context, findings.workshop, base, posterior);
        let (ranking, residual_drivers) = rayon::join(
            || ranked(context, base, posterior),
            || {
                let after = leader.filter(|_| !nothing_missing);
                residual_drivers::of(likelihood, context.middle, &base.fitted, after)
            },
        );
        let goodness_of_fit =
            nothing_missing.then(|| GoodnessOfFit::new(likelihood, &base.fitted.found.model));
        let mut explanation =
            Explanation::new(&findings, drivers.first(), next_experiment.as_ref());
        let doubt = goodness_of_fit.iter().filter_map(|fit| fit.warning.clone());
        explanation.reasons.splice(0..0, doubt);
        let held = Likelihood::new(likelihood.measured, likelihood.noise, Role::Holdout);
        let better = better_on_held_out(decision, &ranking, held.len());
        explanation.reasons.extend(better);
        // beside something unknown the effects alone are what cannot be told apart
        let member = |hypothesis: &Hypothesis| match hypothesis {
            Hypothesis::EffectsAndUnknown(effects) => effects.to_string(),
            other => other.to_string(),
        };
        let group = decision.group.iter().map(member).collect();
        let alone = decision.group.len() < 2;
        let names = |hypotheses: Vec<Hypothesis>| -> Vec<String> {
            hypotheses.iter().map(Hypothesis::to_string).collect()
        };
        Self {
            verdict: decision.verdict,
            undecided: undecided(context, base, posterior),
            effect: named(&findings),
            sentence: explanation.sentence,
            goodness_of_fit,
            reasons: explanation.reasons,
            next_step: explanation.next_step,
            probabilities: (decision.log_probabilities.iter())
                .map(|(hypothesis, log)| (hypothesis.to_string(), log.exp()))
                .collect(),
            ranking,
            remainder: remainder(&findings),
            learned: None,
            indistinguishable: if alone { Vec::new() } else { vec![group] },
            driver: drivers.first().cloned(),
            drivers,
            discrepancy: smooth.map(likelihood),
            residual_drivers,
            explained_share: posterior.share_of_leader(),
            attainable_drop: smooth.drop.max(0.0),
            attainable_by_evidence: smooth.by_evidence,
            attainable_spread: smooth.spread(),
            unknown_evidence_gain: posterior.evidence.unknown_evidence_gain,
            next_experiment,
            screened: screened(context, posterior),
            beside_unknown: posterior.evidence.beside_unknown.clone(),
            place_laws: posterior.evidence.place_laws.clone(),
            time_laws: posterior.evidence.time_laws.clone(),
            laws_beside: posterior.evidence.laws_beside.clone(),
            law_alone: posterior.evidence.law_alone.clone(),
            rule: posterior.rule,
            warnings: warnings(context, base, posterior, &findings.not_fitted),
            sparse_regression: names(findings.sparse_regression),
            leaves_only_noise: is_named(decision) && {
                let fitted = leader.unwrap_or(&base.fitted);
                let is_own_error =
                    || context.approximate && is_within_analytic_error(likelihood, fitted);
                is_within_noise(fitted.square, likelihood.len()) || is_own_error()
            },
            not_judged: findings.not_judged,
        }
    }
}

/// Whether effects of the catalogue are named, if only as a group, and neither nothing nor something unknown may stand in their place.
fn is_named(decision: &Decision) -> bool {
    let is_effect = |hypothesis: &Hypothesis| hypothesis.effects().is_some();
    match decision.verdict {
        Verdict::Effect | Verdict::Effects => true,
        Verdict::Ambiguous => decision.group.iter().all(is_effect),
        Verdict::NothingMissing | Verdict::Partial | Verdict::Unknown => false,
    }
}

fn named(findings: &Findings<'_>) -> Option<Named> {
    let decision = &findings.posterior.decision;
    let leader = decision.leader()?;
    match decision.verdict {
        Verdict::Effect => Some(Named::One(leader.to_string())),
        Verdict::Effects => Some(Named::Several(leader.clone().into())),
        Verdict::Partial => match &established(findings)[..] {
            [effects] => Some(Named::One(effects.to_string())),
            _ => None,
        },
        Verdict::NothingMissing | Verdict::Ambiguous | Verdict::Unknown => None,
    }
}

fn screened(context: &Context<'_>, posterior: &JudgedCandidates) -> Vec<Screened> {
    let all = posterior
        .candidates
        .iter()
        .zip(&posterior.evidence.candidates);
    all.map(|(fitted, figures)| Screened {
        effect: fitted.candidate.hypothesis(),
        effects: figures.effects.clone().into(),
        form: form(fitted),
        accepted_forms: figures.accepted_forms,
        identified: figures.identified,
        evidence_gain: figures.evidence_gain,
        scatter_gain: fitted.scatter_gain,
        chi2_drop: figures.chi2_drop,
        attained_drop: posterior.evidence.fall(figures),
        decided: fitted.fidelity == context.fidelity,
        converged: fitted.found.converged,
        values: parameters(fitted).iter().map(|p| p.value).collect(),
    })
    .collect()
}
