//! Regular triangle meshes of a mapped unit square, for verification.

use super::FemError;
use crate::mesh::{Cells, Mesh};
use crate::numeric::Vec2;

/// Degree of the shape functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// T3.
    Linear,
    /// T6; all mid-sides lie on the mapped square, so mapped edges are curved.
    Quadratic,
}

/// How the cells are cut into triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Diagonals {
    /// The direction changes from cell to cell (checkerboard), so that none is preferred.
    Alternating,
    /// All from the lower left to the upper right corner.
    Parallel,
}

/// A mesh of a mapped unit square with its four sides, each running counter-clockwise (the body on its left).
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// The mesh; without flanks and bore.
    pub mesh: Mesh,
    /// Side t = 0, s ascending.
    pub bottom: Vec<u32>,
    /// Side s = 1, t ascending.
    pub right: Vec<u32>,
    /// Side t = 1, s descending.
    pub top: Vec<u32>,
    /// Side s = 0, t descending.
    pub left: Vec<u32>,
    columns: usize,
}

impl Patch {
    /// Splits the unit square into `nx` x `ny` cells of two triangles, diagonals alternating, and maps the nodes by
    /// `map(s, t)`.
    pub fn new(
        nx: usize,
        ny: usize,
        order: Order,
        map: impl Fn(f64, f64) -> Vec2,
    ) -> Result<Patch, FemError> {
        Patch::with_diagonals(nx, ny, order, Diagonals::Alternating, map)
    }

    /// As [`Patch::new`] with a choice of diagonals.
    pub fn with_diagonals(
        nx: usize,
        ny: usize,
        order: Order,
        diagonals: Diagonals,
        map: impl Fn(f64, f64) -> Vec2,
    ) -> Result<Patch, FemError> {
        if nx == 0 || ny == 0 {
            return Err(FemError::Empty);
        }
        let step = match order {
            Order::Linear => 1,
            Order::Quadratic => 2,
        };
        let (columns, rows) = (nx * step + 1, ny * step + 1);
        let number = |i: usize, j: usize| (j * columns + i) as u32;
        let mut points = Vec::with_capacity(columns * rows);
        for j in 0..rows {
            for i in 0..columns {
                points.push(map(
                    i as f64 / (columns - 1) as f64,
                    j as f64 / (rows - 1) as f64,
                ));
            }
        }
        let mut corners = Vec::with_capacity(2 * nx * ny);
        for j in 0..ny {
            for i in 0..nx {
                let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    .map(|(i, j)| (i * step, j * step));
                if diagonals == Diagonals::Parallel || (i + j) % 2 == 0 {
                    corners.extend([[a, b, c], [a, c, d]]);
                } else {
                    corners.extend([[a, b, d], [b, c, d]]);
                }
            }
        }
        let at = |p: (usize, usize)| number(p.0, p.1);
        let middle =
            |p: (usize, usize), q: (usize, usize)| number((p.0 + q.0) / 2, (p.1 + q.1) / 2);
        let cells = match order {
            Order::Linear => Cells::T3(corners.iter().map(|c| c.map(at)).collect()),
            Order::Quadratic => Cells::T6(
                corners
                    .iter()
                    .map(|&[a, b, c]| {
                        [
                            at(a),
                            at(b),
                            at(c),
                            middle(a, b),
                            middle(b, c),
                            middle(c, a),
                        ]
                    })
                    .collect(),
            ),
        };
        Ok(Patch {
            mesh: Mesh {
                points,
                cells,
                flanks: Vec::new(),
                bore: Vec::new(),
            },
            bottom: (0..columns).map(|i| number(i, 0)).collect(),
            right: (0..rows).map(|j| number(columns - 1, j)).collect(),
            top: (0..columns).rev().map(|i| number(i, rows - 1)).collect(),
            left: (0..rows).rev().map(|j| number(0, j)).collect(),
            columns,
        })
    }

    /// The node in column `i` and row `j` of the node grid (for T6 the grid of corners and mid-sides).
    pub fn node(&self, i: usize, j: usize) -> u32 {
        (j * self.columns + i) as u32
    }
}
