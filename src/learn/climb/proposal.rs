//! What a diagnosis proposes to add, and which of several that look alike.

use serde::Deserialize;

use super::Standing;
use crate::effects::CATALOGUE;
use crate::learn::decision::Verdict;
use crate::learn::experiment::decided::{DecidedCandidate, values_of};
use crate::learn::explanation::{Diagnosis, Named, Ranked, Screened};

/// Effects that are tried in turn where the first does not pay.
const IN_TURN: usize = 3;
/// Effects that are compared where the data cannot tell them apart.
const COMPARED: usize = 4;

/// Effects that a diagnosis proposes to add.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Proposal {
    /// One is to be tried after the other until one pays, the strongest first.
    InTurn(Vec<String>),
    /// The data cannot tell them apart: the best of all is to be taken. The most probable first.
    BestOf(Vec<String>),
}

/// Which of several effects is taken, and in words why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choice {
    /// Its place among them.
    pub place: usize,
    /// Why this one.
    pub why: String,
    /// Why not the others that pay.
    pub why_not: String,
}

/// What a step up needs of a diagnosis; it can be read from its document.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// What is missing.
    pub verdict: Verdict,
    /// The named effect or effects.
    effect: Option<Named>,
    /// Groups that the data cannot tell apart.
    indistinguishable: Vec<Vec<String>>,
    /// What was fitted.
    screened: Vec<AnswerFit>,
    /// Candidates, the most probable first.
    ranking: Vec<DecidedCandidate>,
}

/// A fit of a diagnosis.
#[derive(Debug, Clone, PartialEq, Deserialize)]
struct AnswerFit {
    effects: Vec<String>,
    chi2_drop: f64,
}

impl From<&Diagnosis> for Answer {
    fn from(diagnosis: &Diagnosis) -> Self {
        let fit = |fit: &Screened| AnswerFit {
            effects: fit.effects.clone(),
            chi2_drop: fit.chi2_drop,
        };
        Self {
            verdict: diagnosis.verdict,
            effect: diagnosis.effect.clone(),
            indistinguishable: diagnosis.indistinguishable.clone(),
            screened: diagnosis.screened.iter().map(fit).collect(),
            ranking: diagnosis.ranking.iter().map(Ranked::decided).collect(),
        }
    }
}

impl Answer {
    /// The fitted values of a single effect in one of its forms (empty for the card's own), by itself or else beside something unknown, by
    /// parameter, and the wear coefficient with them; none where it is not listed.
    pub fn values_of(&self, effect: &str, form: &str) -> Vec<(&str, f64)> {
        values_of(&self.ranking, effect, form)
    }
}

/// What a diagnosis proposes: the effects that it names; of what it cannot tell apart, all. None where nothing is missing, or nothing of the
/// catalogue is established.
pub fn proposal(answer: &Answer) -> Proposal {
    let named: Vec<String> = match (answer.verdict, &answer.effect) {
        (Verdict::NothingMissing | Verdict::Unknown, _) => Vec::new(),
        (_, Some(Named::One(effect))) => vec![effect.clone()],
        (_, Some(Named::Several(effects))) => effects.clone(),
        (_, None) => {
            let mut alike = known(members(&answer.indistinguishable));
            alike.truncate(COMPARED);
            return match alike.len() {
                0 | 1 => Proposal::InTurn(alike),
                _ => Proposal::BestOf(alike),
            };
        }
    };
    let alone = |effect: &str| {
        let own = answer.screened.iter().filter(|s| s.effects == [effect]);
        own.map(|s| s.chi2_drop).fold(f64::NEG_INFINITY, f64::max)
    };
    let mut effects = known(named.into_iter());
    // of several the strongest first: the others are looked for again with it in
    effects.sort_by(|a, b| alone(b).total_cmp(&alone(a)));
    effects.truncate(IN_TURN);
    Proposal::InTurn(effects)
}

/// The effects of groups, sets taken apart.
fn members(groups: &[Vec<String>]) -> impl Iterator<Item = String> {
    let all = groups.iter().flatten();
    all.flat_map(|member| member.split('+')).map(str::to_owned)
}

/// Those that the catalogue holds, each once.
fn known(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut known: Vec<String> = Vec::new();
    for name in names {
        if !known.contains(&name) && CATALOGUE.iter().any(|card| card.name == name) {
            known.push(name);
        }
    }
    known
}

/// ln of the odds below which the best of several effects is hardly ahead of the next.
const HARDLY_AHEAD: f64 = 3.0;

