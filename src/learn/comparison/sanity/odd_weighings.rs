//! A single weighing that stands apart from the growth of its series: a drift, a drop of oil, a digit. An estimated sigma does not show it, for the slip
//! is in the scatter that it is made of.
//!
//! ```text
//! m ≈ a N + b N²       the masses of one member in one test
//! ```
//! Wear that runs in bends in another way in all series, which the scatter holds.

use std::collections::BTreeMap;

use super::standing_apart::{Law, Series, farthest};
use crate::measure::{Dataset, Quantity, Subject};
use crate::numeric::written::significant;
use crate::study::Study;

/// Least part of the mass that a weighing is off.
const LEAST: f64 = 0.03;

/// A question about the weighing that stands farthest apart.
pub(super) fn odd_weighing(study: &Study, data: &Dataset) -> Option<String> {
    let mut all: BTreeMap<(usize, Subject), Series> = BTreeMap::new();
    let masses = data.observations.iter();
    for o in masses.filter(|o| o.quantity == Quantity::MassLoss && o.cycles > 0.0) {
        let own = all.entry((o.test, o.member)).or_default();
        own.push([o.cycles, o.value]);
    }
    let series: Vec<((usize, Subject), Series)> = all.into_iter().collect();
    let masses: Vec<Series> = series.iter().map(|(_, own)| own.clone()).collect();
    let odd = farthest(&masses, &OF_MASSES)?;
    let ((test, member), own) = &series[odd.series];
    let [cycles, mass] = own[odd.at];
    Some(format!(
        "mass_loss of the {} in test {} is {} mg after {cycles} cycles, where its other weighings lead to {} mg, {:.0} times as far off as weighings scatter: look \
         at this one first; left in, it widens the sigma that is estimated of all",
        member.name(),
        study.tests[*test].id,
        significant(mass, 4),
        significant(odd.expected, 4),
        odd.scatters
    ))
}

/// How masses grow.
const OF_MASSES: Law = Law {
    basis: |cycles| [1e-6 * cycles, (1e-6 * cycles).powi(2)],
    is_off: |mass, expected| (mass / expected - 1.0).abs() > LEAST,
};

#[cfg(test)]
mod tests {
    use super::super::standing_apart::growth;
    use super::*;

    /// Four series of five weighings with noise of up to 1 mg that grow as wear does that slows down.
    fn series() -> Vec<Series> {
        let noise = [0.6, -0.9, 0.2, 1.0, -0.4, -0.7, 0.3, 0.8, -1.0, 0.5];
        let of = |which: usize| {
            let at = |i: usize| {
                let n = [0.1, 0.25, 0.5, 0.75, 1.0][i];
                let size = 100.0 + 40.0 * which as f64;
                [
                    6e5 * n,
                    size * n * (1.2 - 0.2 * n) + noise[(3 * which + 2 * i) % 10],
                ]
            };
            (0..5).map(at).collect()
        };
        (0..4).map(of).collect()
    }

    #[test]
    fn a_weighing_that_is_45_mg_off_is_found_wherever_it_stands() {
        assert_eq!(farthest(&series(), &OF_MASSES), None);
        for which in 0..4 {
            for at in 0..5 {
                let mut wrong = series();
                let right = wrong[which][at][1];
                wrong[which][at][1] += 45.0;
                let odd = farthest(&wrong, &OF_MASSES).unwrap();
                assert_eq!((odd.series, odd.at), (which, at));
                assert!((odd.expected - right).abs() < 8.0, "{odd:?}, {right}");
            }
        }
    }

    /// Leverages add up to the number of parameters, and what a mass lies off the others' growth is its residual over 1 less its leverage (Cook & Weisberg,
    /// Residuals and Influence in Regression, 1982, ch. 2).
    #[test]
    fn leverages_are_those_of_least_squares() {
        for own in series() {
            let all = growth(&own, &OF_MASSES).unwrap();
            let sum: f64 = own.iter().map(|[cycles, _]| all.leverage(*cycles)).sum();
            assert!((sum - 2.0).abs() < 1e-9, "{sum}");
            for at in 0..own.len() {
                let mut others = own.clone();
                let [cycles, mass] = others.remove(at);
                let left_out = mass - growth(&others, &OF_MASSES).unwrap().at(cycles);
                let residual = mass - all.at(cycles);
                let free = 1.0 - all.leverage(cycles);
                assert!(
                    (left_out - residual / free).abs() < 1e-6,
                    "{left_out} {residual}"
                );
            }
        }
    }

    #[test]
    fn a_law_that_bends_in_all_series_is_no_slip() {
        let run_in = |own: &Series| -> Series {
            let bent = |&[n, m]: &[f64; 2]| [n, m + 30.0 * (1.0 - (-n / 8e4).exp())];
            own.iter().map(bent).collect()
        };
        let all: Vec<Series> = series().iter().map(run_in).collect();
        assert_eq!(farthest(&all, &OF_MASSES), None);
        // few weighings in all
        let mut few = series()[..2].to_vec();
        few[0][2][1] += 45.0;
        assert_eq!(farthest(&few, &OF_MASSES), None);
    }
}
