//! What measurements carry beyond the model: independent noise, a constant datum per trace, a correlated error of the model.
//!
//! ```text
//! y = f + d_trace + m + e      e ~ N(0, diag σ²),  d ~ N(0, τ²) one per trace,  m ~ N(0, K) only if switched on
//! S = diag σ² + Σ_traces τ² 1 1ᵀ + K
//! ```
//! Datums are marginalised: with z = e/σ and the trace's u = 1/σ, q = |u|, the inverse root of `I + τ² u uᵀ` is
//! `I − (1 − 1/√(1 + τ² q²)) û ûᵀ` (Sherman, Morrison and Woodbury), so whitening costs one pass. With K, rows of one test,
//! member and quantity make one dense block with its Cholesky factor.

use std::collections::BTreeMap;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::measure::{Dataset, Observation, Quantity};
use crate::study;

/// The noise model's settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseModel {
    /// Prior standard deviation of a wear trace's datum, µm. Datums of other quantities' traces get a broad prior: the
    /// largest magnitude measured in the trace, at least ten of its largest sigmas.
    pub datum_um: f64,
    /// Factor on the stated σ.
    pub sigma_factor: f64,
    /// Scatter of the wear coefficient between tests.
    pub scatter: study::Scatter,
    /// Error of the model itself, correlated along a trace and over cycles.
    pub model_error: Option<ModelError>,
}

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

impl NoiseModel {
    /// A study's `[noise]`, without a model error.
    pub fn of(noise: &study::Noise) -> Self {
        Self {
            datum_um: noise.datum_um,
            sigma_factor: 1.0,
            scatter: noise.coefficient_scatter,
            model_error: None,
        }
    }
}

/// The most probable datum of a trace, in the unit of its quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Datum {
    /// Its place in [`Dataset::traces`].
    pub trace: usize,
    /// Value: measured = model + datum + noise.
    pub value: f64,
    /// Posterior standard deviation at given parameters.
    pub sigma: f64,
}

/// A smooth discrepancy of unknown cause, integrated out with the noise.
#[derive(Debug, Clone)]
pub(super) enum Discrepancy {
    /// Of each curve's own, with its amplitude at every row.
    EachCurve(Vec<f64>, ModelError),
    /// A sum of functions of the rows (the columns), each in its prior standard deviation: common to all tests.
    Shared(DMatrix<f64>),
}

/// The covariance of some of a data set's rows.
#[derive(Debug, Clone)]
pub(super) struct Covariance {
    sigma: Vec<f64>,
    blocks: Vec<Block>,
    traces: Vec<TraceRows>,
    /// Orthonormal whitened directions of a shared discrepancy with their variances.
    shared: Vec<(DVector<f64>, f64)>,
}

#[derive(Debug, Clone)]
struct TraceRows {
    trace: usize,
    rows: Vec<usize>,
    tau: f64,
}

#[derive(Debug, Clone)]
enum Block {
    Datum(TraceRows),
    Dense(Vec<usize>, Box<Cholesky<f64, Dyn>>),
}

impl Covariance {
    /// Of the observations `rows` of a data set; rows are counted from 0 in that list from here on.
    pub(super) fn new(data: &Dataset, rows: &[usize], model: &NoiseModel) -> Self {
        Self::with_errors(data, rows, model, &[])
    }

    /// With further correlated errors, each with its amplitude at every row.
    pub(super) fn with_errors(
        data: &Dataset,
        rows: &[usize],
        model: &NoiseModel,
        further: &[(&[f64], ModelError)],
    ) -> Self {
        let picked: Vec<&Observation> = rows.iter().map(|&row| &data.observations[row]).collect();
        let sigma: Vec<f64> = (picked.iter())
            .map(|o| model.sigma_factor * o.sigma)
            .collect();
        let traces = || trace_rows(&picked, model.datum_um);
        let mut errors: Vec<(Vec<f64>, ModelError)> = Vec::new();
        if let Some(error) = model.model_error {
            errors.push((amplitudes(&picked), error));
        }
        errors.extend(further.iter().map(|(size, error)| (size.to_vec(), *error)));
        let blocks = if errors.is_empty() {
            traces().into_iter().map(Block::Datum).collect()
        } else {
            dense_blocks(&picked, &sigma, &traces(), &errors)
        };
        Self {
            sigma,
            blocks,
            traces: traces(),
            shared: Vec::new(),
        }
    }

