//! What a diagnosis left open, as a plan of further tests starts from it: the leading candidates, fitted anew by the analytic model from
//! the values that the diagnosis found.

use serde::Deserialize;

use super::next::NextExperiment;
use super::plan::{LEADERS, LEADING, Leader};
use crate::learn::decision::Verdict;
use crate::learn::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::learn::model_search::context::Context;
use crate::learn::model_search::pair_fit::{self, PairStart};

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
    /// Its effects; none of `nothing_missing`. None if the catalogue does not hold them.
    fn effects(&self) -> Option<EffectSet> {
        if self.effect == Hypothesis::NothingMissing.to_string() {
            return Some(EffectSet::new([]));
        }
        let names: Vec<String> = self.effect.split('+').map(str::to_owned).collect();
        EffectSet::try_from(names).ok()
    }

    /// ln probability behind that of `first`; what a number cannot hold counts as the least that it can.
    fn behind(&self, first: &Self) -> f64 {
        let log = |p: f64| p.max(f64::MIN_POSITIVE).ln();
        log(first.probability) - log(self.probability)
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

impl Decided {
    /// The fitted values of a single effect in one of its forms (empty for the card's own), by parameter; none where it was not listed.
    pub fn values_of(&self, effect: &str, form: &str) -> Vec<(&str, f64)> {
        let known = (self.ranking.iter()).find(|c| c.effect == effect && c.form == form);
        let values = known.into_iter().flat_map(|c| &c.parameters);
        values.map(|p| (p.name.as_str(), p.value)).collect()
    }

    /// What leads: the first two, and up to two more that are not far behind.
    pub(super) fn leaders(&self) -> Vec<&DecidedCandidate> {
        let Some(first) = self.ranking.iter().find(|c| c.effects().is_some()) else {
            return Vec::new();
        };
        let near =
            |(i, c): &(usize, &DecidedCandidate)| *i < LEADERS[0] || c.behind(first) < LEADING;
        // what stands beside something unknown predicts no further test
        let known = self.ranking.iter().filter(|c| c.effects().is_some());
        let all = known.enumerate().take(LEADERS[1]);
        all.filter(near).map(|(_, candidate)| candidate).collect()
    }

    /// The leaders fitted by the analytic model, each with how far it stands behind the first by the diagnosis; those that this model
    /// cannot fit are left out.
    pub(super) fn fitted(
        &self,
        context: &Context<'_>,
        base: &BaseFit,
    ) -> Vec<(FittedCandidate, Leader)> {
        let leaders = self.leaders();
        let (singles, _) = Candidate::singles(context.likelihood.measured.study());
        let of = |leader: &DecidedCandidate, name: &str, several: bool| {
            let values = leader.values(name, several);
            let mut own = singles.iter().filter(|candidate| {
                let single = candidate.effects.single();
                single.is_some_and(|card| card.name == name)
                    && candidate.parameters.len() - candidate.inherited == values.len()
            });
            let form = |c: &&Candidate| {
                let name = c.forms.iter().flatten().next().map_or("", |form| form.name);
                name == leader.form || several && leader.form.split(", ").any(|f| f == name)
            };
            let candidate = own.clone().find(form).or_else(|| own.next())?;
            Some(candidate.starting_at(values))
        };
        let fitted = leaders.iter().filter_map(|leader| {
            let effects = leader.effects()?;
            let several = effects.len() > 1;
            let parts: Option<Vec<Candidate>> = effects
                .names()
                .map(|name| of(leader, name, several))
                .collect();
            let mut parts = context.screen(base, &parts?);
            let fitted = match (effects.len(), parts.len()) {
                (0, _) => base.fitted.clone(),
                (1, 1) => parts.remove(0),
                (2, 2) => {
                    let start = PairStart::of(base, &parts[0], &parts[1]);
                    pair_fit::fit(context, base, vec![start]).pop()?
                }
                _ => return None,
            };
            let told = Leader {
                effect: leader.effect.clone(),
                form: leader.form.clone(),
                behind: leader.behind(leaders[0]),
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

    fn candidate(effect: &str, probability: f64) -> DecidedCandidate {
        DecidedCandidate {
            effect: effect.to_owned(),
            form: String::new(),
            probability,
            parameters: Vec::new(),
        }
    }

    #[test]
    fn two_lead_at_least_and_others_only_where_they_are_near() {
        let names = |probabilities: &[f64]| -> Vec<f64> {
            let decided = Decided {
                verdict: Verdict::Effect,
                ranking: (probabilities.iter().map(|&p| candidate("coating", p))).collect(),
                next_experiment: None,
            };
            decided.leaders().iter().map(|c| c.probability).collect()
        };
        assert_eq!(names(&[0.998, 1e-30, 0.0]), [0.998, 1e-30]);
        assert_eq!(names(&[0.5, 0.3, 0.1, 0.05, 0.05]).len(), 4);
        assert_eq!(names(&[0.6, 0.399, 1e-5]).len(), 2);
        assert!(names(&[]).is_empty());
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
