//! How well a test tells two candidates apart once what is free has been refitted.
//!
//! ```text
//! D = vᵀ (S + O Oᵀ + C Cᵀ)⁻¹ v      v = f_a − f_b
//! S: noise, model error among it;  O: what is refitted in each test for itself (its k);  C: what all tests share
//! ```
//! Columns are scaled by standard deviations. Over several tests vᵀv, Cᵀv and CᵀC, each freed of O, are sums, so a set of tests
//! costs no more than its members (Sherman, Morrison and Woodbury).

use nalgebra::{DMatrix, DVector};

use crate::learn::candidates::candidate_model::model;
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::noise::{Covariance, ModelError, NoiseModel, SigmaModel};
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::predictor::{PredictError, Predictor};
use crate::measure::{Dataset, Quantity};
use crate::study::Study;

/// Least scatter of k assumed of a new test.
pub(in crate::learn) const LEAST_SCATTER: f64 = 0.05;
/// Step in ln k of the derivatives of what is no depth.
const STEP: f64 = 0.05;

/// What a candidate says of a test that has not been made, and how that moves.
pub(in crate::learn) struct PlannedResponse {
    /// Values of the rows.
    pub(in crate::learn) values: Vec<f64>,
    /// Derivatives by ln k.
    pub(in crate::learn) by_k: Vec<f64>,
    /// Derivatives by each parameter on its natural scale.
    by_parameter: DMatrix<f64>,
}

impl PlannedResponse {
    /// Of the only test of a bench.
    pub(in crate::learn) fn of(
        bench: &Bench<'_>,
        candidate: &Candidate,
        state: &State,
    ) -> Result<Self, PredictError> {
        let predictor = model(bench, candidate);
        let parameters = &candidate.parameters;
        let values = |theta: &[f64]| -> Vec<f64> {
            let both = parameters.iter().zip(theta);
            both.map(|(p, &x)| p.value(x)).collect()
        };
        let own = values(&state.theta);
        let at = predictor.predict(0, state.log_k.exp(), &own)?;
        let rows = &bench.tests[0].observations;
        let worn = Quantity::is_wear;
        // Worn depths are nearly proportional to k.
        let by_k = if rows.iter().all(|o| worn(o.quantity)) {
            at.clone()
        } else {
            let moved = predictor.predict(0, (state.log_k + STEP).exp(), &own)?;
            let rows = rows.iter().zip(&moved).zip(&at);
            rows.map(|((o, moved), at)| {
                if worn(o.quantity) {
                    *at
                } else {
                    (moved - at) / STEP
                }
            })
            .collect()
        };
        let mut by_parameter = DMatrix::zeros(at.len(), parameters.len());
        for (p, parameter) in parameters.iter().enumerate() {
            let step = parameter.difference(state.theta[p]);
            let mut theta = state.theta.clone();
            theta[p] += step;
            let moved = predictor.predict(0, state.log_k.exp(), &values(&theta))?;
            for (i, (moved, at)) in moved.iter().zip(&at).enumerate() {
                by_parameter[(i, p)] = (moved - at) / parameter.divisor(step);
            }
        }
        Ok(Self {
            values: at,
            by_k,
            by_parameter,
        })
    }

    /// Columns of what refitting can move in all tests: the parameters with their posterior covariance.
    pub(in crate::learn) fn posterior(&self, judged: &FittedCandidate) -> Vec<Vec<f64>> {
        let count = judged.candidate.parameters.len();
        let mut columns = Vec::new();
        if count > 0 {
            let first = judged.covariance.nrows() - count;
            let own = judged.covariance.view((first, first), (count, count));
            let eigen = own.into_owned().symmetric_eigen();
            columns.extend((0..count).map(|i| {
                let scale = eigen.eigenvalues[i].max(0.0).sqrt();
                let column: DVector<f64> = &self.by_parameter * eigen.eigenvectors.column(i);
                column.iter().map(|c| c * scale).collect()
            }));
        }
        columns
    }

    /// The column of what it can move in this test alone: k with its scatter.
    pub(in crate::learn) fn scatter(&self, judged: &FittedCandidate) -> Vec<f64> {
        let scatter = judged.found.scatter.max(LEAST_SCATTER);
        self.by_k.iter().map(|f| f * scatter).collect()
    }

    /// The same from the parameters' priors, without k.
    pub(in crate::learn) fn prior(&self, candidate: &Candidate) -> Vec<Vec<f64>> {
        let columns = self.by_parameter.column_iter().zip(&candidate.parameters);
        columns
            .map(|(column, parameter)| {
                let scale = parameter.natural_prior().scale();
                column.iter().map(|c| c * scale).collect()
            })
            .collect()
    }
}

