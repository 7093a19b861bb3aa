//! Masses with a decimal point in the wrong place.
//!
//! ```text
//! m_i outside of [m_(i−1), m_(i+1)], and m_i/10 or 10 m_i inside: asked        losses of one member in one test, by cycles
//! ```
//! Estimated sigmas do not show it: the slip is in the scatter that they are made of.

use std::collections::BTreeMap;

use crate::measure::{Dataset, Quantity};
use crate::study::Study;

/// Fewest weighings of a member, so that the others tell how its wear goes on.
const FEWEST: usize = 4;

/// A question for each such mass.
pub(super) fn decimal_slips(study: &Study, data: &Dataset) -> Vec<String> {
    let mut members: BTreeMap<_, BTreeMap<u64, Vec<f64>>> = BTreeMap::new();
    let masses = data.observations.iter();
    for o in masses.filter(|o| o.quantity == Quantity::MassLoss && o.cycles > 0.0) {
        let own = members.entry((o.test, o.member)).or_default();
        own.entry(o.cycles.to_bits()).or_default().push(o.value);
    }
    let mut said = Vec::new();
    for ((test, member), weighings) in members {
        // repeats show a slip by themselves
        let single: Option<Vec<(f64, f64)>> = (weighings.into_iter())
            .map(|(cycles, values)| Some((f64::from_bits(cycles), single(&values)?)))
            .collect();
        let Some(losses) = single.filter(|losses| losses.len() >= FEWEST) else {
            continue;
        };
        if let Some((at, meant)) = slip(&losses) {
            let (cycles, value) = losses[at];
            said.push(format!(
                "mass_loss of the {} in test {} is {value} mg after {cycles} cycles, between {} and {} mg before and after: is a decimal point wrong? {} mg would \
                 fit",
                member.name(),
                study.tests[test].id,
                losses[at - 1].1,
                losses[at + 1].1,
                (1e6 * meant).round() / 1e6
            ));
        }
    }
    said
}

fn single(values: &[f64]) -> Option<f64> {
    match values[..] {
        [one] => Some(one),
        _ => None,
    }
}

/// Which of losses by cycles fits only with its decimal point elsewhere, and that; none where the others do not rise.
fn slip(losses: &[(f64, f64)]) -> Option<(usize, f64)> {
    (1..losses.len() - 1).find_map(|at| {
        let rest: Vec<f64> = (losses.iter().enumerate())
            .filter(|(other, _)| *other != at)
            .map(|(_, loss)| loss.1)
            .collect();
        let rises = rest
            .windows(2)
            .all(|pair| 0.0 < pair[0] && pair[0] < pair[1]);
        let between = |value: f64| losses[at - 1].1 < value && value < losses[at + 1].1;
        let value = losses[at].1;
        let meant = [value / 10.0, 10.0 * value]
            .into_iter()
            .find(|v| between(*v));
        meant
            .filter(|_| rises && !between(value))
            .map(|meant| (at, meant))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mass_that_fits_with_its_point_elsewhere_is_found() {
        let slip = |losses: [f64; 5]| {
            let losses = losses.iter().enumerate();
            let losses: Vec<(f64, f64)> = losses.map(|(n, loss)| (n as f64, *loss)).collect();
            slip(&losses)
        };
        let (at, meant) = slip([26.8, 50.7, 86.9, 1057.3, 135.0]).unwrap();
        assert!(at == 3 && (meant - 105.73).abs() < 1e-9);
        assert_eq!(slip([26.8, 50.7, 86.9, 10.57, 135.0]).unwrap().0, 3);
        for right in [
            [26.8, 50.7, 86.9, 105.7, 135.0],
            // noise; a first part that wears fast; no order at all
            [26.8, 50.7, 49.0, 105.7, 135.0],
            [1.0, 50.7, 86.9, 105.7, 135.0],
            [26.8, 50.7, 5.0, 300.0, 35.0],
        ] {
            assert_eq!(slip(right), None, "{right:?}");
        }
    }
}
