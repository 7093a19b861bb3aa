//! Tests that were made: what was measured there (or nearly) is no new test.

use super::candidate_tests::{NextTest, shown};
use crate::measure::{Dataset, Quantity};
use crate::study::Test;

/// Relative difference up to which two conditions are nearly the same, and that of misalignments, mm.
const ALIKE: f64 = 0.05;
const ALIKE_MM: f64 = 0.02;
/// That of temperatures, K.
const ALIKE_K: f64 = 5.0;

/// A made test, with what was measured in it.
pub(super) struct MadeTest {
    pub(super) test: NextTest,
    pub(super) quantities: Vec<Quantity>,
}

/// The tests of a study that have rows.
pub(super) fn made(tests: &[Test], data: &Dataset) -> Vec<MadeTest> {
    let of = |(number, test): (usize, &Test)| {
        let own = data.observations.iter().filter(|o| o.test == number);
        let mut quantities: Vec<Quantity> = own.map(|o| o.quantity).collect();
        quantities.sort();
        quantities.dedup();
        MadeTest {
            test: shown(&test.conditions),
            quantities,
        }
    };
    let all = tests.iter().enumerate().map(of);
    all.filter(|made| !made.quantities.is_empty()).collect()
}

impl MadeTest {
    /// Whether another test is made under (nearly) these conditions, for as long.
    pub(super) fn is_repeated_by(&self, other: &NextTest) -> bool {
        alike(&self.test, other)
    }

    /// Whether a quantity was measured in it.
    pub(super) fn has(&self, quantity: &str) -> bool {
        self.quantities.iter().any(|own| own.name() == quantity)
    }
}

/// Whether two tests are made under (nearly) the same conditions, for as long.
pub(in crate::learn) fn alike(a: &NextTest, b: &NextTest) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.abs().max(b.abs());
    near(a.torque, b.torque)
        && near(a.speed, b.speed)
        && near(a.cycles, b.cycles)
        && (a.misalignment - b.misalignment).abs() <= ALIKE_MM
        && a.reversed == b.reversed
        && near_in_temperature(a, b)
}

/// Whether two tests are nearly as warm; one whose temperature is not known is so only beside another such.
fn near_in_temperature(a: &NextTest, b: &NextTest) -> bool {
    match (a.bulk_temperature, b.bulk_temperature) {
        (Some(a), Some(b)) => (a - b).abs() <= ALIKE_K,
        (None, None) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::candidate_tests::tests::plain;
    use super::*;
    use crate::study::Operation;

    #[test]
    fn nearly_the_same_conditions_for_about_as_long_are_a_repetition() {
        let made = MadeTest {
            test: shown(&plain()),
            quantities: vec![Quantity::WearDepth],
        };
        let at = |share: f64, reversed: bool| {
            shown(&Operation {
                cycles: share * plain().cycles,
                reversed,
                ..plain()
            })
        };
        assert!(made.is_repeated_by(&at(1.0, false)) && made.is_repeated_by(&at(0.97, false)));
        assert!(!made.is_repeated_by(&at(2.0, false)) && !made.is_repeated_by(&at(1.0, true)));
        assert!(made.has("wear_depth") && !made.has("mass_loss"));
    }

    /// A made test whose temperature nobody stated is not that of every proposed temperature.
    #[test]
    fn an_unknown_temperature_is_near_an_unknown_one_only() {
        let at = |bulk_temperature: Option<f64>| NextTest {
            bulk_temperature,
            ..shown(&plain())
        };
        let near = |a: Option<f64>, b: Option<f64>| near_in_temperature(&at(a), &at(b));
        assert!(near(None, None) && near(Some(60.0), Some(63.0)));
        assert!(!near(None, Some(60.0)) && !near(Some(60.0), None));
        assert!(!near(Some(60.0), Some(80.0)));
    }
}
