//! Floor 8: verification cases as plain functions; each returns what was measured beside its target and tolerance.

pub mod elasticity;

/// One measured figure of a verification case.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Case.
    pub id: &'static str,
    /// What was measured, with its unit.
    pub quantity: String,
    /// The program's value.
    pub value: f64,
    /// The reference value.
    pub target: f64,
    /// Distance from the target, by the measure of the case (relative unless the quantity says otherwise).
    pub error: f64,
    /// Largest accepted error.
    pub tolerance: f64,
}

impl Measured {
    /// A value judged by its relative distance from the target.
    pub fn relative(
        id: &'static str,
        quantity: impl Into<String>,
        value: f64,
        target: f64,
        tolerance: f64,
    ) -> Self {
        let error = (value / target - 1.0).abs();
        Measured {
            id,
            quantity: quantity.into(),
            value,
            target,
            error,
            tolerance,
        }
    }

    /// A value that should be zero (a defect or an error norm).
    pub fn defect(
        id: &'static str,
        quantity: impl Into<String>,
        value: f64,
        tolerance: f64,
    ) -> Self {
        Measured {
            id,
            quantity: quantity.into(),
            value,
            target: 0.0,
            error: value.abs(),
            tolerance,
        }
    }

    /// A value that must reach the target; only falling short counts as error.
    pub fn at_least(
        id: &'static str,
        quantity: impl Into<String>,
        value: f64,
        target: f64,
        tolerance: f64,
    ) -> Self {
        let error = if value.is_nan() {
            f64::NAN
        } else {
            (target - value).max(0.0)
        };
        Measured {
            id,
            quantity: quantity.into(),
            value,
            target,
            error,
            tolerance,
        }
    }

    /// A value that must not exceed the target; only what goes beyond counts as error.
    pub fn at_most(
        id: &'static str,
        quantity: impl Into<String>,
        value: f64,
        target: f64,
        tolerance: f64,
    ) -> Self {
        let error = if value.is_nan() {
            f64::NAN
        } else {
            (value - target).max(0.0)
        };
        Measured {
            id,
            quantity: quantity.into(),
            value,
            target,
            error,
            tolerance,
        }
    }

    /// Whether the error is within the tolerance; never for NaN.
    pub fn passes(&self) -> bool {
        self.error <= self.tolerance
    }
}