/// Some rows of a test with their noise: puts columns over all rows into units of it.
pub(in crate::learn) struct Whitening {
    rows: Vec<usize>,
    covariance: Covariance,
}

impl Whitening {
    pub(in crate::learn) fn new(data: &Dataset, rows: Vec<usize>, noise: &NoiseModel) -> Self {
        let covariance = Covariance::new(data, &rows, noise);
        Self { rows, covariance }
    }

    pub(in crate::learn) fn white(&self, column: &[f64]) -> DVector<f64> {
        let own: Vec<f64> = self.rows.iter().map(|&row| column[row]).collect();
        DVector::from_vec(self.covariance.whiten(&own))
    }
}

/// What one or several tests say of a difference: the products of the difference and of the columns common to tests.
#[derive(Debug, Clone)]
pub(in crate::learn) struct Discrimination(DMatrix<f64>);

impl Discrimination {
    /// One test's; all columns in units of its noise.
    pub(in crate::learn) fn new(
        difference: &DVector<f64>,
        common: &[DVector<f64>],
        own: &[DVector<f64>],
    ) -> Self {
        let all: Vec<DVector<f64>> = std::iter::once(difference).chain(common).cloned().collect();
        let all = DMatrix::from_columns(&all);
        let products = all.tr_mul(&all);
        if own.is_empty() {
            return Self(products);
        }
        let own = DMatrix::from_columns(own);
        let inner = DMatrix::identity(own.ncols(), own.ncols()) + own.tr_mul(&own);
        let along = own.tr_mul(&all);
        match inner.cholesky() {
            Some(factor) => Self(products - along.tr_mul(&factor.solve(&along))),
            None => Self(DMatrix::zeros(all.ncols(), all.ncols())),
        }
    }

    /// Together with another test.
    pub(in crate::learn) fn and(&self, other: &Self) -> Self {
        Self(&self.0 + &other.0)
    }

    /// Expected difference of χ² after refitting.
    pub(in crate::learn) fn chi2(&self) -> f64 {
        let count = self.0.nrows() - 1;
        let square = self.0[(0, 0)];
        let along = self.0.view((1, 0), (count, 1)).into_owned();
        let inner = DMatrix::identity(count, count) + self.0.view((1, 1), (count, count));
        let absorbed = inner
            .cholesky()
            .map_or(square, |factor| along.dot(&factor.solve(&along)));
        (square - absorbed).max(0.0)
    }
}

/// The noise of a test to be made, with this σ of its rows: it will be judged by finite elements.
pub(in crate::learn) fn noise_ahead(study: &Study, sigma: SigmaModel) -> NoiseModel {
    NoiseModel {
        sigma,
        model_error: Some(ModelError::default()),
        ..NoiseModel::of(&study.noise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(values: &[f64]) -> DVector<f64> {
        DVector::from_column_slice(values)
    }

    /// vᵀ(I + Σ c cᵀ)⁻¹v by the full inverse.
    fn direct(v: &DVector<f64>, columns: &[DVector<f64>]) -> f64 {
        let mut s = DMatrix::identity(v.len(), v.len());
        columns.iter().for_each(|c| s += c * c.transpose());
        v.dot(&(s.try_inverse().unwrap() * v))
    }

    #[test]
    fn two_tests_give_the_inverse_of_their_joint_covariance() {
        let (v1, v2) = (vector(&[1.0, 2.0, -0.5]), vector(&[0.3, -1.0]));
        let (c1, c2) = (vector(&[0.4, 1.0, 2.0]), vector(&[1.5, 0.2]));
        let (o1, o2) = (vector(&[1.0, 1.0, 0.7]), vector(&[0.1, 3.0]));
        let one = Discrimination::new(&v1, std::slice::from_ref(&c1), std::slice::from_ref(&o1));
        let two = Discrimination::new(&v2, std::slice::from_ref(&c2), std::slice::from_ref(&o2));
        let join = |a: &[f64], b: &[f64]| vector(&[a, b].concat());
        let columns = [
            join(c1.as_slice(), c2.as_slice()),
            join(o1.as_slice(), &[0.0; 2]),
            join(&[0.0; 3], o2.as_slice()),
        ];
        let wanted = direct(&join(v1.as_slice(), v2.as_slice()), &columns);
        assert!((one.and(&two).chi2() - wanted).abs() < 1e-12);
        assert!((one.chi2() - direct(&v1, &[c1, o1])).abs() < 1e-12);
    }

    #[test]
    fn what_can_be_refitted_tells_nothing() {
        let v = vector(&[1.0, 2.0, 3.0]);
        let discrimination = Discrimination::new(&v, &[&v * 1e4], &[]);
        assert!(discrimination.chi2() < 1e-6);
        assert!((Discrimination::new(&v, &[], &[]).chi2() - 14.0).abs() < 1e-12);
    }
}
