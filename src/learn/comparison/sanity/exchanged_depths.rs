//! Depths of the two members that stand in each other's rows, in one test among others.
//!
//! ```text
//! A_y² = Σ (y − mean of its profile)² of a test's depths, A_f of the model's, L = 2 ln (A_f,p/A_f,g)
//! q = ln s_p/s_g; s = A_y/A_f where the model's shape does not stand in the measured depths
//! the others within 0.15 L of their middle, q below that by L, to a fifth: exchanged
//! ```
//! In the other member's rows the depths run the other way along the flank, so that the model's shape need not stand in them.
//! The pinion's flanks meet z_g/z_p times as often as the gear's and wear about as much deeper. In all tests alike it would be what members do that wear by
//! a k of their own.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::{CLEAR_RATIO, EXPLAINS, rounded, scale};
use crate::measure::{Observation, Quantity, Subject};
use crate::numeric::median;
use crate::study::Study;

/// Fewest other tests.
pub(super) const OTHERS: usize = 2;
/// How near each other those must be, and how near to exchanged the one, in parts of what an exchange makes.
const AGREE: f64 = 0.15;
const NEAR: f64 = 0.2;

/// A question about the tests of which the members' depths fit once exchanged; none where both wear about alike by the model.
pub(super) fn exchanged_depths(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let own = (0..study.tests.len()).filter_map(|test| Some((test, of_test(rows, test)?)));
    let own: Vec<(usize, f64)> = own.collect();
    let exchanged = own.iter().filter_map(|&(test, q)| {
        let others: Vec<f64> = (own.iter())
            .filter_map(|(t, q)| (*t != test).then_some(*q))
            .collect();
        let usual = median(others.clone())?;
        let ratio = model_ratio(rows, test)?;
        let shift = 2.0 * ratio.ln();
        let agree = others
            .iter()
            .all(|other| (other - usual).abs() < AGREE * shift);
        let is_near = (q - usual + shift).abs() < NEAR * shift;
        let is_clear = ratio > CLEAR_RATIO && others.len() >= OTHERS;
        (is_clear && agree && is_near).then(|| (study.tests[test].id.as_str(), ratio))
    });
    let exchanged: Vec<(&str, f64)> = exchanged.collect();
    let ratio = exchanged.first()?.1;
    let ids: Vec<&str> = exchanged.iter().map(|(id, _)| *id).collect();
    Some(format!(
        "are the depths of pinion and gear exchanged in test {}? Against the other tests, which agree, its pinion wears too little and its gear too much, both \
         by a factor of about {}: exchange the members of these rows",
        ids.join(", "),
        rounded(ratio)
    ))
}

/// How many times as far the pinion's depths range by the model as the gear's; None without both.
fn model_ratio(rows: &[FittedRow<'_>], test: usize) -> Option<f64> {
    let [pinion, gear] = [Subject::Pinion, Subject::Gear].map(|member| sizes(rows, test, member));
    Some(pinion?.1 / gear?.1).filter(|ratio| ratio.is_finite())
}

/// Root mean squares of a member's measured and computed depths about the mean of their profile.
pub(super) fn sizes(rows: &[FittedRow<'_>], test: usize, member: Subject) -> Option<(f64, f64)> {
    let mut profiles: BTreeMap<_, Vec<[f64; 2]>> = BTreeMap::new();
    let is_own =
        |o: &Observation| (o.test, o.quantity, o.member) == (test, Quantity::WearDepth, member);
    for (o, row) in rows.iter().filter(|(o, _)| is_own(o)) {
        let own = profiles.entry((o.trace, o.cycles.to_bits())).or_default();
        own.push([o.value, row.model]);
    }
    let squares = |of: usize| -> f64 {
        let about_mean = |own: &Vec<[f64; 2]>| {
            let mean = own.iter().map(|x| x[of]).sum::<f64>() / own.len() as f64;
            own.iter().map(|x| (x[of] - mean).powi(2)).sum::<f64>()
        };
        profiles.values().map(about_mean).sum()
    };
    let count: usize = profiles.values().map(Vec::len).sum();
    (count > 0).then(|| {
        let [measured, computed] = [0, 1].map(|of| (squares(of) / count as f64).sqrt());
        (measured, computed)
    })
}

/// The rows of one test.
pub(super) fn of_one_test<'d>(rows: &[FittedRow<'d>], test: usize) -> Vec<FittedRow<'d>> {
    let own = rows.iter().filter(|(o, _)| o.test == test);
    own.copied().collect()
}

