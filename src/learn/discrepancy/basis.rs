//! Functions of one driver by the rows of measurements, on which a discrepancy is laid out.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::numeric::chebyshev;

/// Functions of a driver: their values at each row, none where all are zero.
pub(in crate::learn) type Functions = Vec<Vec<f64>>;

/// Numbers from 0 for values, alike where they are.
pub(in crate::learn) fn numbered<T: Ord>(values: impl Iterator<Item = T>) -> Vec<usize> {
    let mut numbers = BTreeMap::new();
    values
        .map(|value| {
            let next = numbers.len();
            *numbers.entry(value).or_insert(next)
        })
        .collect()
}

/// Chebyshev's polynomials over the range of the values, fewer than there are different values.
pub(in crate::learn) fn polynomials(kinds: &[usize], values: &[f64], most: usize) -> Functions {
    let (x, distinct) = ranged(kinds, values);
    (0..most.min(distinct))
        .map(|degree| {
            x.iter()
                .map(|&x| chebyshev(degree, 2.0 * x - 1.0))
                .collect()
        })
        .collect()
}

/// Cosines over the range of the values, no more than there are different values.
pub(in crate::learn) fn waves(kinds: &[usize], values: &[f64], most: usize) -> Functions {
    let (x, distinct) = ranged(kinds, values);
    (0..most.min(distinct))
        .map(|p| x.iter().map(|x| (p as f64 * PI * x).cos()).collect())
        .collect()
}

/// Means of cosines over 0 to a value, sin(pπx)/(pπx) with x the value as a share of the largest, no more than there are different values.
pub(in crate::learn) fn mean_waves(values: &[f64], most: usize) -> Functions {
    let largest = values.iter().copied().fold(0.0, f64::max);
    let mut distinct = values.to_vec();
    distinct.sort_by(f64::total_cmp);
    distinct.dedup();
    let mean = |p: usize, value: f64| {
        let angle = p as f64 * PI * value / largest;
        if angle > 0.0 {
            angle.sin() / angle
        } else {
            1.0
        }
    };
    (0..most.min(distinct.len()))
        .map(|p| values.iter().map(|&value| mean(p, value)).collect())
        .collect()
}

/// Values as shares of the range that those of their kind have, and how many are different in a kind at most.
fn ranged(kinds: &[usize], values: &[f64]) -> (Vec<f64>, usize) {
    let mut shares = vec![0.0; values.len()];
    let mut most = 0;
    for kind in 0..kinds.iter().max().map_or(0, |last| last + 1) {
        let own: Vec<usize> = (0..values.len()).filter(|&i| kinds[i] == kind).collect();
        let mut distinct: Vec<f64> = own.iter().map(|&i| values[i]).collect();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        let (low, high) = (distinct[0], distinct[distinct.len() - 1]);
        let width = if high > low { high - low } else { 1.0 };
        for i in own {
            shares[i] = ((values[i] - low) / width).clamp(0.0, 1.0);
        }
        most = most.max(distinct.len());
    }
    (shares, most)
}
