//! The covariance of measured rows, by the blocks it falls into.
//!
//! With z = e/σ and X = M/σ = U s Vᵀ, the inverse root of `I + X Xᵀ` is `I − U (1 − 1/√(1 + s²)) Uᵀ` (Sherman, Morrison and Woodbury), so
//! whitening costs one pass. With K or N, rows of one test, member, quantity and place across the face make one dense block with its Cholesky factor.

use faer::Mat;
use nalgebra::{DMatrix, DVector};

use super::NoiseModel;
use super::model_error::{Dense, ModelError, amplitudes, dense_blocks};
use super::new_profile::NewProfile;
use super::trace::{Datum, TraceErrors, directions, trace_errors};
use crate::measure::{Dataset, Observation};
use crate::numeric::positive_definite::Factor;

/// The covariance of some of a data set's rows.
#[derive(Debug, Clone)]
pub(in crate::learn) struct Covariance {
    sigma: Vec<f64>,
    blocks: Vec<Block>,
    traces: Vec<TraceErrors>,
    /// Blocks of the measurements' own covariance, without an error of the model, where the scatter of new profiles ties rows together.
    tied: Vec<Tied>,
    /// Orthonormal whitened directions of a shared discrepancy with their variances.
    shared: Vec<(DVector<f64>, f64)>,
}

/// Rows that the scatter of new profiles ties together, with the factor of their covariance T and the diagonal of T⁻¹.
#[derive(Debug, Clone)]
struct Tied {
    rows: Vec<usize>,
    factor: Factor,
    precision: Vec<f64>,
}

