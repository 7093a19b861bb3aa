//! Supports: which unknowns are fixed, how the free ones are numbered, and whether any part can still move.

use super::FemError;
use super::assemble::FIXED;
use super::triangle::{element_count, nodes_of};
use crate::mesh::{Cells, Mesh};
use crate::numeric::Vec2;

/// A direction of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
}

impl Axis {
    /// 0 for x, 1 for y.
    pub fn index(self) -> usize {
        match self {
            Axis::X => 0,
            Axis::Y => 1,
        }
    }
}

/// Fixed directions of every node.
pub(super) fn fixed_flags(count: usize, fixed: &[(u32, Axis)]) -> Result<Vec<[bool; 2]>, FemError> {
    let mut flags = vec![[false; 2]; count];
    for &(node, axis) in fixed {
        let unknown = FemError::UnknownNode {
            what: "the list of fixed nodes",
            node,
            count,
        };
        flags.get_mut(node as usize).ok_or(unknown)?[axis.index()] = true;
    }
    Ok(flags)
}

/// Equation numbers of the free unknowns, counted along `order`; `FIXED` elsewhere. Also their number.
pub(super) fn number_equations(order: &[u32], fixed: &[[bool; 2]]) -> (Vec<[u32; 2]>, usize) {
    let mut equation = vec![[FIXED; 2]; fixed.len()];
    let mut next = 0;
    for &node in order {
        for axis in 0..2 {
            if !fixed[node as usize][axis] {
                equation[node as usize][axis] = next;
                next += 1;
            }
        }
    }
    (equation, next as usize)
}

/// Refuses a mesh of which a connected part keeps a rigid motion, or which has free nodes outside all triangles.
///
/// A motion (a, b, ω) moves node p by (a − ω p_y, b + ω p_x). The fixed unknowns of a part give one linear condition
/// each; the part is held if these have rank 3, which is judged on coordinates scaled to the size of the part.
pub(super) fn check_support(mesh: &Mesh, fixed: &[[bool; 2]]) -> Result<(), FemError> {
    let part = parts(&mesh.cells, mesh.points.len());
    for (node, &root) in part.iter().enumerate() {
        if root == u32::MAX && fixed[node] != [true; 2] {
            return Err(FemError::UnusedNode { node: node as u32 });
        }
    }
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); mesh.points.len()];
    for (node, &root) in part.iter().enumerate() {
        if root != u32::MAX {
            members[root as usize].push(node as u32);
        }
    }
    for nodes in members.iter().filter(|nodes| !nodes.is_empty()) {
        let rank = support_rank(mesh, fixed, nodes);
        if rank < 3 {
            return Err(FemError::MissingSupport {
                node: nodes[0],
                free: 3 - rank,
            });
        }
    }
    Ok(())
}

fn support_rank(mesh: &Mesh, fixed: &[[bool; 2]], nodes: &[u32]) -> usize {
    let point = |node: u32| mesh.points[node as usize];
    let centre = nodes.iter().map(|&n| point(n)).sum::<Vec2>() / nodes.len() as f64;
    let size = nodes
        .iter()
        .map(|&n| (point(n) - centre).norm())
        .fold(0.0, f64::max);
    let mut rows = nalgebra::Matrix3::<f64>::zeros();
    for &node in nodes {
        let p = (point(node) - centre) / size;
        let conditions = [
            nalgebra::Vector3::new(1.0, 0.0, -p.y),
            nalgebra::Vector3::new(0.0, 1.0, p.x),
        ];
        for axis in 0..2 {
            if fixed[node as usize][axis] {
                rows += conditions[axis] * conditions[axis].transpose();
            }
        }
    }
    let eigenvalues = rows.symmetric_eigenvalues();
    let largest = eigenvalues.max();
    eigenvalues
        .iter()
        .filter(|&&value| value > 1e-12 * largest)
        .count()
}

/// For every node the smallest node number of its connected part, or `u32::MAX` if no triangle uses it.
fn parts(cells: &Cells, count: usize) -> Vec<u32> {
    fn root(parent: &mut [u32], mut node: u32) -> u32 {
        while parent[node as usize] != node {
            parent[node as usize] = parent[parent[node as usize] as usize];
            node = parent[node as usize];
        }
        node
    }
    let mut parent = vec![u32::MAX; count];
    for index in 0..element_count(cells) {
        let (len, nodes) = nodes_of(cells, index);
        for &node in &nodes[..len] {
            if parent[node as usize] == u32::MAX {
                parent[node as usize] = node;
            }
        }
        let mut first = root(&mut parent, nodes[0]);
        for &node in &nodes[1..len] {
            let other = root(&mut parent, node);
            let (low, high) = (first.min(other), first.max(other));
            parent[high as usize] = low;
            first = low;
        }
    }
    (0..count as u32)
        .map(|node| {
            if parent[node as usize] == u32::MAX {
                u32::MAX
            } else {
                root(&mut parent, node)
            }
        })
        .collect()
}
