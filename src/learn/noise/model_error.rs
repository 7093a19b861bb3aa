//! An error of the model itself, and the covariance of rows that it ties together.

use std::collections::BTreeMap;

use faer::Mat;

use super::new_profile::NewProfile;
use super::trace::TraceErrors;
use crate::measure::{Observation, Surface, surfaces};
use crate::numeric::positive_definite::Factor;

/// An error of the model, proportional to each curve's largest measured magnitude (a curve: same test, member,
/// quantity, place across the face and cycles).
///
/// ```text
/// K_ij = r² a_i a_j exp(−(s_i − s_j)²/(2 l²)) exp(−(ln(n_i/n_j))²/(2 g²))
/// ```
/// a: the curve's largest magnitude; s: position in shares of the range measured on that member; n: cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelError {
    /// r, relative standard deviation.
    pub relative: f64,
    /// l, correlation length as a share of the measured range.
    pub along: f64,
    /// g, correlation length in the logarithm of cycles.
    pub over_cycles: f64,
}

impl Default for ModelError {
    fn default() -> Self {
        Self {
            relative: 0.005,
            along: 0.15,
            over_cycles: 1.0,
        }
    }
}

/// Rows with the factor of their covariance.
pub(super) type Dense = (Vec<usize>, Factor);

/// One block per test, member, quantity and place across the face; traces that reach over several tie them together.
pub(super) fn dense_blocks(
    picked: &[&Observation],
    sigma: &[f64],
    traces: &[TraceErrors],
    errors: &[(Vec<f64>, ModelError)],
    new_profile: Option<&NewProfile>,
) -> Vec<Dense> {
    let mut groups = BTreeMap::new();
    for (i, surface) in surfaces(picked).into_iter().enumerate() {
        let rows: &mut Vec<usize> = groups.entry(surface).or_default();
        rows.push(i);
    }
    let groups: Vec<Vec<usize>> = groups.into_values().collect();
    let mut group = vec![0; picked.len()];
    for (number, rows) in groups.iter().enumerate() {
        rows.iter().for_each(|&i| group[i] = number);
    }
    let mut label = group.clone();
    for trace in traces {
        let first = label[trace.rows[0]];
        for &row in &trace.rows {
            let other = label[row];
            if other != first {
                label
                    .iter_mut()
                    .filter(|l| **l == other)
                    .for_each(|l| *l = first);
            }
        }
    }
    let share = shares(picked, &groups);
    let logs: Vec<f64> = picked.iter().map(|o| o.cycles.max(1.0).ln()).collect();
    let mut blocks: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (i, &label) in label.iter().enumerate() {
        blocks.entry(label).or_default().push(i);
    }
    let block = |rows: Vec<usize>| {
        let n = rows.len();
        let mut matrix = Mat::<f64>::zeros(n, n);
        for (amplitude, error) in errors {
            let along = Bell::new(rows.iter().map(|&i| share[i]), error.along);
            let over = Bell::new(rows.iter().map(|&i| logs[i]), error.over_cycles);
            for (b, &j) in rows.iter().enumerate() {
                let size = error.relative.powi(2) * amplitude[j];
                let column = &mut matrix.col_as_slice_mut(b)[b..];
                for ((a, &i), entry) in rows.iter().enumerate().skip(b).zip(column) {
                    if group[i] == group[j] {
                        *entry += size * amplitude[i] * along.at(a, b) * over.at(a, b);
                    }
                }
            }
        }
        if let Some(new_profile) = new_profile {
            for (b, &j) in rows.iter().enumerate() {
                let below = rows.iter().enumerate().skip(b);
                for (a, &i) in below.filter(|(_, i)| group[**i] == group[j]) {
                    matrix[(a, b)] += new_profile.between(picked, i, j);
                }
            }
        }
        for (a, &i) in rows.iter().enumerate() {
            matrix[(a, a)] += sigma[i].powi(2);
        }
        for errors in traces
            .iter()
            .filter(|errors| label[errors.rows[0]] == label[rows[0]])
        {
            let place: Vec<usize> = (errors.rows.iter())
                .map(|row| rows.binary_search(row).expect("a trace lies in one block"))
                .collect();
            let own = &errors.functions * errors.functions.transpose();
            for (a, &i) in place.iter().enumerate() {
                for (b, &j) in place.iter().enumerate().filter(|(_, j)| **j <= i) {
                    matrix[(i, j)] += own[(a, b)];
                }
            }
        }
        (rows, factor(&matrix))
    };
    blocks.into_values().map(block).collect()
}

