//! Condensation: the displacement of a set of nodes under unit forces on them.
//!
//! With the interface unknowns last in the elimination order, K = L Lᵀ and L partitioned alike,
//!
//! ```text
//! (K⁻¹)_ii = L_ii⁻ᵀ L_ii⁻¹          i the interface block
//! ```
//! so the compliance needs only the dense last block of the factor (Golub & Van Loan, Matrix Computations, 4th ed. 2013,
//! section 4.2), not one solution per interface unknown.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::inverse;
use faer::{MatMut, MatRef, Par};

/// Displacement of the interface nodes under unit loads on them, mm per (N per mm of width).
///
/// Row and column 2 k is the x, 2 k + 1 the y direction of the k-th interface node. The matrix is symmetric to the last
/// bit and positive definite; rows and columns of fixed directions are zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Compliance {
    nodes: Vec<u32>,
    values: Vec<f64>,
}

impl Compliance {
    /// Interface nodes, in the order of the unknowns.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Number of rows, twice the number of nodes.
    pub fn size(&self) -> usize {
        2 * self.nodes.len()
    }

    /// Displacement in unknown `row` under a unit load in unknown `column`.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        self.column(column)[row]
    }

    /// Displacements of all unknowns under a unit load in unknown `index`; by symmetry also row `index`.
    pub fn column(&self, index: usize) -> &[f64] {
        &self.values[index * self.size()..][..self.size()]
    }

    /// The matrix as a dense view, column-major without padding.
    pub fn matrix(&self) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(&self.values, self.size(), self.size())
    }

    /// Inverts the dense lower factor `block` (column-major) and spreads it over the unknowns: `place[k]` is the unknown
    /// of the factor's k-th column.
    pub(super) fn from_factor(
        nodes: Vec<u32>,
        place: &[usize],
        block: &[f64],
        parallelism: Par,
    ) -> Compliance {
        let (n, m) = (2 * nodes.len(), place.len());
        let mut inverted = vec![0.0; m * m];
        let request = inverse::inverse_scratch::<f64>(m, parallelism);
        inverse::inverse(
            MatMut::from_column_major_slice_mut(&mut inverted, m, m),
            MatRef::from_column_major_slice(block, m, m),
            parallelism,
            MemStack::new(&mut MemBuffer::new(request)),
        );
        mirror_lower(&mut inverted, m);
        if m == n {
            return Compliance {
                nodes,
                values: inverted,
            };
        }
        let mut values = vec![0.0; n * n];
        for (j, &column) in place.iter().enumerate() {
            for (i, &row) in place.iter().enumerate() {
                values[column * n + row] = inverted[j * m + i];
            }
        }
        Compliance { nodes, values }
    }
}

/// Copies the lower triangle of a column-major square matrix to the upper one, in cache-sized tiles.
fn mirror_lower(values: &mut [f64], n: usize) {
    const TILE: usize = 32;
    for column_tile in (0..n).step_by(TILE) {
        for row_tile in (column_tile..n).step_by(TILE) {
            for j in column_tile..(column_tile + TILE).min(n) {
                for i in row_tile.max(j + 1)..(row_tile + TILE).min(n) {
                    values[i * n + j] = values[j * n + i];
                }
            }
        }
    }
}
