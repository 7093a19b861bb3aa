//! Conditions that the tests change together: of a law of one of them it cannot be told whether it is one of the other.
//!
//! ```text
//! r = Σ (x − x̄)(y − ȳ)/√(Σ (x − x̄)² Σ (y − ȳ)²)      x, y: ln torque, ln speed, temperature, misalignment of the fit tests; told where |r| > 0.95
//! ```
//! At |r| = 0.95 the error of a slope is 1/√(1 − r²) = 3.2 times what it is where the other condition stays. A temperature that friction losses make
//! follows torque and speed by construction and says nothing: only what tests state counts.

use crate::study::Operation;

/// Correlation from which two conditions go together.
const TOGETHER: f64 = 0.95;

/// A condition: its name, its value on the scale of its laws, and the least spread that counts as a change.
type Condition = (&'static str, fn(&Operation) -> Option<f64>, f64);

const CONDITIONS: [Condition; 4] = [
    ("temperature", Operation::stated_temperature_c, 2.0),
    ("speed", |o| Some(o.speed_rpm.ln()), 0.01),
    ("torque", |o| Some(o.torque_nmm.ln()), 0.01),
    ("misalignment", |o| Some(o.misalignment_mm), 1e-3),
];

/// A sentence for each pair of conditions that go together over some tests.
pub(super) fn conditions_together(tests: &[&Operation]) -> Vec<String> {
    let mut said = Vec::new();
    for (i, one) in CONDITIONS.iter().enumerate() {
        for other in &CONDITIONS[i + 1..] {
            let points: Vec<(f64, f64)> = (tests.iter())
                .filter_map(|test| (one.1)(test).zip((other.1)(test)))
                .collect();
            let changes = |of: fn(&(f64, f64)) -> f64, least: f64| {
                let values = || points.iter().map(of);
                values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
                    > least
            };
            if !(changes(|p| p.0, one.2) && changes(|p| p.1, other.2)) {
                continue;
            }
            let r = correlation(&points);
            if r.abs() > TOGETHER {
                said.push(in_words(one.0, other.0, r, points.len()));
            }
        }
    }
    said
}

fn in_words(one: &str, other: &str, r: f64, tests: usize) -> String {
    let turn = if r > 0.0 { "rises" } else { "falls" };
    // of two points the correlation is 1 always
    let how = match tests {
        2 => format!("in these two tests the {one} {turn} with the {other}"),
        _ => format!("in these tests the {one} {turn} with the {other} (correlation {r:.2})"),
    };
    format!(
        "which of {one} and {other} acts: {how}, so that a law of one looks like a law of the other: add a test with another {one} at the same {other}"
    )
}

fn correlation(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| of(p.0 - x, p.1 - y)).sum::<f64>();
    sum(&|x, y| x * y) / (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Torque in N·m, speed in rpm, temperature in °C.
    fn told(of: &[(f64, f64, f64)]) -> Vec<String> {
        let tests: Vec<Operation> = (of.iter())
            .map(|(torque, speed, celsius)| Operation::at(*torque, *speed).at_temperature(*celsius))
            .collect();
        conditions_together(&tests.iter().collect::<Vec<_>>())
    }

    #[test]
    fn a_temperature_that_goes_with_the_speed_is_told() {
        let said = told(&[
            (100.0, 1000.0, 50.0),
            (100.0, 2000.0, 70.2),
            (150.0, 2000.0, 70.0),
            (150.0, 4000.0, 91.0),
        ]);
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].starts_with("which of temperature and speed acts: in these tests the temperature rises with the speed (correlation 1.00)"),
            "{said:?}"
        );
        assert!(said[0].ends_with("add a test with another temperature at the same speed"));
    }

    /// What friction losses make of the temperature follows the speed by construction; two tests have no correlation to tell.
    #[test]
    fn two_tests_are_told_without_a_correlation_and_computed_temperatures_not_at_all() {
        let said = told(&[(100.0, 1000.0, 50.0), (150.0, 2000.0, 50.0)]);
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].starts_with("which of speed and torque acts: in these two tests the speed rises with the torque, so that"),
            "{said:?}"
        );
        let computed = |speed: f64, celsius: f64| Operation {
            bulk_temperature_c: Some(celsius),
            flank_temperature_c: Some(celsius + 10.0),
            ..Operation::at(100.0, speed)
        };
        let tests = [computed(1000.0, 50.0), computed(3000.0, 90.0)];
        assert_eq!(
            conditions_together(&[&tests[0], &tests[1]]),
            Vec::<String>::new()
        );
    }

    #[test]
    fn conditions_that_change_apart_or_not_at_all_are_not() {
        let apart = [
            (100.0, 1000.0, 50.0),
            (100.0, 1000.0, 80.0),
            (200.0, 3000.0, 50.0),
            (100.0, 3000.0, 80.0),
        ];
        assert_eq!(told(&apart), Vec::<String>::new());
        // a thermometer's last digit is no change
        assert_eq!(
            told(&[(100.0, 1000.0, 60.0), (100.0, 2000.0, 60.4)]),
            Vec::<String>::new()
        );
    }
}
