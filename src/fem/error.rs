//! What can go wrong between a mesh and its displacements.

use crate::numeric::Vec2;

/// Refusals of the elastic solver, with the values that caused them.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FemError {
    /// The mesh has no triangles or no points.
    #[error("the mesh has no triangles")]
    Empty,
    /// A constant outside the range of a stable isotropic solid.
    #[error(
        "Young's modulus {youngs_modulus} MPa and Poisson's ratio {poisson_ratio} are not a stable elastic solid; E > 0 and -1 < nu < 0.5 are needed"
    )]
    Material {
        /// Young's modulus, MPa.
        youngs_modulus: f64,
        /// Poisson's ratio.
        poisson_ratio: f64,
    },
    /// A coordinate, load or prescribed displacement is NaN or infinite.
    #[error("{what} of node {node} is not finite: ({}, {})", .value.x, .value.y)]
    NotFinite {
        /// Which quantity.
        what: &'static str,
        /// Node number.
        node: u32,
        /// The value found.
        value: Vec2,
    },
    /// A node number beyond the mesh.
    #[error("{what} names node {node}, but the mesh has {count} nodes")]
    UnknownNode {
        /// Who names it.
        what: &'static str,
        /// The number.
        node: u32,
        /// Nodes of the mesh.
        count: usize,
    },
    /// A node stands twice in the interface.
    #[error("node {node} stands twice in the interface")]
    RepeatedInterfaceNode {
        /// Node number.
        node: u32,
    },
    /// A free node belongs to no triangle.
    #[error("node {node} belongs to no triangle and is not fixed")]
    UnusedNode {
        /// Node number.
        node: u32,
    },
    /// A triangle is inverted or has no area.
    #[error("triangle {element} is inverted or flat: Jacobian {jacobian} mm² at ({}, {})", .at.x, .at.y)]
    Inverted {
        /// Element number.
        element: usize,
        /// Jacobian determinant, mm².
        jacobian: f64,
        /// Where, mm.
        at: Vec2,
    },
    /// A connected part of the mesh can move as a rigid body.
    #[error(
        "the part of the mesh around node {node} can move as a rigid body in {free} of 3 ways; fix more nodes"
    )]
    MissingSupport {
        /// A node of the part.
        node: u32,
        /// Number of rigid motions left.
        free: usize,
    },
    /// The stiffness matrix is not positive definite, though every part is supported (for instance two parts joined in one node).
    #[error(
        "the stiffness matrix is not positive definite near node {node} (pivot ratio {ratio:e})"
    )]
    NotPositiveDefinite {
        /// The node whose pivot failed.
        node: u32,
        /// Pivot over diagonal entry; 0 when the pivot was not positive.
        ratio: f64,
    },
    /// A displacement is prescribed where the body is not fixed.
    #[error("a displacement is prescribed at node {node} in {axis:?}, which is not fixed")]
    PrescribedFree {
        /// Node number.
        node: u32,
        /// Direction.
        axis: super::Axis,
    },
    /// The linear solution is not accurate enough.
    #[error("relative residual {residual:e} of the linear solution is above {limit:e}")]
    Residual {
        /// The residual, ‖K u − f‖ / ‖f‖.
        residual: f64,
        /// The limit.
        limit: f64,
    },
    /// New coordinates come with another topology.
    #[error("the mesh has other triangles than the one analysed; build a new body")]
    TopologyChanged,
    /// The displacement field has another length than the mesh.
    #[error("{found} displacements for {expected} nodes")]
    FieldLength {
        /// Values given.
        found: usize,
        /// Nodes of the mesh.
        expected: usize,
    },
    /// The factor does not fit into memory or into 32-bit indices.
    #[error("the factorisation of {unknowns} unknowns ran out of memory or index range")]
    TooLarge {
        /// Unknowns.
        unknowns: usize,
    },
}
