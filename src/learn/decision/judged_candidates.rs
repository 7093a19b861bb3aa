//! All fitted candidates with what the decision says of them.

use super::evidence::{
    CandidateEvidence, Evidence, LawAloneEvidence, LawBesideEvidence, LawInsteadEvidence,
    RemainderEvidence,
};
use super::rule::DecisionRule;
use super::verdict::{Decision, Verdict, decide};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::checks::identifiability::unidentified;
use crate::learn::discrepancy::smooth::SmoothDiscrepancy;
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::learn::model_search::beside_unknown::{BesideUnknown, WithDiscrepancy};
use crate::learn::model_search::law_instead::LawInstead;
use crate::learn::model_search::laws_beside::LawBeside;

/// Effects beside something unknown that laws beside each tell apart, at the most.
const LAWS_BESIDE: usize = 2;

/// Everything fitted, and the decision on it.
pub(in crate::learn) struct JudgedCandidates {
    /// All fitted candidates that are not the base, by falling evidence.
    pub(in crate::learn) candidates: Vec<FittedCandidate>,
    /// The effects fitted beside something unknown.
    pub(in crate::learn) beside_unknown: Vec<BesideUnknown>,
    /// The figures of the same, in the same order.
    pub(in crate::learn) evidence: Evidence,
    /// By this rule.
    pub(in crate::learn) rule: DecisionRule,
    pub(in crate::learn) decision: Decision,
}

impl JudgedCandidates {
    /// `candidates` by falling evidence; `discrepancy`: one alone, and effects beside it.
    pub(in crate::learn) fn new(
        likelihood: &Likelihood<'_>,
        base: &BaseFit,
        candidates: Vec<FittedCandidate>,
        discrepancy: WithDiscrepancy,
        [place_laws, time_laws]: [Vec<LawInstead>; 2],
        smooth: &SmoothDiscrepancy,
        rule: DecisionRule,
    ) -> Self {
        let base = &base.fitted;
        let figures = |fitted: &FittedCandidate| CandidateEvidence {
            effects: fitted.candidate.effects.clone(),
            accepted_forms: fitted.candidate.siblings,
            identified: unidentified(likelihood, fitted).is_none(),
            evidence_gain: fitted.log_evidence - base.log_evidence,
            chi2_drop: base.square - fitted.square,
            scatter_gain: fitted.scatter_gain,
        };
        let instead = |law: LawInstead| LawInsteadEvidence {
            beside: law.beside,
            instead_of: law.instead_of,
            law: law.name,
            evidence_gain: law.log_evidence - base.log_evidence,
        };
        let evidence = Evidence {
            candidates: candidates.iter().map(figures).collect(),
            attainable_drop: smooth.drop,
            attainable_by_evidence: smooth.by_evidence,
            attainable_spread: smooth.spread(),
            unknown_evidence_gain: discrepancy.alone - base.log_evidence,
            beside_unknown: (discrepancy.effects.iter())
                .map(|beside| remainder(likelihood, beside))
                .collect(),
            place_laws: place_laws.into_iter().map(instead).collect(),
            time_laws: time_laws.into_iter().map(instead).collect(),
            laws_beside: Vec::new(),
            law_alone: None,
        };
        Self {
            decision: decide(&evidence, &rule),
            candidates,
            beside_unknown: discrepancy.effects,
            evidence,
            rule,
        }
    }

    /// The effects beside something unknown of which none is established, the most probable first; none where one is, or all are improbable.
    pub(in crate::learn) fn undecided_beside_unknown(&self) -> Vec<&BesideUnknown> {
        let probability = |beside: &&BesideUnknown| {
            let effects = beside.fitted.candidate.effects.clone();
            self.decision
                .probability(&Hypothesis::EffectsAndUnknown(effects))
        };
        let mut all: Vec<(f64, &BesideUnknown)> = (self.beside_unknown.iter())
            .map(|beside| (probability(&beside), beside))
            .collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let together: f64 = all.iter().map(|(p, _)| p).sum();
        let first = all.first().map_or(0.0, |(p, _)| *p);
        if together < self.rule.doubt || first >= self.rule.claim * together {
            return Vec::new();
        }
        let alike = all.into_iter().take(LAWS_BESIDE);
        let alike = alike.filter(|(p, _)| *p > self.rule.alike * first);
        alike.map(|(_, beside)| beside).collect()
    }

    /// The single effects that bring most by themselves, where something unknown alone is what is most probable: a discrepancy of the results follows them
    /// too, and may hide them.
    pub(in crate::learn) fn hidden_by_unknown(&self) -> Vec<&BesideUnknown> {
        if self.decision.verdict != Verdict::Unknown || !self.evidence.is_discrepant() {
            return Vec::new();
        }
        let least = self.rule.remainder_share * self.evidence.attainable_drop;
        let mut all: Vec<&BesideUnknown> = (self.beside_unknown.iter())
            .filter(|beside| beside.fitted.candidate.effects.single().is_some())
            .filter(|beside| beside.chi2_drop > least)
            .collect();
        all.sort_by(|a, b| b.chi2_drop.total_cmp(&a.chi2_drop));
        all.truncate(LAWS_BESIDE);
        all
    }

    /// Whether effects beside something unknown are so probable together that something unknown alone is to be held against them.
    pub(in crate::learn) fn is_beside_unknown(&self) -> bool {
        let all = self.beside_unknown.iter().map(|beside| {
            let effects = beside.fitted.candidate.effects.clone();
            self.decision
                .probability(&Hypothesis::EffectsAndUnknown(effects))
        });
        all.sum::<f64>() >= self.rule.doubt
    }

