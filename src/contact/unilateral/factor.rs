//! Solves with the compliance of the points in contact, also where some of them stand for the same place.

use nalgebra::{Cholesky, DMatrix, Dyn, LU};

use super::{Problem, UnilateralError};

/// A pivot below this share of its point's own compliance is rounding: the point depends on those before it.
const LEAST_PIVOT: f64 = 1e-13;

/// Share of its own compliance that each point is given besides where points depend on one another: those that stand for one
/// place then share its pressure evenly, and the gaps change by no more than this share of what the pressure closes.
const RIDGE: f64 = 1e-10;

/// The compliance of a set of points, factored.
pub(super) enum Factor {
    Symmetric(Cholesky<f64, Dyn>),
    General(LU<f64, Dyn, Dyn>),
}

impl Factor {
    /// The compliance of the points `active` of `problem`.
    pub(super) fn of(problem: &Problem, active: &[usize]) -> Result<Self, UnilateralError> {
        let m = active.len();
        Self::regular(part(problem.w, active), problem.symmetric)
            .ok_or(UnilateralError::Singular { active: m })
    }

    /// The same, of points that may depend on one another.
    pub(super) fn of_any(problem: &Problem, active: &[usize]) -> Result<Self, UnilateralError> {
        Self::of(problem, active).or_else(|error| {
            Self::regular(ridged(&part(problem.w, active)), problem.symmetric).ok_or(error)
        })
    }

    fn regular(w: DMatrix<f64>, symmetric: bool) -> Option<Self> {
        let own = w.diagonal();
        if symmetric {
            let factor = w.cholesky()?;
            let l = factor.l_dirty();
            let sound = |i: usize| l[(i, i)] * l[(i, i)] >= LEAST_PIVOT * own[i];
            (0..own.len()).all(sound).then_some(Self::Symmetric(factor))
        } else {
            let factor = w.lu();
            let u = factor.u();
            let least = LEAST_PIVOT * own.iter().fold(f64::INFINITY, |m, w| m.min(*w));
            let sound = |i: usize| u[(i, i)].abs() >= least;
            (0..own.len()).all(sound).then_some(Self::General(factor))
        }
    }

    /// W⁻¹ times the columns of `right`, in place.
    pub(super) fn solve(&self, right: &mut DMatrix<f64>) {
        match self {
            Self::Symmetric(factor) => factor.solve_mut(right),
            Self::General(factor) => {
                let solvable = factor.solve_mut(right);
                debug_assert!(solvable, "pivots were looked at");
            }
        }
    }

    /// W⁻¹.
    pub(super) fn inverse(&self, m: usize) -> DMatrix<f64> {
        match self {
            Self::Symmetric(factor) => factor.inverse(),
            Self::General(_) => {
                let mut inverse = DMatrix::identity(m, m);
                self.solve(&mut inverse);
                inverse
            }
        }
    }
}

fn part(w: &DMatrix<f64>, of: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(of.len(), of.len(), |i, j| w[(of[i], of[j])])
}

/// `w` with a little more of its diagonal.
pub(super) fn ridged(w: &DMatrix<f64>) -> DMatrix<f64> {
    let mut ridged = w.clone();
    for k in 0..w.nrows() {
        ridged[(k, k)] *= 1.0 + RIDGE;
    }
    ridged
}
