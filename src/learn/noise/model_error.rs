//! An error of the model itself, and the covariance of rows that it ties together.

use std::collections::BTreeMap;

use nalgebra::{Cholesky, DMatrix, Dyn};

use super::trace::TraceErrors;
use crate::measure::Observation;

/// An error of the model, proportional to each curve's largest measured magnitude (a curve: same test, member, quantity and cycles).
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
pub(super) type Dense = (Vec<usize>, Box<Cholesky<f64, Dyn>>);

/// One block per test, member and quantity; traces that reach over several tie them together.
pub(super) fn dense_blocks(
    picked: &[&Observation],
    sigma: &[f64],
    traces: &[TraceErrors],
    errors: &[(Vec<f64>, ModelError)],
) -> Vec<Dense> {
    let mut groups = BTreeMap::new();
    for (i, o) in picked.iter().enumerate() {
        let rows: &mut Vec<usize> = groups.entry((o.test, o.member, o.quantity)).or_default();
        rows.push(i);
    }
    let groups: Vec<Vec<usize>> = groups.into_values().collect();
    let mut label = vec![0; picked.len()];
    for (number, rows) in groups.iter().enumerate() {
        rows.iter().for_each(|&i| label[i] = number);
    }
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
        let mut matrix = DMatrix::zeros(n, n);
        for (a, &i) in rows.iter().enumerate() {
            for (b, &j) in rows.iter().enumerate().take(a + 1) {
                let (o, p) = (picked[i], picked[j]);
                if (o.test, o.member, o.quantity) == (p.test, p.member, p.quantity) {
                    for (amplitude, error) in errors {
                        let along = (share[i] - share[j]) / error.along;
                        let over = (logs[i] - logs[j]) / error.over_cycles;
                        let size = error.relative.powi(2) * amplitude[i] * amplitude[j];
                        matrix[(a, b)] += size * (-0.5 * (along * along + over * over)).exp();
                    }
                }
            }
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
                for (b, &j) in place.iter().enumerate() {
                    matrix[(i, j)] += own[(a, b)];
                }
            }
        }
        (rows, Box::new(factor(matrix)))
    };
    blocks.into_values().map(block).collect()
}

/// Cholesky's factor of a covariance: a sum of positive semi-definite parts and diag σ² > 0.
///
/// An error a million times the noise leaves σ² below the rounding of the sum: then as much is added to the diagonal as the factor needs,
/// from 1e-14 of its largest element on.
///
/// # Panics
/// If an element is not finite.
fn factor(matrix: DMatrix<f64>) -> Cholesky<f64, Dyn> {
    let largest = matrix.diagonal().max();
    let mut rounding = 1e-14 * largest;
    let mut raised = matrix.clone();
    loop {
        if let Some(factor) = Cholesky::new(raised) {
            return factor;
        }
        assert!(largest.is_finite(), "a covariance is not finite");
        raised = &matrix + DMatrix::identity(matrix.nrows(), matrix.nrows()) * rounding;
        rounding *= 10.0;
    }
}

/// The largest magnitude measured in each row's curve.
pub(in crate::learn) fn amplitudes(picked: &[&Observation]) -> Vec<f64> {
    let key = |o: &Observation| (o.test, o.member, o.quantity, o.cycles.to_bits());
    let mut largest = BTreeMap::new();
    for o in picked {
        let entry: &mut f64 = largest.entry(key(o)).or_insert(0.0);
        *entry = entry.max(o.value.abs());
    }
    picked.iter().map(|o| largest[&key(o)]).collect()
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
        let matrix = DMatrix::from_fn(30, 30, |i, j| {
            let size = |k: usize| 1e10 * (1.0 + 0.3 * k as f64).sin();
            size(i) * size(j) + if i == j { 1e-3 } else { 0.0 }
        });
        assert!(Cholesky::new(matrix.clone()).is_none());
        let back = factor(matrix.clone());
        let product = back.l() * back.l().transpose();
        assert!((product - &matrix).abs().max() < 1e-9 * matrix.abs().max());
        // and what needs nothing gets nothing
        let plain = DMatrix::identity(3, 3) * 4.0;
        assert_eq!(factor(plain.clone()).l(), plain / 2.0);
    }
}