    /// The most probable effect beside something unknown, if a law alone gains more than any does beside a discrepancy.
    pub(in crate::learn) fn behind(&self, law: &LawBeside) -> Vec<&BesideUnknown> {
        let of = |remainder: &&RemainderEvidence| {
            let hypothesis = Hypothesis::EffectsAndUnknown(remainder.effects.clone());
            self.decision.probability(&hypothesis)
        };
        let all = self.evidence.beside_unknown.iter();
        let first = all.max_by(|a, b| of(a).total_cmp(&of(b)));
        let most = self.evidence.beside_discrepancy();
        let behind = first.filter(|_| most.is_some_and(|most| most < law.gain));
        let same = |beside: &&BesideUnknown| {
            behind.is_some_and(|first| first.effects == beside.fitted.candidate.effects)
        };
        self.beside_unknown.iter().filter(same).collect()
    }

    /// The decision with laws beside the effects that something unknown stands beside, and the best law alone.
    pub(in crate::learn) fn with_laws_beside(
        mut self,
        laws: Vec<LawBeside>,
        alone: Option<LawBeside>,
    ) -> Self {
        let most = laws.iter().map(|law| law.log_evidence).reduce(f64::max);
        let base = (alone.as_ref()).map(|alone| alone.log_evidence - alone.gain);
        self.evidence.law_alone = alone.map(|alone| LawAloneEvidence {
            beside_effects: most.zip(base).map(|(most, base)| most - base),
            law: alone.name,
            evidence_gain: alone.gain,
        });
        let log_evidence = laws.iter().map(|law| law.log_evidence);
        let least = log_evidence.fold(f64::INFINITY, f64::min);
        let figures = |law: LawBeside| LawBesideEvidence {
            effects: law.effects,
            law: law.name,
            evidence_gain: law.log_evidence - least,
            law_gain: law.gain,
            gain_over_base: base.map(|base| law.log_evidence - base),
        };
        self.evidence.laws_beside = laws.into_iter().map(figures).collect();
        self.decision = decide(&self.evidence, &self.rule);
        self
    }

    /// The form of effects with the largest evidence; their own where that does as well by the same model.
    pub(in crate::learn) fn best_form(&self, effects: &EffectSet) -> Option<&FittedCandidate> {
        let all = self.candidates.iter();
        let mut forms = all.filter(|fitted| fitted.candidate.effects == *effects);
        let best = forms.next()?;
        let own = forms.find(|form| {
            let is_known = form.fidelity == best.fidelity && form.converged;
            form.candidate.is_own_form() && is_known && form.does_as_well_as(best)
        });
        Some(
            own.filter(|_| !best.candidate.is_own_form())
                .unwrap_or(best),
        )
    }

    /// The same of a hypothesis; the base model of nothing missing.
    pub(in crate::learn) fn fitted<'p>(
        &'p self,
        base: &'p BaseFit,
        hypothesis: &Hypothesis,
    ) -> Option<&'p FittedCandidate> {
        match hypothesis {
            Hypothesis::NothingMissing => Some(&base.fitted),
            Hypothesis::Effects(effects) => self.best_form(effects),
            Hypothesis::EffectsAndUnknown(effects) => {
                let mut all = self.beside_unknown.iter().map(|beside| &beside.fitted);
                all.find(|fitted| fitted.candidate.effects == *effects)
            }
            Hypothesis::Unknown => None,
        }
    }

    /// The leading effects by themselves, in their best form.
    pub(in crate::learn) fn leader(&self) -> Option<&FittedCandidate> {
        self.best_form(self.decision.leading_effects()?)
    }

    /// The fit of what leads, beside something unknown where that is what leads.
    pub(in crate::learn) fn leading_fit<'p>(
        &'p self,
        base: &'p BaseFit,
    ) -> Option<&'p FittedCandidate> {
        match self.decision.group.first() {
            Some(first @ Hypothesis::EffectsAndUnknown(_)) => self.fitted(base, first),
            _ => self.leader(),
        }
    }

    /// Share of the attainable fall of χ² that the leading effects account for, in their best form; None without a discrepancy.
    pub(in crate::learn) fn share_of_leader(&self) -> Option<f64> {
        (self.falls_of_leader()).map(|[fall, attainable]| fall / attainable)
    }

    /// The two falls of χ² that this share is made of: by the leading effects, and the attainable one.
    pub(in crate::learn) fn falls_of_leader(&self) -> Option<[f64; 2]> {
        let leader = self.decision.leading_effects()?;
        let mut all = self.evidence.candidates.iter();
        let best = all.find(|c| c.effects == *leader)?;
        (self.evidence.is_discrepant())
            .then_some([self.evidence.fall(best), self.evidence.attainable_drop])
    }
}

fn remainder(likelihood: &Likelihood<'_>, beside: &BesideUnknown) -> RemainderEvidence {
    RemainderEvidence {
        effects: beside.fitted.candidate.effects.clone(),
        identified: unidentified(likelihood, &beside.fitted).is_none(),
        free_shape: beside.fitted.candidate.is_free_shape(),
        gain_over_unknown: beside.gain_over_unknown(),
        gain_with_one: Some(beside.gain_with_one),
        gain_with_any: Some(beside.gain_with_any),
        remainder_gain: beside.remainder_gain,
        chi2_drop: beside.chi2_drop,
        remaining_drop: beside.remaining.drop,
        remaining_spread: beside.remaining.spread(),
    }
}
