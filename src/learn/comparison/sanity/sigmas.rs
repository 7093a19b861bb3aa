//! Standard deviations of depths and masses that stand in another unit than the values, or values in another unit than theirs: of all tests, or of some.
//!
//! ```text
//! r_t = median of σ over the largest value, of test t      all r_t < 3e-5: no instrument of wear;  r_t a 200th of the others' median, or 200 times it
//! largest value < σ, and a 100th of the least largest one of the other tests: mm for µm
//! ```

use std::collections::BTreeMap;

use super::rounded;
use crate::measure::{Dataset, Observation, Quantity};
use crate::numeric::median;
use crate::numeric::written::significant;

/// σ over the largest value that no instrument of wear has.
const TOO_SURE: f64 = 3e-5;
/// Factor between a test's r and those of the others from which it is no matter of care: two units of one kind lie 1000 apart.
const FACTOR: f64 = 200.0;
/// The same of σ itself: a test without wear to speak of has a large r by the ordinary σ.
const FACTOR_OF_SIGMA: f64 = 30.0;

/// Fewest values of a test, all below their sigma; share of them that must be positive, for noise about nothing is not; and how many times larger those of every
/// other test must be, between which a thousand lies.
const FEWEST: usize = 8;
const POSITIVE: f64 = 0.8;
const FAR_LARGER: [f64; 2] = [200.0, 5000.0];

/// Of one quantity in one test.
struct Stated {
    test: usize,
    /// Median of σ.
    sigma: f64,
    /// Largest value.
    largest: f64,
    /// Number of values, and of positive ones.
    count: usize,
    positive: usize,
}

impl Stated {
    fn ratio(&self) -> f64 {
        self.sigma / self.largest
    }
}

/// A line for each quantity whose sigmas ask for it; not for those of all tests where `values_asked`: a line asks about the values' unit already.
pub(super) fn of_another_unit(data: &Dataset, values_asked: bool) -> Vec<String> {
    let all = [Quantity::WearDepth, Quantity::MassLoss].into_iter();
    all.filter_map(|quantity| {
        let stated = stated(data, quantity);
        let of_all = too_sure(quantity, &stated);
        (of_all.filter(|_| !values_asked)).or_else(|| unlike_the_others(data, quantity, &stated))
    })
    .collect()
}

/// Each test that has the quantity.
fn stated(data: &Dataset, quantity: Quantity) -> Vec<Stated> {
    let mut tests: BTreeMap<usize, Vec<&Observation>> = BTreeMap::new();
    for o in data.observations.iter().filter(|o| o.quantity == quantity) {
        tests.entry(o.test).or_default().push(o);
    }
    let of_test = |(test, rows): (usize, Vec<&Observation>)| {
        Some(Stated {
            test,
            sigma: median(rows.iter().map(|o| o.sigma).collect())?,
            largest: rows.iter().map(|o| o.value.abs()).fold(0.0, f64::max),
            count: rows.len(),
            positive: rows.iter().filter(|o| o.value > 0.0).count(),
        })
    };
    (tests.into_iter().filter_map(of_test))
        .filter(|stated| stated.largest > 0.0)
        .collect()
}

fn too_sure(quantity: Quantity, stated: &[Stated]) -> Option<String> {
    let largest = stated.iter().map(|s| s.largest).fold(0.0, f64::max);
    let sigma = median(stated.iter().map(|s| s.sigma).collect())?;
    let all = stated.iter().all(|s| s.sigma < TOO_SURE * largest);
    all.then(|| {
        let (name, unit) = (quantity.name(), quantity.shown_unit());
        format!(
            "sigma of {name} is about {} {unit} where values go up to {} {unit}: is it in another unit than the values?",
            significant(sigma, 2),
            rounded(largest)
        )
    })
}

