//! Whether the tests share one wear coefficient: a common k with its error says nothing of a single test where they do not.
//!
//! ```text
//! x_i = ln k_i ± s_i        Q = Σ ((x_i − x̄)/s_i)²        x̄: mean with weights 1/s_i²
//! two are unlike where   |x_i − x_j| > 2.6 √(s_i² + s_j²)   and   their factor > 1.25
//! told where   P(χ²_{n−1} ≥ Q) < 0.005   and   two of them are unlike
//! test i stands out where it is unlike the mean of the others, from which it is more than twice their range away
//! ```
//! Of the fit tests, of which the common k is. The tail of χ² is by Wilson and Hilferty (Proc. Natl. Acad. Sci. 17, 1931). The s_i hold what all
//! tests have in common too, the errors of the effects' parameters, so that Q is rather too small: what is said is said on the safe side.

use super::coefficients_in_order::in_order;
use super::own_coefficient::{NO_CHANCE, OwnK};
use crate::learn::fitting::coefficient_trend::{own_coefficients, trend_of_coefficients};
use crate::learn::fitting::fitted::Fit;
use crate::measure::Dataset;
use crate::numeric::chi_squared::normal_deviate;
use crate::numeric::written::significant;
use crate::study::{Operation, Role, Study};

/// Distance from the others, in ranges of theirs, from which a test stands out.
const APART: f64 = 2.0;

/// What the tests' own k say together: that they differ by more than their errors, and what they follow.
pub fn differing_tests(study: &Study, data: &Dataset, fit: &Fit) -> Vec<String> {
    let unlike = unlike_tests(study, data, fit).into_iter();
    unlike.chain(trend(study, data, fit)).collect()
}

/// What the tests' own k follow, in words.
fn trend(study: &Study, data: &Dataset, fit: &Fit) -> Option<String> {
    trend_of_coefficients(study, data, &own_coefficients(data, fit))
}

/// Sentences where the own k of fit tests differ by more than their errors, with the one that stands out, and where that of a held-out test differs
/// from theirs; none where they share one k.
fn unlike_tests(study: &Study, data: &Dataset, fit: &Fit) -> Vec<String> {
    let measured = |test: usize| data.observations.iter().any(|o| o.test == test);
    let of = |role: Role| -> Vec<(&Operation, OwnK<'_>)> {
        let known = (fit.tests.iter())
            .filter(|t| t.role == role && t.coefficient > 0.0 && measured(t.test));
        let own = known.map(|t| {
            let own = OwnK::new(&data.tests[t.test], t.coefficient, t.sigma);
            (&study.tests[t.test].conditions, own)
        });
        own.collect()
    };
    let fitted = of(Role::Fit);
    let tests: Vec<(&Operation, &OwnK<'_>)> = fitted.iter().map(|(o, own)| (*o, own)).collect();
    // a line through them says more than their order
    let order = match trend(study, data, fit) {
        None => in_order(&tests),
        Some(_) => None,
    };
    let own: Vec<OwnK<'_>> = fitted.into_iter().map(|(_, own)| own).collect();
    if let Some(said) = in_words(own.iter().collect(), order.as_deref()) {
        return vec![said];
    }
    let held_out = of(Role::Holdout);
    let odd = held_out
        .iter()
        .filter_map(|(_, held_out)| of_held_out(held_out, &own));
    odd.collect()
}

fn in_words(mut own: Vec<&OwnK<'_>>, order: Option<&str>) -> Option<String> {
    own.sort_by(|a, b| a.log.total_cmp(&b.log));
    let (first, last) = widest(&own)?;
    if !scatter_beyond_errors(&own) {
        return None;
    }
    let k = |log: f64| significant(log.exp(), 3);
    let outstanding = one_apart(&own).map_or(String::new(), |(one, others)| {
        format!(
            "; test {} stands out, at {} times the mean of the others, {} mm²/N (are torque, speed and cycles of each test those that the study states?)",
            one.test,
            significant((one.log - others).exp(), 2),
            k(others)
        )
    });
    let order = order.map_or(String::new(), |order| format!("; {order}"));
    Some(format!(
        "the tests do not share one k: their own differ by more than their errors, from {} (test {}) to {} mm²/N (test {}){outstanding}{order}; \
         the common k is a mean of unlike tests, and its error that of the mean",
        k(first.log),
        first.test,
        k(last.log),
        last.test
    ))
}

/// A held-out test whose k is not that of the fit tests, in words.
fn of_held_out(held_out: &OwnK<'_>, fitted: &[OwnK<'_>]) -> Option<String> {
    if fitted.is_empty() {
        return None;
    }
    let mean = mean(&fitted.iter().collect::<Vec<_>>());
    held_out.is_unlike(&mean).then(|| {
        format!(
            "the held-out test {} has a k of {} mm²/N, {} times that of the fit tests",
            held_out.test,
            significant(held_out.log.exp(), 3),
            significant((held_out.log - mean.log).exp(), 2)
        )
    })
}

