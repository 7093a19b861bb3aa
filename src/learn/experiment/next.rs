//! The next experiment: the feasible test in which two candidates, each as fitted, would differ most after refitting, and those that it
//! takes beside it where one test is not enough.

use rayon::prelude::*;

use super::candidate_tests::{
    APART, CLEAR, ENOUGH, NEARLY, NextTest, changes, duration, feasible, ranked, shown, strength,
    with_hours,
};
use super::discrimination::{Discrimination, PlannedResponse, Whitening};
use super::made_tests::made;
use super::measurement_design::MeasurementDesign;
use crate::learn::candidates::fitted_candidate::BaseFit;
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::decision::Verdict;
use crate::learn::decision::judged_candidates::JudgedCandidates;
use crate::learn::hypothesis::Hypothesis;
use crate::learn::model_search::context::Context;
use crate::learn::prediction::bench::Workshop;
use crate::measure::{Dataset, Quantity};
use crate::study::Operation;
use serde::{Deserialize, Serialize};

/// A test that would separate what is left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NextExperiment {
    /// What it separates.
    pub separates: Vec<String>,
    /// Its conditions.
    #[serde(serialize_with = "with_hours")]
    pub test: NextTest,
    /// Id of the test that it repeats; None of one under new conditions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repeats: Option<String>,
    /// Why it does.
    pub why: String,
    /// Expected difference of the two in χ² after refitting.
    pub expected_chi2: f64,
    /// The same for a repetition of the most telling test that is there already.
    pub repetition_chi2: f64,
    /// Tests to be made as well where that one is not enough.
    pub further: Vec<NextTest>,
    /// Expected difference of the two in χ² after all of them.
    pub together_chi2: f64,
}

/// Log evidence between two candidates from which no experiment is needed to separate them.
const SETTLED: f64 = 10.0;
/// χ² between two candidates below which a test is not worth proposing.
const WORTH_MAKING: f64 = 1.0;
/// Most tests that are proposed beside the first.
const FURTHER: usize = 3;

/// The test that separates the two most probable of what is left; none where nothing is in doubt.
pub(in crate::learn) fn separating(
    context: &Context<'_>,
    shop: &Workshop,
    base: &BaseFit,
    posterior: &JudgedCandidates,
) -> Option<NextExperiment> {
    let decision = &posterior.decision;
    let effects = || decision.effects.iter().cloned().map(Hypothesis::Effects);
    let hypotheses: Vec<Hypothesis> = match decision.verdict {
        Verdict::Ambiguous => decision.group.clone(),
        Verdict::Effect | Verdict::Effects => effects().take(2).collect(),
        Verdict::NothingMissing => std::iter::once(Hypothesis::NothingMissing)
            .chain(effects().take(1))
            .collect(),
        Verdict::Partial if decision.group.len() > 1 => decision.group.clone(),
        Verdict::Partial | Verdict::Unknown => return None,
    };
    let mut left = hypotheses.iter().filter_map(|h| posterior.fitted(base, h));
    let (a, b) = (left.next()?, left.next()?);
    let settled = (a.log_evidence - b.log_evidence).abs() > SETTLED;
    if settled && decision.group.len() < 2 {
        return None;
    }
    experiment(context, shop, a, b).filter(|told| told.together_chi2 >= WORTH_MAKING)
}

/// The most telling feasible test for two candidates, and what to make beside it.
fn experiment(
    context: &Context<'_>,
    shop: &Workshop,
    a: &FittedCandidate,
    b: &FittedCandidate,
) -> Option<NextExperiment> {
    let study = context.likelihood.measured.study();
    let plain = plain(context);
    let made = made(&study.tests, &context.likelihood.measured.data);
    let is_new = |(_, test): &(usize, Operation)| {
        let test = shown(test);
        !made.iter().any(|made| made.is_repeated_by(&test))
    };
    let mut tests: Vec<(usize, Operation)> = (feasible(study, &plain).into_iter())
        .filter(is_new)
        .collect();
    let count = tests.len();
    let existing = existing(context).into_iter();
    tests.extend(existing.map(|operation| (0, operation)));
    let found: Vec<Option<TestDiscrimination>> = tests
        .par_iter()
        .map(|(_, operation)| discrimination(context, shop, operation, a, b))
        .collect();
    let [of_new, of_made] = [&found[..count], &found[count..]].map(best);
    let chosen = (0..count)
        .filter(|&i| {
            found[i]
                .as_ref()
                .is_some_and(|t| t.chi2().min(ENOUGH) >= NEARLY * of_new.1.min(ENOUGH))
        })
        .min_by(|&i, &j| {
            let [a, b] = [i, j].map(|i| cost(&tests[i]));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })?;
    let repeated = is_better_repeated(of_new.1, of_made.1).then_some(of_made.0);
    let repeats = repeated.map(|i| study.tests[context.likelihood.tests[i]].id.clone());
    let chosen = repeated.map_or(chosen, |i| count + i);
    let (operation, told) = (&tests[chosen].1, found[chosen].as_ref()?);
    let names = [a, b].map(|j| j.candidate.hypothesis().to_string());
    let test = shown(operation);
    let (beside, together) = beside(&told.discrimination, &found[..count], &tests);
    let further: Vec<NextTest> = beside.into_iter().map(|i| shown(&tests[i].1)).collect();
    let other = match repeats {
        Some(_) => of_new.1,
        None => of_made.1,
    };
    let what = proposal(&test, repeats.as_deref(), &plain);
    Some(NextExperiment {
        why: sentence(&what, &names, told, [other, together], repeats.is_some())
            + &more(&test, &further, &plain, together),
        separates: names.to_vec(),
        test,
        repeats,
        expected_chi2: told.chi2(),
        repetition_chi2: of_made.1,
        further,
        together_chi2: together,
    })
}

