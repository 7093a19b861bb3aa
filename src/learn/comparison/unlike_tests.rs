//! Whether the tests share one wear coefficient: a common k with its error says nothing of a single test where they do not.
//!
//! ```text
//! x_i = ln k_i ± s_i        Q = Σ ((x_i − x̄)/s_i)²        x̄: mean with weights 1/s_i²
//! told where   P(χ²_{n−1} ≥ Q) < 0.005   and   largest/smallest k > 1.25
//! test i stands out where |x_i − mean of the others| is more than twice the range of the others
//! ```
//! The tail of χ² is by Wilson and Hilferty (Proc. Natl. Acad. Sci. 17, 1931). The s_i hold what all tests have in common too, the errors of the
//! effects' parameters, so that Q is rather too small: what is said is said on the safe side.

use crate::learn::fitting::fitted::Fit;
use crate::measure::Dataset;
use crate::numeric::written::significant;

/// Quantile of the normal distribution beyond which the scatter of the tests' own k is no chance: 0.005 on one side.
const NO_CHANCE: f64 = 2.576;
/// Factor between the largest and the smallest k from which it is worth telling.
const FACTOR: f64 = 1.25;
/// Distance from the others, in ranges of theirs, from which a test stands out.
const APART: f64 = 2.0;

/// One test's own k.
struct OwnK<'a> {
    test: &'a str,
    /// ln k.
    log: f64,
    /// Standard deviation of `log`.
    sigma: f64,
}

/// A sentence where the tests' own k differ by more than their errors, with the one that stands out; None where they share one k.
pub(super) fn unlike_tests(data: &Dataset, fit: &Fit) -> Option<String> {
    let measured = |test: usize| data.observations.iter().any(|o| o.test == test);
    let known = (fit.tests.iter()).filter(|t| t.coefficient > 0.0 && measured(t.test));
    let own = known.map(|t| OwnK {
        test: &data.tests[t.test],
        log: t.coefficient.ln(),
        sigma: t.sigma,
    });
    in_words(own.collect())
}

fn in_words(mut own: Vec<OwnK<'_>>) -> Option<String> {
    own.sort_by(|a, b| a.log.total_cmp(&b.log));
    let [first, .., last] = &own[..] else {
        return None;
    };
    if last.log - first.log < FACTOR.ln() || !scatter_beyond_errors(&own) {
        return None;
    }
    let k = |log: f64| significant(log.exp(), 3);
    let outstanding = one_apart(&own).map_or(String::new(), |(one, others)| {
        format!(
            "; test {} stands out, at {} times the mean of the others, {} mm²/N",
            one.test,
            significant((one.log - others).exp(), 2),
            k(others)
        )
    });
    Some(format!(
        "the tests do not share one k: their own differ by more than their errors, from {} (test {}) to {} mm²/N (test {}){outstanding}; \
         the common k is a mean of unlike tests, and its error that of the mean",
        k(first.log),
        first.test,
        k(last.log),
        last.test
    ))
}

/// Whether chance makes the tests' ln k differ so much once in 200 times or less.
fn scatter_beyond_errors(own: &[OwnK<'_>]) -> bool {
    let weight = |one: &OwnK<'_>| one.sigma.max(f64::MIN_POSITIVE).powi(-2);
    let total: f64 = own.iter().map(weight).sum();
    let mean = own.iter().map(|one| weight(one) * one.log).sum::<f64>() / total;
    let square: f64 = (own.iter())
        .map(|one| weight(one) * (one.log - mean).powi(2))
        .sum();
    let free = (own.len() - 1) as f64;
    let spread = 2.0 / (9.0 * free);
    ((square / free).cbrt() - (1.0 - spread)) / spread.sqrt() > NO_CHANCE
}

/// The test whose ln k, of tests in order, lies apart from that of all others, and the mean of theirs. Of two tests either might be the odd one.
fn one_apart<'o, 'a>(own: &'o [OwnK<'a>]) -> Option<(&'o OwnK<'a>, f64)> {
    if own.len() < 3 {
        return None;
    }
    let apart = |one: &'o OwnK<'a>, others: &[OwnK<'_>]| {
        let mean = others.iter().map(|o| o.log).sum::<f64>() / others.len() as f64;
        let range = others[others.len() - 1].log - others[0].log;
        ((one.log - mean).abs() > APART * range).then_some((one, mean))
    };
    let last = own.len() - 1;
    apart(&own[last], &own[..last]).or_else(|| apart(&own[0], &own[1..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each test's k in 1e-10 mm²/N with its relative error.
    fn told(of: &[(&'static str, f64, f64)]) -> Option<String> {
        let own = of.iter().map(|(test, k, sigma)| OwnK {
            test,
            log: (1e-10 * k).ln(),
            sigma: *sigma,
        });
        in_words(own.collect())
    }

    #[test]
    fn a_test_apart_from_the_others_is_named_with_figures() {
        let said = told(&[("A", 1.54, 0.03), ("B", 1.32, 0.04), ("C", 4.10, 0.03)]).unwrap();
        assert!(
            said.starts_with(
                "the tests do not share one k: their own differ by more than their errors, from 1.32·10⁻¹⁰ (test B) to 4.10·10⁻¹⁰ mm²/N (test C); \
                 test C stands out, at 2.9 times the mean of the others, 1.43·10⁻¹⁰ mm²/N"
            ),
            "{said}"
        );
        // the smallest may be the odd one
        let said = told(&[("A", 4.0, 0.03), ("B", 1.3, 0.04), ("C", 4.1, 0.03)]).unwrap();
        assert!(said.contains("test B stands out, at 0.32 times"), "{said}");
    }

    #[test]
    fn nothing_is_said_within_errors_and_nobody_stands_out_among_evenly_spread_tests() {
        assert_eq!(
            told(&[("A", 1.5, 0.3), ("B", 1.3, 0.4), ("C", 2.4, 0.3)]),
            None
        );
        assert_eq!(told(&[("A", 1.0, 0.001), ("B", 1.1, 0.001)]), None);
        assert_eq!(told(&[("A", 1.0, 0.001)]), None);
        for spread in [
            &[("A", 1.0, 0.03), ("B", 2.0, 0.03), ("C", 4.0, 0.03)][..],
            &[("A", 1.0, 0.03), ("B", 2.0, 0.03)],
        ] {
            let said = told(spread).unwrap();
            assert!(!said.contains("stands out"), "{said}");
        }
    }
}
