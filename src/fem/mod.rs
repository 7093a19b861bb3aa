//! Floor 3: plane-strain linear elasticity: elements, assembly, sparse Cholesky, condensation onto the flanks, stresses.
//!
//! ```text
//! strong form    div σ = 0,  σ = λ tr(ε) I + 2 μ ε,  ε = sym grad u,  ε_zz = 0;  u given on supports, σ n = t elsewhere
//! discrete       K u = f    K = ∫ Bᵀ D B dA,  f = ∫ Nᵀ t ds           T3 or T6 triangles, two unknowns a node
//! solved         K = L Lᵀ   fixed unknowns left out, interface unknowns last
//! condensed      C = (K⁻¹)_ii = L_ii⁻ᵀ L_ii⁻¹                       what contact and wear work with
//! ```
//! All quantities are per mm of width. Small strain, one homogeneous isotropic material, no thermal strain, no inertia;
//! nothing varies across the width, but in `waves`: loads that vary across it as a cosine.

mod assemble;
mod body;
mod cholesky;
mod compliance;
mod dirichlet;
mod error;
mod free_ends;
mod loads;
mod ordering;
mod stress;
pub mod structured;
mod triangle;
mod waves;

pub use assemble::{
    ElementStiffness, element_stiffness, internal_forces, lame_constants, plane_stress_equivalent,
    strain_energy,
};
pub use body::{Body, Solution};
pub use compliance::Compliance;
pub use dirichlet::Axis;
pub use error::FemError;
pub use free_ends::{EndAnswer, EndModes, EndShape, FreeEnds};
pub use loads::{body_force, edge_traction};
pub use stress::{Stress, element_stress, largest_principal, nodal_stress, stress_at};
pub use triangle::{Element, ShapeAt, element_count, elements, shape};
pub use waves::{Prism, Wave};

/// Largest accepted relative residual ‖K u − f‖ / ‖f‖ of a linear solution.
///
/// Where rounding of K u itself is larger (8 epsilon ‖ |K| |u| ‖ / ‖f‖; nearly incompressible or very soft bodies on fine
/// meshes) that is accepted instead: no better u exists in double precision.
pub const RESIDUAL_LIMIT: f64 = 1e-10;