/// The test of the largest χ², and that χ²; 0 where none has one.
fn best(found: &[Option<TestDiscrimination>]) -> (usize, f64) {
    let chi2 = |told: &Option<TestDiscrimination>| told.as_ref().map_or(0.0, |t| t.chi2());
    let all = found.iter().map(chi2).enumerate();
    // of equals the first
    all.fold((0, 0.0), |best, at| if at.1 > best.1 { at } else { best })
}

/// Whether a test made already is to be made once more: where one under new conditions tells clearly less, and not enough either. New conditions
/// are preferred: what is wrong with a test is wrong in its repetition too.
fn is_better_repeated(of_new: f64, of_made: f64) -> bool {
    of_new.min(ENOUGH) < NEARLY * of_made.min(ENOUGH)
}

/// What makes one of near-equal tests the better: fewer changes, then fewer hours on the rig.
fn cost((changes, operation): &(usize, Operation)) -> (usize, f64) {
    (*changes, shown(operation).hours())
}

/// The tests that best join a first one, one after the other until all together are enough, and what they then tell.
fn beside(
    first: &Discrimination,
    found: &[Option<TestDiscrimination>],
    tests: &[(usize, Operation)],
) -> (Vec<usize>, f64) {
    let mut discrimination = first.clone();
    let mut chosen = Vec::new();
    while discrimination.chi2() < APART && chosen.len() < FURTHER {
        let with = |told: &Option<TestDiscrimination>| {
            told.as_ref().map(|t| discrimination.and(&t.discrimination))
        };
        let joined: Vec<Option<Discrimination>> = found.iter().map(with).collect();
        let score = |t: &Option<Discrimination>| t.as_ref().map_or(0.0, Discrimination::chi2);
        let costs = tests.iter().map(cost);
        let scores: Vec<_> = joined.iter().map(score).zip(costs).collect();
        let next = ranked(&scores)[0];
        let Some(joined) = joined.into_iter().nth(next).flatten() else {
            break;
        };
        discrimination = joined;
        chosen.push(next);
    }
    (chosen, discrimination.chi2())
}

/// What to make beside the first test, in words; nothing if it is enough.
fn more(first: &NextTest, further: &[NextTest], plain: &Operation, together: f64) -> String {
    if further.is_empty() {
        return String::new();
    }
    let mut counted: Vec<(&NextTest, usize)> = Vec::new();
    for test in further {
        match counted.iter_mut().find(|(known, _)| *known == test) {
            Some((_, count)) => *count += 1,
            None => counted.push((test, 1)),
        }
    }
    let each: Vec<String> = (counted.into_iter())
        .map(|(test, count)| {
            let number = ["one", "two", "three"].get(count - 1);
            let number = number.map_or_else(|| count.to_string(), |word| (*word).to_owned());
            let s = if count > 1 { "s" } else { "" };
            if test == first {
                return format!("{number} repeat{s} of it");
            }
            format!("{number} test{s} with {}", changes(test, plain))
        })
        .collect();
    format!(
        " Together with {}: χ² {together:.1}, {}.",
        each.join(" and "),
        strength(together)
    )
}

/// The study's operation, as long as the longest test; at the first test's temperature where the study states none and its tests do.
pub(in crate::learn) fn plain(context: &Context<'_>) -> Operation {
    let existing = existing(context);
    let longest = existing.iter().map(|o| o.cycles).fold(0.0, f64::max);
    let operation = Operation {
        cycles: longest,
        ..context.likelihood.measured.study().operation
    };
    let mut of_tests = existing.iter().filter_map(Operation::stated_temperature_c);
    match (operation.bulk_temperature_c, of_tests.next()) {
        (None, Some(celsius)) => operation.at_temperature(celsius),
        _ => operation,
    }
}

