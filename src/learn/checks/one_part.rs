//! One test, or one quantity, that carries nearly all that the base model leaves, where the others are near their noise.

use std::collections::BTreeMap;

use crate::learn::candidates::likelihood::Likelihood;
use crate::measure::{Observation, Quantity};

/// χ² per point of a part that is off by itself, and up to which the others are near their noise.
const OFF: f64 = 2.5;
const NEAR_NOISE: f64 = 1.6;
/// Share of the χ² beyond noise that is nearly all of it: the others may be many, and each but a little off.
const NEARLY_ALL: f64 = 0.8;
/// Fewest tests among which one says something.
const TESTS: usize = 3;

/// A part of the measurements that may be at fault itself, before any physics is blamed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::learn) struct OddPart {
    /// What is wrong with it.
    pub(in crate::learn) warning: String,
    /// What to do about it before anything else.
    pub(in crate::learn) first: String,
}

/// The part of the measurements that carries nearly all of the misfit of `model`; none where several do.
pub(in crate::learn) fn one_part(likelihood: &Likelihood<'_>, model: &[f64]) -> Option<OddPart> {
    one_test(likelihood, model).or_else(|| one_quantity(likelihood, model))
}

/// A test: its conditions may not be those that are stated.
fn one_test(likelihood: &Likelihood<'_>, model: &[f64]) -> Option<OddPart> {
    let tests = misfits(likelihood, model, |o| o.test);
    let (test, words) = odd_one(&tests, TESTS)?;
    let id = &likelihood.measured.data.tests[test];
    Some(OddPart {
        warning: format!(
            "nearly all of the misfit is that of test {id} ({words}): an effect may act under its conditions only, but check first that its torque, speed, \
             misalignment and the positions of its rows are those of the test, and that its parts were new at the start"
        ),
        first: format!("check test {id} first (see the warning)"),
    })
}

/// A quantity: how it was measured may be at fault.
fn one_quantity(likelihood: &Likelihood<'_>, model: &[f64]) -> Option<OddPart> {
    let quantities = misfits(likelihood, model, |o| o.quantity);
    let (quantity, words) = odd_one(&quantities, 2)?;
    let how = match quantity {
        Quantity::MassLoss => " (drift of the balance, oil left on the parts, chipping)",
        _ => "",
    };
    let name = quantity.name();
    Some(OddPart {
        warning: format!(
            "nearly all of the misfit is that of {name} ({words}): an effect may show in it alone, but check first how it was measured{how}"
        ),
        first: format!("check how {name} was measured first (see the warning)"),
    })
}

/// χ² of a part, and its number of points.
type Misfit = (f64, f64);

/// χ² and the number of points of each part.
fn misfits<K: Ord>(
    likelihood: &Likelihood<'_>,
    model: &[f64],
    part: impl Fn(&Observation) -> K,
) -> Vec<(K, Misfit)> {
    let mut parts: BTreeMap<K, Misfit> = BTreeMap::new();
    for (row, z) in likelihood.standardised(model).into_iter().enumerate() {
        let (square, count) = parts.entry(part(likelihood.observation(row))).or_default();
        *square += z * z;
        *count += 1.0;
    }
    parts.into_iter().collect()
}

/// The one that is off among at least so many, with its χ² per point and those of the others in words.
fn odd_one<K: Copy>(parts: &[(K, Misfit)], fewest: usize) -> Option<(K, String)> {
    let beyond = |&(_, (square, count)): &(K, Misfit)| (square - count).max(0.0);
    let all: f64 = parts.iter().map(beyond).sum();
    let per_point = |&(_, (square, count)): &(K, Misfit)| square / count;
    let mut by_misfit = parts.to_vec();
    by_misfit.sort_by(|a, b| per_point(b).total_cmp(&per_point(a)));
    let (odd, others) = by_misfit.split_first()?;
    let [worst, next, least] = [odd, others.first()?, others.last()?].map(per_point);
    let of_others = match others.len() {
        1 => format!("{next:.1}"),
        _ => format!("{least:.1} to {next:.1}"),
    };
    let is_odd = parts.len() >= fewest && worst > OFF && next < NEAR_NOISE;
    (is_odd && beyond(odd) >= NEARLY_ALL * all).then(|| {
        (
            odd.0,
            format!("χ² {worst:.1} per point, of the others {of_others}"),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_part_is_odd_where_all_others_are_near_their_noise() {
        let of = |parts: &[(usize, f64)]| -> Vec<(usize, Misfit)> {
            (parts
                .iter()
                .map(|&(part, per_point)| (part, (100.0 * per_point, 100.0))))
            .collect()
        };
        let odd =
            |parts: &[(usize, f64)], fewest| odd_one(&of(parts), fewest).map(|(part, _)| part);
        assert_eq!(odd(&[(0, 0.9), (1, 6.5), (2, 0.7)], TESTS), Some(1));
        assert_eq!(odd(&[(0, 0.9), (1, 6.5), (2, 1.7)], TESTS), None);
        assert_eq!(odd(&[(0, 0.9), (1, 2.4), (2, 0.7)], TESTS), None);
        assert_eq!(odd(&[(0, 0.9), (1, 6.5)], TESTS), None);
        assert_eq!(odd(&[(0, 0.9), (1, 6.5)], 2), Some(1));
        assert_eq!(odd(&[(0, 6.5)], 1), None);
        let (_, words) = odd_one(&of(&[(0, 0.9), (1, 6.5), (2, 0.7)]), TESTS).unwrap();
        assert_eq!(words, "χ² 6.5 per point, of the others 0.7 to 0.9");
        // thirty masses beside 1230 depths: most of what is missed is in the depths
        for of_depths in [1320.0, 1900.0] {
            let masses = [(0, (of_depths, 1230.0)), (1, (78.0, 30.0))];
            assert!(odd_one(&masses, 2).is_none(), "{of_depths}");
        }
        assert!(odd_one(&[(0, (1235.0, 1230.0)), (1, (78.0, 30.0))], 2).is_some());
    }
}
