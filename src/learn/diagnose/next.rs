//! The next experiment: the feasible test in which two candidates, each as fitted, would differ most after refitting.

use rayon::prelude::*;

use super::feasible::{ENOUGH, NEARLY, changes, grid, shown, strength};
use super::judge::{Judge, Judged};
use super::layout::Layout;
use super::telling::{Said, Scale, Telling};
use super::verdict::{NextExperiment, NextTest};
use crate::learn::bench::Workshop;
use crate::measure::{Dataset, Quantity};
use crate::study::Operation;

/// The most telling feasible test for two candidates.
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
        .map(|t| t.chi2)
        .fold(0.0, f64::max);
    let best = found[..count]
        .iter()
        .flatten()
        .map(|t| t.chi2.min(ENOUGH))
        .fold(0.0, f64::max);
    let chosen = (0..count)
        .filter(|&i| {
            found[i]
                .as_ref()
                .is_some_and(|t| t.chi2.min(ENOUGH) >= NEARLY * best)
        })
        .min_by_key(|&i| tests[i].0)?;
    let (operation, told) = (&tests[chosen].1, found[chosen].as_ref()?);
    let names = [a.candidate.name(), b.candidate.name()];
    let test = shown(operation);
    Some(NextExperiment {
        why: sentence(judge, &test, &names, told, repetition),
        separates: names.to_vec(),
        test,
        expected_chi2: told.chi2,
        repetition_chi2: repetition,
    })
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
    chi2: f64,
    place: Place,
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
    let columns = fa.posterior(a).into_iter().chain(fb.posterior(b));
    let own: Vec<_> = columns.map(|column| scale.white(&column)).collect();
    Some(Told {
        chi2: Telling::new(&difference, &[], &own).chi2(),
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
        told.chi2,
        strength(told.chi2),
        repetition
    )
}
