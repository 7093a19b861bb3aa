//! A single weighing that stands apart from the growth of its series: a drift, a drop of oil, a digit. An estimated sigma does not show it, for the slip
//! is in the scatter that it is made of.
//!
//! ```text
//! m ≈ a N + b N² of the masses of one member in one test, by least squares;  h_i: leverage
//! t_i = r_i √(1 − h_i),  r_i: m_i less what the others lead to                (of one standard deviation: that of the weighings)
//! s = 1.48 median |t| of all series;  |t_i| > 8 s, the largest of its series, and none of the others apart without it: asked
//! ```
//! Wear that runs in bends in another way in all series, which s holds.

use std::collections::BTreeMap;

use crate::measure::{Dataset, Quantity, Subject};
use crate::numeric::written::significant;
use crate::numeric::{MEDIAN_OF_NORMAL, median};
use crate::study::Study;

/// Fewest weighings of a series, and of all together.
const FEWEST: usize = 4;
const SEVERAL: usize = 12;
/// Scatters from which a weighing stands apart, up to which the others do not without it, and least part of the mass that it is off.
const APART: f64 = 8.0;
const ALIKE: f64 = 4.5;
const LEAST: f64 = 0.03;

/// Values by cycles, or functions of both.
pub(super) type Series = Vec<[f64; 2]>;

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

/// A weighing that stands apart.
#[derive(Debug, PartialEq)]
pub(super) struct Odd {
    /// Which series.
    pub(super) series: usize,
    /// Its place in it.
    pub(super) at: usize,
    /// What the others lead to.
    pub(super) expected: f64,
    /// By how many scatters it stands apart.
    pub(super) scatters: f64,
}

/// How series grow.
pub(super) struct Law {
    /// The two functions whose sum a series is.
    pub(super) basis: fn(f64) -> [f64; 2],
    /// Whether a value is off by enough to be asked about from what the others lead to.
    pub(super) is_off: fn(f64, f64) -> bool,
}

const OF_MASSES: Law = Law {
    basis: |cycles| [1e-6 * cycles, (1e-6 * cycles).powi(2)],
    is_off: |mass, expected| (mass / expected - 1.0).abs() > LEAST,
};

/// The value that stands farthest apart from the growth of its series, if one does.
pub(super) fn farthest(all: &[Series], law: &Law) -> Option<Odd> {
    let long = |own: &Series| (own.len() >= FEWEST).then(|| standing(own, law))?;
    let standing_of: Vec<Option<Vec<f64>>> = all.iter().map(long).collect();
    let magnitudes: Vec<f64> = standing_of
        .iter()
        .flatten()
        .flatten()
        .map(|t| t.abs())
        .collect();
    if magnitudes.len() < SEVERAL {
        return None;
    }
    let scatter = median(magnitudes)? / MEDIAN_OF_NORMAL;
    let each = standing_of.iter().enumerate().flat_map(|(series, own)| {
        let own = own.iter().flatten().enumerate();
        own.map(move |(at, t)| (series, at, *t))
    });
    let (series, at, t) = each.max_by(|a, b| a.2.abs().total_cmp(&b.2.abs()))?;
    let mut others = all[series].clone();
    let [cycles, value] = others.remove(at);
    let expected = growth(&others, law)?.at(cycles);
    let are_alike = standing(&others, law)?
        .iter()
        .all(|other| other.abs() < ALIKE * scatter);
    let is_apart = t.abs() > APART * scatter && (law.is_off)(value, expected);
    (is_apart && are_alike).then(|| Odd {
        series,
        at,
        expected,
        scatters: t.abs() / scatter,
    })
}

/// t of each value of a series.
fn standing(own: &Series, law: &Law) -> Option<Vec<f64>> {
    let growth = growth(own, law)?;
    let of = |&[cycles, value]: &[f64; 2]| {
        let free = (1.0 - growth.leverage(cycles)).max(f64::EPSILON);
        (value - growth.at(cycles)) / free.sqrt()
    };
    Some(own.iter().map(of).collect())
}

/// a u + b v of a law's two functions by least squares.
struct Growth {
    basis: fn(f64) -> [f64; 2],
    a: f64,
    b: f64,
    /// Inverse of the normal matrix: its diagonal, and what stands beside it.
    inverse: [f64; 3],
}

impl Growth {
    fn at(&self, cycles: f64) -> f64 {
        let [u, v] = (self.basis)(cycles);
        self.a * u + self.b * v
    }

    fn leverage(&self, cycles: f64) -> f64 {
        let [u, v] = (self.basis)(cycles);
        let [uu, vv, uv] = self.inverse;
        u * u * uu + 2.0 * uv * u * v + v * v * vv
    }
}

/// None of fewer than three different cycles.
fn growth(own: &Series, law: &Law) -> Option<Growth> {
    let sum = |f: &dyn Fn(f64, f64, f64) -> f64| -> f64 {
        let values = own.iter().map(|&[cycles, value]| {
            let [u, v] = (law.basis)(cycles);
            f(u, v, value)
        });
        values.sum()
    };
    let (uu, uv, vv) = (
        sum(&|u, _, _| u * u),
        sum(&|u, v, _| u * v),
        sum(&|_, v, _| v * v),
    );
    let (uy, vy) = (sum(&|u, _, y| u * y), sum(&|_, v, y| v * y));
    let determinant = uu * vv - uv * uv;
    let is_known = own.len() >= 3 && determinant > 1e-9 * uu * vv;
    is_known.then(|| Growth {
        basis: law.basis,
        a: (uy * vv - vy * uv) / determinant,
        b: (vy * uu - uy * uv) / determinant,
        inverse: [vv / determinant, uu / determinant, -uv / determinant],
    })
}

#[cfg(test)]
mod tests {
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