    /// With functions common to all rows, one a column, each in its prior standard deviation.
    ///
    /// ```text
    /// X = W Φ = U s Vᵀ:   (I + X Xᵀ)^(−½) = I − U (1 − 1/√(1 + s²)) Uᵀ
    /// ```
    pub(super) fn with_shared(mut self, functions: &DMatrix<f64>) -> Self {
        let columns: Vec<DVector<f64>> = (functions.column_iter())
            .map(|column| DVector::from_vec(self.whiten(column.as_slice())))
            .collect();
        if columns.is_empty() {
            return self;
        }
        let x = DMatrix::from_columns(&columns);
        let eigen = x.tr_mul(&x).symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        for (variance, vector) in eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter())
        {
            if *variance > 1e-12 * largest && *variance > 1e-12 {
                self.shared
                    .push(((&x * vector) / variance.sqrt(), *variance));
            }
        }
        self
    }

    /// W v, where WᵀW is the inverse of the covariance.
    pub(super) fn whiten(&self, v: &[f64]) -> Vec<f64> {
        let z = self.whiten_blocks(v);
        if self.shared.is_empty() {
            return z;
        }
        let mut z = DVector::from_vec(z);
        let along: Vec<f64> = self.shared.iter().map(|(u, _)| u.dot(&z)).collect();
        for ((u, variance), along) in self.shared.iter().zip(along) {
            z.axpy(-(1.0 - (1.0 + variance).sqrt().recip()) * along, u, 1.0);
        }
        z.as_slice().to_vec()
    }

    /// The same without a shared discrepancy.
    fn whiten_blocks(&self, v: &[f64]) -> Vec<f64> {
        let mut z: Vec<f64> = v.iter().zip(&self.sigma).map(|(v, s)| v / s).collect();
        for block in &self.blocks {
            match block {
                Block::Datum(TraceRows { rows, tau, .. }) => {
                    let q2: f64 = rows.iter().map(|&i| self.sigma[i].powi(-2)).sum();
                    let along: f64 = rows.iter().map(|&i| z[i] / self.sigma[i]).sum();
                    let change = (1.0 - (1.0 + tau * tau * q2).sqrt().recip()) * along / q2;
                    for &i in rows {
                        z[i] -= change / self.sigma[i];
                    }
                }
                // a derivative with respect to one test's k is zero in the blocks of all others
                Block::Dense(rows, _) if rows.iter().all(|&i| v[i] == 0.0) => {}
                Block::Dense(rows, factor) => {
                    let mut part = DVector::from_iterator(rows.len(), rows.iter().map(|&i| v[i]));
                    factor.l_dirty().solve_lower_triangular_mut(&mut part);
                    for (&i, part) in rows.iter().zip(part.iter()) {
                        z[i] = *part;
                    }
                }
            }
        }
        z
    }

    /// Logarithm of the covariance's determinant.
    pub(super) fn log_determinant(&self) -> f64 {
        let mut dense = vec![false; self.sigma.len()];
        let mut sum = 0.0;
        for block in &self.blocks {
            match block {
                Block::Datum(TraceRows { rows, tau, .. }) => {
                    let q2: f64 = rows.iter().map(|&i| self.sigma[i].powi(-2)).sum();
                    sum += (tau * tau * q2).ln_1p();
                }
                Block::Dense(rows, factor) => {
                    rows.iter().for_each(|&i| dense[i] = true);
                    sum += 2.0 * factor.l_dirty().diagonal().map(f64::ln).sum();
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

    /// Each trace's most probable datum when measured minus model is `residual`; a model error is not counted.
    ///
    /// ```text
    /// d = τ² Σ r/σ² / (1 + τ² Σ 1/σ²)      sd = τ/√(1 + τ² Σ 1/σ²)
    /// ```
    pub(super) fn datums(&self, residual: &[f64]) -> Vec<Datum> {
        let of = |TraceRows { trace, rows, tau }: &TraceRows| {
            let weight = |i: usize| self.sigma[i].powi(-2);
            let sum: f64 = rows.iter().map(|&i| weight(i)).sum();
            let residual: f64 = rows.iter().map(|&i| residual[i] * weight(i)).sum();
            let shrink = 1.0 + tau * tau * sum;
            Datum {
                trace: *trace,
                value: tau * tau * residual / shrink,
                sigma: tau / shrink.sqrt(),
            }
        };
        self.traces.iter().map(of).collect()
    }
}

/// The rows of each trace and its datum's prior standard deviation.
fn trace_rows(picked: &[&Observation], datum_um: f64) -> Vec<TraceRows> {
    let mut traces: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (i, observation) in picked.iter().enumerate() {
        if let Some(trace) = observation.trace {
            traces.entry(trace).or_default().push(i);
        }
    }
    let of = |(trace, rows): (usize, Vec<usize>)| {
        let tau = if picked[rows[0]].quantity == Quantity::WearDepth {
            datum_um
        } else {
            let largest =
                |f: fn(&Observation) -> f64| rows.iter().map(|&i| f(picked[i])).fold(0.0, f64::max);
            largest(|o| o.value.abs()).max(10.0 * largest(|o| o.sigma))
        };
        TraceRows { trace, rows, tau }
    };
    traces.into_iter().map(of).collect()
}

/// One block per test, member and quantity; traces that reach over several tie them together.
fn dense_blocks(
    picked: &[&Observation],
    sigma: &[f64],
    traces: &[TraceRows],
    errors: &[(Vec<f64>, ModelError)],
) -> Vec<Block> {
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
                if o.trace.is_some() && o.trace == p.trace {
                    let tau = traces.iter().find(|t| Some(t.trace) == o.trace);
                    matrix[(a, b)] += tau.map_or(0.0, |t| t.tau * t.tau);
                }
            }
            matrix[(a, a)] += sigma[i].powi(2);
        }
        Block::Dense(rows, Box::new(factor(matrix)))
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
pub(super) fn amplitudes(picked: &[&Observation]) -> Vec<f64> {
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

    /// Against the dense covariance σ² + τ² 1 1ᵀ (per trace) + Φ Φᵀ: the square of the whitened rows and the determinant.
    #[test]
    fn functions_common_to_all_rows_join_the_covariance() {
        let sigma: Vec<f64> = (0..12).map(|i| 0.3 + 0.05 * f64::from(i)).collect();
        let traces: Vec<TraceRows> = [(0, 0..5), (1, 5..9)]
            .map(|(trace, rows)| TraceRows {
                trace,
                rows: rows.collect(),
                tau: 0.7,
            })
            .into();
        let plain = Covariance {
            blocks: traces.iter().cloned().map(Block::Datum).collect(),
            sigma: sigma.clone(),
            traces: traces.clone(),
            shared: Vec::new(),
        };
        let functions = DMatrix::from_fn(12, 3, |i, j| (0.4 * (i * (j + 1)) as f64).cos());
        let mut dense = DMatrix::from_diagonal(&DVector::from_vec(sigma).map(|s| s * s));
        for trace in &traces {
            for &i in &trace.rows {
                for &j in &trace.rows {
                    dense[(i, j)] += trace.tau * trace.tau;
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
