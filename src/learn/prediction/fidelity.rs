//! Three fidelities of the forward model: the analytic one screens, coarse finite elements fit, fine ones decide.

use serde::{Deserialize, Serialize};

use crate::learn::noise::ModelError;
use crate::learn::prediction::bench::for_looks;
use crate::simulate::numerics::Numerics;

/// By which model candidates are compared at last, or one of them was fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Fidelity {
    /// The analytic contact model alone.
    #[serde(rename = "hertz")]
    Screening,
    /// The base model by fine finite elements, what effects change about it by coarse ones.
    #[serde(rename = "coarse_fem")]
    Middle,
    /// Fine finite elements.
    #[serde(rename = "fem")]
    Full,
}

/// Relative error of the analytic model where it decides: its curves differ from finite elements by 1 to 2 % for the reference pair.
const HERTZ_ERROR: f64 = 0.02;

/// Resolution of the coarse finite elements: flank edges per half width, positions, error of a wear step.
const MIDDLE_EDGES: f64 = 2.5;
const MIDDLE_POSITIONS: usize = 50;
const MIDDLE_STEP: f64 = 5e-3;

/// Step tolerance of the fine ones: they compare candidates where these stand and need no smooth derivatives.
const FULL_STEP: f64 = 4e-3;

impl Fidelity {
    /// As it stands in the result file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Screening => "hertz",
            Self::Middle => "coarse_fem",
            Self::Full => "fem",
        }
    }

    /// The model error that belongs to it.
    pub(in crate::learn) fn model_error(self) -> ModelError {
        let plain = ModelError::default();
        ModelError {
            relative: match self {
                Self::Screening => HERTZ_ERROR,
                Self::Middle | Self::Full => plain.relative,
            },
            ..plain
        }
    }

    /// Its resolution where a study asks for `fine`.
    pub(in crate::learn) fn resolution(self, fine: Numerics) -> Numerics {
        match self {
            Self::Screening => for_looks(fine),
            // coarse enough for thousands of histories
            Self::Middle => Numerics {
                elements_per_half_width: MIDDLE_EDGES,
                positions: MIDDLE_POSITIONS,
                step_tolerance: MIDDLE_STEP,
                condense_after: f64::INFINITY,
                ..fine
            },
            Self::Full => Numerics {
                step_tolerance: fine.step_tolerance.max(FULL_STEP),
                ..fine
            },
        }
    }
}
