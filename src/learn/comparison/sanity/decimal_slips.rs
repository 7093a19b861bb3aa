//! Masses with a decimal point in the wrong place, or written in another unit than the others.
//!
//! ```text
//! losses m_i of one member in one test, by cycles N_i
//! m_i outside of [m_(i−1), m_(i+1)], and m_i/10 or 10 m_i inside:                             a decimal point
//! m_i/N_i a thousand times below or above those of the others, which lie within a factor of 10: another unit
//! ```
//! Estimated sigmas do not show it: the slip is in the scatter that they are made of.

use std::collections::BTreeMap;

use crate::measure::{Dataset, Quantity};
use crate::numeric::written::significant;
use crate::study::Study;

/// Fewest weighings of a member, so that the others tell how its wear goes on.
const FEWEST: usize = 4;
/// Fewest of them where one is a thousand times off, which no course of wear explains.
const FEWEST_OF_A_UNIT: usize = 3;
/// Factor between milligrams and the next larger or smaller unit.
const UNIT: f64 = 1000.0;
/// Factor within which the others' masses per cycle lie, and how far beyond them one may be in its own unit.
const ALIKE: f64 = 10.0;
const BEYOND: f64 = 2.0;

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
        let Some(losses) = single else {
            continue;
        };
        if let Some((at, meant)) = in_another_unit(&losses) {
            let (cycles, value) = losses[at];
            let (times, unit) = match meant > value {
                true => ("less", "g"),
                false => ("more", "µg"),
            };
            said.push(format!(
                "mass_loss of the {} in test {} is {} mg after {cycles} cycles, about a thousand times {times} than its other weighings lead to expect: was \
                 this one written in {unit}? {} mg would fit",
                member.name(),
                study.tests[test].id,
                significant(value, 4),
                significant(meant, 4)
            ));
        } else if let Some((at, meant)) = slip(&losses) {
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

/// All losses but one, if they rise.
fn rising_others(losses: &[(f64, f64)], at: usize) -> Option<Vec<(f64, f64)>> {
    let others = losses.iter().enumerate().filter(|(other, _)| *other != at);
    let others: Vec<(f64, f64)> = others.map(|(_, loss)| *loss).collect();
    let rises = |pair: &[(f64, f64)]| 0.0 < pair[0].1 && pair[0].1 < pair[1].1;
    others.windows(2).all(rises).then_some(others)
}

/// Which of losses by cycles is a thousand times off, and what it is in the unit of the others.
fn in_another_unit(losses: &[(f64, f64)]) -> Option<(usize, f64)> {
    let per_cycle = |(cycles, loss): &(f64, f64)| loss / cycles;
    let of = |at: usize| {
        let others = rising_others(losses, at)?;
        let paces = || others.iter().map(per_cycle);
        let (least, most) = (
            paces().fold(f64::INFINITY, f64::min),
            paces().fold(0.0, f64::max),
        );
        let would_fit = |pace: f64| (least / BEYOND..BEYOND * most).contains(&pace);
        let own = per_cycle(&losses[at]);
        let factor = [UNIT, UNIT.recip()]
            .into_iter()
            .find(|factor| would_fit(factor * own))?;
        (most < ALIKE * least).then(|| (at, factor * losses[at].1))
    };
    (losses.len() >= FEWEST_OF_A_UNIT)
        .then(|| (0..losses.len()).find_map(of))
        .flatten()
}

/// Which of losses by cycles fits only with its decimal point elsewhere, and that; none where the others do not rise.
fn slip(losses: &[(f64, f64)]) -> Option<(usize, f64)> {
    if losses.len() < FEWEST {
        return None;
    }
    (1..losses.len() - 1).find_map(|at| {
        let between = |value: f64| losses[at - 1].1 < value && value < losses[at + 1].1;
        let value = losses[at].1;
        let meant = [value / 10.0, 10.0 * value]
            .into_iter()
            .find(|v| between(*v));
        meant
            .filter(|_| !between(value) && rising_others(losses, at).is_some())
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

    #[test]
    fn a_mass_in_another_unit_is_found_wherever_it_stands() {
        let losses = [26.8, 50.7, 86.9, 105.7, 135.0];
        let found = |losses: &[f64]| {
            let losses = losses.iter().enumerate();
            let losses: Vec<(f64, f64)> = losses.map(|(n, m)| (1e5 * (n + 1) as f64, *m)).collect();
            in_another_unit(&losses)
        };
        for at in 0..losses.len() {
            for factor in [1e-3, 1e3] {
                let mut wrong = losses;
                wrong[at] *= factor;
                let (place, meant) = found(&wrong).unwrap();
                assert!(place == at && (meant / losses[at] - 1.0).abs() < 1e-9);
            }
        }
        assert!(found(&[0.0268, 50.7, 86.9]).is_some());
        for right in [
            &losses[..],
            // a decimal point; nothing lost yet; two weighings alone; others in no order
            &[26.8, 50.7, 86.9, 1057.0, 135.0],
            &[0.0, 50.7, 86.9, 105.7],
            &[0.0268, 50.7],
            &[0.0268, 86.9, 50.7, 105.7],
        ] {
            assert_eq!(found(right), None, "{right:?}");
        }
    }
}