/// Of tests in order the two furthest from one another of those that are unlike.
fn widest<'o, 'a>(own: &[&'o OwnK<'a>]) -> Option<(&'o OwnK<'a>, &'o OwnK<'a>)> {
    let pairs = (own.iter().enumerate())
        .flat_map(|(i, one)| own[i + 1..].iter().map(move |other| (*one, *other)));
    let unlike = pairs.filter(|(one, other)| one.is_unlike(other));
    unlike.max_by(|a, b| (a.1.log - a.0.log).total_cmp(&(b.1.log - b.0.log)))
}

/// The mean of several ln k with its error.
fn mean(own: &[&OwnK<'_>]) -> OwnK<'static> {
    let n = own.len() as f64;
    OwnK {
        test: "",
        log: own.iter().map(|one| one.log).sum::<f64>() / n,
        sigma: own.iter().map(|one| one.sigma.powi(2)).sum::<f64>().sqrt() / n,
    }
}

/// Whether chance makes the tests' ln k differ so much once in 200 times or less.
fn scatter_beyond_errors(own: &[&OwnK<'_>]) -> bool {
    let weight = |one: &OwnK<'_>| one.sigma.powi(-2);
    let total: f64 = own.iter().map(|one| weight(one)).sum();
    let mean = own.iter().map(|one| weight(one) * one.log).sum::<f64>() / total;
    let square: f64 = (own.iter())
        .map(|one| weight(one) * (one.log - mean).powi(2))
        .sum();
    let free = (own.len() - 1) as f64;
    normal_deviate(square / free, free) > NO_CHANCE
}

/// The test whose ln k, of tests in order, lies apart from that of all others, and the mean of theirs. Of two tests either might be the odd one.
fn one_apart<'o, 'a>(own: &[&'o OwnK<'a>]) -> Option<(&'o OwnK<'a>, f64)> {
    if own.len() < 3 {
        return None;
    }
    let apart = |one: &'o OwnK<'a>, others: &[&OwnK<'_>]| {
        let mean = mean(others);
        let range = others[others.len() - 1].log - others[0].log;
        let far = (one.log - mean.log).abs() > APART * range && one.is_unlike(&mean);
        far.then_some((one, mean.log))
    };
    let last = own.len() - 1;
    apart(own[last], &own[..last]).or_else(|| apart(own[0], &own[1..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each test's k in 1e-10 mm²/N with its relative error.
    fn told(of: &[(&'static str, f64, f64)]) -> Option<String> {
        let own: Vec<OwnK<'_>> = of.iter().map(own).collect();
        in_words(own.iter().collect(), None)
    }

    fn own<'a>((test, k, sigma): &(&'a str, f64, f64)) -> OwnK<'a> {
        OwnK {
            test,
            log: (1e-10 * k).ln(),
            sigma: *sigma,
        }
    }

    /// What makes the scatter significant must be what is large.
    #[test]
    fn a_k_with_a_large_error_makes_no_tests_unlike_and_does_not_stand_out() {
        let poor = [("A", 1.0, 0.001), ("B", 1.01, 0.001), ("C", 1.5, 0.5)];
        assert_eq!(told(&poor), None);
        // and hides none that are
        let said = told(&[("A", 1.0, 0.001), ("B", 1.5, 0.001), ("C", 1.6, 0.5)]).unwrap();
        assert!(
            said.contains("from 1.00·10⁻¹⁰ (test A) to 1.50·10⁻¹⁰ mm²/N (test B); the common"),
            "{said}"
        );
    }

    #[test]
    fn a_held_out_test_of_another_k_has_its_own_sentence() {
        let fitted = [own(&("A", 1.0, 0.03)), own(&("B", 1.02, 0.03))];
        let told = |k: f64, sigma: f64| of_held_out(&own(&("S", k, sigma)), &fitted);
        assert_eq!(
            told(2.02, 0.05).as_deref(),
            Some(
                "the held-out test S has a k of 2.02·10⁻¹⁰ mm²/N, 2.0 times that of the fit tests"
            )
        );
        assert_eq!(told(2.02, 0.4), None);
        assert_eq!(told(1.1, 0.001), None);
        assert_eq!(of_held_out(&own(&("S", 2.0, 0.1)), &[]), None);
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
