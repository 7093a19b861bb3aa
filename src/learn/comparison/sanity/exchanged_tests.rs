//! Two tests whose rows stand under each other's names.
//!
//! ```text
//! depth ∝ k T at the same cycles:    the rows of test i under the name of test j call for k_i T_i/T_j
//! R = range of ln k of all tests as they stand, R' once i and j are exchanged
//! R > ln 1.5 and R' < 0.35 R, and R' < ln 1.15 or R > ln 3 or R > ln 2 and R' < 0.2 R, for one pair only: asked
//! ```
//! Tests of one torque show nothing. A law of the load, k ∝ T^p, does the same for p about −2 (−3.1 to −1.5 where the middle of three torques is the
//! geometric mean): no known one falls so steeply. Where a power of the speed brings all together as well nothing is asked.

use crate::learn::fitting::coefficient_trend::own_coefficients;
use crate::learn::fitting::fitted::Fit;
use crate::measure::Dataset;
use crate::numeric::written::significant;
use crate::study::Study;

/// Factor between the tests' k from which they are far apart.
const FAR_APART: f64 = 1.5;
/// Part of their range, of ln k, that may be left once two tests are exchanged.
const LEFT: f64 = 0.35;
/// The factor that may be left, unless the tests' k were farther apart than any that scatter: by 20 or 30 % they come together by chance.
const AGREE: f64 = 1.15;
const NO_SCATTER: f64 = 3.0;
/// Where they are this far apart, the part of their range that may be left whatever it is.
const SELDOM_SCATTER: f64 = 2.0;
const LITTLE_LEFT: f64 = 0.2;
/// The same that a power of the speed may leave for it to be the likelier reason.
const LEFT_BY_SPEED: f64 = 0.5;
/// Fewest tests: of two nobody knows which k is right.
const FEWEST: usize = 3;

/// A question about the two tests that share the others' k once exchanged.
pub(super) fn exchanged_tests(study: &Study, data: &Dataset, fit: &Fit) -> Option<String> {
    let own = own_coefficients(data, fit);
    let tests: Vec<(f64, f64)> = (own.iter())
        .map(|&(test, k)| (study.tests[test].conditions.torque_nmm.ln(), k))
        .collect();
    let (i, j, before, after) = exchanged(&tests)?;
    let speed = |test: usize| study.tests[test].conditions.speed_rpm.ln();
    let by_speed: Vec<(f64, f64)> = own.iter().map(|&(test, k)| (speed(test), k)).collect();
    if is_law(&by_speed) {
        return None;
    }
    let [one, other] = [i, j].map(|at| &study.tests[own[at].0].id);
    Some(format!(
        "are tests {one} and {other} exchanged? As they stand the tests' k differ by a factor of {}; with the rows of these two under each other's names \
         by one of {}: look at their labels, and at the torques that the study states for them; a k that falls with the torque to the power of \
         2 would look the same",
        significant(before.exp(), 2),
        significant(after.exp(), 3),
    ))
}

/// Of tests with ln T and ln k the only two that, exchanged, bring all together, with the range of ln k before and after.
fn exchanged(tests: &[(f64, f64)]) -> Option<(usize, usize, f64, f64)> {
    if tests.len() < FEWEST {
        return None;
    }
    let before = range(tests.iter().map(|&(_, k)| k));
    if before < FAR_APART.ln() {
        return None;
    }
    let pairs = (0..tests.len()).flat_map(|i| (i + 1..tests.len()).map(move |j| (i, j)));
    let mut fits = pairs.filter_map(|(i, j)| {
        let of = |(test, &(torque, k)): (usize, &(f64, f64))| match test {
            test if test == i => k + torque - tests[j].0,
            test if test == j => k + torque - tests[i].0,
            _ => k,
        };
        let after = range(tests.iter().enumerate().map(of));
        let agree = after < AGREE.ln()
            || before > NO_SCATTER.ln()
            || before > SELDOM_SCATTER.ln() && after < LITTLE_LEFT * before;
        (after < LEFT * before && agree).then_some((i, j, before, after))
    });
    let found = fits.next()?;
    fits.next().is_none().then_some(found)
}

