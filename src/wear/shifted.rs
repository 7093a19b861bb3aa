//! Solves with I − γτJ, the matrix of an implicit wear step.
//!
//! A place on a flank wears by the pressure there, which depends on the worn depth within the contact, on both flanks and on those of
//! the other pairs in mesh at the time. Where contacts are narrow against the tooth that is a small part of the matrix.

use std::sync::Arc;

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::prelude::ReborrowMut;
use faer::sparse::linalg::solvers::Lu;
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{ColMut, Mat, MatMut};
use rayon::prelude::*;

use crate::contact::sequence::Sharing;
use crate::numeric::patchy::PatchyMatrix;
use crate::wear::integrator::Jacobian;

/// From so many unknowns on a sparse factor can be cheaper than a full one.
const LEAST_UNKNOWNS: usize = 500;

/// Share of entries other than zero up to which it is.
const MOST_FILLED: f64 = 0.25;

/// I − γτJ, factored.
pub(super) enum Shifted {
    Full(PartialPivLu<f64>),
    Sparse(Box<Lu<u32, f64>>),
    Blocks(Box<Blocks>),
    Shared(Box<Shifted>, Arc<Sharing>),
}

/// diag(A_i) − f U Vᵀ with A_i = I − f J_i, by Woodbury's formula: x = A⁻¹ r + f Z s, (I − f Vᵀ Z) s = Vᵀ A⁻¹ r, Z = A⁻¹ U.
pub(super) struct Blocks {
    size: usize,
    quantities: usize,
    factor: f64,
    blocks: Vec<Shifted>,
    /// Z by block.
    driven: Vec<Mat<f64>>,
    follow: Vec<Mat<f64>>,
    common: PartialPivLu<f64>,
}

impl Blocks {
    fn new(blocks: &[PatchyMatrix], drive: &[Mat<f64>], follow: &[Mat<f64>], factor: f64) -> Self {
        let parts: Vec<(Shifted, Mat<f64>, Mat<f64>)> = (blocks, drive, follow)
            .into_par_iter()
            .map(|(block, drive, follow)| {
                let shifted = Shifted::of(block, factor);
                let mut driven = drive.clone();
                shifted.solve_all(driven.as_mut());
                let loop_gain = follow.transpose() * &driven;
                (shifted, driven, loop_gain)
            })
            .collect();
        let quantities = follow.first().map_or(0, Mat::ncols);
        let mut common = Mat::<f64>::identity(quantities, quantities);
        let (mut shifted, mut driven) = (Vec::new(), Vec::new());
        // in the blocks' order, so that the sum does not depend on the threads
        for (block, of_block, gain) in parts {
            common -= faer::Scale(factor) * gain;
            shifted.push(block);
            driven.push(of_block);
        }
        Self {
            size: blocks.first().map_or(0, PatchyMatrix::size),
            quantities,
            factor,
            blocks: shifted,
            driven,
            follow: follow.to_vec(),
            common: common.partial_piv_lu(),
        }
    }

    fn solve(&self, right: &mut [f64]) {
        let mut shared = Mat::<f64>::zeros(self.quantities, 1);
        for (i, own) in right.chunks_mut(self.size).enumerate() {
            self.blocks[i].solve(own);
            for (j, shared) in shared.col_as_slice_mut(0).iter_mut().enumerate() {
                let follow = self.follow[i].col_as_slice(j);
                *shared += follow.iter().zip(&*own).map(|(v, x)| v * x).sum::<f64>();
            }
        }
        self.common.solve_in_place(shared.as_mut());
        for (i, own) in right.chunks_mut(self.size).enumerate() {
            for (j, shared) in shared.col_as_slice(0).iter().enumerate() {
                let driven = self.driven[i].col_as_slice(j);
                for (x, z) in own.iter_mut().zip(driven) {
                    *x += self.factor * shared * z;
                }
            }
        }
    }
}

impl Shifted {
    /// I − `factor` J. (J's eigenvalues lie in the left half plane, so it is never near singular.)
    pub(super) fn new(jacobian: &Jacobian, factor: f64) -> Self {
        match jacobian {
            Jacobian::Full(jacobian) => Self::of(jacobian, factor),
            Jacobian::Blocks {
                blocks,
                drive,
                follow,
            } => Self::Blocks(Box::new(Blocks::new(blocks, drive, follow, factor))),
            Jacobian::Shared {
                of_classes,
                sharing,
            } => Self::Shared(Box::new(Self::of(of_classes, factor)), Arc::clone(sharing)),
        }
    }

    fn of(jacobian: &PatchyMatrix, factor: f64) -> Self {
        Self::sparse(jacobian, factor).unwrap_or_else(|| {
            let mut matrix = Mat::<f64>::identity(jacobian.size(), jacobian.size());
            for j in 0..jacobian.size() {
                let column = matrix.col_as_slice_mut(j);
                for (first, values) in jacobian.stretches(j) {
                    for (entry, value) in column[first..].iter_mut().zip(values) {
                        *entry -= factor * value;
                    }
                }
            }
            Self::Full(matrix.partial_piv_lu())
        })
    }

