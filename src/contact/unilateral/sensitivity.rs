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