/// The best of `effects`, each with how it stands and whether it pays: of those that pay the one that all measurements make the most likely, those
/// of the fit by evidence and the tests that it was not fitted to by their error, the first of equals. None if none pays.
pub fn choose(effects: &[(&str, Standing, bool)]) -> Option<Choice> {
    let mut paying: Vec<usize> = (0..effects.len()).filter(|&i| effects[i].2).collect();
    let likelihood = |i: usize| effects[i].1.log_likelihood_of_all();
    paying.sort_by(|&a, &b| likelihood(b).total_cmp(&likelihood(a)));
    let place = *paying.first()?;
    let (name, standing, _) = effects[place];
    let tests = match standing.holdout {
        Some(_) => "by evidence and held-out error combined",
        None => "by evidence and left-out error combined",
    };
    let mut in_order = paying.clone();
    in_order.sort_unstable();
    let names: Vec<&str> = in_order.iter().map(|&i| effects[i].0).collect();
    let why = match paying.get(1) {
        Some(&second) if likelihood(place) - likelihood(second) < HARDLY_AHEAD => format!(
            "of {}, {name} does best {tests}, but is hardly ahead of {}: make the test that gearwear plan has for the study without it before going by it",
            listed(&names),
            effects[second].0
        ),
        Some(_) => format!("of {}, {name} does best {tests}", listed(&names)),
        None => {
            let names: Vec<&str> = effects.iter().map(|effect| effect.0).collect();
            format!("of {}, only {name} pays", listed(&names))
        }
    };
    Some(Choice {
        place,
        why,
        why_not: format!("{name} does better {tests}"),
    })
}

/// `a, b and c`.
fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standing(holdout: Option<f64>, left_out: Option<f64>) -> Standing {
        Standing {
            fit: Some(1.05),
            log_evidence: 50.0,
            holdout,
            left_out,
            points: 200,
        }
    }

    #[test]
    fn the_best_by_evidence_and_on_held_out_tests_is_chosen_of_those_that_pay() {
        let of = |holdouts: [f64; 3], pays: [bool; 3]| {
            let names = ["profile_slope", "tip_relief", "profile_form"];
            let all: Vec<(&str, Standing, bool)> = (names.into_iter().zip(holdouts).zip(pays))
                .map(|((name, chi2), pays)| (name, standing(Some(chi2), None), pays))
                .collect();
            choose(&all)
        };
        let best = of([1.135, 1.084, 1.18], [true; 3]).unwrap();
        assert_eq!(best.place, 1);
        assert_eq!(
            best.why,
            "of profile_slope, tip_relief and profile_form, tip_relief does best by evidence and held-out error combined"
        );
        assert_eq!(
            best.why_not,
            "tip_relief does better by evidence and held-out error combined"
        );
        let best = of([1.135, 1.114, 1.18], [true, false, true]).unwrap();
        assert_eq!((best.place, best.why.contains("tip_relief")), (0, false));
        let best = of([1.135, 1.114, 1.18], [false, false, true]).unwrap();
        assert!(best.why.ends_with("only profile_form pays"), "{}", best.why);
        assert_eq!(of([1.0; 3], [false; 3]), None);
        // of equals the more probable, which comes first
        let equal = of([1.1; 3], [true; 3]).unwrap();
        assert!(
            equal.place == 0 && equal.why.contains("hardly ahead of tip_relief"),
            "{}",
            equal.why
        );
    }

    /// 444 held-out rows with χ² 0.915 and 0.916 per point say nothing where the evidence has odds of 3000 to 1.
    #[test]
    fn held_out_tests_that_hardly_differ_do_not_outweigh_the_evidence() {
        let of = |log_evidence: f64, holdout: f64| Standing {
            log_evidence,
            points: 444,
            ..standing(Some(holdout), None)
        };
        let all = [
            ("running_in", of(6518.2, 0.916), true),
            ("lubricant_ageing", of(6510.2, 0.915), true),
        ];
        assert_eq!(choose(&all).unwrap().place, 0);
        // 444 × 0.027/2 = 6 is less than 8
        let near = [all[0], ("lubricant_ageing", of(6510.2, 0.889), true)];
        assert_eq!(choose(&near).unwrap().place, 0);
        let clear = [all[0], ("lubricant_ageing", of(6510.2, 0.8), true)];
        assert_eq!(choose(&clear).unwrap().place, 1);
    }

    #[test]
    fn where_nothing_is_held_out_tests_left_out_decide() {
        let all = [
            ("a", standing(None, Some(1.3)), true),
            ("b", standing(None, Some(1.2)), true),
        ];
        let best = choose(&all).unwrap();
        assert_eq!(best.place, 1);
        assert_eq!(
            best.why,
            "of a and b, b does best by evidence and left-out error combined"
        );
    }

    #[test]
    fn groups_are_taken_apart_and_only_the_catalogue_is_proposed() {
        let groups = [["running_in+coating", "running_in", "unknown"]
            .map(str::to_owned)
            .to_vec()];
        assert_eq!(known(members(&groups)), ["running_in", "coating"]);
    }
}
