//! The next experiment: the feasible test in which two candidates, each as fitted, would differ most after refitting, and those that it
//! takes beside it where one test is not enough.

use rayon::prelude::*;

use super::feasible::{APART, ENOUGH, NEARLY, changes, grid, ranked, shown, strength};
use super::judge::{Judge, Judged};
use super::layout::Layout;
use super::telling::{Said, Scale, Telling};
use super::verdict::{NextExperiment, NextTest};
use crate::learn::bench::Workshop;
use crate::measure::{Dataset, Quantity};
use crate::study::Operation;

/// Most tests that are proposed beside the first.
const FURTHER: usize = 3;

/// The most telling feasible test for two candidates, and what to make beside it.
pub(super) fn experiment(
    judge: &Judge<'_>,
    shop: &Workshop,
    a: &Judged,
    b: &Judged,
) -> Option<NextExperiment> {
    let mut tests: Vec<(usize, Operation)> = grid(&plain(judge));
    let count = tests.len();
    tests.extend(existing(judge).into_iter().map(|operation| (0, operation)));
    let found: Vec<Option<Told>> = tests
        .par_iter()
        .map(|(_, operation)| told(judge, shop, operation, a, b))
        .collect();
    let repetition = found[count..]
        .iter()
        .flatten()
        .map(Told::chi2)
        .fold(0.0, f64::max);
    let best = found[..count]
        .iter()
        .flatten()
        .map(|t| t.chi2().min(ENOUGH))
        .fold(0.0, f64::max);
    let chosen = (0..count)
        .filter(|&i| {
            found[i]
                .as_ref()
                .is_some_and(|t| t.chi2().min(ENOUGH) >= NEARLY * best)
        })
        .min_by_key(|&i| tests[i].0)?;
    let (operation, told) = (&tests[chosen].1, found[chosen].as_ref()?);
    let names = [a.candidate.name(), b.candidate.name()];
    let test = shown(operation);
    let (beside, together) = beside(&told.telling, &found[..count], &tests);
    let further: Vec<NextTest> = beside.into_iter().map(|i| shown(&tests[i].1)).collect();
    Some(NextExperiment {
        why: sentence(judge, &test, &names, told, repetition) + &more(judge, &further, together),
        separates: names.to_vec(),
        test,
        expected_chi2: told.chi2(),
        repetition_chi2: repetition,
        further,
        together_chi2: together,
    })
}

/// The tests that best join a first one, one after the other until all together are enough, and what they then tell.
fn beside(
    first: &Telling,
    found: &[Option<Told>],
    tests: &[(usize, Operation)],
) -> (Vec<usize>, f64) {
    let mut telling = first.clone();
    let mut chosen = Vec::new();
    while telling.chi2() < APART && chosen.len() < FURTHER {
        let with = |told: &Option<Told>| told.as_ref().map(|t| telling.and(&t.telling));
        let joined: Vec<Option<Telling>> = found.iter().map(with).collect();
        let score = |t: &Option<Telling>| t.as_ref().map_or(0.0, Telling::chi2);
        let changes = tests.iter().map(|t| t.0);
        let scores: Vec<(f64, usize)> = joined.iter().map(score).zip(changes).collect();
        let next = ranked(&scores)[0];
        let Some(joined) = joined.into_iter().nth(next).flatten() else {
            break;
        };
        telling = joined;
        chosen.push(next);
    }
    (chosen, telling.chi2())
}

/// What to make beside the first test, in words; nothing if it is enough.
fn more(judge: &Judge<'_>, further: &[NextTest], together: f64) -> String {
    if further.is_empty() {
        return String::new();
    }
    let plain = &judge.ground.measured.study().operation;
    let each: Vec<String> = further.iter().map(|test| changes(test, plain)).collect();
    let (word, verdict) = (
        if each.len() > 1 { "tests" } else { "one" },
        strength(together),
    );
    format!(
        " With {word} at {} as well: χ² {together:.0}, {verdict}.",
        each.join("; at ")
    )
}

