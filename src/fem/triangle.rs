//! The linear and the quadratic triangle.
//!
//! ```text
//!   eta                      L0 = 1 − xi − eta,  L1 = xi,  L2 = eta
//!    2                       T3   N_i = L_i
//!    | \                     T6   N_i = L_i (2 L_i − 1)                       corners 0 1 2
//!    5   4                        N_3 = 4 L0 L1,  N_4 = 4 L1 L2,  N_5 = 4 L2 L0   mid-sides
//!    |     \
//!    0--3---1  xi
//! ```
//! Zienkiewicz, Taylor & Zhu, The Finite Element Method (6th ed., 2005), section 4.7. Isoparametric: the geometry uses the
//! same functions, so an edge of a T6 is a parabola through its three nodes.

use super::FemError;
use crate::mesh::{Cells, Mesh};
use crate::numeric::Vec2;
use crate::numeric::quadrature::{TRIANGLE_1, TRIANGLE_3, TRIANGLE_7, TrianglePoint};

/// One triangle of a mesh with its node positions.
#[derive(Debug, Clone, Copy)]
pub struct Element {
    /// Number of nodes, 3 or 6.
    pub len: usize,
    /// Node numbers; the first `len` are used.
    pub nodes: [u32; 6],
    /// Node positions, mm; the first `len` are used.
    pub points: [Vec2; 6],
}

/// The shape functions of an element at one point.
#[derive(Debug, Clone, Copy)]
pub struct ShapeAt {
    /// Values N_i.
    pub value: [f64; 6],
    /// Derivatives of N_i after x and y, 1/mm.
    pub gradient: [Vec2; 6],
    /// Jacobian determinant, mm² (twice the area for straight edges).
    pub jacobian: f64,
    /// Position, mm.
    pub position: Vec2,
}

impl Element {
    /// The element number `index` of `mesh`.
    pub fn of(mesh: &Mesh, index: usize) -> Element {
        let (len, nodes) = nodes_of(&mesh.cells, index);
        let mut points = [Vec2::zeros(); 6];
        for (point, &node) in points.iter_mut().zip(&nodes[..len]) {
            *point = mesh.points[node as usize];
        }
        Element { len, nodes, points }
    }

    /// Node numbers.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes[..self.len]
    }

    /// As [`Element::at`] at a point of a quadrature rule, of the element with this `number` in its mesh.
    ///
    /// # Errors
    /// [`FemError::Inverted`] where the Jacobian is not positive.
    pub fn upright_at(&self, point: &TrianglePoint, number: usize) -> Result<ShapeAt, FemError> {
        let at = self.at(point.xi, point.eta);
        if at.jacobian.is_nan() || at.jacobian <= 0.0 {
            return Err(FemError::Inverted {
                element: number,
                jacobian: at.jacobian,
                at: at.position,
            });
        }
        Ok(at)
    }

    /// Shape functions, their derivatives in the plane and the Jacobian at a reference point.
    pub fn at(&self, xi: f64, eta: f64) -> ShapeAt {
        let (value, slope) = shape(self.len, xi, eta);
        let (mut dxi, mut deta, mut position) = (Vec2::zeros(), Vec2::zeros(), Vec2::zeros());
        for i in 0..self.len {
            dxi += slope[i][0] * self.points[i];
            deta += slope[i][1] * self.points[i];
            position += value[i] * self.points[i];
        }
        let jacobian = dxi.x * deta.y - dxi.y * deta.x;
        let mut gradient = [Vec2::zeros(); 6];
        for i in 0..self.len {
            gradient[i] = Vec2::new(
                (slope[i][0] * deta.y - slope[i][1] * dxi.y) / jacobian,
                (slope[i][1] * dxi.x - slope[i][0] * deta.x) / jacobian,
            );
        }
        ShapeAt {
            value,
            gradient,
            jacobian,
            position,
        }
    }

    /// Whether a mid-side node is off the middle of its chord by more than 1e-9 of the chord.
    pub fn is_curved(&self) -> bool {
        self.len == 6
            && (0..3).any(|edge| {
                let (a, b) = (self.points[edge], self.points[(edge + 1) % 3]);
                let middle = self.points[3 + edge];
                (middle - 0.5 * (a + b)).norm_squared() > 1e-18 * (b - a).norm_squared()
            })
    }

    /// The rule for the stiffness: exact for straight edges (1 point for T3, 3 for T6), 7 points for curved ones, where
    /// the integrand is a rational function.
    pub fn stiffness_rule(&self) -> &'static [TrianglePoint] {
        match (self.len, self.is_curved()) {
            (3, _) => &TRIANGLE_1,
            (_, false) => &TRIANGLE_3,
            (_, true) => &TRIANGLE_7,
        }
    }
}

