//! The covariance of measured rows, by the blocks it falls into.
//!
//! With z = e/σ and X = M/σ = U s Vᵀ, the inverse root of `I + X Xᵀ` is `I − U (1 − 1/√(1 + s²)) Uᵀ` (Sherman, Morrison and Woodbury), so
//! whitening costs one pass. With K, rows of one test, member, quantity and place across the face make one dense block with its Cholesky factor.

use faer::Mat;
use nalgebra::{DMatrix, DVector};

use super::NoiseModel;
use super::model_error::{ModelError, amplitudes, dense_blocks};
use super::trace::{Datum, TraceErrors, directions, trace_errors};
use crate::measure::{Dataset, Observation};
use crate::numeric::positive_definite::Factor;

/// The covariance of some of a data set's rows.
#[derive(Debug, Clone)]
pub(in crate::learn) struct Covariance {
    sigma: Vec<f64>,
    blocks: Vec<Block>,
    traces: Vec<TraceErrors>,
    /// Orthonormal whitened directions of a shared discrepancy with their variances.
    shared: Vec<(DVector<f64>, f64)>,
}

#[derive(Debug, Clone)]
enum Block {
    Trace(TraceErrors),
    Dense(Vec<usize>, Factor),
}

impl Covariance {
    /// Of the observations `rows` of a data set; rows are counted from 0 in that list from here on.
    pub(in crate::learn) fn new(data: &Dataset, rows: &[usize], model: &NoiseModel) -> Self {
        Self::with_errors(data, rows, model, &[])
    }

    /// With further correlated errors, each with its amplitude at every row.
    pub(in crate::learn) fn with_errors(
        data: &Dataset,
        rows: &[usize],
        model: &NoiseModel,
        further: &[(&[f64], ModelError)],
    ) -> Self {
        let picked: Vec<&Observation> = rows.iter().map(|&row| &data.observations[row]).collect();
        let sigma = model.sigma.of(&picked);
        let traces = trace_errors(&picked, &sigma, model);
        let mut errors: Vec<(Vec<f64>, ModelError)> = Vec::new();
        if let Some(error) = model.model_error {
            errors.push((amplitudes(&picked), error));
        }
        errors.extend(further.iter().map(|(size, error)| (size.to_vec(), *error)));
        let blocks = if errors.is_empty() {
            traces.iter().cloned().map(Block::Trace).collect()
        } else {
            let dense = dense_blocks(&picked, &sigma, &traces, &errors);
            dense
                .into_iter()
                .map(|(rows, factor)| Block::Dense(rows, factor))
                .collect()
        };
        Self {
            sigma,
            blocks,
            traces,
            shared: Vec::new(),
        }
    }

    /// With functions common to all rows, one a column, each in its prior standard deviation.
    ///
    /// ```text
    /// X = W Φ = U s Vᵀ:   (I + X Xᵀ)^(−½) = I − U (1 − 1/√(1 + s²)) Uᵀ
    /// ```
    pub(in crate::learn) fn with_shared(mut self, functions: &DMatrix<f64>) -> Self {
        if functions.ncols() > 0 {
            self.shared.extend(directions(&self.whiten_all(functions)));
        }
        self
    }

    /// W v, where WᵀW is the inverse of the covariance.
    pub(in crate::learn) fn whiten(&self, v: &[f64]) -> Vec<f64> {
        let column = DMatrix::from_column_slice(v.len(), 1, v);
        self.whiten_all(&column).data.into()
    }

    /// W of every column.
    pub(in crate::learn) fn whiten_all(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let mut z = self.whiten_blocks(columns);
        for mut z in z.column_iter_mut() {
            let along: Vec<f64> = self.shared.iter().map(|(u, _)| u.dot(&z)).collect();
            for ((u, variance), along) in self.shared.iter().zip(along) {
                z.axpy(-(1.0 - (1.0 + variance).sqrt().recip()) * along, u, 1.0);
            }
        }
        z
    }

