//! What measurements carry beyond the model: independent noise, what a measuring machine does to a trace, a correlated error of the model.
//!
//! ```text
//! y = f + M a + m + e      e ~ N(0, diag σ²),  a ~ N(0, 1) some per trace,  m ~ N(0, K) only if switched on
//! S = diag σ² + Σ_traces M Mᵀ + N + K
//! ```
//! M: a constant (datum), a tilt and a shift of the radii, each in its prior standard deviation ([`trace`]); N: the scatter of the new profile,
//! which all checkpoints of a flank share ([`new_profile`]). All are marginalised.

mod covariance;
mod model_error;
mod new_profile;
mod sigma_model;
mod trace;

use nalgebra::DMatrix;

use crate::study;

pub(super) use covariance::Covariance;
pub use model_error::ModelError;
pub(super) use model_error::amplitudes;
pub use sigma_model::SigmaModel;
pub use trace::Datum;

/// The noise model's settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseModel {
    /// Prior standard deviation of a wear trace's datum, µm. Datums of other quantities' traces get a broad prior: the
    /// largest magnitude measured in the trace, at least ten of its largest sigmas.
    pub datum_um: f64,
    /// Prior standard deviation of a wear trace's tilt from end to end, µm.
    pub tilt_um: f64,
    /// Prior standard deviation of the shift of a wear trace's radii, mm.
    pub shift_mm: f64,
    /// Standard deviation of the scatter of the new profile that all depths of a flank were taken from, µm.
    pub new_profile_um: f64,
    /// Which σ the rows get.
    pub sigma: SigmaModel,
    /// Scatter of the wear coefficient between tests.
    pub scatter: study::Scatter,
    /// Error of the model itself, correlated along a trace and over cycles.
    pub model_error: Option<ModelError>,
}

impl NoiseModel {
    /// A study's `[noise]`, without a model error.
    pub fn of(noise: &study::Noise) -> Self {
        Self {
            datum_um: noise.datum_um,
            tilt_um: noise.tilt_um,
            shift_mm: noise.shift_mm,
            new_profile_um: noise.new_profile_um,
            sigma: SigmaModel::AS_STATED,
            scatter: noise.coefficient_scatter,
            model_error: None,
        }
    }
}

/// A smooth discrepancy of unknown cause, integrated out with the noise.
#[derive(Debug, Clone)]
pub(super) enum Discrepancy {
    /// Of each curve's own, with its amplitude at every row.
    EachCurve(Vec<f64>, ModelError),
    /// A sum of functions of the rows (the columns), each in its prior standard deviation: common to all tests.
    Shared(DMatrix<f64>),
}
