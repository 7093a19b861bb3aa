//! A test whose wear coefficient lies apart from those of the others, which agree.
//!
//! ```text
//! x_i = ln k_i      x_t beyond all others by more than ln 5, these within half of that: t stands apart
//! ```
//! Laws of the load and of the speed move all tests by degrees; a slip in a torque, in cycles or in a unit moves one.

use crate::numeric::written::significant;

/// Factor from the nearest of the others on.
const APART: f64 = 5.0;
/// Part of that, in ln, within which the others agree.
const AGREE: f64 = 0.5;
/// How near 10 a factor is a decimal place, in ln.
const NEAR_TEN: f64 = 0.3;
/// Fewest others.
const OTHERS: usize = 2;

/// The test that stands apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::learn) struct TestApart {
    /// Its place among those given.
    pub(in crate::learn) test: usize,
    /// ln of its k over the mean of the others.
    off: f64,
    /// Range of ln k of the others.
    range: f64,
}

/// The test, of these ln k, that stands apart.
pub(in crate::learn) fn test_apart(own: &[f64]) -> Option<TestApart> {
    (0..own.len()).find_map(|test| {
        let others = || (own.iter().enumerate()).filter_map(|(i, k)| (i != test).then_some(*k));
        let count = others().count();
        let low = others().fold(f64::INFINITY, f64::min);
        let high = others().fold(f64::NEG_INFINITY, f64::max);
        let by = (own[test] - high).max(low - own[test]);
        let apart = count >= OTHERS && by > APART.ln() && high - low < AGREE * by;
        apart.then(|| TestApart {
            test,
            off: own[test] - others().sum::<f64>() / count as f64,
            range: high - low,
        })
    })
}

impl TestApart {
    /// What to look at; `id`: the test's.
    pub(in crate::learn) fn in_words(&self, id: &str) -> String {
        let by = self.off.abs();
        let (near, look) = if (by - 10f64.ln()).abs() < NEAR_TEN {
            (
                " (near 10)",
                "is its torque, or are its cycles or values, off by a decimal place?",
            )
        } else {
            (
                "",
                "look at its torque, its cycles and the units of its values first.",
            )
        };
        format!(
            "test {id} wears with a k {} times{near} {} that of the others, which agree within a factor of {}: {look} If all are right, something acts in this \
             test that the model lacks",
            significant(by.exp(), 2),
            if self.off > 0.0 { "above" } else { "below" },
            significant(self.range.exp(), 2),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of tests A, B, … with these k.
    fn told(k: &[f64]) -> Option<String> {
        let own: Vec<f64> = k.iter().map(|k| k.ln()).collect();
        let found = test_apart(&own)?;
        Some(found.in_words(["A", "B", "C"][found.test]))
    }

    #[test]
    fn a_test_apart_from_others_that_agree_is_asked_about() {
        let ten = told(&[1.0, 1.1, 9.5]).unwrap();
        let start = "test C wears with a k 9.1 times (near 10) above that of the others, which agree within a factor of 1.1: is its torque";
        assert!(ten.starts_with(start), "{ten}");
        let seven = told(&[1.0, 0.15, 1.1]).unwrap();
        assert!(
            seven.contains("test B")
                && seven.contains("7.0 times below")
                && seven.contains(": look at its torque, its cycles"),
            "{seven}"
        );
    }

    #[test]
    fn scatter_laws_and_two_tests_are_not() {
        assert_eq!(told(&[1.0, 1.1, 2.0]), None);
        assert_eq!(told(&[1.0, 2.5, 9.0]), None);
        assert_eq!(told(&[1.0, 9.0]), None);
    }
}
