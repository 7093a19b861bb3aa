//! How the pressures follow the gaps.

use nalgebra::{DMatrix, DVector};

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
