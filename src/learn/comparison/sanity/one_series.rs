//! One series of a member in one test that is far from all others of its quantity: a unit of its own.
//!
//! ```text
//! s = Σ y/Σ f of masses, that of the scale of depths       f the model with one k for all
//! told where one |ln s − median| > ln 12 and the others lie within a factor of 3
//! ```

use super::super::residual_statistics::FittedRow;
use super::{EXPLAINS, Quantity, Subject, rounded, scale};
use crate::numeric::median;
use crate::study::Study;

/// Factor from the others from which no scatter of k and no law that the model lacks is thought of.
const FAR: f64 = 12.0;
/// Factor within which the others lie.
const ALIKE: f64 = 3.0;
/// Factor within which a ratio is that of a known unit: tests scatter by as much.
const NEAR_UNIT: f64 = 1.5;
/// Fewest others.
const OTHERS: usize = 3;

/// A test, a member, and the measured values over the computed ones.
type Series<'s> = (&'s str, Subject, f64);

/// The series of one member in one test that alone is off by a factor, in words.
pub(super) fn one_series(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let quantities = [Quantity::MassLoss, Quantity::WearDepth];
    quantities.into_iter().find_map(|quantity| {
        let series = series(study, rows, quantity);
        let (test, member, factor) = odd(&series)?;
        Some(in_words(quantity, test, member, factor))
    })
}

fn series<'s>(study: &'s Study, rows: &[FittedRow<'_>], quantity: Quantity) -> Vec<Series<'s>> {
    let mut all = Vec::new();
    for (number, test) in study.tests.iter().enumerate() {
        for member in [Subject::Pinion, Subject::Gear] {
            let is_own = |(o, _): &&FittedRow<'_>| {
                (o.test, o.quantity, o.member) == (number, quantity, member)
            };
            let own: Vec<FittedRow<'_>> = rows.iter().filter(is_own).copied().collect();
            let factor = if quantity == Quantity::MassLoss {
                let sum = |of: fn(&FittedRow<'_>) -> f64| own.iter().map(of).sum::<f64>();
                Some(sum(|(o, _)| o.value) / sum(|(_, row)| row.model))
            } else {
                let found = scale(&own, quantity, None);
                found.filter(|s| s.explains > EXPLAINS).map(|s| s.factor)
            };
            let usable = factor.filter(|factor| factor.is_finite() && *factor > 0.0);
            all.extend(usable.map(|factor| (test.id.as_str(), member, factor)));
        }
    }
    all
}

/// The one that is far from all others, with its factor over their median.
fn odd<'s>(all: &[Series<'s>]) -> Option<Series<'s>> {
    let of_others = |one: usize| -> Vec<f64> {
        let others = all.iter().enumerate().filter(|(i, _)| *i != one);
        others.map(|(_, (.., factor))| factor.ln()).collect()
    };
    (0..all.len()).find_map(|one| {
        let mut others = of_others(one);
        others.sort_by(f64::total_cmp);
        let spread = others.last()? - others[0];
        let far = all[one].2.ln() - median(others.clone())?;
        (others.len() >= OTHERS && spread < ALIKE.ln() && far.abs() > FAR.ln())
            .then(|| (all[one].0, all[one].1, far.exp()))
    })
}

fn in_words(quantity: Quantity, test: &str, member: Subject, factor: f64) -> String {
    let (unit, small, large) = match quantity {
        Quantity::MassLoss => ("mg", &[(1e3, "g")][..], (1e3, "µg")),
        _ => ("µm", &[(1e3, "mm"), (25.4, "mils")][..], (1e3, "nm")),
    };
    let large = &[large][..];
    let (units, times, side) = if factor < 1.0 {
        (small, 1.0 / factor, "below")
    } else {
        (large, factor, "above")
    };
    let near = units
        .iter()
        .find(|(of, _)| (times / of).ln().abs() < NEAR_UNIT.ln());
    let looks = near.map_or("look at its unit".to_owned(), |(_, name)| {
        format!("this looks like {name}")
    });
    format!(
        "{} of the {} in test {test} lies {} times {side} what all others ask for: {looks}, it is wanted in {unit}",
        quantity.name(),
        member.name(),
        rounded(times)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_series_in_a_unit_of_its_own_is_named() {
        use Subject::{Gear, Pinion};
        let grams = [
            ("A", Pinion, 1.0),
            ("A", Gear, 1.3),
            ("B", Pinion, 0.8),
            ("B", Gear, 1.1e-3),
            ("C", Pinion, 2.0),
        ];
        let (test, member, factor) = odd(&grams).unwrap();
        assert_eq!((test, member), ("B", Gear));
        let said = in_words(Quantity::MassLoss, test, member, factor);
        assert_eq!(
            said,
            "mass_loss of the gear in test B lies 1182 times below what all others ask for: this looks like g, it is wanted in mg"
        );
        assert!(in_words(Quantity::WearDepth, "B", Gear, 1.0 / 24.0).contains("like mils"));
        assert!(
            in_words(Quantity::WearDepth, "B", Gear, 60.0)
                .contains("60 times above what all others ask for: look at its unit")
        );
        // two of them, too few others, and others that scatter themselves
        let mut two = grams;
        two[0].2 = 1e-3;
        assert_eq!(odd(&two), None);
        assert_eq!(odd(&grams[1..4]), None);
        let mut scattered = grams;
        scattered[0].2 = 5.0;
        assert_eq!(odd(&scattered), None);
    }
}
