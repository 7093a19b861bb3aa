//! Depths of the two members that stand in each other's rows, in one test among others.
//!
//! ```text
//! q = ln s_p/s_g of a test's depths, u = z_g/z_p
//! the others within 0.3 ln u of their middle, q below that by 2 ln u, to a fifth: exchanged
//! ```
//! The pinion's flanks meet u times as often as the gear's and wear about as much deeper. In all tests alike it would be what members do that wear by
//! a k of their own.

use super::super::residual_statistics::FittedRow;
use super::{CLEAR_RATIO, scale};
use crate::measure::{Quantity, Subject};
use crate::numeric::median;
use crate::study::Study;

/// Fewest other tests.
const OTHERS: usize = 2;
/// How near each other those must be, and how near to exchanged the one, in parts of what an exchange makes.
const AGREE: f64 = 0.15;
const NEAR: f64 = 0.2;

/// A question about the tests of which the members' depths fit once exchanged; none where the numbers of teeth are alike.
pub(super) fn exchanged_depths(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let [pinion, gear] = [&study.gears.pinion, &study.gears.gear].map(|g| g.spec.teeth);
    let ratio = f64::from(gear) / f64::from(pinion);
    if ratio < CLEAR_RATIO {
        return None;
    }
    let own = (0..study.tests.len()).filter_map(|test| Some((test, of_test(rows, test)?)));
    let own: Vec<(usize, f64)> = own.collect();
    let shift = -2.0 * ratio.ln();
    let exchanged = own.iter().filter(|(test, q)| {
        let others = || (own.iter()).filter_map(|(t, q)| (t != test).then_some(*q));
        let Some(usual) = median(others().collect()) else {
            return false;
        };
        let agree = others().all(|other| (other - usual).abs() < AGREE * shift.abs());
        let is_near = (q - usual - shift).abs() < NEAR * shift.abs();
        others().count() >= OTHERS && agree && is_near
    });
    let ids: Vec<&str> = exchanged
        .map(|(test, _)| study.tests[*test].id.as_str())
        .collect();
    (!ids.is_empty()).then(|| {
        format!(
            "are the depths of pinion and gear exchanged in test {}? Against the other tests, which agree, its pinion wears too little and its gear too much, \
             both by about {gear}/{pinion}: exchange the members of these rows",
            ids.join(", ")
        )
    })
}

/// The rows of one test.
pub(super) fn of_one_test<'d>(rows: &[FittedRow<'d>], test: usize) -> Vec<FittedRow<'d>> {
    let own = rows.iter().filter(|(o, _)| o.test == test);
    own.copied().collect()
}

/// ln of how much more the pinion's depths are the model's than the gear's; None without both.
pub(super) fn of_test(rows: &[FittedRow<'_>], test: usize) -> Option<f64> {
    let own = of_one_test(rows, test);
    let of = |member| {
        let found = scale(&own, Quantity::WearDepth, Some(member))?;
        (found.factor > 0.0).then_some(found.factor)
    };
    Some((of(Subject::Pinion)? / of(Subject::Gear)?).ln())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What a question says of three tests whose computed depths are so many times some, with so many times these on pinion and gear.
    pub(in super::super) fn said_of(
        question: fn(&Study, &[FittedRow<'_>]) -> Option<String>,
        levels: [f64; 3],
        factors: [[f64; 2]; 3],
    ) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        let tests = ["A", "B", "C"].into_iter().zip(levels);
        for ((test, level), factors) in tests.zip(factors) {
            for ((member, radius), factor) in
                [("pinion", 27.0), ("gear", 53.0)].into_iter().zip(factors)
            {
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

    fn said(factors: [[f64; 2]; 3]) -> Option<String> {
        said_of(exchanged_depths, [1.0; 3], factors)
    }

    #[test]
    fn one_test_among_others_is_asked_about() {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let [z1, z2] = [&study.gears.pinion, &study.gears.gear].map(|g| f64::from(g.spec.teeth));
        let u = z2 / z1;
        let exchanged = [u.recip(), u];
        let asked = said([[1.0, 1.0], exchanged, [1.1, 1.05]]).unwrap();
        assert!(
            asked.starts_with("are the depths of pinion and gear exchanged in test B?"),
            "{asked}"
        );
        // none; all; others that do not agree; by another factor
        assert_eq!(said([[1.0, 1.0], [1.2, 1.1], [1.1, 1.05]]), None);
        assert_eq!(said([exchanged; 3]), None);
        assert_eq!(said([[1.0, 1.0], exchanged, [1.0, u]]), None);
        assert_eq!(
            said([[1.0, 1.0], [u.sqrt().recip(), u.sqrt()], [1.0, 1.0]]),
            None
        );
    }
}
