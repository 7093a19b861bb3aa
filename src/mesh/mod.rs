//! Floor 2: triangle meshes of whole gears.

use crate::numeric::Vec2;

/// Triangles of a mesh; nodes counter-clockwise, corners first; T6 then the mid-sides of edges 0-1, 1-2, 2-0 (VTK order).
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Linear triangles.
    T3(Vec<[u32; 3]>),
    /// Quadratic triangles; only edges on curved boundaries are curved.
    T6(Vec<[u32; 6]>),
}

/// The finely meshed loaded flank of one tooth, ordered from the root side to the tip corner.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankChain {
    /// Tooth number; 0 is centred on the +x axis of the member frame, +1 the next counter-clockwise.
    pub tooth: i32,
    /// Node numbers; for T6 corner, mid-side, corner, ... (2m + 1 nodes for m edges), for T3 m + 1 nodes.
    pub nodes: Vec<u32>,
    /// Arc length coordinate of each node, mm: rho²/(2 r_b) on the involute; mid-side nodes at the middle of the arc.
    pub arc: Vec<f64>,
}

/// A mesh of one member in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Node positions, mm.
    pub points: Vec<Vec2>,
    /// Triangles.
    pub cells: Cells,
    /// The candidate teeth's loaded flanks, by ascending tooth number.
    pub flanks: Vec<FlankChain>,
    /// Nodes on the bore circle (held rigid).
    pub bore: Vec<u32>,
}
