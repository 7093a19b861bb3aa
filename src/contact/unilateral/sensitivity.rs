//! How the pressures follow the gaps.

use nalgebra::{DMatrix, DVector};

use super::factor::Factor;
use super::{Drive, Problem, UnilateralError};

/// Sensitivity of the pressures on the active set to their weighted gaps at fixed load:
/// dλ = −S dg with S = W⁻¹ − x (W⁻ᵀ b)ᵀ/(b·x), x = W⁻¹ a (at fixed approach S = W⁻¹). Rows and columns follow `active`.
///
/// # Errors
/// [`UnilateralError::Singular`] if the set's compliance cannot be inverted.
pub fn sensitivity(problem: &Problem, active: &[usize]) -> Result<DMatrix<f64>, UnilateralError> {
    let m = active.len();
    let arm = DVector::from_fn(m, |i, _| problem.arm[active[i]]);
    let mut s = Factor::of_any(problem, active)?.inverse(m);
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
pub struct Linearised {
    factor: Factor,
    /// W⁻¹ a.
    of_arm: DVector<f64>,
    lever: DVector<f64>,
}

impl Linearised {
    /// On `active`, the set of a solution.
    ///
    /// # Errors
    /// [`UnilateralError::Singular`] if the set's compliance cannot be inverted.
    pub fn new(problem: &Problem, active: &[usize]) -> Result<Self, UnilateralError> {
        let m = active.len();
        let factor = Factor::of_any(problem, active)?;
        let mut of_arm = DMatrix::from_fn(m, 1, |i, _| problem.arm[active[i]]);
        factor.solve(&mut of_arm);
        let lever = DVector::from_fn(m, |i, _| problem.lever[active[i]]);
        Ok(Self {
            factor,
            of_arm: of_arm.column(0).into_owned(),
            lever,
        })
    }

    /// x and ψ with W x − a ψ = `right` and b·x = `load`.
    pub fn solve(&self, right: DVector<f64>, load: f64) -> (DVector<f64>, f64) {
        let mut columns = DMatrix::from_column_slice(right.len(), 1, right.as_slice());
        self.factor.solve(&mut columns);
        let mut x = columns.column(0).into_owned();
        let psi = (load - self.lever.dot(&x)) / self.lever.dot(&self.of_arm);
        x.axpy(psi, &self.of_arm, 1.0);
        (x, psi)
    }
}
