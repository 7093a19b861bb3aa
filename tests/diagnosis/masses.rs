//! Campaigns that weigh the gears and measure nothing else.

use gearwear::learn::diagnose::Verdict;
use gearwear::measure::{Dataset, Observation, Quantity};

/// Every test's masses at so many equal times, exact, each with the σ of 3 % of the last.
fn weighed(times: u32) -> Dataset {
    let study = crate::study("");
    let mut data = crate::layout(&study);
    let last = |one: &Observation, all: &[Observation]| {
        let own = (all.iter()).filter(|o| o.test == one.test && o.member == one.member);
        own.map(|o| o.cycles).fold(0.0, f64::max)
    };
    let masses: Vec<Observation> = (data.observations.iter())
        .filter(|o| o.quantity == Quantity::MassLoss)
        .cloned()
        .collect();
    let ends = (masses.iter()).filter(|o| o.cycles == last(o, &masses));
    data.observations = ends
        .flat_map(|end| {
            (1..=times).map(|i| Observation {
                cycles: end.cycles * f64::from(i) / f64::from(times),
                ..end.clone()
            })
        })
        .collect();
    data.traces.clear();
    let coefficients = vec![5e-10; data.tests.len()];
    let exact = crate::exact(&study, data, &coefficients);
    let largest = |one: &Observation| {
        let all = exact.observations.iter();
        let own = all.filter(|o| o.test == one.test && o.member == one.member);
        own.map(|o| o.value).fold(0.0, f64::max)
    };
    let mut data = exact.clone();
    for o in &mut data.observations {
        o.sigma = 0.03 * largest(o);
    }
    data
}

/// A row that is alone at its time has nothing beside it that a discrepancy could share: noise 1.2 times the stated is no cause.
#[test]
fn noise_of_single_readings_is_no_cause() {
    let mut data = weighed(30);
    let mut random = crate::Random(5);
    for o in &mut data.observations {
        o.value += 1.2 * o.sigma * random.normal();
    }
    let found = crate::diagnosed_of(data);
    assert_eq!(
        found.verdict,
        Verdict::NothingMissing,
        "{}",
        crate::says(&found)
    );
    let unknown = found.probabilities.get("unknown").copied().unwrap_or(0.0);
    assert!(unknown < 0.2, "{unknown}");
}
