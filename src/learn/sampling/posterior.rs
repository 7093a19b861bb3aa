//! The probability model of a fit as a density that samplers can ask: likelihood of the fit tests, priors, gradients of both.
//!
//! ```text
//! y = f(k_t, θ) + datums + noise      k_t = k exp(σ_k w_t),  w_t ~ N(0, 1),  σ_k half-normal(0.25) or stated
//! ```
//! Datums, tilts and shifts of traces are integrated out in closed form, as in a fit. The scatter of k between tests is not: a fit integrates
//! it by a parabola, here σ_k and the w_t are arguments of their own, so that the density is exact.

use std::f64::consts::PI;

use crate::learn::hypothesis::parameters::Parameter;
use crate::learn::inference::scatter::SCATTER_SD;
use crate::learn::inference::selection::Selection;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::predictor::PredictError;
use crate::learn::sampling::simulator::{Place, Simulator};
use crate::study::{Role, Scatter};

/// In which coordinates the free parameters are stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// In their units.
    Physical,
    /// 0: the study's value; 1: one standard deviation of the prior away, on the parameter's natural scale (the logarithm for log-normal priors).
    Standardised,
}

/// A logarithm of a density, and its derivatives by both blocks of arguments.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    /// Natural logarithm; minus infinity where the density is 0.
    pub log: f64,
    /// Derivatives by the free parameters in their coordinates.
    pub by_parameters: Vec<f64>,
    /// Derivatives by the arguments of the scatter.
    pub by_scatter: Vec<f64>,
}

/// What samplers ask.
pub struct Posterior<'a> {
    simulator: &'a Simulator<'a>,
    selection: Selection<'a>,
    scatter: Scatter,
}

impl Parameter {
    /// The value in its unit, between its bounds, and its derivative by the coordinate; 0 beyond the bounds.
    pub fn physical(&self, coordinate: f64, scale: Scale) -> (f64, f64) {
        let prior = self.natural_prior();
        match scale {
            Scale::Physical => {
                let inside = (self.lower..=self.upper).contains(&coordinate);
                let value = coordinate.clamp(self.lower, self.upper);
                (value, f64::from(u8::from(inside)))
            }
            Scale::Standardised => {
                let natural = self.natural_start(self.start) + coordinate * prior.scale();
                let inside = (prior.lower..=prior.upper).contains(&natural);
                let value = if coordinate == 0.0 {
                    // the study's value to the bit
                    self.start.clamp(self.lower, self.upper)
                } else {
                    self.value(natural.clamp(prior.lower, prior.upper))
                };
                let slope = if self.is_logarithmic() { value } else { 1.0 };
                (value, if inside { slope * prior.scale() } else { 0.0 })
            }
        }
    }

    /// Logarithm of the prior's density per unit of the coordinate, and its derivative.
    fn log_prior(&self, coordinate: f64, scale: Scale) -> (f64, f64) {
        let prior = self.natural_prior();
        let nothing = (f64::NEG_INFINITY, 0.0);
        match scale {
            Scale::Physical => {
                let inside = (self.lower..=self.upper).contains(&coordinate);
                let natural = self.natural(coordinate);
                if !inside || !(prior.lower..=prior.upper).contains(&natural) {
                    return nothing;
                }
                let log = prior.log_density(natural);
                let slope = -prior.precision * (natural - prior.mean);
                if self.is_logarithmic() {
                    (log - coordinate.ln(), (slope - 1.0) / coordinate)
                } else {
                    (log, slope)
                }
            }
            Scale::Standardised => {
                let natural = self.natural_start(self.start) + coordinate * prior.scale();
                if !(prior.lower..=prior.upper).contains(&natural) {
                    return nothing;
                }
                let slope = -prior.precision * (natural - prior.mean);
                let log = prior.log_density(natural) + prior.scale().ln();
                (log, slope * prior.scale())
            }
        }
    }
}

impl<'a> Posterior<'a> {
    /// Of the tests with the role `fit`, under the study's `[noise]`.
    pub fn new(simulator: &'a Simulator<'a>) -> Self {
        let measured = simulator.measured();
        let noise = NoiseModel::of(&measured.study().noise);
        Self {
            selection: Selection::new(&measured.data, &measured.roles, Role::Fit, &noise),
            scatter: noise.scatter,
            simulator,
        }
    }

    /// The names of the arguments of the scatter of k between tests: `noise.coefficient_scatter` if it is to be estimated, then the
    /// deviation of each fit test in units of it; none where the study excludes scatter.
    pub fn scatter_names(&self) -> Vec<String> {
        let of_test = |test: &usize| {
            let id = &self.simulator.measured().study().tests[*test].id;
            format!("deviation of test {id}")
        };
        let tests = self.selection.tests.iter().map(of_test);
        match self.scatter {
            Scatter::Relative(0.0) => Vec::new(),
            Scatter::Relative(_) => tests.collect(),
            Scatter::Estimate => std::iter::once("noise.coefficient_scatter".to_owned())
                .chain(tests)
                .collect(),
        }
    }

