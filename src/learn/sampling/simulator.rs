//! The measured rows as functions of a model's free parameters: for samplers and for tables of simulated histories.
//!
//! ```text
//! θ (free parameters, in their units), ln k_t/k of each test  ->  rows, derivatives of rows
//! ```
//! Every call wears new histories with the finest steps ([`Measured::finest_bench`]), so that an answer depends on its arguments alone: not
//! on the calls before it, not on how many run side by side. Derivatives are exact along the steps that a history takes; steps are
//! chosen anew at every point, which leaves values rough by some 1e-5 of the largest depth. Along the steps of one point
//! ([`Simulator::rows`], `along`) they are smooth.

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::parameters::Parameter;
use crate::learn::hypothesis::version::{ModelVersion, parameter};
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::gear_model::GearModel;
use crate::learn::prediction::predictor::{Linearised, Move, PredictError, Predictor};
use crate::study::{EffectModel, WEAR_COEFFICIENT};

/// A model whose free parameters are arguments.
pub struct Simulator<'a> {
    measured: &'a Measured<'a>,
    bench: &'a Bench<'a>,
    effects: &'a EffectModel,
    parameters: Vec<Parameter>,
    /// Place of the wear coefficient among them.
    coefficient: Option<usize>,
}

/// A point at which a model is asked.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Place {
    /// Values of the free parameters, in their order and units.
    pub theta: Vec<f64>,
    /// ln(k_t/k) by test of the study; none for tests that are not reached.
    pub deviations: Vec<f64>,
}

impl Place {
    /// With the same wear coefficient in all tests.
    pub fn common(theta: &[f64]) -> Self {
        Self {
            theta: theta.to_vec(),
            deviations: Vec::new(),
        }
    }
}

/// How far a law is asked along a derivative, in standard deviations of the prior.
const STEP: f64 = 1e-7;
/// The same for a difference where a history's derivatives follow no trend.
const DIFFERENCE: f64 = 0.02;

impl<'a> Simulator<'a> {
    /// A version of the study's model on a bench.
    pub fn new(
        measured: &'a Measured<'a>,
        bench: &'a Bench<'a>,
        version: &'a ModelVersion,
    ) -> Self {
        Self {
            measured,
            bench,
            effects: &version.effects,
            parameters: version.free.iter().map(parameter).collect(),
            coefficient: (version.free.iter()).position(|free| free.name == WEAR_COEFFICIENT),
        }
    }

    /// The free parameters.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The study with its measurements.
    pub fn measured(&self) -> &'a Measured<'a> {
        self.measured
    }

    /// Number of measured rows.
    pub fn len(&self) -> usize {
        self.measured.data.observations.len()
    }

    /// Whether nothing is measured.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The values that all rows should have, in the order of the measurement file and in their units; `along` the wear steps of the history
    /// at another place if one is given.
    ///
    /// # Errors
    /// [`PredictError`] if the model has no answer there.
    pub fn rows(&self, at: &Place, along: Option<&Place>) -> Result<Vec<f64>, PredictError> {
        let tests: Vec<usize> = (0..self.bench.tests.len()).collect();
        let of_tests = self.of_tests(&tests, at, along)?;
        let mut rows = vec![0.0; self.len()];
        for (test, values) in of_tests.iter().enumerate() {
            for (row, value) in self.rows_of(test).zip(values) {
                rows[row] = *value;
            }
        }
        Ok(rows)
    }

    /// The same with derivatives by the free parameters, per unit: a column each.
    ///
    /// # Errors
    /// As [`Simulator::rows`].
    pub fn rows_with_derivatives(
        &self,
        at: &Place,
    ) -> Result<(Vec<f64>, DMatrix<f64>), PredictError> {
        let tests: Vec<usize> = (0..self.bench.tests.len()).collect();
        let of_tests = self.derivatives_of_tests(&tests, at)?;
        let mut rows = vec![0.0; self.len()];
        let mut derivatives = DMatrix::zeros(self.len(), self.parameters.len());
        for (test, found) in of_tests.iter().enumerate() {
            for (i, row) in self.rows_of(test).enumerate() {
                rows[row] = found.values[i];
                for p in 0..self.parameters.len() {
                    derivatives[(row, p)] = found.derivatives[(i, self.column(p))]
                        / self.per_logarithm(p, at).unwrap_or(1.0);
                }
            }
        }
        Ok((rows, derivatives))
    }

    /// The value by which a derivative by a logarithm is divided; None for parameters that are differentiated themselves.
    pub(in crate::learn) fn per_logarithm(&self, parameter: usize, at: &Place) -> Option<f64> {
        (self.coefficient == Some(parameter)).then(|| at.theta[parameter])
    }

    /// The column of a parameter in what [`Simulator::derivatives_of_tests`] gives: effects' parameters first, then ln k.
    pub(in crate::learn) fn column(&self, parameter: usize) -> usize {
        match self.coefficient {
            Some(k) if k == parameter => self.parameters.len() - 1,
            Some(k) if k < parameter => parameter - 1,
            _ => parameter,
        }
    }

