//! How the pressures follow the gaps.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, LU};

use super::{Drive, Problem, UnilateralError};

/// Sensitivity of the pressures on the active set to their weighted gaps at fixed load:
/// dλ = −S dg with S = W⁻¹ − x (W⁻ᵀ b)ᵀ/(b·x), x = W⁻¹ a (at fixed approach S = W⁻¹). Rows and columns follow `active`.
///
/// # Errors
/// [`UnilateralError::Singular`] if the set's compliance cannot be inverted.
pub fn sensitivity(problem: &Problem, active: &[usize]) -> Result<DMatrix<f64>, UnilateralError> {
    let m = active.len();
    let singular = UnilateralError::Singular { active: m };
    let w = DMatrix::from_fn(m, m, |i, j| problem.w[(active[i], active[j])]);
    let arm = DVector::from_fn(m, |i, _| problem.arm[active[i]]);
    let mut s = if problem.symmetric {
        w.cholesky().ok_or(singular)?.inverse()
    } else {
        w.try_inverse().ok_or(singular)?
    };
    if matches!(problem.drive, Drive::Load(_)) {
        let x = &s * &arm;
        let lever = DVector::from_fn(m, |i, _| problem.lever[active[i]]);
        let left = s.tr_mul(&lever);
        let scale = 1.0 / lever.dot(&x);
        s.ger(-scale, &x, &left, 1.0);
    }
    Ok(s)
}

/// A contact problem under a given load, linearised on its active set and factored: any number of small changes then cost one
/// back-substitution each.
///
/// ```text
/// W x − a ψ = r,   b·x = s          dλ, dφ:  r = −dg − dW λ,  s = d(load) − db·λ          S v:  r = v,  s = 0
/// ```
#[derive(Debug, Clone)]
pub struct Linearised {
    factor: Factor,
    /// W⁻¹ a.
    of_arm: DVector<f64>,
    lever: DVector<f64>,
}

#[derive(Debug, Clone)]
enum Factor {
    Symmetric(Cholesky<f64, Dyn>),
    General(LU<f64, Dyn, Dyn>),
}

impl Factor {
    fn solve_mut(&self, right: &mut DVector<f64>) -> bool {
        match self {
            Factor::Symmetric(factor) => factor.solve_mut(right),
            Factor::General(factor) => return factor.solve_mut(right),
        }
        true
    }
}

impl Linearised {
    /// On `active`, the set of a solution.
    ///
    /// # Errors
    /// [`UnilateralError::Singular`] if the set's compliance cannot be inverted.
    pub fn new(problem: &Problem, active: &[usize]) -> Result<Self, UnilateralError> {
        let m = active.len();
        let singular = UnilateralError::Singular { active: m };
        let w = DMatrix::from_fn(m, m, |i, j| problem.w[(active[i], active[j])]);
        let factor = if problem.symmetric {
            Factor::Symmetric(w.cholesky().ok_or(singular.clone())?)
        } else {
            Factor::General(w.lu())
        };
        let mut of_arm = DVector::from_fn(m, |i, _| problem.arm[active[i]]);
        if !factor.solve_mut(&mut of_arm) {
            return Err(singular);
        }
        let lever = DVector::from_fn(m, |i, _| problem.lever[active[i]]);
        Ok(Self {
            factor,
            of_arm,
            lever,
        })
    }

    /// x and ψ with W x − a ψ = `right` and b·x = `load`.
    pub fn solve(&self, mut right: DVector<f64>, load: f64) -> (DVector<f64>, f64) {
        // the factor was found regular when it was made
        self.factor.solve_mut(&mut right);
        let psi = (load - self.lever.dot(&right)) / self.lever.dot(&self.of_arm);
        right.axpy(psi, &self.of_arm, 1.0);
        (right, psi)
    }
}
