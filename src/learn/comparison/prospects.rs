//! What measurements let a comparison conclude, before any is made: which laws could show, and what would have to be measured besides.

use std::collections::BTreeSet;

use crate::measure::{Dataset, Observation, Quantity, Subject};
use crate::study::{Operation, Role, Study};

/// Sentences, what can be said first and what cannot after.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Prospects {
    /// What these measurements can show.
    pub can: Vec<String>,
    /// What they cannot, and what would.
    pub cannot: Vec<String>,
}

/// Of the rows of the fit tests.
pub fn prospects(study: &Study, data: &Dataset) -> Prospects {
    let rows = |role: Role| {
        let of = move |o: &&Observation| study.tests[o.test].role == role;
        data.observations.iter().filter(of)
    };
    let measured: BTreeSet<usize> = rows(Role::Fit).map(|o| o.test).collect();
    let distinct = |of: &dyn Fn(&Operation) -> f64| {
        let values = measured
            .iter()
            .map(|&t| of(&study.tests[t].conditions).to_bits());
        values.collect::<BTreeSet<u64>>().len()
    };
    let has = |quantity: Quantity| rows(Role::Fit).any(|o| o.quantity == quantity);
    let members =
        [Subject::Pinion, Subject::Gear].map(|member| rows(Role::Fit).any(|o| o.member == member));
    let checkpoints = measured.iter().map(|&test| {
        let of_test = rows(Role::Fit).filter(|o| o.test == test && o.cycles > 0.0);
        of_test
            .map(|o| o.cycles.to_bits())
            .collect::<BTreeSet<u64>>()
            .len()
    });
    let checkpoints = checkpoints.max().unwrap_or(0);
    let mut said = Prospects::default();
    let mut judge = |good: bool, can: &str, cannot: &str| {
        let (list, words) = if good {
            (&mut said.can, can)
        } else {
            (&mut said.cannot, cannot)
        };
        list.push(words.to_owned());
    };
    judge(
        Quantity::ALL.into_iter().any(|q| q.is_wear() && has(q)),
        "the wear coefficient k",
        "the wear coefficient: no fit test has a depth, a mass or a mean lag",
    );
    judge(
        has(Quantity::WearDepth),
        "where along the flank the model fails",
        "where along the flank the model fails: measure wear_depth along it",
    );
    judge(
        checkpoints >= 3,
        "laws of time (running-in, ageing, coatings)",
        "laws of time (running-in, ageing, coatings): measure a test at three times or more",
    );
    judge(
        distinct(&|o| o.torque_nmm) >= 2,
        "laws of the load (pressure exponent, flexibility)",
        "laws of the load (pressure exponent, flexibility) apart from k: a second torque",
    );
    judge(
        distinct(&|o| o.speed_rpm) >= 2,
        "laws of the speed (film thickness, flash temperature, dynamic load)",
        "laws of the speed (film thickness, flash temperature, dynamic load) apart from k: a second speed",
    );
    judge(
        members == [true, true],
        "whether both members wear by one k",
        "whether both members wear by one k: measure the other member too",
    );
    judge(
        measured.len() >= 2,
        "how k scatters between tests",
        "how k scatters between tests: a second fit test",
    );
    let held_out = study.tests.iter().find(|test| test.role == Role::Holdout);
    judge(
        rows(Role::Holdout).next().is_some(),
        "whether what was fitted holds elsewhere (held-out tests)",
        &match held_out {
            Some(test) => format!(
                "whether what is fitted holds elsewhere: test {} is held out but has no row in the measurements",
                test.id
            ),
            None => "whether what is fitted holds elsewhere: give a test at other conditions role = \"holdout\"".to_owned(),
        },
    );
    said
}