    /// A sparse factor where it pays and can be had.
    fn sparse(jacobian: &PatchyMatrix, factor: f64) -> Option<Self> {
        let n = jacobian.size();
        if n < LEAST_UNKNOWNS {
            return None;
        }
        let most = (MOST_FILLED * (n * n) as f64) as usize;
        let mut starts = Vec::with_capacity(n + 1);
        let (mut rows, mut values) = (Vec::new(), Vec::new());
        for j in 0..n {
            starts.push(rows.len() as u32);
            let mut met_diagonal = false;
            let mut put = |i: usize, value: f64| {
                rows.push(i as u32);
                values.push(value);
            };
            for (i, value) in jacobian.column(j) {
                if i >= j && !met_diagonal {
                    met_diagonal = true;
                    put(j, 1.0 - factor * if i == j { value } else { 0.0 });
                }
                if i != j {
                    put(i, -factor * value);
                }
            }
            if !met_diagonal {
                put(j, 1.0);
            }
            if rows.len() > most {
                return None;
            }
        }
        starts.push(rows.len() as u32);
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let matrix = SparseColMat::new(pattern, values);
        Some(Self::Sparse(Box::new(matrix.sp_lu().ok()?)))
    }

    /// Solves in place.
    pub(super) fn solve(&self, rhs: &mut [f64]) {
        let mut column = ColMut::from_slice_mut(rhs);
        match self {
            Self::Full(lu) => lu.solve_in_place(column.rb_mut()),
            Self::Sparse(lu) => lu.solve_in_place(column.rb_mut()),
            Self::Blocks(blocks) => blocks.solve(rhs),
            Self::Shared(classes, sharing) => {
                let mut own = sharing.gather(rhs);
                classes.solve(&mut own);
                sharing.spread(&own, rhs);
            }
        }
    }

    /// Solves for every column in place.
    fn solve_all(&self, mut columns: MatMut<'_, f64>) {
        match self {
            Self::Full(lu) => lu.solve_in_place(columns.rb_mut()),
            Self::Sparse(lu) => lu.solve_in_place(columns.rb_mut()),
            Self::Blocks(_) | Self::Shared(..) => unreachable!("blocks have no blocks"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both factors against the product with a known solution, on a matrix like that of two narrow contacts that share a load.
    #[test]
    fn full_and_sparse_solve_alike() {
        let n = LEAST_UNKNOWNS;
        let half = n / 2;
        let jacobian = PatchyMatrix::from_fn(n, |i, j| {
            let apart = (i % half).abs_diff(j % half);
            if apart > 6 {
                return 0.0;
            }
            let own = if i == j { -3.0 } else { 0.0 };
            own - ((7 * i + 13 * j) % 11) as f64 / (11.0 + apart as f64)
        });
        let known: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let factor = 0.3;
        let sparse = Shifted::of(&jacobian, factor);
        assert!(matches!(sparse, Shifted::Sparse(_)));
        let matrix = Mat::from_fn(n, n, |i, j| {
            f64::from(u8::from(i == j)) - factor * jacobian[(i, j)]
        });
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
            let jacobian = PatchyMatrix::from_fn(n, |i, j| match i.abs_diff(j) {
                0 => -2.0,
                1 => 1.0,
                _ => 0.0,
            });
            let factor = 40.0;
            let shifted = Shifted::of(&jacobian, factor);
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
        let jacobian =
            PatchyMatrix::from_fn(LEAST_UNKNOWNS, |i, j| -1.0 / (1.0 + i.abs_diff(j) as f64));
        assert!(matches!(Shifted::of(&jacobian, 1.0), Shifted::Full(_)));
    }

    /// Blocks with common quantities against the same matrix written out.
    #[test]
    fn blocks_with_common_quantities_are_solved_as_the_whole() {
        let (count, n, quantities) = (3, 5, 2);
        let value =
            |i: usize, j: usize, k: usize| ((7 * i + 13 * j + 29 * k) % 11) as f64 / 11.0 - 0.4;
        let blocks: Vec<PatchyMatrix> = (0..count)
            .map(|b| {
                PatchyMatrix::from_fn(n, |i, j| value(i, j, b) - 3.0 * f64::from(u8::from(i == j)))
            })
            .collect();
        let thin = |shift: usize| -> Vec<Mat<f64>> {
            (0..count)
                .map(|b| Mat::from_fn(n, quantities, |i, j| value(i, j, b + shift)))
                .collect()
        };
        let (drive, follow) = (thin(3), thin(8));
        let all = count * n;
        let whole = PatchyMatrix::from_fn(all, |i, j| {
            let own = if i / n == j / n {
                blocks[i / n][(i % n, j % n)]
            } else {
                0.0
            };
            let common: f64 = (0..quantities)
                .map(|q| drive[i / n][(i % n, q)] * follow[j / n][(j % n, q)])
                .sum();
            own + common
        });
        let factor = 0.2;
        let mut expected: Vec<f64> = (0..all).map(|i| (i as f64).cos()).collect();
        let mut found = expected.clone();
        Shifted::of(&whole, factor).solve(&mut expected);
        let jacobian = Jacobian::Blocks {
            blocks,
            drive,
            follow,
        };
        Shifted::new(&jacobian, factor).solve(&mut found);
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-12, "{found}, {expected}");
        }
    }
}
