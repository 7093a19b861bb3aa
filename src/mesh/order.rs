//! Mid-side nodes: from straight triangles with corners to linear or quadratic cells.

use super::{Cells, Outline, Triangles};
use crate::numeric::Vec2;

/// Polynomial order of the elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// Three-node triangles with straight edges.
    T3,
    /// Six-node triangles, curved where the boundary is.
    #[default]
    T6,
}

/// A directed edge of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Edge {
    /// Node numbers, smaller first.
    pub(super) ends: [u32; 2],
    /// Cell number.
    pub(super) cell: u32,
    /// 0, 1, 2 for edges 0-1, 1-2, 2-0 of the cell.
    pub(super) side: u8,
}

/// All cell edges sorted by their ends: an inner edge stands twice, a boundary edge once.
pub(super) fn edge_list(corners: &[[u32; 3]]) -> Vec<Edge> {
    let mut edges = Vec::with_capacity(3 * corners.len());
    for (cell, t) in corners.iter().enumerate() {
        for side in 0..3u8 {
            let (a, b) = (t[side as usize], t[(side as usize + 1) % 3]);
            edges.push(Edge {
                ends: [a.min(b), a.max(b)],
                cell: cell as u32,
                side,
            });
        }
    }
    edges.sort_unstable();
    edges
}

/// Nodes and cells of the wanted order, and for T6 the mid-side node of each outline edge (in the order of [`Outline::edges`]).
///
/// Corner nodes keep their numbers; mid-side nodes follow. Those of outline edges take the outline's mid-side points.
pub fn raise_order(
    mesh: &Triangles,
    outline: &Outline,
    order: Order,
) -> (Vec<Vec2>, Cells, Vec<u32>) {
    let mut points = mesh.points.clone();
    if order == Order::T3 {
        return (points, Cells::T3(mesh.corners.clone()), Vec::new());
    }
    let mut boundary: Vec<([u32; 2], Vec2, usize)> = outline
        .edges()
        .iter()
        .zip(outline.mids())
        .enumerate()
        .map(|(i, ([a, b], mid))| ([*a.min(b), *a.max(b)], mid, i))
        .collect();
    boundary.sort_by_key(|e| e.0);
    let mut outline_mids = vec![u32::MAX; boundary.len()];
    let mut cells: Vec<[u32; 6]> = mesh
        .corners
        .iter()
        .map(|t| [t[0], t[1], t[2], 0, 0, 0])
        .collect();
    let mut last = None;
    let mut next_boundary = boundary.iter().peekable();
    for e in edge_list(&mesh.corners) {
        if last != Some(e.ends) {
            last = Some(e.ends);
            let [a, b] = e.ends.map(|k| points[k as usize]);
            let mut place = 0.5 * (a + b);
            if let Some((_, mid, i)) = next_boundary.next_if(|x| x.0 == e.ends) {
                place = *mid;
                outline_mids[*i] = points.len() as u32;
            }
            points.push(place);
        }
        cells[e.cell as usize][3 + e.side as usize] = points.len() as u32 - 1;
    }
    (points, Cells::T6(cells), outline_mids)
}
