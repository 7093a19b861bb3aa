//! What a measuring machine does to a whole trace.
//!
//! ```text
//! M a = a₁ τ + a₂ t s + a₃ x dh/dr        a ~ N(0, 1)
//! ```
//! τ: datum; t: tilt from end to end, s from −½ to ½ over the trace's range; x: shift of the radii, by which a profile is registered on the
//! machine, to first order by the slope of the measured profile itself ([`crate::measure::neighbours`]). A slope of the data, not of a
//! model: so that all models are judged with the same covariance.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::NoiseModel;
use crate::measure::neighbours::slopes;
use crate::measure::{Observation, Quantity};

/// The most probable datum of a trace, in the unit of its quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Datum {
    /// Its place in [`crate::measure::Dataset::traces`].
    pub trace: usize,
    /// Value: measured = model + datum + noise.
    pub value: f64,
    /// Posterior standard deviation at given parameters.
    pub sigma: f64,
}

/// The errors that the rows of one trace share.
#[derive(Debug, Clone)]
pub(super) struct TraceErrors {
    pub(super) trace: usize,
    pub(super) rows: Vec<usize>,
    /// M: one column each, in its prior standard deviation; the constant first.
    pub(super) functions: DMatrix<f64>,
    /// 1/σ of the rows.
    weights: DVector<f64>,
    /// Columns of U with s², of X = M/σ.
    directions: Vec<(DVector<f64>, f64)>,
}

impl TraceErrors {
    /// Of rows with these standard deviations.
    pub(super) fn new(
        trace: usize,
        rows: Vec<usize>,
        functions: DMatrix<f64>,
        sigma: &[f64],
    ) -> Self {
        let weights = DVector::from_iterator(rows.len(), rows.iter().map(|&i| sigma[i].recip()));
        let mut x = functions.clone();
        x.column_iter_mut()
            .for_each(|mut column| column.component_mul_assign(&weights));
        Self {
            directions: directions(&x),
            trace,
            rows,
            functions,
            weights,
        }
    }

    /// Turns the rows of `z`, values over σ, into whitened ones.
    pub(super) fn whiten(&self, z: &mut [f64]) {
        for (u, square) in &self.directions {
            let along: f64 = (self.rows.iter().zip(u.iter()))
                .map(|(&i, u)| u * z[i])
                .sum();
            let change = (1.0 - (1.0 + square).sqrt().recip()) * along;
            for (&i, u) in self.rows.iter().zip(u.iter()) {
                z[i] -= change * u;
            }
        }
    }

    /// What the errors add to the logarithm of the covariance's determinant.
    pub(super) fn log_determinant(&self) -> f64 {
        self.directions
            .iter()
            .map(|(_, square)| square.ln_1p())
            .sum()
    }

    /// The most probable errors when measured minus model is `residual`: at each of the rows, and the constant alone.
    ///
    /// ```text
    /// a = (1 + XᵀX)⁻¹ Xᵀ r/σ      cov a = (1 + XᵀX)⁻¹
    /// ```
    pub(super) fn most_probable(&self, residual: &[f64]) -> (DVector<f64>, Datum) {
        let mut x = self.functions.clone();
        x.column_iter_mut()
            .for_each(|mut column| column.component_mul_assign(&self.weights));
        let own = self.rows.iter().map(|&i| residual[i]);
        let r = DVector::from_iterator(self.rows.len(), own).component_mul(&self.weights);
        let columns = x.ncols();
        let precision = x.tr_mul(&x) + DMatrix::identity(columns, columns);
        let covariance = (precision.cholesky())
            .expect("one plus a Gram matrix is positive definite")
            .inverse();
        let a = &covariance * x.tr_mul(&r);
        let tau = self.functions[(0, 0)];
        let datum = Datum {
            trace: self.trace,
            value: a[0] * tau,
            sigma: covariance[(0, 0)].sqrt() * tau,
        };
        (&self.functions * a, datum)
    }
}

/// The left singular vectors of X that are not rounding, with the squares of their singular values.
pub(super) fn directions(x: &DMatrix<f64>) -> Vec<(DVector<f64>, f64)> {
    let SymmetricEigen {
        eigenvalues,
        eigenvectors,
    } = x.tr_mul(x).symmetric_eigen();
    let largest = eigenvalues.max();
    (eigenvalues.iter().zip(eigenvectors.column_iter()))
        .filter(|(square, _)| **square > 1e-12 * largest && **square > 1e-12)
        .map(|(square, vector)| ((x * vector) / square.sqrt(), *square))
        .collect()
}

/// The errors of each trace among these rows, of which these are the standard deviations.
pub(super) fn trace_errors(
    picked: &[&Observation],
    sigma: &[f64],
    model: &NoiseModel,
) -> Vec<TraceErrors> {
    let mut traces: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (i, observation) in picked.iter().enumerate() {
        if let Some(trace) = observation.trace {
            traces.entry(trace).or_default().push(i);
        }
    }
    let slope = if model.shift_mm > 0.0 {
        slopes(picked)
    } else {
        Vec::new()
    };
    let of = |(trace, rows): (usize, Vec<usize>)| {
        let own: Vec<&Observation> = rows.iter().map(|&i| picked[i]).collect();
        let is_wear = own[0].quantity == Quantity::WearDepth;
        let mut columns = vec![DVector::from_element(rows.len(), datum(&own, model))];
        if is_wear && model.tilt_um > 0.0 {
            columns.push(DVector::from_vec(from_end_to_end(&own)) * model.tilt_um);
        }
        if is_wear && model.shift_mm > 0.0 {
            let slope = rows.iter().map(|&i| slope[i] * model.shift_mm);
            columns.push(DVector::from_iterator(rows.len(), slope));
        }
        TraceErrors::new(trace, rows, DMatrix::from_columns(&columns), sigma)
    };
    traces.into_iter().map(of).collect()
}

/// Prior standard deviation of the constant: of wear as stated, of other quantities broad, the largest magnitude measured in the trace, at
/// least ten of its largest σ.
fn datum(own: &[&Observation], model: &NoiseModel) -> f64 {
    if own[0].quantity == Quantity::WearDepth {
        return model.datum_um;
    }
    let largest = |f: fn(&Observation) -> f64| own.iter().map(|o| f(o)).fold(0.0, f64::max);
    largest(|o| o.value.abs()).max(10.0 * largest(|o| o.sigma))
}

/// Positions from −½ to ½ over their range, 0 where there is none.
pub(in crate::learn) fn from_end_to_end(own: &[&Observation]) -> Vec<f64> {
    let place = |o: &&Observation| o.position.unwrap_or(0.0);
    let low = own.iter().map(place).fold(f64::INFINITY, f64::min);
    let high = own.iter().map(place).fold(f64::NEG_INFINITY, f64::max);
    let width = high - low;
    let share = |o: &&Observation| {
        if width > 0.0 {
            (place(o) - low) / width - 0.5
        } else {
            0.0
        }
    };
    own.iter().map(share).collect()
}
