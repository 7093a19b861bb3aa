//! What a diagnosis left open, as a plan of further tests starts from it: the leading candidates by the analytic model, at the
//! values that the diagnosis found.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::next::NextExperiment;
use super::plan::{LEADERS, Leader};
use crate::learn::candidates::candidate_model::{Anchored, model};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::decision::Verdict;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::learn::inference::search::Effort;
use crate::learn::model_search::context::Context;
use crate::learn::prediction::fidelity::Fidelity;
use crate::study::WEAR_COEFFICIENT;

/// Log probability behind the first from which a candidate of a diagnosis leads no longer: a hundredth of its probability.
const DECIDED_LEADING: f64 = 4.6;

/// How a document names what stands beside something unknown.
const BESIDE_UNKNOWN: &str = "+unknown";

/// A finished diagnosis, as its document holds it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Decided {
    /// What is missing.
    pub verdict: Verdict,
    /// Candidates, the most probable first.
    pub ranking: Vec<DecidedCandidate>,
    /// The test that it proposes.
    #[serde(default)]
    pub next_experiment: Option<NextExperiment>,
    /// Probabilities by hypothesis.
    #[serde(default)]
    pub probabilities: BTreeMap<String, f64>,
    /// What it says to do next.
    #[serde(default)]
    pub next_step: String,
}

/// One candidate of a finished diagnosis.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct DecidedCandidate {
    /// Effect, set, or `nothing_missing`.
    pub effect: String,
    /// Its most probable form; empty for the card's own.
    pub form: String,
    /// Probability.
    pub probability: f64,
    /// Fitted parameters.
    pub parameters: Vec<DecidedValue>,
    /// The wear coefficient that they were fitted with, mm²/N.
    #[serde(default)]
    pub wear_coefficient: Option<f64>,
}

/// The fitted value of one parameter.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct DecidedValue {
    /// Its name; with its effect's where there are several effects.
    pub name: String,
    /// Most probable value.
    pub value: f64,
}

impl DecidedCandidate {
    /// Its effects, by themselves or beside something unknown; none of `nothing_missing`. None if the catalogue does not hold them.
    fn effects(&self) -> Option<EffectSet> {
        if self.effect == Hypothesis::NothingMissing.to_string() {
            return Some(EffectSet::new([]));
        }
        let known = self.effect.strip_suffix(BESIDE_UNKNOWN);
        let names = known.unwrap_or(&self.effect).split('+').map(str::to_owned);
        EffectSet::try_from(names.collect::<Vec<String>>()).ok()
    }

    /// ln probability behind that of `first`; what a number cannot hold counts as the least that it can.
    fn behind(&self, first: &Self) -> f64 {
        let log = |p: f64| p.max(f64::MIN_POSITIVE).ln();
        log(first.probability) - log(self.probability)
    }

    /// Its model at its fitted values by the analytic model; `singles`: all effects with their forms.
    fn at_its_values(
        &self,
        context: &Context<'_>,
        base: &BaseFit,
        singles: &[Candidate],
    ) -> Option<FittedCandidate> {
        let log_k = self.wear_coefficient.filter(|k| *k > 0.0).map(f64::ln);
        let effects = self.effects()?;
        let several = effects.len() > 1;
        let mut parts = effects
            .names()
            .map(|name| self.part(singles, name, several));
        let Some(first) = parts.next() else {
            let mut fitted = base.fitted.clone();
            fitted.found.state.log_k = log_k.unwrap_or(fitted.found.state.log_k);
            return Some(fitted);
        };
        let (candidate, values) = parts.try_fold(first?, |(all, mut values), part| {
            let (candidate, own) = part?;
            values.extend(own);
            Some((all.with(&candidate), values))
        })?;
        let mut state = base.added(&candidate, &values);
        state.log_k = log_k.unwrap_or(state.log_k);
        let predictor = Anchored::new(model(context.hertz, &candidate), base.hertz_offset.clone());
        let likelihood = &context.likelihood;
        let parameters = &candidate.parameters;
        let mut found = (likelihood.fit(&predictor, parameters, state, &Effort::STAY)).ok()?;
        if let Some(log_k) = log_k {
            // a search begins at the size of what was measured, by this model; all leaders stay at the k of the diagnosis
            found.state.log_k = log_k;
        }
        Some(FittedCandidate::new(
            likelihood,
            candidate.clone(),
            found,
            base.hertz_offset.clone(),
            Some(base),
            Fidelity::Screening,
        ))
    }

