//! Supernodal sparse Cholesky factor K = L Lᵀ of a stiffness matrix that is already in elimination order.
//!
//! The symbolic part is computed once; `factor` may be repeated with new values. All work is sequential and in a fixed
//! order, so the result has the same bits whatever the number of threads around it.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SymbolicSupernodalParams;
use faer::sparse::linalg::cholesky::{simplicial, supernodal};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};

use super::FemError;
use super::assemble::StiffnessPattern;

/// Pivot over diagonal entry below which the matrix counts as singular.
///
/// The pivot of an unknown is what the earlier unknowns leave of its diagonal entry; rounding leaves about 1e-16 of the
/// entry times the number of updates, at most some 1e-14, where nothing should be left. The last pivot of a sound model is
/// 1 / (C_ii K_ii): for the tip of a cantilever of length-to-depth ratio 100 still some 1e-7.
const SINGULAR_PIVOT: f64 = 1e-13;

/// Symbolic structure and values of the factor.
#[derive(Debug)]
pub(super) struct Factor {
    symbolic: supernodal::SymbolicSupernodalCholesky<u32>,
    values: Vec<f64>,
}

/// A pivot that shows the matrix not to be positive definite: its column and its ratio to the diagonal entry.
#[derive(Debug, Clone, Copy)]
pub(super) struct BadPivot {
    pub(super) column: usize,
    pub(super) ratio: f64,
}

impl Factor {
    /// Analyses the pattern; no values yet.
    pub(super) fn analyse(pattern: &StiffnessPattern) -> Result<Factor, FemError> {
        let n = pattern.column_start.len() - 1;
        let too_large = || FemError::TooLarge { unknowns: n };
        let (start, row) = transpose(&pattern.column_start, &pattern.row);
        let upper = SymbolicSparseColMatRef::new_checked(n, n, &start, None, &row);
        let (mut tree, mut counts) = (vec![0i32; n], vec![0u32; n]);
        let request = simplicial::prefactorize_symbolic_cholesky_scratch::<u32>(n, row.len())
            .or(supernodal::factorize_supernodal_symbolic_cholesky_scratch::<u32>(n));
        let mut memory = MemBuffer::try_new(request).map_err(|_| too_large())?;
        let stack = MemStack::new(&mut memory);
        let tree = simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, upper, stack);
        let symbolic = supernodal::factorize_supernodal_symbolic_cholesky(
            upper,
            tree,
            &counts,
            stack,
            SymbolicSupernodalParams::default(),
        )
        .map_err(|_| too_large())?;
        Ok(Factor {
            symbolic,
            values: Vec::new(),
        })
    }

    /// Numerical factorisation of the matrix with these values of the lower triangle.
    pub(super) fn factor(
        &mut self,
        pattern: &StiffnessPattern,
        stiffness: &[f64],
    ) -> Result<(), BadPivot> {
        let n = self.symbolic.nrows();
        self.values.resize(self.symbolic.len_val(), 0.0);
        let structure =
            SymbolicSparseColMatRef::new_checked(n, n, &pattern.column_start, None, &pattern.row);
        let matrix = SparseColMatRef::new(structure, stiffness);
        let request = supernodal::factorize_supernodal_numeric_llt_scratch::<u32, f64>(
            &self.symbolic,
            Par::Seq,
            Default::default(),
        );
        supernodal::factorize_supernodal_numeric_llt(
            &mut self.values,
            matrix,
            LltRegularization::default(),
            &self.symbolic,
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(request)),
            Default::default(),
        )
        .map_err(|error| {
            let faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot { index } = error;
            BadPivot {
                column: index.min(n.saturating_sub(1)),
                ratio: 0.0,
            }
        })?;
        self.check_pivots(pattern, stiffness)
    }

    /// Solves K x = b in place.
    pub(super) fn solve(&self, right_hand_side: &mut [f64]) {
        let n = self.symbolic.nrows();
        let request = self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        self.numeric().solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right_hand_side, n, 1),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(request)),
        );
    }

    /// The last `size` rows and columns of L as a dense column-major lower triangle; zeros above the diagonal.
    pub(super) fn trailing_block(&self, size: usize) -> Vec<f64> {
        let cut = self.symbolic.nrows() - size;
        let mut block = vec![0.0; size * size];
        let factor = self.numeric();
        for s in 0..self.symbolic.n_supernodes() {
            let node = factor.supernode(s);
            let (start, values) = (node.start(), node.val());
            let width = values.ncols();
            if start + width <= cut {
                continue;
            }
            for local in cut.saturating_sub(start)..width {
                let column = start + local - cut;
                let target = &mut block[column * size..][..size];
                for i in local..width {
                    target[start + i - cut] = values[(i, local)];
                }
                for (i, &row) in node.pattern().iter().enumerate() {
                    target[row as usize - cut] = values[(width + i, local)];
                }
            }
        }
        block
    }

    /// Number of stored values of the factor.
    pub(super) fn len(&self) -> usize {
        self.symbolic.len_val()
    }

    /// Additions and multiplications of one numerical factorisation.
    pub(super) fn operations(&self) -> f64 {
        let factor = self.numeric();
        (0..self.symbolic.n_supernodes())
            .map(|s| {
                let node = factor.supernode(s);
                let width = node.val().ncols() as f64;
                let below = node.pattern().len() as f64;
                // the block on the diagonal, the rows below it, what these take from the rest
                width.powi(3) / 3.0 + width * width * below + width * below * below
            })
            .sum()
    }

    fn numeric(&self) -> supernodal::SupernodalLltRef<'_, u32, f64> {
        supernodal::SupernodalLltRef::new(&self.symbolic, &self.values)
    }

    fn check_pivots(&self, pattern: &StiffnessPattern, stiffness: &[f64]) -> Result<(), BadPivot> {
        let factor = self.numeric();
        let mut worst = BadPivot {
            column: 0,
            ratio: f64::INFINITY,
        };
        for s in 0..self.symbolic.n_supernodes() {
            let node = factor.supernode(s);
            for local in 0..node.val().ncols() {
                let column = node.start() + local;
                let diagonal = stiffness[pattern.column_start[column] as usize];
                let ratio = node.val()[(local, local)].powi(2) / diagonal;
                if ratio.is_nan() || ratio < worst.ratio {
                    worst = BadPivot { column, ratio };
                }
            }
        }
        if worst.ratio > SINGULAR_PIVOT {
            Ok(())
        } else {
            Err(worst)
        }
    }
}

/// Transpose of a compressed-column pattern.
fn transpose(start: &[u32], row: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let n = start.len() - 1;
    let mut out_start = vec![0u32; n + 1];
    for &i in row {
        out_start[i as usize + 1] += 1;
    }
    for i in 0..n {
        out_start[i + 1] += out_start[i];
    }
    let mut next = out_start.clone();
    let mut out_row = vec![0u32; row.len()];
    for j in 0..n {
        for &i in &row[start[j] as usize..start[j + 1] as usize] {
            out_row[next[i as usize] as usize] = j as u32;
            next[i as usize] += 1;
        }
    }
    (out_start, out_row)
}
