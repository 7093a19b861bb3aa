//! What can go wrong while a mesh is made, moved or read.

use std::path::PathBuf;

use crate::gear::{Member, Thinnest};

/// Why there is no mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// A number of the mesh specification lies outside its range.
    #[error("mesh: {name} = {value}, allowed {allowed}")]
    Spec {
        /// Which number.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed, in words.
        allowed: String,
    },
    /// The outline is not a set of simple closed loops.
    #[error("outline: {what} near ({x:.4}, {y:.4}) mm")]
    Outline {
        /// What is wrong.
        what: &'static str,
        /// Place, mm.
        x: f64,
        /// Place, mm.
        y: f64,
    },
    /// The size field asks for more points than the cap.
    #[error("the element sizes ask for more than {cap} points; use larger elements")]
    TooManyPoints {
        /// The largest number of interior points allowed.
        cap: usize,
    },
    /// A triangle stayed too thin after all repair attempts.
    #[error(
        "smallest angle {angle_deg:.2} degrees near ({x:.4}, {y:.4}) mm, at least {limit_deg} is needed"
    )]
    PoorAngle {
        /// The smallest angle, degrees.
        angle_deg: f64,
        /// The limit, degrees.
        limit_deg: f64,
        /// Centre of that triangle, mm.
        x: f64,
        /// Centre of that triangle, mm.
        y: f64,
    },
    /// An element is turned inside out somewhere.
    #[error(
        "element {element} near ({x:.4}, {y:.4}) mm has Jacobian {jacobian:.3e} mm²; the body must be meshed again"
    )]
    Inverted {
        /// Element number, from 0.
        element: usize,
        /// Smallest Jacobian determinant over the checked points, mm².
        jacobian: f64,
        /// Centre of that element, mm.
        x: f64,
        /// Centre of that element, mm.
        y: f64,
    },
    /// Wear has taken most of a tooth.
    #[error(
        "a tooth{} is worn to a point: {:.4} mm deep at radius {:.4} mm, where {:.4} mm of its thickness are left; fewer cycles or a smaller wear coefficient leave more",
        .of.map_or(String::new(), |member| format!(" of the {member}")), .at.depth, .at.radius, .at.left
    )]
    WornThrough {
        /// Where.
        at: Thinnest,
        /// Whose tooth, if known.
        of: Option<Member>,
    },
    /// A displacement list does not fit the flank it is for.
    #[error("flank {flank}: {given} displacements for {nodes} nodes")]
    WrongLength {
        /// Index of the flank chain.
        flank: usize,
        /// Number of displacements given.
        given: usize,
        /// Number of nodes of the chain.
        nodes: usize,
    },
    /// A mesh file cannot be used.
    #[error("{}: {problem}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong and what is allowed.
        problem: String,
    },
}

impl MeshError {
    /// The same with the member's name, where that helps.
    #[must_use]
    pub fn of(self, member: Member) -> Self {
        match self {
            Self::WornThrough { at, .. } => Self::WornThrough {
                at,
                of: Some(member),
            },
            other => other,
        }
    }
}
