//! A model as a fit sees it: parameters in, predictions at the measured places out.

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