/// ln of how much more the pinion's depths are the model's than the gear's; None without both.
fn of_test(rows: &[FittedRow<'_>], test: usize) -> Option<f64> {
    let of = |member| factor(rows, test, member);
    Some((of(Subject::Pinion)? / of(Subject::Gear)?).ln())
}

/// How many times the model's a member's depths are; None without any.
pub(super) fn factor(rows: &[FittedRow<'_>], test: usize, member: Subject) -> Option<f64> {
    let found = scale(&of_one_test(rows, test), Quantity::WearDepth, Some(member))?;
    let factor = if found.explains > EXPLAINS && found.factor > 0.0 {
        found.factor
    } else {
        let (measured, computed) = sizes(rows, test, member)?;
        measured / computed
    };
    (factor > 0.0 && factor.is_finite()).then_some(factor)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What a question says of three tests whose computed depths on pinion and gear are so many times some, with so many times these measured.
    pub(in super::super) fn said_of(
        question: fn(&Study, &[FittedRow<'_>]) -> Option<String>,
        levels: [[f64; 2]; 3],
        factors: [[f64; 2]; 3],
    ) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        let tests = ["A", "B", "C"].into_iter().zip(levels);
        for ((test, levels), factors) in tests.zip(factors) {
            let members = [("pinion", 27.0), ("gear", 53.0)].into_iter().zip(levels);
            for (((member, radius), level), factor) in members.zip(factors) {
                for (place, depth) in [3.0, 5.0, 8.0].into_iter().enumerate() {
                    let place = radius + 0.2 * place as f64;
                    let model = level * depth;
                    let value = factor * model;
                    text += &format!("{test},{member},200000,wear_depth,{place},{value},0.1\n");
                    models.push(model);
                }
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        question(&study, &rows)
    }

    /// What is said where the pinion wears twice as deep as the gear by the model.
    fn said(factors: [[f64; 2]; 3]) -> Option<String> {
        said_of(exchanged_depths, [[2.0, 1.0]; 3], factors)
    }

    /// Depths 8, 5, 3 where the model has 3, 5, 8: its shape explains nothing of them, and their size tells all the same.
    #[test]
    fn depths_that_run_the_other_way_tell_by_their_size() {
        let rows = |values: [f64; 3]| {
            let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
            let study = Study::parse(study, "study.toml").unwrap();
            let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
            for (member, radius) in [("pinion", 27.0), ("gear", 53.0)] {
                for (place, value) in values.iter().enumerate() {
                    let place = radius + 0.2 * place as f64;
                    let value = if member == "pinion" {
                        *value
                    } else {
                        [3.0, 5.0, 8.0][((place - radius) / 0.2).round() as usize]
                    };
                    text += &format!("A,{member},200000,wear_depth,{place},{value},0.1,{member}\n");
                }
            }
            Dataset::parse(&text, "m.csv", &study.known()).unwrap()
        };
        let of = |values| {
            let data = rows(values);
            let fits = super::super::fits_of(&[3.0, 5.0, 8.0, 3.0, 5.0, 8.0]);
            let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
            of_test(&rows, 0).unwrap()
        };
        assert!(of([3.0, 5.0, 8.0]).abs() < 1e-9);
        assert!((of([4.0, 2.5, 1.5]) - 0.5f64.ln()).abs() < 1e-9);
    }

    #[test]
    fn one_test_among_others_is_asked_about() {
        let exchanged = [0.5, 2.0];
        let asked = said([[1.0, 1.0], exchanged, [1.1, 1.05]]).unwrap();
        assert!(
            asked.starts_with("are the depths of pinion and gear exchanged in test B?")
                && asked.contains("a factor of about 2.0"),
            "{asked}"
        );
        // none; all; others that do not agree; by another factor
        assert_eq!(said([[1.0, 1.0], [1.2, 1.1], [1.1, 1.05]]), None);
        assert_eq!(said([exchanged; 3]), None);
        assert_eq!(said([[1.0, 1.0], exchanged, [1.0, 2.0]]), None);
        let root = 2f64.sqrt();
        assert_eq!(said([[1.0, 1.0], [root.recip(), root], [1.0, 1.0]]), None);
        // members that wear alike
        let alike = said_of(exchanged_depths, [[1.0; 2]; 3], [[1.0; 2]; 3]);
        assert_eq!(alike, None);
    }
}
