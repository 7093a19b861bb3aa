//! Floor 8: verification cases run with the product's own code against closed forms and published values.
//!
//! Each function runs one family of cases and returns what it measured beside its target and tolerance; `Measured::passed`
//! is the verdict. Small cases are also tests; the large ones run in the validation only.

pub mod elasticity;
pub mod sliding;
pub mod wear_half_plane;
pub mod wear_punch;
pub mod wear_steps;
pub mod wear_tolerance;
pub mod wear_winkler;

use crate::contact::unilateral::UnilateralError;
use crate::wear::integrator::StepError;

/// One verified quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Case, as in the list of benchmarks (for instance `F4`).
    pub id: &'static str,
    /// What was measured, with its conditions.
    pub quantity: String,
    /// The product's value.
    pub value: f64,
    /// What it should be (0 where only a bound is asked for).
    pub target: f64,
    /// Deviation in the sense of the tolerance: relative unless the quantity says otherwise.
    pub error: f64,
    /// Largest error allowed.
    pub tolerance: f64,
}

impl Measured {
    /// A value whose deviation relative to `target` counts.
    pub fn relative(
        id: &'static str,
        quantity: impl Into<String>,
        value: f64,
        target: f64,
        tolerance: f64,
    ) -> Self {
        Self {
            id,
            quantity: quantity.into(),
            value,
            target,
            error: (value / target - 1.0).abs(),
            tolerance,
        }
    }

    /// A value whose absolute deviation from `target` counts.
    pub fn absolute(
        id: &'static str,
        quantity: impl Into<String>,
        value: f64,
        target: f64,
        tolerance: f64,
    ) -> Self {
        Self {
            id,
            quantity: quantity.into(),
            value,
            target,
            error: (value - target).abs(),
            tolerance,
        }
    }

    /// A magnitude that must stay below `tolerance`.
    pub fn bound(
        id: &'static str,
        quantity: impl Into<String>,
        value: f64,
        tolerance: f64,
    ) -> Self {
        Self::absolute(id, quantity, value, 0.0, tolerance)
    }

    /// True if the error is a number within the tolerance.
    pub fn passed(&self) -> bool {
        self.error <= self.tolerance
    }
}

impl std::fmt::Display for Measured {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let verdict = if self.passed() { "ok" } else { "FAILS" };
        write!(
            f,
            "{} {}: {:.8} (target {:.8}, error {:.2e}, allowed {:.1e}) {verdict}",
            self.id, self.quantity, self.value, self.target, self.error, self.tolerance
        )
    }
}

/// Why a case could not be run to its end.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CaseError {
    /// A contact problem had no solution.
    #[error(transparent)]
    Contact(#[from] UnilateralError),
    /// A wear history stopped.
    #[error(transparent)]
    Wear(#[from] StepError<UnilateralError>),
}