/// exp(−(x_a − x_b)²/(2 l²)) between the values of rows, each pair of values worked out once.
struct Bell {
    /// Which of the different values a row has.
    kind: Vec<usize>,
    kinds: usize,
    between: Vec<f64>,
}

impl Bell {
    fn new(values: impl Iterator<Item = f64>, length: f64) -> Self {
        let values: Vec<f64> = values.collect();
        let mut different = values.clone();
        different.sort_by(f64::total_cmp);
        different.dedup();
        let kinds = different.len();
        let kind = |value: &f64| different.partition_point(|known| known < value);
        let pair = |p: usize| {
            let apart = (different[p / kinds] - different[p % kinds]) / length;
            (-0.5 * apart * apart).exp()
        };
        Self {
            kind: values.iter().map(kind).collect(),
            kinds,
            between: (0..kinds * kinds).map(pair).collect(),
        }
    }

    fn at(&self, a: usize, b: usize) -> f64 {
        self.between[self.kind[b] * self.kinds + self.kind[a]]
    }
}

/// Cholesky's factor of a covariance: a sum of positive semi-definite parts and diag σ² > 0.
///
/// An error a million times the noise leaves σ² below the rounding of the sum: then as much is added to the diagonal as the factor needs,
/// from 1e-14 of its largest element on.
///
/// # Panics
/// If an element is not finite.
fn factor(matrix: &Mat<f64>) -> Factor {
    let diagonal = (0..matrix.nrows()).map(|i| matrix[(i, i)]);
    let largest = diagonal.fold(0.0, f64::max);
    let mut rounding = 1e-14 * largest;
    let mut raised = matrix.clone();
    loop {
        if let Some(factor) = Factor::new(raised) {
            return factor;
        }
        assert!(largest.is_finite(), "a covariance is not finite");
        raised = matrix.clone();
        for i in 0..matrix.nrows() {
            raised[(i, i)] += rounding;
        }
        rounding *= 10.0;
    }
}

/// The largest magnitude measured in each row's curve.
pub(in crate::learn) fn amplitudes(picked: &[&Observation]) -> Vec<f64> {
    let surfaces = surfaces(picked).into_iter();
    let keys: Vec<(Surface, u64)> = (surfaces.zip(picked))
        .map(|(surface, o)| (surface, o.cycles.to_bits()))
        .collect();
    let mut largest = BTreeMap::new();
    for (key, o) in keys.iter().zip(picked) {
        let entry: &mut f64 = largest.entry(key).or_insert(0.0);
        *entry = entry.max(o.value.abs());
    }
    keys.iter().map(|key| largest[key]).collect()
}

/// Each row's position as a share of its group's measured range, 0 where there is none.
fn shares(picked: &[&Observation], groups: &[Vec<usize>]) -> Vec<f64> {
    let mut shares = vec![0.0; picked.len()];
    for rows in groups {
        let place = |i: usize| picked[i].position.unwrap_or(0.0);
        let low = rows.iter().map(|&i| place(i)).fold(f64::INFINITY, f64::min);
        let high = rows
            .iter()
            .map(|&i| place(i))
            .fold(f64::NEG_INFINITY, f64::max);
        if high > low {
            rows.iter()
                .for_each(|&i| shares[i] = (place(i) - low) / (high - low));
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_far_above_the_noise_has_a_factor_too() {
        // rank one of size 1e20 over a variance of 1e-3: below the rounding of the sum
        let size = |k: usize| 1e10 * (1.0 + 0.3 * k as f64).sin();
        let noise = |i: usize, j: usize| if i == j { 1e-3 } else { 0.0 };
        let matrix = Mat::from_fn(30, 30, |i, j| size(i) * size(j) + noise(i, j));
        assert!(Factor::new(matrix.clone()).is_none());
        // whitened, the one direction that there is has a length of about 1
        let mut whitened = Mat::from_fn(30, 1, |i, _| size(i));
        factor(&matrix).solve_lower(whitened.as_mut());
        let square = whitened.col_as_slice(0).iter().map(|z| z * z).sum::<f64>();
        assert!((square - 1.0).abs() < 1e-2, "{square}");
        // and what needs nothing gets nothing
        let plain = factor(&Mat::from_fn(3, 3, |i, j| 4000.0 * noise(i, j)));
        assert!((plain.log_determinant() - 3.0 * 4.0f64.ln()).abs() < 1e-14);
    }
}
