//! Consistent nodal loads of edge tractions and body forces.
//!
//! ```text
//! f_a = ∫ N_a t ds   (edge, t in MPa)          f_a = ∫ N_a b dA   (area, b in N/mm³)          N per mm of width
//! ```

use super::triangle::elements;
use crate::mesh::{Cells, Mesh};
use crate::numeric::Vec2;
use crate::numeric::quadrature::{gauss_legendre, triangle_product};

/// Nodal loads of a traction, MPa, along a chain of boundary nodes.
///
/// `chain` runs along the boundary with the body on its left: corner, mid-side, corner, ... for T6 (2 m + 1 nodes),
/// corners for T3. `traction` is given the position and the outward unit normal. Five Gauss points per edge.
pub fn edge_traction(
    mesh: &Mesh,
    chain: &[u32],
    traction: impl Fn(Vec2, Vec2) -> Vec2,
) -> Vec<(u32, Vec2)> {
    let rule = gauss_legendre(5);
    let step = match mesh.cells {
        Cells::T3(_) => 1,
        Cells::T6(_) => 2,
    };
    let mut loads: Vec<(u32, Vec2)> = chain.iter().map(|&node| (node, Vec2::zeros())).collect();
    let mut start = 0;
    while start + step < chain.len() {
        let edge = start..=start + step;
        for &(s, weight) in &rule {
            let (value, slope) = line_shape(step, s);
            let (mut position, mut tangent) = (Vec2::zeros(), Vec2::zeros());
            for (i, &node) in chain[edge.clone()].iter().enumerate() {
                position += value[i] * mesh.points[node as usize];
                tangent += slope[i] * mesh.points[node as usize];
            }
            let length = tangent.norm();
            let t = traction(position, Vec2::new(tangent.y, -tangent.x) / length);
            for (i, load) in loads[edge.clone()].iter_mut().enumerate() {
                load.1 += weight * length * value[i] * t;
            }
        }
        start += step;
    }
    loads
}

/// Nodal loads of a body force, N/mm³, given at a position; 5 x 5 Gauss points per triangle.
pub fn body_force(mesh: &Mesh, force: impl Fn(Vec2) -> Vec2) -> Vec<(u32, Vec2)> {
    let rule = triangle_product(5);
    let mut loads: Vec<(u32, Vec2)> = (0..mesh.points.len() as u32)
        .map(|node| (node, Vec2::zeros()))
        .collect();
    for element in elements(mesh) {
        for point in &rule {
            let at = element.at(point.xi, point.eta);
            let b = point.weight * at.jacobian * force(at.position);
            for (&node, value) in element.nodes().iter().zip(&at.value) {
                loads[node as usize].1 += *value * b;
            }
        }
    }
    loads
}

/// Values and derivatives of the shape functions of an edge on -1 ≤ s ≤ 1, nodes in order along the edge.
fn line_shape(step: usize, s: f64) -> ([f64; 3], [f64; 3]) {
    if step == 1 {
        ([0.5 * (1.0 - s), 0.5 * (1.0 + s), 0.0], [-0.5, 0.5, 0.0])
    } else {
        (
            [0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)],
            [s - 0.5, -2.0 * s, s + 0.5],
        )
    }
}
