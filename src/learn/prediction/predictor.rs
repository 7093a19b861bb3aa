//! A model as a fit sees it: parameters in, predictions at the measured places out.

use nalgebra::DMatrix;

/// A model with some parameters free.
pub trait Predictor: Sync {
    /// Predicted values of the observations of test number `test`, in the order in which they stand in the data set and in
    /// the unit of their quantity.
    ///
    /// `coefficient` is that test's wear coefficient, mm²/N; `parameters` are the values of the model's free effect
    /// parameters, in the model's order and their own units.
    ///
    /// # Errors
    /// [`PredictError`] if the model has no answer there: a contact that cannot be solved, a formula without a value.
    fn predict(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, PredictError>;

    /// Whether [`Predictor::linearise`] costs less than differences: a fit then takes derivatives from there.
    fn has_derivatives(&self) -> bool {
        false
    }

    /// The same with derivatives, along each of `moves` and with respect to ln k. None: the model has none of its own there, and whoever
    /// needs them takes differences.
    fn linearise(
        &self,
        _test: usize,
        _coefficient: f64,
        _parameters: &[f64],
        _moves: &[Move],
    ) -> Option<Result<Linearised, PredictError>> {
        None
    }
}

/// A small move of one parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Move {
    /// The values of all parameters after it.
    pub parameters: Vec<f64>,
    /// Its length, in the unit in which the derivative is wanted.
    pub step: f64,
}

/// Predictions with their derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearised {
    /// As [`Predictor::predict`] gives them, to the bit.
    pub values: Vec<f64>,
    /// Rows as the values; a column for each move, then one for ln k.
    pub derivatives: DMatrix<f64>,
}

impl<P: Predictor + ?Sized> Predictor for &P {
    fn predict(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, PredictError> {
        (**self).predict(test, coefficient, parameters)
    }

    fn has_derivatives(&self) -> bool {
        (**self).has_derivatives()
    }

    fn linearise(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
        moves: &[Move],
    ) -> Option<Result<Linearised, PredictError>> {
        (**self).linearise(test, coefficient, parameters, moves)
    }
}

/// Why a model has no answer at some parameters.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("test {test}: {reason}")]
pub struct PredictError {
    /// Id of the test.
    pub test: String,
    /// What failed.
    pub reason: String,
}