    /// Values of some tests.
    pub(in crate::learn) fn of_tests(
        &self,
        tests: &[usize],
        at: &Place,
        along: Option<&Place>,
    ) -> Result<Vec<Vec<f64>>, PredictError> {
        let model = self.model();
        (tests.par_iter())
            .map(|&test| {
                let (k, values) = self.arguments(test, at);
                match along {
                    None => model.predict(test, k, &values),
                    Some(other) => {
                        let (k_along, along) = self.arguments(test, other);
                        model.predict_along(test, (k_along, &along), (k, &values))
                    }
                }
            })
            .collect()
    }

    /// Values of some tests with their derivatives by the effects' parameters (per unit) and by the test's ln k.
    pub(in crate::learn) fn derivatives_of_tests(
        &self,
        tests: &[usize],
        at: &Place,
    ) -> Result<Vec<Linearised>, PredictError> {
        let model = self.model();
        (tests.par_iter())
            .map(|&test| {
                let (k, values) = self.arguments(test, at);
                let moves = self.moves(&values, STEP);
                match model.linearise(test, k, &values, &moves) {
                    Some(found) => found,
                    None => self.differences(&model, test, k, &values),
                }
            })
            .collect()
    }

    /// Central differences, for places where the derivatives of a history follow no trend.
    fn differences(
        &self,
        model: &GearModel<'_>,
        test: usize,
        k: f64,
        values: &[f64],
    ) -> Result<Linearised, PredictError> {
        let middle = model.predict(test, k, values)?;
        let mut derivatives = DMatrix::zeros(middle.len(), values.len() + 1);
        let moves = self.moves(values, DIFFERENCE);
        let bounds: Vec<_> = (self.effect_parameters())
            .map(|parameter| parameter.lower..=parameter.upper)
            .collect();
        for column in 0..=values.len() {
            let at = |sign: f64| match moves.get(column) {
                Some(a_move) => {
                    let mut moved = values.to_vec();
                    moved[column] += sign * a_move.step;
                    // a law says nothing beyond its bounds
                    (bounds[column].contains(&moved[column]))
                        .then(|| model.predict(test, k, &moved))
                }
                None => Some(model.predict(test, k * (sign * DIFFERENCE).exp(), values)),
            };
            let apart = moves.get(column).map_or(DIFFERENCE, |a_move| a_move.step);
            // to one side only where the model has no answer on the other
            let (low, high, apart) = match (at(-1.0), at(1.0)) {
                (Some(Ok(low)), Some(Ok(high))) => (low, high, 2.0 * apart),
                (_, Some(Ok(high))) => (middle.clone(), high, apart),
                (Some(Ok(low)), _) => (low, middle.clone(), apart),
                (Some(Err(error)), _) | (_, Some(Err(error))) => return Err(error),
                // narrower than a step
                (None, None) => (middle.clone(), middle.clone(), apart),
            };
            for (row, (low, high)) in low.iter().zip(&high).enumerate() {
                derivatives[(row, column)] = (high - low) / apart;
            }
        }
        Ok(Linearised {
            values: middle,
            derivatives,
        })
    }

    /// A small move of each of the effects' parameters, inside its bounds.
    fn moves(&self, values: &[f64], share: f64) -> Vec<Move> {
        let each = self.effect_parameters().zip(values).enumerate();
        each.map(|(place, (parameter, &value))| {
            let natural = parameter.natural_prior().scale();
            let size = if parameter.is_logarithmic() && value > 0.0 {
                natural * value
            } else {
                natural
            };
            let step = share * size;
            let step = if value + step <= parameter.upper {
                step
            } else {
                -step
            };
            let mut parameters = values.to_vec();
            parameters[place] += step;
            // what was added is what the sum holds
            let step = parameters[place] - value;
            Move { parameters, step }
        })
        .collect()
    }

    fn effect_parameters(&self) -> impl Iterator<Item = &Parameter> {
        let each = self.parameters.iter().enumerate();
        each.filter(|(i, _)| self.coefficient != Some(*i))
            .map(|(_, parameter)| parameter)
    }

    /// Wear coefficient of a test, mm²/N, and the values of the effects' parameters.
    fn arguments(&self, test: usize, at: &Place) -> (f64, Vec<f64>) {
        let k = match self.coefficient {
            Some(place) => at.theta[place],
            None => self.bench.tests[test].wear.0,
        };
        let deviation = at.deviations.get(test).copied().unwrap_or(0.0);
        let each = at.theta.iter().enumerate();
        let values = each.filter(|(i, _)| self.coefficient != Some(*i));
        (
            k * deviation.exp(),
            values.map(|(_, value)| *value).collect(),
        )
    }

    fn rows_of(&self, test: usize) -> impl Iterator<Item = usize> {
        let observations = self.measured.data.observations.iter().enumerate();
        observations
            .filter(move |(_, o)| o.test == test)
            .map(|(row, _)| row)
    }

    /// The model without any history yet.
    fn model(&self) -> GearModel<'_> {
        let names: Vec<&str> = self.effect_parameters().map(|p| p.name.as_str()).collect();
        GearModel::of_effects(self.bench, self.effects, names)
    }
}