/// Conditions of the tests that were made.
pub(in crate::learn) fn existing(context: &Context<'_>) -> Vec<Operation> {
    let tests = &context.likelihood.measured.study().tests;
    let own = context.likelihood.tests.iter();
    own.map(|&test| tests[test].conditions).collect()
}

/// How two candidates differ in a test.
struct TestDiscrimination {
    discrimination: Discrimination,
    place: Place,
}

impl TestDiscrimination {
    fn chi2(&self) -> f64 {
        self.discrimination.chi2()
    }
}

/// Where two candidates' wear depths differ most.
pub(in crate::learn) struct Place {
    /// µm.
    pub(in crate::learn) largest: f64,
    /// On which member.
    pub(in crate::learn) member: &'static str,
    /// When.
    pub(in crate::learn) cycles: f64,
}

impl Place {
    /// None without wear depths.
    pub(in crate::learn) fn of(data: &Dataset, a: &[f64], b: &[f64]) -> Option<Self> {
        let off = |i: &usize| (a[*i] - b[*i]).abs();
        (0..data.observations.len())
            .filter(|&i| data.observations[i].quantity == Quantity::WearDepth)
            .max_by(|i, j| off(i).total_cmp(&off(j)))
            .map(|i| Self {
                largest: off(&i),
                member: data.observations[i].member.name(),
                cycles: data.observations[i].cycles,
            })
    }
}

fn discrimination(
    context: &Context<'_>,
    shop: &Workshop,
    operation: &Operation,
    a: &FittedCandidate,
    b: &FittedCandidate,
) -> Option<TestDiscrimination> {
    let design = MeasurementDesign::measured(context, operation.cycles)?;
    let test = design.test(context.likelihood.measured.study(), operation);
    let bench = shop.bench(vec![test]).ok()?;
    let said = [a, b].map(|j| PlannedResponse::of(&bench, &j.candidate, &j.found.state).ok());
    let [Some(fa), Some(fb)] = said else {
        return None;
    };
    let both = || fa.values.iter().zip(&fb.values);
    let data = design.with(&both().map(|(a, b)| 0.5 * (a + b)).collect::<Vec<f64>>());
    let rows = (0..data.observations.len()).collect();
    let scale = Whitening::new(&data, rows, &context.likelihood.noise);
    let difference = scale.white(&both().map(|(a, b)| a - b).collect::<Vec<f64>>());
    let parameters = fa.posterior(a).into_iter().chain(fb.posterior(b));
    let common: Vec<_> = parameters.map(|column| scale.white(&column)).collect();
    let own = [fa.scatter(a), fb.scatter(b)].map(|column| scale.white(&column));
    Some(TestDiscrimination {
        discrimination: Discrimination::new(&difference, &common, &own),
        place: Place::of(&data, &fa.values, &fb.values).unwrap_or(Place {
            largest: 0.0,
            member: "pair",
            cycles: operation.cycles,
        }),
    })
}

/// The beginning of the sentence on a proposed test.
fn proposal(test: &NextTest, repeats: Option<&str>, plain: &Operation) -> String {
    let hours = duration(test);
    match repeats {
        Some(id) => {
            format!("Test {id} made once more ({hours}), with all that was measured in it,")
        }
        None => format!("A test with {} ({hours})", changes(test, plain)),
    }
}

/// `other`: χ² of the best repetition, or where that is what is proposed of the best test under new conditions.
fn sentence(
    proposal: &str,
    names: &[String; 2],
    told: &TestDiscrimination,
    [other, together]: [f64; 2],
    is_repetition: bool,
) -> String {
    let alone = told.chi2();
    let verb = if alone < CLEAR {
        "hardly separates"
    } else {
        "separates"
    };
    let strength = if alone < CLEAR && together > alone {
        "too little by itself"
    } else {
        strength(alone)
    };
    let place = match told.place.largest {
        0.0 => "with the quantities measured so far".to_owned(),
        largest => format!(
            "the largest difference, {largest:.2} µm, is on the {} after {:.2e} cycles",
            told.place.member, told.place.cycles
        ),
    };
    let beside = if is_repetition {
        "under other conditions none tells as much"
    } else {
        "a repetition of a test made already"
    };
    // why not that one, if it seems to tell more
    let why_not = match other > alone && !is_repetition {
        true if alone >= ENOUGH => ", more than is needed as well",
        true => ", hardly more",
        false => "",
    };
    format!(
        "{proposal} {verb} {} from {}: after refitting they differ there by χ² {}, {strength} ({beside}: {}{why_not}); {place}.",
        names[0],
        names[1],
        figure(alone),
        figure(other),
    )
}

