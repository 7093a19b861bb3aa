//! Cholesky's factor of a symmetric positive definite matrix: A = L Lᵀ.
//!
//! By blocks of columns and on one thread, so that its bits do not depend on what runs beside it.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::prelude::ReborrowMut;
use faer::{Mat, MatMut, Par};

/// L of A = L Lᵀ.
#[derive(Debug, Clone)]
pub struct Factor(Mat<f64>);

impl Factor {
    /// Of the matrix whose lower half is that of `matrix`; None if it is not positive definite.
    pub fn new(mut matrix: Mat<f64>) -> Option<Self> {
        let size = matrix.nrows();
        let scratch = cholesky_in_place_scratch::<f64>(size, Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        cholesky_in_place(
            matrix.as_mut(),
            Default::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        )
        .ok()?;
        let finite = (0..size).all(|i| matrix[(i, i)].is_finite());
        finite.then_some(Self(matrix))
    }

    /// L⁻¹ of every column, in place.
    pub fn solve_lower(&self, columns: MatMut<'_, f64>) {
        solve_lower_triangular_in_place(self.0.as_ref(), columns, Par::Seq);
    }

    /// A⁻¹ of every column, in place.
    pub fn solve(&self, mut columns: MatMut<'_, f64>) {
        self.solve_lower(columns.rb_mut());
        solve_upper_triangular_in_place(self.0.as_ref().transpose(), columns, Par::Seq);
    }

    /// ln det A.
    pub fn log_determinant(&self) -> f64 {
        let diagonal = (0..self.0.nrows()).map(|i| self.0[(i, i)].ln());
        2.0 * diagonal.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Second differences between fixed ends: det A = n + 1, and A x = 1 for x_i = (i + 1)(n − i)/2.
    #[test]
    fn second_differences_have_their_determinant_and_solution() {
        for n in [1, 2, 7, 40, 193] {
            let matrix = Mat::from_fn(n, n, |i, j| match i.abs_diff(j) {
                0 => 2.0,
                1 => -1.0,
                _ => 0.0,
            });
            let factor = Factor::new(matrix).unwrap();
            let determinant = factor.log_determinant().exp();
            assert!((determinant / (n as f64 + 1.0) - 1.0).abs() < 1e-11);
            // 1ᵀA⁻¹1 = Σ x_i = n (n + 1)(n + 2)/12; the second column is twice the first
            let mut ones = Mat::from_fn(n, 2, |_, j| 1.0 + j as f64);
            factor.solve_lower(ones.as_mut());
            let square = |j| (0..n).map(|i| ones[(i, j)].powi(2)).sum::<f64>();
            let exact = (n * (n + 1) * (n + 2)) as f64 / 12.0;
            assert!((square(0) / exact - 1.0).abs() < 1e-11);
            assert!((square(1) / exact - 4.0).abs() < 1e-11);
            let mut solution = Mat::from_fn(n, 1, |_, _| 1.0);
            factor.solve(solution.as_mut());
            for i in 0..n {
                let exact = ((i + 1) * (n - i)) as f64 / 2.0;
                assert!((solution[(i, 0)] / exact - 1.0).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn what_is_not_positive_definite_has_no_factor() {
        let indefinite = Mat::from_fn(2, 2, |i, j| if i == j { 1.0 } else { 2.0 });
        assert!(Factor::new(indefinite).is_none());
        assert!(Factor::new(Mat::from_fn(1, 1, |_, _| f64::NAN)).is_none());
    }
}
