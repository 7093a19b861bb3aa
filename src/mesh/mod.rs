//! Floor 2: triangle meshes of whole gears.

mod boundary;
mod error;
mod gear_mesh;
mod gear_outline;
mod grading;
mod msh;
mod order;
mod outline;
mod profile;
mod quality;
mod relocate;
mod repair;
mod seed;
mod smooth;
mod triangulate;
mod user;
mod vtu;

pub use boundary::{BoundaryEdge, boundary_edges, outer_area};
pub use error::MeshError;
pub use gear_mesh::{MeshSpec, mesh_gear, mesh_worn_gear};
pub use grading::SizeField;
pub use msh::read_msh;
pub use order::{Order, raise_order};
pub use outline::{Loop, Outline};
pub use quality::{Quality, check_jacobians};
pub use relocate::{relocate, steepness, unworn};
pub use triangulate::{Triangles, TriangulateOptions, triangulate};
pub use user::{BORE_TOLERANCE, FLANK_TOLERANCE};
pub use vtu::read_vtu;

use crate::numeric::Vec2;

/// Triangles of a mesh; nodes counter-clockwise, corners first; T6 then the mid-sides of edges 0-1, 1-2, 2-0 (VTK order).
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Linear triangles.
    T3(Vec<[u32; 3]>),
    /// Quadratic triangles; only edges on curved boundaries are curved.
    T6(Vec<[u32; 6]>),
}

impl Cells {
    /// Number of triangles.
    pub fn len(&self) -> usize {
        match self {
            Cells::T3(t) => t.len(),
            Cells::T6(t) => t.len(),
        }
    }

    /// True if there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Corner nodes of triangle `element`.
    pub fn corners(&self, element: usize) -> [u32; 3] {
        match self {
            Cells::T3(t) => t[element],
            Cells::T6(t) => [t[element][0], t[element][1], t[element][2]],
        }
    }
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

impl Mesh {
    /// Corner nodes of all triangles.
    pub fn corners(&self) -> Vec<[u32; 3]> {
        (0..self.cells.len())
            .map(|e| self.cells.corners(e))
            .collect()
    }
}