/// A χ² between candidates: of small ones the first decimal counts.
fn figure(chi2: f64) -> String {
    let digits = usize::from(chi2 < 10.0);
    format!("{chi2:.digits$}")
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::super::candidate_tests::tests::plain;
    use super::*;

    /// A test in which two candidates differ by so many sigmas, and nothing can be refitted.
    fn told(sigmas: f64) -> Option<TestDiscrimination> {
        let difference = DVector::from_column_slice(&[sigmas]);
        Some(TestDiscrimination {
            discrimination: Discrimination::new(&difference, &[], &[]),
            place: Place {
                largest: 0.0,
                member: "pair",
                cycles: 1e6,
            },
        })
    }

    fn tests(changes: &[usize]) -> Vec<(usize, Operation)> {
        changes.iter().map(|&n| (n, plain())).collect()
    }

    fn joined(
        first: f64,
        found: &[Option<TestDiscrimination>],
        changes: &[usize],
    ) -> (Vec<usize>, f64) {
        beside(&told(first).unwrap().discrimination, found, &tests(changes))
    }

    #[test]
    fn tests_join_until_they_are_enough() {
        let found = [told(3.0), told(2.0), None];
        // 9 + 9 = 18 beats 9 + 4; then 18 + 4 = 22 is nearly 18 + 9, plainer and enough
        let (beside, together) = joined(3.0, &found, &[1, 0, 0]);
        assert_eq!(beside, [0, 1]);
        assert!((together - 22.0).abs() < 1e-9);
        assert_eq!(joined(5.0, &found, &[1, 0, 0]), (Vec::new(), 25.0));
    }

    #[test]
    fn like_tests_are_counted_and_not_listed_one_by_one() {
        let test = |torque| NextTest {
            torque,
            ..shown(&plain())
        };
        let first = test(50.0);
        let same = [first.clone(), first.clone(), first.clone()];
        assert_eq!(
            more(&first, &same, &plain(), 3.2),
            " Together with three repeats of it: χ² 3.2, still little: other measurements are needed."
        );
        let others = [first.clone(), test(200.0)];
        let said = more(&first, &others, &plain(), 30.0);
        assert!(
            said.starts_with(" Together with one repeat of it and one test with 200 N·m: χ² 30"),
            "{said}"
        );
        assert!(more(&first, &[], &plain(), 30.0).is_empty());
    }

    #[test]
    fn no_more_join_than_a_campaign_bears() {
        let (beside, together) = joined(1.0, &[told(1.0)], &[0]);
        assert_eq!(beside.len(), FURTHER);
        assert!((together - 4.0).abs() < 1e-9 && together < APART);
    }

    /// One piece of advice: what tells more is what is proposed, but for what is hardly better or more than anybody needs.
    #[test]
    fn a_test_is_repeated_where_new_conditions_tell_less() {
        assert!(is_better_repeated(4.0, 6.0) && is_better_repeated(20.0, 366.0));
        assert!(!is_better_repeated(5.0, 6.0) && !is_better_repeated(275.0, 366.0));
        assert!(!is_better_repeated(0.0, 0.0));
        let names = ["a".to_owned(), "b".to_owned()];
        let said = |repeats, sigmas: f64, other| {
            let what = proposal(&shown(&plain()), repeats, &plain());
            let told = told(sigmas).unwrap();
            sentence(&what, &names, &told, [other, 100.0], repeats.is_some())
        };
        let again = said(Some("P2"), 3.0, 4.0);
        assert!(
            again.starts_with("Test P2 made once more (8.33 h), with all that was measured in it, separates a from b: "),
            "{again}"
        );
        assert!(
            again.contains("(under other conditions none tells as much: 4.0)"),
            "{again}"
        );
        let new = said(None, 3.0, 10.0);
        assert!(
            new.contains("(a repetition of a test made already: 10, hardly more)"),
            "{new}"
        );
        let enough = said(None, 9.0, 366.0);
        assert!(
            enough.contains("made already: 366, more than is needed as well)"),
            "{enough}"
        );
    }

    #[test]
    fn the_most_telling_test_is_the_first_of_equals() {
        let (place, chi2) = best(&[None, told(2.0), told(3.0), told(3.0)]);
        assert_eq!(place, 2);
        assert!((chi2 - 9.0).abs() < 1e-12);
        assert_eq!(best(&[None]), (0, 0.0));
    }
}