    /// The same without a shared discrepancy.
    fn whiten_blocks(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let mut z = columns.clone();
        for mut column in z.column_iter_mut() {
            let rows = column.iter_mut().zip(&self.sigma);
            rows.for_each(|(z, sigma)| *z /= sigma);
        }
        for block in &self.blocks {
            match block {
                Block::Trace(errors) => {
                    let columns = z.column_iter_mut();
                    columns.for_each(|mut column| errors.whiten(column.as_mut_slice()));
                }
                Block::Dense(rows, factor) => {
                    // a derivative with respect to one test's k is zero in the blocks of all others
                    let touched = |j: &usize| rows.iter().any(|&i| columns[(i, *j)] != 0.0);
                    let own: Vec<usize> = (0..columns.ncols()).filter(touched).collect();
                    let value = |i: usize, j: usize| columns[(rows[i], own[j])];
                    let mut part = Mat::from_fn(rows.len(), own.len(), value);
                    factor.solve_lower(part.as_mut());
                    for (j, &column) in own.iter().enumerate() {
                        for (&row, part) in rows.iter().zip(part.col_as_slice(j)) {
                            z[(row, column)] = *part;
                        }
                    }
                }
            }
        }
        z
    }

    /// Logarithm of the covariance's determinant.
    pub(in crate::learn) fn log_determinant(&self) -> f64 {
        let mut dense = vec![false; self.sigma.len()];
        let mut sum = 0.0;
        for block in &self.blocks {
            match block {
                Block::Trace(errors) => sum += errors.log_determinant(),
                Block::Dense(rows, factor) => {
                    rows.iter().for_each(|&i| dense[i] = true);
                    sum += factor.log_determinant();
                }
            }
        }
        let alone = self.sigma.iter().zip(dense).filter(|(_, dense)| !dense);
        let shared: f64 = self
            .shared
            .iter()
            .map(|(_, variance)| variance.ln_1p())
            .sum();
        sum + shared + alone.map(|(sigma, _)| 2.0 * sigma.ln()).sum::<f64>()
    }

    /// What the traces' most probable errors make at each row when measured minus model is `residual`, and each trace's datum; a model error
    /// is not counted.
    pub(in crate::learn) fn trace_errors(&self, residual: &[f64]) -> (Vec<f64>, Vec<Datum>) {
        let mut at_rows = vec![0.0; residual.len()];
        let mut datums = Vec::new();
        for errors in &self.traces {
            let (own, datum) = errors.most_probable(residual);
            for (&i, own) in errors.rows.iter().zip(own.iter()) {
                at_rows[i] = *own;
            }
            datums.push(datum);
        }
        (at_rows, datums)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Cholesky;

    use super::*;

    /// Against the dense covariance σ² + M Mᵀ (per trace) + Φ Φᵀ: the square of the whitened rows and the determinant.
    #[test]
    fn functions_common_to_all_rows_join_the_covariance() {
        let sigma: Vec<f64> = (0..12).map(|i| 0.3 + 0.05 * f64::from(i)).collect();
        // a datum, a tilt and a shift along some slope
        let errors = |n: usize| {
            DMatrix::from_fn(n, 3, |i, j| match j {
                0 => 0.7,
                1 => 0.5 * (i as f64 / (n - 1) as f64 - 0.5),
                _ => 0.2 * (0.9 * i as f64).sin(),
            })
        };
        let traces: Vec<TraceErrors> = [(0, 0..5), (1, 5..9)]
            .map(|(trace, rows)| {
                TraceErrors::new(trace, rows.clone().collect(), errors(rows.len()), &sigma)
            })
            .into();
        let plain = Covariance {
            blocks: traces.iter().cloned().map(Block::Trace).collect(),
            sigma: sigma.clone(),
            traces: traces.clone(),
            shared: Vec::new(),
        };
        let functions = DMatrix::from_fn(12, 3, |i, j| (0.4 * (i * (j + 1)) as f64).cos());
        let mut dense = DMatrix::from_diagonal(&DVector::from_vec(sigma).map(|s| s * s));
        for trace in &traces {
            let own = &trace.functions * trace.functions.transpose();
            for (a, &i) in trace.rows.iter().enumerate() {
                for (b, &j) in trace.rows.iter().enumerate() {
                    dense[(i, j)] += own[(a, b)];
                }
            }
        }
        dense += &functions * functions.transpose();
        let shared = plain.with_shared(&functions);
        let factor = Cholesky::new(dense).unwrap();
        assert!((shared.log_determinant() - factor.determinant().ln()).abs() < 1e-10);
        for seed in 0..4 {
            let v = DVector::from_fn(12, |i, _| (1.3 * i as f64 + f64::from(seed)).sin());
            let square: f64 = (shared.whiten(v.as_slice()).iter()).map(|z| z * z).sum();
            let exact = v.dot(&factor.solve(&v));
            assert!((square - exact).abs() < 1e-10 * exact, "{square} {exact}");
        }
    }
}
