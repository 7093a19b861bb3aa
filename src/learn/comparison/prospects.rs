//! What measurements let a comparison conclude, before any is made: which laws could show, and what would have to be measured besides.

use std::collections::BTreeSet;

use super::together::conditions_together;
use crate::measure::{Dataset, Observation, Quantity, Subject, checkpoints};
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
    let temperatures: BTreeSet<u64> = (measured.iter())
        .filter_map(|&t| study.tests[t].conditions.stated_temperature_c())
        .map(f64::to_bits)
        .collect();
    let temperatures = temperatures.len();
    let has = |quantity: Quantity| rows(Role::Fit).any(|o| o.quantity == quantity);
    let members =
        [Subject::Pinion, Subject::Gear].map(|member| rows(Role::Fit).any(|o| o.member == member));
    let of_each = measured
        .iter()
        .map(|&test| checkpoints(rows(Role::Fit).filter(|o| o.test == test && o.cycles > 0.0)));
    let checkpoints = of_each.max().unwrap_or(0);
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
    let [loads, speeds] = [distinct(&|o| o.torque_nmm), distinct(&|o| o.speed_rpm)];
    let alike = if measured.len() == 2 && loads == 2 && speeds == 2 {
        "; with two fit tests load and speed cannot be told apart"
    } else {
        ""
    };
    judge(
        loads >= 2,
        &format!("laws of the load (pressure exponent, flexibility){alike}"),
        "laws of the load (pressure exponent, flexibility) apart from k: a second torque",
    );
    judge(
        speeds >= 2,
        &format!("laws of the speed (film thickness, flash temperature, dynamic load){alike}"),
        "how laws of the speed (film thickness, flash temperature, dynamic load) go with the tests' speed: a second speed; at one they show only by the sliding and \
         rolling speeds that differ along the flanks",
    );
    judge(
        temperatures >= 2,
        "laws of the temperature (thermal expansion, flash temperature, plastics)",
        "laws of the temperature (thermal expansion, flash temperature, plastics) apart from k: a second bulk_temperature",
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
    let made = measured.iter().map(|&t| &study.tests[t].conditions);
    let together = conditions_together(&made.collect::<Vec<_>>());
    said.cannot.extend(together);
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_depends_on_temperature_takes_tests_at_two() {
        let text = include_str!("../../cli/examples/hidden-effect.toml");
        let mut study = Study::parse(text, "study.toml").unwrap();
        let row = Observation {
            test: 0,
            member: Subject::Pinion,
            cycles: 1e5,
            quantity: Quantity::MassLoss,
            position: None,
            value: 1.0,
            sigma: 0.1,
            trace: None,
            face: None,
            tooth: None,
            line: 1,
        };
        let fit: Vec<usize> = (0..study.tests.len())
            .filter(|&test| study.tests[test].role == Role::Fit)
            .take(2)
            .collect();
        let data = Dataset {
            observations: (fit.iter())
                .map(|&test| Observation {
                    test,
                    ..row.clone()
                })
                .collect(),
            name: "measurements.csv".to_owned(),
            tests: study.tests.iter().map(|test| test.id.clone()).collect(),
            traces: Vec::new(),
            reading: String::new(),
            outliers: Vec::new(),
            estimated_sigmas: 0,
        };
        let has = |list: &[String]| {
            list.iter()
                .any(|s| s.starts_with("laws of the temperature"))
        };
        let mut at = |celsius: [f64; 2]| {
            for (&test, celsius) in fit.iter().zip(celsius) {
                let conditions = &mut study.tests[test].conditions;
                *conditions = conditions.at_temperature(celsius);
            }
            let found = prospects(&study, &data);
            [has(&found.can), has(&found.cannot)]
        };
        assert_eq!(at([60.0, 60.0]), [false, true]);
        assert_eq!(at([60.0, 80.0]), [true, false]);
        // two tests of another load and another speed show laws of either, but not which
        let mut with_speed = |second: f64| {
            for (&test, (torque, speed)) in fit.iter().zip([(1e4, 1000.0), (2e4, second)]) {
                let conditions = &mut study.tests[test].conditions;
                (conditions.torque_nmm, conditions.speed_rpm) = (torque, speed);
            }
            let can = prospects(&study, &data).can;
            let told = can.iter().filter(|s| s.ends_with("cannot be told apart"));
            told.count()
        };
        assert_eq!(with_speed(2000.0), 2);
        assert_eq!(with_speed(1000.0), 0);
    }
}
