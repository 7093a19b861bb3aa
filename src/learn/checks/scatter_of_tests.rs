//! A test whose traces scatter quite unlike their stated σ, where those of the other tests do not: its σ is another test's, or of another unit.
//!
//! ```text
//! r_t = √(median(D²/var D)/0.4549)      fourth differences D along the traces of test t
//! r_t three times the middle of the others', or a third of it, and these within a factor of 2
//! ```

use super::fourth_differences::{MEDIAN, standardised_squares};
use crate::measure::{Observation, Quantity};
use crate::numeric::median;
use crate::numeric::written::significant;
use crate::study::Study;

/// Differences needed of a test.
const LEAST: usize = 40;
/// Fewest other tests.
const OTHERS: usize = 2;
/// Factor from the others, and that within which they agree.
const UNLIKE: f64 = 3.0;
const AGREE: f64 = 2.0;

/// The first such test in words, of measured minus model row by row.
pub(super) fn unlike_test(
    study: &Study,
    rows: &[&Observation],
    residual: &[f64],
) -> Option<String> {
    let of = |test: usize| {
        let is_own = |o: &Observation| o.test == test && o.quantity == Quantity::WearDepth;
        let own = rows.iter().zip(residual).filter(|(o, _)| is_own(o));
        let (own, left): (Vec<&Observation>, Vec<f64>) = own.unzip();
        let sigma: Vec<f64> = own.iter().map(|o| o.sigma).collect();
        let squares = standardised_squares(&own, &left, &sigma);
        let middle = (squares.len() >= LEAST).then(|| median(squares))??;
        Some((test, (middle / MEDIAN).sqrt()))
    };
    let all: Vec<(usize, f64)> = (0..study.tests.len()).filter_map(of).collect();
    all.iter().find_map(|&(test, own)| {
        let others = || all.iter().filter(|other| other.0 != test).map(|other| other.1);
        let usual = median(others().collect())?;
        let agree = others().all(|other| (other / usual).ln().abs() < AGREE.ln());
        let is_unlike = (own / usual).ln().abs() > UNLIKE.ln();
        (others().count() >= OTHERS && agree && is_unlike).then(|| {
            format!(
                "neighbouring points of the traces of test {} scatter {} times their stated sigma, those of the other tests {} times: is the sigma of that \
                 test right?",
                study.tests[test].id,
                significant(own, 2),
                significant(usual, 2)
            )
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What is said of three tests whose traces scatter by 0.1, with these σ.
    fn said(sigmas: [f64; 3]) -> Option<String> {
        let study = include_str!("../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
        let mut residual = Vec::new();
        // a fixed sequence of the logistic map, whose logit is nearly normal
        let mut x = 0.37f64;
        for (test, sigma) in ["A", "B", "C"].into_iter().zip(sigmas) {
            for point in 0..60 {
                x = 3.999 * x * (1.0 - x);
                let place = 27.0 + 0.01 * f64::from(point);
                text += &format!("{test},pinion,200000,wear_depth,{place},3,{sigma},{test}\n");
                residual.push(0.05 * (x / (1.0 - x)).ln());
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let rows: Vec<&Observation> = data.observations.iter().collect();
        unlike_test(&study, &rows, &residual)
    }

    #[test]
    fn a_test_with_another_sigma_is_named() {
        let large = said([0.1, 1.0, 0.1]).unwrap();
        assert!(large.contains("of test B scatter 0.1"), "{large}");
        let small = said([0.1, 0.1, 0.01]).unwrap();
        assert!(small.contains("of test C scatter"), "{small}");
        // alike; all misjudged alike; each another
        assert_eq!(said([0.1, 0.12, 0.1]), None);
        assert_eq!(said([1.0, 1.0, 1.0]), None);
        assert_eq!(said([0.01, 0.1, 1.0]), None);
    }
}
