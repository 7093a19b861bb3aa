//! Solves with I − γτJ, the matrix of an implicit wear step.
//!
//! A place on a flank wears by the pressure there, which depends on the worn depth within the contact, on both flanks and on those of
//! the other pairs in mesh at the time. Where contacts are narrow against the tooth that is a small part of the matrix.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::prelude::ReborrowMut;
use faer::sparse::linalg::solvers::Lu;
use faer::sparse::{SparseColMat, Triplet};
use faer::{ColMut, Mat};

/// From so many unknowns on a sparse factor can be cheaper than a full one.
const LEAST_UNKNOWNS: usize = 500;

/// Share of entries other than zero up to which it is.
const MOST_FILLED: f64 = 0.25;

/// I − γτJ, factored.
pub(super) enum Shifted {
    Full(PartialPivLu<f64>),
    Sparse(Box<Lu<u32, f64>>),
}

impl Shifted {
    /// I − `factor` J. (J's eigenvalues lie in the left half plane, so it is never near singular.)
    pub(super) fn new(jacobian: &Mat<f64>, factor: f64) -> Self {
        Self::sparse(jacobian, factor).unwrap_or_else(|| {
            let n = jacobian.nrows();
            Self::Full(Mat::from_fn(n, n, |i, j| entry(jacobian, factor, i, j)).partial_piv_lu())
        })
    }

    /// A sparse factor where it pays and can be had.
    fn sparse(jacobian: &Mat<f64>, factor: f64) -> Option<Self> {
        let n = jacobian.nrows();
        let column = |j: usize| jacobian.col(j).iter().enumerate();
        let filled = |j: usize| column(j).filter(|(i, v)| **v != 0.0 || *i == j).count();
        let count: usize = (0..n).map(filled).sum();
        if n < LEAST_UNKNOWNS || count as f64 > MOST_FILLED * (n * n) as f64 {
            return None;
        }
        let mut entries = Vec::with_capacity(count);
        for j in 0..n {
            for (i, value) in column(j) {
                if *value != 0.0 || i == j {
                    let value = entry(jacobian, factor, i, j);
                    entries.push(Triplet::new(i as u32, j as u32, value));
                }
            }
        }
        let matrix = SparseColMat::try_new_from_triplets(n, n, &entries).ok()?;
        Some(Self::Sparse(Box::new(matrix.sp_lu().ok()?)))
    }

    /// Solves in place.
    pub(super) fn solve(&self, rhs: &mut [f64]) {
        let mut column = ColMut::from_slice_mut(rhs);
        match self {
            Self::Full(lu) => lu.solve_in_place(column.rb_mut()),
            Self::Sparse(lu) => lu.solve_in_place(column.rb_mut()),
        }
    }
}

fn entry(jacobian: &Mat<f64>, factor: f64, i: usize, j: usize) -> f64 {
    f64::from(u8::from(i == j)) - factor * jacobian[(i, j)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both factors against the product with a known solution, on a matrix like that of two narrow contacts that share a load.
    #[test]
    fn full_and_sparse_solve_alike() {
        let n = LEAST_UNKNOWNS;
        let half = n / 2;
        let jacobian = Mat::from_fn(n, n, |i, j| {
            let apart = (i % half).abs_diff(j % half);
            if apart > 6 {
                return 0.0;
            }
            let own = if i == j { -3.0 } else { 0.0 };
            own - ((7 * i + 13 * j) % 11) as f64 / (11.0 + apart as f64)
        });
        let known: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let factor = 0.3;
        let sparse = Shifted::new(&jacobian, factor);
        assert!(matches!(sparse, Shifted::Sparse(_)));
        let matrix = Mat::from_fn(n, n, |i, j| entry(&jacobian, factor, i, j));
        let full = Shifted::Full(matrix.partial_piv_lu());
        for factored in [full, sparse] {
            let mut x: Vec<f64> = (0..n)
                .map(|i| (0..n).map(|j| matrix[(i, j)] * known[j]).sum())
                .collect();
            factored.solve(&mut x);
            for (x, known) in x.iter().zip(&known) {
                assert!((x - known).abs() < 1e-9, "{x} for {known}");
            }
        }
    }

    /// J the second difference, whose eigenvectors are sines: I − f J stretches sin(k π (i + 1)/(n + 1)) by 1 + 4 f sin²(k π/(2 (n + 1))).
    #[test]
    fn second_differences_are_solved_as_their_sines_say() {
        for (n, sparse) in [(LEAST_UNKNOWNS - 1, false), (LEAST_UNKNOWNS, true)] {
            let jacobian = Mat::from_fn(n, n, |i, j| match i.abs_diff(j) {
                0 => -2.0,
                1 => 1.0,
                _ => 0.0,
            });
            let factor = 40.0;
            let shifted = Shifted::new(&jacobian, factor);
            assert_eq!(matches!(shifted, Shifted::Sparse(_)), sparse);
            for k in [1, 7, n / 2, n] {
                let angle = k as f64 * std::f64::consts::PI / (n as f64 + 1.0);
                let stretch = 1.0 + 4.0 * factor * (0.5 * angle).sin().powi(2);
                let sine: Vec<f64> = (1..=n).map(|i| (angle * i as f64).sin()).collect();
                let mut x = sine.clone();
                shifted.solve(&mut x);
                for (x, sine) in x.iter().zip(&sine) {
                    let expected = sine / stretch;
                    assert!((x - expected).abs() < 1e-13, "{x}, {expected}");
                }
            }
        }
    }

    /// A matrix as full as that of contacts as wide as the tooth is not taken for a sparse one.
    #[test]
    fn wide_contacts_are_factored_full() {
        let jacobian = Mat::from_fn(LEAST_UNKNOWNS, LEAST_UNKNOWNS, |i, j| {
            -1.0 / (1.0 + i.abs_diff(j) as f64)
        });
        assert!(matches!(Shifted::new(&jacobian, 1.0), Shifted::Full(_)));
    }
}