/// The study's operation, as long as the longest test.
pub(super) fn plain(judge: &Judge<'_>) -> Operation {
    let longest = existing(judge).iter().map(|o| o.cycles).fold(0.0, f64::max);
    Operation {
        cycles: longest,
        ..judge.ground.measured.study().operation
    }
}

/// Conditions of the tests that were made.
pub(super) fn existing(judge: &Judge<'_>) -> Vec<Operation> {
    let tests = &judge.ground.measured.study().tests;
    let own = judge.ground.tests.iter();
    own.map(|&test| tests[test].conditions).collect()
}

/// How two candidates differ in a test.
struct Told {
    telling: Telling,
    place: Place,
}

impl Told {
    fn chi2(&self) -> f64 {
        self.telling.chi2()
    }
}

/// Where two candidates' wear depths differ most.
pub(super) struct Place {
    /// µm.
    pub(super) largest: f64,
    /// On which member.
    pub(super) member: &'static str,
    /// When.
    pub(super) cycles: f64,
}

impl Place {
    /// None without wear depths.
    pub(super) fn of(data: &Dataset, a: &[f64], b: &[f64]) -> Option<Self> {
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

fn told(
    judge: &Judge<'_>,
    shop: &Workshop,
    operation: &Operation,
    a: &Judged,
    b: &Judged,
) -> Option<Told> {
    let layout = Layout::measured(judge, operation.cycles)?;
    let test = layout.test(judge.ground.measured.study(), operation);
    let bench = shop.bench(vec![test]).ok()?;
    let said = [a, b].map(|j| Said::of(&bench, &j.candidate, &j.found.state).ok());
    let [Some(fa), Some(fb)] = said else {
        return None;
    };
    let both = || fa.values.iter().zip(&fb.values);
    let data = layout.with(&both().map(|(a, b)| 0.5 * (a + b)).collect::<Vec<f64>>());
    let rows = (0..data.observations.len()).collect();
    let scale = Scale::new(&data, rows, &judge.ground.noise);
    let difference = scale.white(&both().map(|(a, b)| a - b).collect::<Vec<f64>>());
    let parameters = fa.posterior(a).into_iter().chain(fb.posterior(b));
    let common: Vec<_> = parameters.map(|column| scale.white(&column)).collect();
    let own = [fa.scatter(a), fb.scatter(b)].map(|column| scale.white(&column));
    Some(Told {
        telling: Telling::new(&difference, &common, &own),
        place: Place::of(&data, &fa.values, &fb.values).unwrap_or(Place {
            largest: 0.0,
            member: "pair",
            cycles: operation.cycles,
        }),
    })
}

fn sentence(
    judge: &Judge<'_>,
    test: &NextTest,
    names: &[String; 2],
    told: &Told,
    repetition: f64,
) -> String {
    let place = match told.place.largest {
        0.0 => "with the quantities measured so far".to_owned(),
        largest => format!(
            "the largest difference, {largest:.2} µm, is on the {} after {:.2e} cycles",
            told.place.member, told.place.cycles
        ),
    };
    format!(
        "A test with {} separates {} from {}: after refitting they differ there by χ² {:.0}, {} (a repetition of a test made already: {:.0}); {place}.",
        changes(test, &judge.ground.measured.study().operation),
        names[0],
        names[1],
        told.chi2(),
        strength(told.chi2()),
        repetition
    )
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::super::feasible::tests::plain;
    use super::*;

    /// A test in which two candidates differ by so many sigmas, and nothing can be refitted.
    fn told(sigmas: f64) -> Option<Told> {
        let difference = DVector::from_column_slice(&[sigmas]);
        Some(Told {
            telling: Telling::new(&difference, &[], &[]),
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

    fn joined(first: f64, found: &[Option<Told>], changes: &[usize]) -> (Vec<usize>, f64) {
        beside(&told(first).unwrap().telling, found, &tests(changes))
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
    fn no_more_join_than_a_campaign_bears() {
        let (beside, together) = joined(1.0, &[told(1.0)], &[0]);
        assert_eq!(beside.len(), FURTHER);
        assert!((together - 4.0).abs() < 1e-9 && together < APART);
    }
}
