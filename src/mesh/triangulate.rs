//! Triangles inside an outline: quadtree points, constrained Delaunay, smoothing, repair.
//!
//! ```text
//! outline -> seed points -> [ Delaunay -> drop outside -> smooth ] x rounds -> improve worst stars -> T3
//! ```
//! The points of the outline never move and every outline edge is an edge of the mesh.

use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::quality::worst_triangle;
use super::repair::repair;
use super::seed::interior_points;
use super::smooth::smooth;
use super::{MeshError, Outline};
use crate::numeric::Vec2;

/// How a triangulation is made.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangulateOptions {
    /// Rounds of smoothing, each followed by a new triangulation.
    pub rounds: usize,
    /// Smallest angle accepted, degrees.
    pub min_angle_deg: f64,
    /// Largest number of interior points.
    pub max_points: usize,
}

impl Default for TriangulateOptions {
    fn default() -> Self {
        TriangulateOptions {
            rounds: 4,
            min_angle_deg: 20.0,
            max_points: 400_000,
        }
    }
}

/// Straight triangles filling an outline.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangles {
    /// Corner points: first the outline's, in its order, then interior ones.
    pub points: Vec<Vec2>,
    /// Corners of each triangle, counter-clockwise.
    pub corners: Vec<[u32; 3]>,
    /// Number of outline points.
    pub boundary: usize,
}

/// Fills `outline` with triangles whose edges are about `size(x)` mm long.
pub fn triangulate(
    outline: &Outline,
    size: &dyn Fn(Vec2) -> f64,
    options: &TriangulateOptions,
) -> Result<Triangles, MeshError> {
    outline.check()?;
    let mut points = outline.points();
    let boundary = points.len();
    let edges: Vec<[usize; 2]> = outline
        .edges()
        .iter()
        .map(|e| [e[0] as usize, e[1] as usize])
        .collect();
    points.extend(interior_points(outline, size, options.max_points)?);
    let mut mesh = Triangles {
        corners: delaunay(&points, &edges)?,
        points,
        boundary,
    };
    for _ in 0..options.rounds {
        smooth(&mut mesh, size);
        mesh.corners = delaunay(&mesh.points, &edges)?;
    }
    let mesh = repair(mesh, size, GOOD_DEG.max(options.min_angle_deg), |points| {
        delaunay(points, &edges)
    })?;
    let (angle_deg, centre) = worst_triangle(&mesh);
    if angle_deg < options.min_angle_deg {
        let limit_deg = options.min_angle_deg;
        return Err(MeshError::PoorAngle {
            angle_deg,
            limit_deg,
            x: centre.x,
            y: centre.y,
        });
    }
    Ok(mesh)
}

/// Triangles are repaired until no angle is smaller, degrees, whatever is accepted in the end.
const GOOD_DEG: f64 = 26.0;

/// Constrained Delaunay triangulation of the points, reduced to the triangles left of the given edges.
fn delaunay(points: &[Vec2], edges: &[[usize; 2]]) -> Result<Vec<[u32; 3]>, MeshError> {
    let wrong = |what, k: usize| MeshError::Outline {
        what,
        x: points[k].x,
        y: points[k].y,
    };
    let vertices = points.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let mut conflict = None;
    let cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
        vertices,
        edges.to_vec(),
        |e| {
            conflict.get_or_insert(e[0]);
        },
    )
    .map_err(|_| wrong("a coordinate is out of range", 0))?;
    if cdt.num_vertices() != points.len() {
        return Err(wrong("two points coincide", 0));
    }
    if let Some(k) = conflict {
        return Err(wrong("the outline crosses itself", k));
    }
    let mut inside = vec![false; cdt.num_all_faces()];
    let mut stack = Vec::new();
    for e in edges {
        let [a, b] = e.map(FixedVertexHandle::from_index);
        let edge = cdt
            .get_edge_from_neighbors(a, b)
            .filter(|e| cdt.is_constraint_edge(e.as_undirected().fix()));
        let face = edge.and_then(|e| e.face().as_inner());
        let face = face.ok_or_else(|| wrong("an outline edge passes through a point", e[0]))?;
        stack.push(face.fix());
    }
    let mut corners = Vec::with_capacity(2 * points.len());
    while let Some(face) = stack.pop() {
        if std::mem::replace(&mut inside[face.index()], true) {
            continue;
        }
        let face = cdt.face(face);
        corners.push(face.vertices().map(|v| v.fix().index() as u32));
        for e in face.adjacent_edges() {
            if !cdt.is_constraint_edge(e.as_undirected().fix()) {
                let next = e.rev().face().as_inner();
                let next =
                    next.ok_or_else(|| wrong("the outline is not closed", e.from().fix().index()))?;
                if !inside[next.fix().index()] {
                    stack.push(next.fix());
                }
            }
        }
    }
    Ok(corners)
}
