//! Elements and linear solver: cases A1 to A9.
//!
//! Each function runs one case on regular meshes and returns its figures; targets come from closed forms (`analytic`) or
//! from the literature named at the function.

mod elements;
mod manufactured;
mod membranes;
mod ring;

pub use elements::{a1_patch, a2_rigid_motion};
pub use manufactured::a3_manufactured;
pub use membranes::{a6_elliptic_membrane, a7_cantilever, a8_cook, a9_residual};
pub use ring::{a4_thick_ring, a5_nearly_incompressible, linear_triangle_locking};

use crate::material::Elastic;

/// The steel of the cases that name no other material: E 210 000 MPa, nu 0.3.
const STEEL: Elastic = Elastic {
    youngs_modulus: 2.1e5,
    poisson_ratio: 0.3,
};
