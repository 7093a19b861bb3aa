//! The measurements of the tests with one role: which rows, their covariance, and what is worked out on them alone.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use crate::learn::inference::quadratic::Normal;
use crate::learn::noise::{Covariance, NoiseModel};
use crate::learn::prediction::evaluate::Evaluator;
use crate::learn::prediction::predictor::Predictor;
use crate::measure::{Dataset, Observation};
use crate::study::Role;

/// The observations of the tests with one role.
#[derive(Clone)]
pub(in crate::learn) struct Selection<'a> {
    data: &'a Dataset,
    /// The tests, by their number in the data set.
    pub(in crate::learn) tests: Vec<usize>,
    /// Rows of each of them, counted within the selection.
    pub(in crate::learn) rows: Vec<Vec<usize>>,
    /// The rows, by their place in the data set.
    pub(in crate::learn) numbers: Vec<usize>,
    /// Measured values.
    pub(in crate::learn) values: Vec<f64>,
    /// Rows whose prediction grows with the wear coefficient.
    worn: Vec<bool>,
    /// What was measured of those, whitened.
    measured_wear: Vec<f64>,
    pub(in crate::learn) covariance: Covariance,
}

impl<'a> Selection<'a> {
    /// The tests with `role` that have measurements.
    pub(in crate::learn) fn new(
        data: &'a Dataset,
        roles: &[Role],
        role: Role,
        noise: &NoiseModel,
    ) -> Self {
        let with = |test: &usize| data.observations.iter().any(|o| o.test == *test);
        let tests: Vec<usize> = (0..roles.len())
            .filter(|t| roles[*t] == role && with(t))
            .collect();
        let numbers: Vec<usize> = (0..data.observations.len())
            .filter(|&row| tests.contains(&data.observations[row].test))
            .collect();
        let picked: Vec<&Observation> = numbers.iter().map(|&n| &data.observations[n]).collect();
        let rows_of = |&test: &usize| {
            let rows = 0..picked.len();
            rows.filter(|&i| picked[i].test == test).collect()
        };
        let is_wear = |o: &&Observation| o.quantity.is_wear();
        let mut selection = Self {
            rows: tests.iter().map(rows_of).collect(),
            values: picked.iter().map(|o| o.value).collect(),
            worn: picked.iter().map(is_wear).collect(),
            measured_wear: Vec::new(),
            covariance: Covariance::new(data, &numbers, noise),
            data,
            tests,
            numbers,
        };
        selection.measured_wear = selection.wear_of(&selection.values);
        selection
    }

    /// The same rows with another covariance.
    pub(in crate::learn) fn with_covariance(mut self, covariance: Covariance) -> Self {
        self.covariance = covariance;
        self.measured_wear = self.wear_of(&self.values);
        self
    }

    /// Number of observations.
    pub(in crate::learn) fn len(&self) -> usize {
        self.numbers.len()
    }

    /// An observation.
    pub(in crate::learn) fn observation(&self, row: usize) -> &Observation {
        &self.data.observations[self.numbers[row]]
    }

    /// The observations of all rows.
    pub(in crate::learn) fn observations(&self) -> Vec<&Observation> {
        (0..self.len()).map(|row| self.observation(row)).collect()
    }

    /// Measured minus `model`.
    pub(in crate::learn) fn residual(&self, model: &[f64]) -> Vec<f64> {
        self.values.iter().zip(model).map(|(y, f)| y - f).collect()
    }

    /// Values per test joined to rows.
    pub(in crate::learn) fn joined<V: AsRef<[f64]>>(&self, of_tests: &[V]) -> Vec<f64> {
        let mut joined = vec![0.0; self.len()];
        for (rows, values) in self.rows.iter().zip(of_tests) {
            for (&row, value) in rows.iter().zip(values.as_ref()) {
                joined[row] = *value;
            }
        }
        joined
    }

    /// χ² with the whole covariance.
    pub(in crate::learn) fn square(&self, model: &[f64]) -> f64 {
        let white = self.covariance.whiten(&self.residual(model));
        white.iter().map(|z| z * z).sum()
    }

    /// Whitened least squares about `model` with its derivatives, under `covariance`.
    pub(in crate::learn) fn normal(
        &self,
        model: &[f64],
        jacobian: &DMatrix<f64>,
        covariance: &Covariance,
    ) -> Normal {
        let residual = DVector::from_vec(covariance.whiten(&self.residual(model)));
        let white = covariance.whiten_all(jacobian);
        Normal {
            gram: white.tr_mul(&white),
            rhs: white.tr_mul(&residual),
            square: residual.norm_squared(),
        }
    }

    /// ½ ln of (2π)ⁿ times the determinant of `covariance`: what a likelihood is divided by.
    pub(in crate::learn) fn log_norm(&self, covariance: &Covariance) -> f64 {
        0.5 * (self.len() as f64 * (2.0 * PI).ln() + covariance.log_determinant())
    }

    /// Rows that are not wear.
    pub(in crate::learn) fn others(&self) -> usize {
        self.worn.iter().filter(|worn| !**worn).count()
    }

    /// χ² of the rows that are not wear.
    pub(in crate::learn) fn square_of_others(&self, model: &[f64]) -> f64 {
        let white = self.masked(&self.residual(model), false);
        white.iter().map(|z| z * z).sum()
    }

    /// Whitened row values, 0 for all rows that are wear or, if `worn`, for all that are not.
    fn masked(&self, values: &[f64], worn: bool) -> Vec<f64> {
        let each = values.iter().zip(&self.worn);
        let kept: Vec<f64> = each
            .map(|(v, &own)| if own == worn { *v } else { 0.0 })
            .collect();
        self.covariance.whiten(&kept)
    }

    fn wear_of(&self, values: &[f64]) -> Vec<f64> {
        self.masked(values, true)
    }

    /// The factor that brings all wear of the model nearest to what was measured; not finite where nothing is worn.
    pub(in crate::learn) fn wear_ratio(&self, model: &[f64]) -> f64 {
        let model = self.wear_of(model);
        let product: f64 = (model.iter().zip(&self.measured_wear))
            .map(|(f, y)| f * y)
            .sum();
        let square: f64 = model.iter().map(|f| f * f).sum();
        product / square
    }

    /// Model values with all wear multiplied by `factor`.
    pub(in crate::learn) fn scaled(&self, model: &[f64], factor: f64) -> Vec<f64> {
        let each = model.iter().zip(&self.worn);
        each.map(|(f, &worn)| if worn { factor * f } else { *f })
            .collect()
    }

    /// `predictor` asked about any test of the data set.
    pub(in crate::learn) fn evaluator<'e>(&'e self, predictor: &'e dyn Predictor) -> Evaluator<'e> {
        let data = self.data;
        let counts = data.tests.iter().enumerate().map(|(test, id)| {
            let rows = data.observations.iter().filter(|o| o.test == test).count();
            (id.as_str(), rows)
        });
        Evaluator::new(predictor, counts.collect())
    }
}