    /// σ_k and the w_t among the arguments.
    fn parts<'s>(&self, scatter: &'s [f64]) -> (f64, &'s [f64]) {
        match self.scatter {
            Scatter::Relative(size) => (size, scatter),
            Scatter::Estimate => (scatter[0], &scatter[1..]),
        }
    }

    /// The place in the model, and the derivatives of its parameters by their coordinates.
    fn place(&self, parameters: &[f64], scale: Scale, scatter: &[f64]) -> (Place, Vec<f64>) {
        let each = self.simulator.parameters().iter().zip(parameters);
        let (theta, slopes) = each.map(|(p, &x)| p.physical(x, scale)).unzip();
        let mut deviations = vec![0.0; self.simulator.measured().tests().len()];
        let (size, each) = self.parts_or_none(scatter);
        for (&test, w) in self.selection.tests.iter().zip(each) {
            deviations[test] = size * w;
        }
        (Place { theta, deviations }, slopes)
    }

    fn parts_or_none<'s>(&self, scatter: &'s [f64]) -> (f64, &'s [f64]) {
        if scatter.is_empty() {
            (0.0, &[])
        } else {
            self.parts(scatter)
        }
    }

    /// The logarithm of the likelihood, along the wear steps of another place if one is given (both blocks of its arguments).
    ///
    /// # Errors
    /// [`PredictError`] if the model has no answer there.
    pub fn log_likelihood(
        &self,
        (parameters, scatter): (&[f64], &[f64]),
        scale: Scale,
        along: Option<(&[f64], &[f64])>,
    ) -> Result<f64, PredictError> {
        let (at, _) = self.place(parameters, scale, scatter);
        let along = along.map(|(parameters, scatter)| self.place(parameters, scale, scatter).0);
        let values = self
            .simulator
            .of_tests(&self.selection.tests, &at, along.as_ref())?;
        let square = self.selection.square(&self.selection.joined(&values));
        Ok(-0.5 * square - self.selection.log_norm(&self.selection.covariance))
    }

    /// The same with its derivatives.
    ///
    /// # Errors
    /// As [`Posterior::log_likelihood`].
    pub fn likelihood(
        &self,
        (parameters, scatter): (&[f64], &[f64]),
        scale: Scale,
    ) -> Result<Density, PredictError> {
        let (at, slopes) = self.place(parameters, scale, scatter);
        let tests = &self.selection.tests;
        let found = self.simulator.derivatives_of_tests(tests, &at)?;
        let values: Vec<&[f64]> = found.iter().map(|f| f.values.as_slice()).collect();
        let model = self.selection.joined(&values);
        let covariance = &self.selection.covariance;
        // the derivative of −|W r|²/2 by each row
        let white = covariance.whiten(&self.selection.residual(&model));
        let mut by_column = vec![vec![0.0; parameters.len() + 1]; tests.len()];
        for ((sums, found), rows) in by_column.iter_mut().zip(&found).zip(&self.selection.rows) {
            for (column, sum) in sums.iter_mut().enumerate().take(found.derivatives.ncols()) {
                let mut rows_moved = vec![0.0; model.len()];
                for (i, &row) in rows.iter().enumerate() {
                    rows_moved[row] = found.derivatives[(i, column)];
                }
                let moved = covariance.whiten(&rows_moved);
                *sum = white.iter().zip(&moved).map(|(r, j)| r * j).sum();
            }
        }
        let by_k = |test: usize| by_column[test][found[test].derivatives.ncols() - 1];
        let by_parameters = (slopes.iter().enumerate()).map(|(p, slope)| {
            let column = self.simulator.column(p);
            let sum: f64 = by_column.iter().map(|sums| sums[column]).sum();
            // outside the bounds nothing moves
            match (*slope, self.simulator.per_logarithm(p, &at)) {
                (0.0, _) => 0.0,
                (slope, Some(value)) => sum * slope / value,
                (slope, None) => sum * slope,
            }
        });
        let by_parameters = by_parameters.collect();
        let (size, deviations) = self.parts_or_none(scatter);
        let mut by_scatter = Vec::with_capacity(scatter.len());
        if self.scatter == Scatter::Estimate && !scatter.is_empty() {
            let each = deviations.iter().enumerate();
            by_scatter.push(each.map(|(test, w)| w * by_k(test)).sum());
        }
        by_scatter.extend((0..deviations.len()).map(|test| size * by_k(test)));
        Ok(Density {
            log: -0.5 * white.iter().map(|z| z * z).sum::<f64>()
                - self.selection.log_norm(covariance),
            by_parameters,
            by_scatter,
        })
    }

    /// The prior's density per unit of the arguments.
    pub fn prior(&self, (parameters, scatter): (&[f64], &[f64]), scale: Scale) -> Density {
        let each = self.simulator.parameters().iter().zip(parameters);
        let (logs, by_parameters): (Vec<f64>, Vec<f64>) =
            each.map(|(p, &x)| p.log_prior(x, scale)).unzip();
        let mut log: f64 = logs.iter().sum();
        let mut by_scatter = Vec::with_capacity(scatter.len());
        let (_, deviations) = self.parts_or_none(scatter);
        if self.scatter == Scatter::Estimate && !scatter.is_empty() {
            let size = scatter[0];
            let z = size / SCATTER_SD;
            log += if size < 0.0 {
                f64::NEG_INFINITY
            } else {
                (2.0 / (SCATTER_SD * (2.0 * PI).sqrt())).ln() - 0.5 * z * z
            };
            by_scatter.push(-z / SCATTER_SD);
        }
        for w in deviations {
            log -= 0.5 * (w * w + (2.0 * PI).ln());
            by_scatter.push(-w);
        }
        Density {
            log,
            by_parameters,
            by_scatter,
        }
    }
}