    /// One of its effects in the form that the document names, with its values.
    fn part(
        &self,
        singles: &[Candidate],
        name: &str,
        several: bool,
    ) -> Option<(Candidate, Vec<f64>)> {
        let values = self.values(name, several);
        let mut own = singles.iter().filter(|candidate| {
            let single = candidate.effects.single();
            single.is_some_and(|card| card.name == name)
                && candidate.parameters.len() - candidate.inherited == values.len()
        });
        let form = |c: &&Candidate| {
            let name = c.forms.iter().flatten().next().map_or("", |form| form.name);
            name == self.form || several && self.form.split(", ").any(|f| f == name)
        };
        let candidate = own.clone().find(form).or_else(|| own.next())?;
        Some((candidate.clone(), values))
    }

    /// The fitted values of one of its effects, in the order of that effect's parameters.
    fn values(&self, effect: &str, several: bool) -> Vec<f64> {
        let prefix = format!("{effect}.");
        let own = |p: &&DecidedValue| !several || p.name.starts_with(&prefix);
        self.parameters
            .iter()
            .filter(own)
            .map(|p| p.value)
            .collect()
    }
}

/// The fitted values of a single effect in one of its forms (empty for the card's own), by itself or else beside something unknown, by parameter,
/// and the wear coefficient with them; none where the `ranking` does not list it.
pub(in crate::learn) fn values_of<'r>(
    ranking: &'r [DecidedCandidate],
    effect: &str,
    form: &str,
) -> Vec<(&'r str, f64)> {
    let in_form = |name: &str| {
        let mut listed = ranking.iter();
        listed.find(|c| c.effect == name && c.form == form)
    };
    let known = in_form(effect).or_else(|| in_form(&format!("{effect}{BESIDE_UNKNOWN}")));
    let values = known.into_iter().flat_map(|c| &c.parameters);
    let k = known.and_then(|c| c.wear_coefficient);
    values
        .map(|p| (p.name.as_str(), p.value))
        .chain(k.map(|k| (WEAR_COEFFICIENT, k)))
        .collect()
}

impl Decided {
    /// The fitted values of a single effect in one of its forms (empty for the card's own), by itself or else beside something unknown, by
    /// parameter, and the wear coefficient with them; none where it was not listed.
    pub fn values_of(&self, effect: &str, form: &str) -> Vec<(&str, f64)> {
        values_of(&self.ranking, effect, form)
    }

    /// What leads: the first two effects or sets, and up to two more that are not far behind. What stands beside something unknown counts with
    /// the same effects by themselves, at the values of the more probable of the two: tests are computed for the effects alone.
    pub(super) fn leaders(&self) -> Vec<DecidedCandidate> {
        let mut merged: Vec<(EffectSet, DecidedCandidate)> = Vec::new();
        let mut by_probability: Vec<&DecidedCandidate> = self.ranking.iter().collect();
        by_probability.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        for candidate in by_probability {
            let Some(effects) = candidate.effects() else {
                continue;
            };
            if let Some((_, known)) = merged.iter_mut().find(|(known, _)| *known == effects) {
                known.probability += candidate.probability;
                continue;
            }
            let name = candidate.effect.strip_suffix(BESIDE_UNKNOWN);
            let named = DecidedCandidate {
                effect: name.unwrap_or(&candidate.effect).to_owned(),
                ..candidate.clone()
            };
            merged.push((effects, named));
        }
        merged.sort_by(|a, b| b.1.probability.total_cmp(&a.1.probability));
        let all: Vec<DecidedCandidate> = merged.into_iter().map(|(_, c)| c).collect();
        let near = |(i, c): &(usize, &DecidedCandidate)| {
            *i < LEADERS[0] || c.behind(&all[0]) < DECIDED_LEADING
        };
        let leading = all.iter().enumerate().take(LEADERS[1]).filter(near);
        leading.map(|(_, candidate)| candidate.clone()).collect()
    }