/// Number of triangles.
pub fn element_count(cells: &Cells) -> usize {
    match cells {
        Cells::T3(cells) => cells.len(),
        Cells::T6(cells) => cells.len(),
    }
}

/// The triangles of a mesh in order.
pub fn elements(mesh: &Mesh) -> impl Iterator<Item = Element> + '_ {
    (0..element_count(&mesh.cells)).map(|index| Element::of(mesh, index))
}

/// Node count and node numbers of one triangle.
pub(super) fn nodes_of(cells: &Cells, index: usize) -> (usize, [u32; 6]) {
    match cells {
        Cells::T3(cells) => {
            let [a, b, c] = cells[index];
            (3, [a, b, c, 0, 0, 0])
        }
        Cells::T6(cells) => (6, cells[index]),
    }
}

/// Values and reference derivatives of the 3 or 6 shape functions; unused places are zero.
pub fn shape(len: usize, xi: f64, eta: f64) -> ([f64; 6], [[f64; 2]; 6]) {
    let l = [1.0 - xi - eta, xi, eta];
    let dl = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let (mut value, mut slope) = ([0.0; 6], [[0.0; 2]; 6]);
    for i in 0..3 {
        if len == 3 {
            value[i] = l[i];
            slope[i] = dl[i];
            continue;
        }
        let j = (i + 1) % 3;
        value[i] = l[i] * (2.0 * l[i] - 1.0);
        value[3 + i] = 4.0 * l[i] * l[j];
        for d in 0..2 {
            slope[i][d] = (4.0 * l[i] - 1.0) * dl[i][d];
            slope[3 + i][d] = 4.0 * (dl[i][d] * l[j] + l[i] * dl[j][d]);
        }
    }
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODES: [[f64; 2]; 6] = [
        [0.0, 0.0],
        [1.0, 0.0],
        [0.0, 1.0],
        [0.5, 0.0],
        [0.5, 0.5],
        [0.0, 0.5],
    ];

    #[test]
    fn shape_functions_are_one_at_their_node_and_sum_to_one() {
        for len in [3, 6] {
            for (i, node) in NODES.iter().enumerate().take(len) {
                let (value, _) = shape(len, node[0], node[1]);
                for (j, v) in value.iter().enumerate().take(len) {
                    assert_eq!(*v, if i == j { 1.0 } else { 0.0 });
                }
            }
            let (value, slope) = shape(len, 0.21, 0.34);
            assert!((value.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            for d in 0..2 {
                assert!(slope.iter().map(|s| s[d]).sum::<f64>().abs() < 1e-15);
            }
        }
    }

    #[test]
    fn derivatives_match_central_differences() {
        let h = 1e-6;
        for len in [3, 6] {
            let (_, slope) = shape(len, 0.21, 0.34);
            let dxi = (shape(len, 0.21 + h, 0.34).0, shape(len, 0.21 - h, 0.34).0);
            let deta = (shape(len, 0.21, 0.34 + h).0, shape(len, 0.21, 0.34 - h).0);
            for (i, slope) in slope.iter().enumerate() {
                assert!((slope[0] - (dxi.0[i] - dxi.1[i]) / (2.0 * h)).abs() < 1e-9);
                assert!((slope[1] - (deta.0[i] - deta.1[i]) / (2.0 * h)).abs() < 1e-9);
            }
        }
    }
}