fn unlike_the_others(data: &Dataset, quantity: Quantity, stated: &[Stated]) -> Option<String> {
    let usual = median(stated.iter().map(Stated::ratio).collect())?;
    let usual_sigma = median(stated.iter().map(|s| s.sigma).collect())?;
    let is_unlike = |s: &&Stated| {
        let (ratio, sigma) = (s.ratio() / usual, s.sigma / usual_sigma);
        let beyond = |x: f64, factor: f64| x > factor || x * factor < 1.0;
        beyond(ratio, FACTOR) && beyond(sigma, FACTOR_OF_SIGMA) && (ratio > 1.0) == (sigma > 1.0)
    };
    let unlike: Vec<&Stated> = stated.iter().filter(is_unlike).collect();
    let first = unlike.first()?;
    let names: Vec<&str> = unlike.iter().map(|s| data.tests[s.test].as_str()).collect();
    Some(format!(
        "sigma of {} in {} is about {} {} where values go up to {}, in the other tests about {:.1} % of the largest value: is it in another unit there?",
        quantity.name(),
        names.join(", "),
        significant(first.sigma, 2),
        quantity.shown_unit(),
        rounded(first.largest),
        100.0 * usual
    ))
}

/// Depths of one test, all below their sigma, that are a hundredth of those of every other: of that alone all else would follow. What masses say against
/// depths is another matter (`mass_balance`).
pub(super) fn values_of_another_unit(data: &Dataset) -> Option<String> {
    let stated = stated(data, Quantity::WearDepth);
    let others = |own: &Stated| {
        let largest = (stated.iter().filter(|s| s.test != own.test)).map(|s| s.largest);
        largest.reduce(f64::min)
    };
    let is_nothing = |s: &Stated| {
        let wears = s.positive as f64 > POSITIVE * s.count as f64;
        s.count >= FEWEST && s.largest < s.sigma && wears
    };
    let [least, most] = FAR_LARGER;
    let (own, others) = stated.iter().find_map(|own| {
        let others = others(own)?;
        let factor = others / own.largest;
        (is_nothing(own) && (least..most).contains(&factor)).then_some((own, others))
    })?;
    Some(format!(
        "wear_depth in test {} goes up to {} µm only, less than its sigma, in every other test to {} µm or more: are these values in mm, or did it hardly wear?",
        data.tests[own.test],
        significant(own.largest, 2),
        rounded(others)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Study;

    /// Three tests with ten values of 10 to 1 µm, each with its sigma, those of test B times a factor.
    fn data(sigmas: [f64; 3], of_second: f64) -> Dataset {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        for (test, sigma) in ["A", "B", "C"].iter().zip(sigmas) {
            for i in 0..10 {
                let factor = if *test == "B" { of_second } else { 1.0 };
                let (radius, depth) = (26.0 + 0.3 * f64::from(i), factor * f64::from(10 - i));
                text += &format!("{test},pinion,100000,wear_depth,{radius},{depth},{sigma}\n");
            }
        }
        Dataset::parse(&text, "m.csv", &study.known()).unwrap()
    }

    fn lines(sigmas: [f64; 3]) -> Vec<String> {
        of_another_unit(&data(sigmas, 1.0), false)
    }

    fn values(of_second: f64) -> Option<String> {
        values_of_another_unit(&data([0.2; 3], of_second))
    }

    #[test]
    fn sigmas_of_one_test_in_another_unit_are_asked_about_by_its_name() {
        assert!(lines([0.2, 0.2, 0.2]).is_empty());
        assert!(lines([0.02, 0.2, 1.0]).is_empty());
        for other in [0.0002, 200.0] {
            let said = lines([0.2, other, 0.2]);
            assert!(
                said[0].contains("sigma of wear_depth in B is about"),
                "{said:?}"
            );
        }
        assert_eq!(values(1.0), None);
        let in_mm = values(1e-3).unwrap();
        assert!(
            in_mm.starts_with("wear_depth in test B goes up to 0.010 µm only, less than its sigma, in every other test to 10 µm or more"),
            "{in_mm}"
        );
        let all = lines([0.0002, 0.0002, 0.0002]);
        assert!(
            all[0].starts_with("sigma of wear_depth is about 0.00020"),
            "{all:?}"
        );
        // values in another unit are enough
        assert!(of_another_unit(&data([0.0002; 3], 1.0), true).is_empty());
        assert!(!of_another_unit(&data([0.2, 200.0, 0.2], 1.0), true).is_empty());
    }
}