    /// The leaders by the analytic model at the values that the diagnosis found, each with how far it stands behind the first by the diagnosis;
    /// those that this model has no answer for are left out. They are not fitted anew: this model may know nothing of what tells an effect
    /// from the base model, and would then take the effect away.
    pub(super) fn fitted(
        &self,
        context: &Context<'_>,
        base: &BaseFit,
    ) -> Vec<(FittedCandidate, Leader)> {
        let leaders = self.leaders();
        let measured = context.likelihood.measured;
        let (singles, _) = Candidate::singles_for(measured.study(), &measured.data);
        let fitted = leaders.iter().filter_map(|leader| {
            let fitted = leader.at_its_values(context, base, &singles)?;
            let told = Leader {
                effect: leader.effect.clone(),
                form: leader.form.clone(),
                behind: leader.behind(&leaders[0]),
                probability: Some(leader.probability),
            };
            Some((fitted, told))
        });
        fitted.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::CATALOGUE;

    fn candidate(effect: &str, probability: f64) -> DecidedCandidate {
        DecidedCandidate {
            effect: effect.to_owned(),
            form: String::new(),
            probability,
            parameters: Vec::new(),
            wear_coefficient: None,
        }
    }

    #[test]
    fn two_lead_at_least_and_others_only_where_they_are_near() {
        let names = |probabilities: &[f64]| -> Vec<f64> {
            let decided = Decided {
                verdict: Verdict::Effect,
                ranking: (probabilities.iter().zip(CATALOGUE))
                    .map(|(&p, card)| candidate(card.name, p))
                    .collect(),
                next_experiment: None,
                probabilities: BTreeMap::new(),
                next_step: String::new(),
            };
            decided.leaders().iter().map(|c| c.probability).collect()
        };
        assert_eq!(names(&[0.998, 1e-30, 0.0]), [0.998, 1e-30]);
        assert_eq!(names(&[0.5, 0.3, 0.1, 0.05, 0.05]).len(), 4);
        assert_eq!(names(&[0.6, 0.399, 1e-5]).len(), 2);
        assert!(names(&[]).is_empty());
    }

    /// What is probable beside something unknown leads, with the probability of the same effects by themselves added, and not a named effect of
    /// which the diagnosis thinks nothing.
    #[test]
    fn effects_beside_something_unknown_lead_by_their_probability() {
        let mut ranking = vec![
            candidate("profile_slope+unknown", 0.40),
            candidate("tip_relief+unknown", 0.31),
            candidate("profile_form+unknown", 0.18),
            candidate("running_in+profile_form", 7e-5),
            candidate("tip_relief", 0.1),
        ];
        for (at, value) in [(0, -2.4), (1, 1.1), (4, 1.3)] {
            ranking[at].parameters.push(DecidedValue {
                name: "amount".to_owned(),
                value,
            });
        }
        let decided = Decided {
            verdict: Verdict::Partial,
            ranking,
            next_experiment: None,
            probabilities: BTreeMap::new(),
            next_step: String::new(),
        };
        let leaders = decided.leaders();
        let names: Vec<&str> = leaders.iter().map(|c| c.effect.as_str()).collect();
        assert_eq!(names, ["tip_relief", "profile_slope", "profile_form"]);
        assert!((leaders[0].probability - 0.41).abs() < 1e-12);
        // at the values of the more probable of the two
        assert_eq!(leaders[0].values("tip_relief", false), [1.1]);
        // a fit begins at those of the effect by itself where there are any
        assert_eq!(decided.values_of("tip_relief", ""), [("amount", 1.3)]);
        assert_eq!(decided.values_of("profile_slope", ""), [("amount", -2.4)]);
        assert!(decided.values_of("running_in", "").is_empty());
        // and at its wear coefficient
        let mut with_k = decided.clone();
        for candidate in &mut with_k.ranking {
            candidate.wear_coefficient = Some(3e-10);
        }
        assert_eq!(
            with_k.values_of("tip_relief", ""),
            [("amount", 1.3), (WEAR_COEFFICIENT, 3e-10)]
        );
    }

    #[test]
    fn names_of_the_document_are_effects_of_the_catalogue() {
        assert!(
            candidate("nothing_missing", 0.5)
                .effects()
                .unwrap()
                .is_empty()
        );
        let pair = candidate("running_in+tip_relief", 0.5).effects().unwrap();
        assert_eq!(pair.len(), 2);
        assert!(candidate("no_such_effect", 0.5).effects().is_none());
    }
}
