//! The boundary of a finished mesh, and areas from it.

use super::order::edge_list;
use super::outline::edge_area;
use super::{Cells, Mesh};

/// A cell edge that belongs to one triangle only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BoundaryEdge {
    /// First node; the body lies to the left on the way to `end`.
    pub start: u32,
    /// Mid-side node of a T6 mesh.
    pub mid: Option<u32>,
    /// Last node.
    pub end: u32,
}

/// All boundary edges, sorted by their node numbers.
pub fn boundary_edges(mesh: &Mesh) -> Vec<BoundaryEdge> {
    let edges = edge_list(&mesh.corners());
    let mut out = Vec::new();
    let mut i = 0;
    while i < edges.len() {
        if i + 1 < edges.len() && edges[i].ends == edges[i + 1].ends {
            i += 2;
            continue;
        }
        let (cell, side) = (edges[i].cell as usize, edges[i].side as usize);
        let corners = mesh.cells.corners(cell);
        let mid = match &mesh.cells {
            Cells::T3(_) => None,
            Cells::T6(t) => Some(t[cell][3 + side]),
        };
        out.push(BoundaryEdge {
            start: corners[side],
            mid,
            end: corners[(side + 1) % 3],
        });
        i += 1;
    }
    out
}

/// Area inside the outer boundary, mm², curved edges as parabolas, the bore not subtracted.
///
/// The difference between the nominal and the relocated mesh is the worn area.
pub fn outer_area(mesh: &Mesh) -> f64 {
    let mut on_bore = vec![false; mesh.points.len()];
    mesh.bore.iter().for_each(|k| on_bore[*k as usize] = true);
    let at = |k: u32| mesh.points[k as usize];
    boundary_edges(mesh)
        .iter()
        .filter(|e| !(on_bore[e.start as usize] && on_bore[e.end as usize]))
        .map(|e| {
            let mid = e.mid.map_or(0.5 * (at(e.start) + at(e.end)), at);
            edge_area(at(e.start), mid, at(e.end))
        })
        .sum()
}