impl Tied {
    fn new((rows, factor): Dense) -> Self {
        let mut inverse = Mat::<f64>::identity(rows.len(), rows.len());
        factor.solve_lower(inverse.as_mut());
        let square = |i| inverse.col_as_slice(i).iter().map(|x| x * x).sum();
        Self {
            precision: (0..rows.len()).map(square).collect(),
            rows,
            factor,
        }
    }
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
        let new_profile = NewProfile::of(&picked, model);
        let dense = |errors| dense_blocks(&picked, &sigma, &traces, errors, new_profile.as_ref());
        let blocks = if errors.is_empty() && new_profile.is_none() {
            traces.iter().cloned().map(Block::Trace).collect()
        } else {
            let blocks = dense(&errors).into_iter();
            blocks
                .map(|(rows, factor)| Block::Dense(rows, factor))
                .collect()
        };
        let tied = match new_profile {
            Some(_) => dense(&[]).into_iter().map(Tied::new).collect(),
            None => Vec::new(),
        };
        Self {
            sigma,
            blocks,
            traces,
            tied,
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

    /// What the most probable errors of the traces and of the new profiles make at each row when measured minus model is `residual`, and each
    /// trace's datum; a model error is not counted.
    ///
    /// ```text
    /// T = diag σ² + Σ_traces M Mᵀ + N:   a = Mᵀ T⁻¹ r,   var a = 1 − Mᵀ T⁻¹ M,   errors (M Mᵀ + N) T⁻¹ r = r − σ² T⁻¹ r
    /// ```
    /// A fifth of the rows' own scatter can go into N. So that what is left has the variance σ² all the same, each row's part of it is scaled to that:
    /// r − errors = σ (T⁻¹ r)_i/√(T⁻¹)_ii, the deviation from what all other rows predict.
    pub(in crate::learn) fn trace_errors(&self, residual: &[f64]) -> (Vec<f64>, Vec<Datum>) {
        if !self.tied.is_empty() {
            return self.tied_errors(residual);
        }
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

    fn tied_errors(&self, residual: &[f64]) -> (Vec<f64>, Vec<Datum>) {
        let mut weighed = vec![0.0; residual.len()];
        // T⁻¹M of every trace's constant, at the trace's own rows
        let mut constants = vec![0.0; residual.len()];
        let mut left = vec![0.0; residual.len()];
        for Tied {
            rows,
            factor,
            precision,
        } in &self.tied
        {
            let mut column = Mat::from_fn(rows.len(), 1, |i, _| residual[rows[i]]);
            factor.solve(column.as_mut());
            let values = rows.iter().zip(column.col_as_slice(0)).zip(precision);
            for ((&row, value), precision) in values {
                weighed[row] = *value;
                left[row] = self.sigma[row] * value / precision.sqrt();
            }
            let own = |errors: &&TraceErrors| rows.binary_search(&errors.rows[0]).is_ok();
            for errors in self.traces.iter().filter(own) {
                let mut constant = Mat::zeros(rows.len(), 1);
                for (row, size) in errors.rows.iter().zip(errors.functions.column(0).iter()) {
                    let at = rows.binary_search(row).expect("a trace lies in one block");
                    constant[(at, 0)] = *size;
                }
                factor.solve(constant.as_mut());
                for &row in &errors.rows {
                    let at = rows.binary_search(&row).expect("a trace lies in one block");
                    constants[row] = constant[(at, 0)];
                }
            }
        }
        let datum = |errors: &TraceErrors| {
            let tau = errors.functions[(0, 0)];
            let along = |v: &[f64]| -> f64 { errors.rows.iter().map(|&row| tau * v[row]).sum() };
            Datum {
                trace: errors.trace,
                value: tau * along(&weighed),
                sigma: tau * (1.0 - along(&constants)).max(0.0).sqrt(),
            }
        };
        let at_rows = residual.iter().zip(left).map(|(r, left)| r - left);
        (at_rows.collect(), self.traces.iter().map(datum).collect())
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Cholesky;

    use super::*;
    use crate::learn::noise::SigmaModel;
    use crate::measure::{Quantity, Subject};
    use crate::study::Scatter;

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
            tied: Vec::new(),
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

    /// Two tests, three checkpoints at the same radii, traces with a datum and rows without: against the covariance written out.
    #[test]
    fn the_scatter_of_a_new_profile_ties_checkpoints_together() {
        let (tau, own, datum) = (0.4, 0.3, 0.5);
        let mut observations = Vec::new();
        for test in 0..2 {
            for (checkpoint, cycles) in [1e5, 2e5, 3e5].into_iter().enumerate() {
                for place in 0..4 {
                    observations.push(Observation {
                        test,
                        member: Subject::Gear,
                        cycles,
                        quantity: Quantity::WearDepth,
                        position: Some(50.0 + 0.1 * f64::from(place)),
                        value: 1.0,
                        sigma: own,
                        trace: (test == 0).then_some(checkpoint),
                        line: 0,
                        face: None,
                        tooth: None,
                    });
                }
            }
        }
        let count = observations.len();
        let of = |i: usize| &observations[i];
        let exact = DMatrix::from_fn(count, count, |i, j| {
            let (a, b) = (of(i), of(j));
            let same = f64::from(u8::from(i == j));
            let profile = a.test == b.test && a.position == b.position;
            let trace = a.trace.is_some() && a.trace == b.trace;
            own * own * same
                + tau * tau * f64::from(u8::from(profile))
                + datum * datum * f64::from(u8::from(trace))
        });
        let data = Dataset {
            name: String::new(),
            tests: vec!["A".to_owned(), "B".to_owned()],
            observations: observations.clone(),
            traces: Vec::new(),
            reading: String::new(),
            outliers: Vec::new(),
            estimated_sigmas: 0,
        };
        let noise = NoiseModel {
            datum_um: datum,
            tilt_um: 0.0,
            shift_mm: 0.0,
            new_profile_um: tau,
            sigma: SigmaModel::AS_STATED,
            scatter: Scatter::Estimate,
            model_error: None,
        };
        let rows: Vec<usize> = (0..count).collect();
        let covariance = Covariance::new(&data, &rows, &noise);
        let factor = Cholesky::new(exact).unwrap();
        assert!((covariance.log_determinant() - factor.determinant().ln()).abs() < 1e-10);
        let residual = DVector::from_fn(count, |i, _| (1.7 * i as f64).sin());
        let square: f64 = (covariance.whiten(residual.as_slice()).iter())
            .map(|z| z * z)
            .sum();
        let inverse = factor.inverse();
        assert!((square - residual.dot(&(&inverse * &residual))).abs() < 1e-10);
        // what is left, and a trace's datum
        let (errors, datums) = covariance.trace_errors(residual.as_slice());
        let weighed = &inverse * &residual;
        for i in 0..count {
            let left = own * weighed[i] / inverse[(i, i)].sqrt();
            assert!((residual[i] - errors[i] - left).abs() < 1e-10);
        }
        let first = DVector::from_fn(count, |i, _| if i < 4 { datum } else { 0.0 });
        assert_eq!(datums.len(), 3);
        assert!((datums[0].value - datum * first.dot(&weighed)).abs() < 1e-10);
        let variance = 1.0 - first.dot(&(&inverse * &first));
        assert!((datums[0].sigma - datum * variance.sqrt()).abs() < 1e-10);
    }
}
