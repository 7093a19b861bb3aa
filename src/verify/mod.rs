//! Floor 8: verification cases run with the product's own code against closed forms and published values.
//!
//! Each function runs one family of cases and returns what it measured beside its target and tolerance; `Measured::passed`
//! is the verdict. Small cases are also tests; the large ones run in the validation only.

pub mod calculix;
pub mod challenge;
pub mod contact_and_wear;
pub mod convergence;
pub mod elasticity;
pub mod face_slices;
pub mod flat_punch;
pub mod gear_condensation;
pub mod gear_contact;
pub mod gear_geometry;
pub mod gear_pairs;
pub mod gear_root;
pub mod gear_sharing;
pub mod gear_stiffness;
pub mod gear_wear;
pub mod gears;
pub mod half_bodies;
pub mod helical;
pub mod hertz_cylinders;
pub mod invariance;
pub mod nafems_cylinder;
pub mod paper_rows;
pub mod partial_slip;
pub mod patch;
pub mod questions;
pub mod registry;
pub mod runner;
pub mod sliding;
pub mod teeth_in_turn;
pub mod two_bodies;
pub mod wear_block;
pub mod wear_half_plane;
pub mod wear_punch;
pub mod wear_steps;
pub mod wear_tolerance;
pub mod wear_winkler;
pub mod worn_corner;

use crate::contact::unilateral::{Solution, UnilateralError};
use crate::fem::FemError;
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

/// B8: iterations and penetration of a solved contact, `id` with its conditions `at`.
pub(crate) fn discipline(id: &'static str, at: &str, solution: &Solution) -> [Measured; 2] {
    [
        Measured::bound(
            id,
            format!("{at}: B8 contact iterations"),
            solution.iterations as f64,
            25.0,
        ),
        Measured::bound(
            id,
            format!("{at}: B8 penetration over approach"),
            solution.penetration,
            1e-6,
        ),
    ]
}

/// A case of the benchmark list that is not run, and why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Skipped {
    /// Case.
    pub id: &'static str,
    /// What is left out.
    pub what: &'static str,
    /// The reason.
    pub reason: &'static str,
}

/// Contact and wear cases that are not run.
pub const SKIPPED: &[Skipped] = &[
    Skipped {
        id: "B3",
        what: "cylinder on block with friction 0.1",
        reason: "the contact knows full slip in a given direction only; under a normal load most of this contact sticks",
    },
    Skipped {
        id: "B3",
        what: "settlement against Code_Aster's -1.308 mm",
        reason: "computed with large displacements there; the small-strain value is checked by a second mesh instead",
    },
    Skipped {
        id: "B4",
        what: "loaded pin in a sheet",
        reason: "conforming contact: its normal turns by 180°, the flank contact has one normal",
    },
];

/// Why a case could not be run to its end.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CaseError {
    /// A contact problem had no solution.
    #[error(transparent)]
    Contact(#[from] UnilateralError),
    /// A wear history stopped.
    #[error(transparent)]
    Wear(#[from] StepError<UnilateralError>),
    /// The elastic solver refused a mesh, a support or a load.
    #[error(transparent)]
    Elasticity(#[from] FemError),
    /// A gear pair could not be built or its contact not solved.
    #[error("gears: {reason}")]
    Gears {
        /// What the gear, mesh or contact code said.
        reason: String,
    },
    /// The displacements of a rigid body were asked for.
    #[error("body {side} is rigid")]
    Rigid {
        /// 0 or 1.
        side: usize,
    },
}

impl CaseError {
    /// A case that failed in the gear, mesh or contact code.
    pub(crate) fn gears(error: impl std::fmt::Display) -> Self {
        Self::Gears {
            reason: error.to_string(),
        }
    }
}