/// Whether y follows a straight line over x.
fn is_law(points: &[(f64, f64)]) -> bool {
    range_beside_line(points) < LEFT_BY_SPEED * range(points.iter().map(|p| p.1))
}

/// Range of y that a straight line over x leaves.
fn range_beside_line(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let xx: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let xy: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let slope = if xx > 0.0 { xy / xx } else { 0.0 };
    range(points.iter().map(|p| p.1 - slope * (p.0 - x)))
}

fn range(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is found of tests with these torques and k.
    fn found(tests: &[(f64, f64)]) -> Option<(usize, usize)> {
        let tests: Vec<(f64, f64)> = tests.iter().map(|(t, k)| (t.ln(), k.ln())).collect();
        exchanged(&tests).map(|(i, j, _, _)| (i, j))
    }

    #[test]
    fn two_tests_that_fit_once_exchanged_are_found() {
        // rows of 10 N m under 25 N m: k 10/25 of what it is, and the other way round
        assert_eq!(
            found(&[(10.0, 2.6), (15.0, 1.03), (25.0, 0.4)]),
            Some((0, 2))
        );
        assert_eq!(
            found(&[(10.0, 1.52), (15.0, 0.66), (25.0, 1.02), (40.0, 0.97)]),
            Some((0, 1))
        );
        // two tests of one torque, and k that scatter by 15 %
        let scattered = [(120.0, 8.05), (200.0, 2.99), (120.0, 5.19), (160.0, 5.77)];
        assert_eq!(found(&scattered), Some((0, 1)));
        // beside a law of the speed
        let beside = [(60.0, 5.55), (110.0, 1.46), (90.0, 4.2), (85.0, 3.52)];
        assert_eq!(found(&beside), Some((0, 1)));
    }

    #[test]
    fn a_line_leaves_what_is_beside_it() {
        assert!(range_beside_line(&[(1.0, 3.0), (2.0, 5.0), (4.0, 9.0)]) < 1e-12);
        assert!((range_beside_line(&[(0.0, 0.0), (1.0, 3.0), (2.0, 0.0)]) - 3.0).abs() < 1e-12);
        assert!((range_beside_line(&[(1.0, 0.0), (1.0, 2.0)]) - 2.0).abs() < 1e-12);
    }

    /// k of three speeds under a law of the film, of which the first and the last would agree once exchanged; and of the same speeds at random.
    #[test]
    fn k_that_follows_the_speed_is_told_from_exchanged_tests() {
        let at = |k: [f64; 4]| {
            let speeds = [400.0_f64, 1500.0, 1500.0, 2600.0];
            let points = speeds.iter().zip(k).map(|(n, k)| (n.ln(), k.ln()));
            is_law(&points.collect::<Vec<_>>())
        };
        assert!(at([4.19, 3.27, 3.38, 2.45]));
        assert!(!at([3.3, 4.6, 2.4, 3.2]));
    }

    #[test]
    fn tests_that_scatter_or_follow_a_law_are_not() {
        assert_eq!(found(&[(10.0, 1.3), (15.0, 1.0), (25.0, 0.9)]), None);
        for power in [-1.0, -0.5, 0.5, 1.0, 2.0_f64] {
            let law = [10.0_f64, 15.0, 25.0, 40.0].map(|t| (t, t.powf(power)));
            assert_eq!(found(&law), None, "{power}");
        }
        // k that scatters by a quarter
        let scatter = [(96.0, 1.6), (150.0, 0.66), (96.0, 0.95), (54.0, 1.2)];
        assert_eq!(found(&scatter), None);
        // one test apart from the others; two tests only; one torque
        assert_eq!(found(&[(10.0, 2.5), (15.0, 1.0), (25.0, 1.0)]), None);
        assert_eq!(found(&[(10.0, 2.5), (25.0, 0.4)]), None);
        assert_eq!(found(&[(10.0, 2.5), (10.0, 0.4), (10.0, 1.0)]), None);
    }
}
