//! Claim: `gearwear run` as a whole keeps its word. Its files hold the promised keys and columns and agree with each other; its
//! results do not depend on threads, on being killed and resumed, or on whether a mesh was made here or read; unusable input is
//! refused with exit code 2 and nothing written; what fails midway ends with exit code 1, says where, and leaves no result.
//!
//! Source: the command and file tables of the README; equilibrium and Reye's balance (worn area = k ∮ F' |v| dt); plane geometry
//! (normals of an involute are tangents of its base circle, the shoelace formula); the wear depth that Kumar, Hirani & Agrawal
//! (2018) print for their point 23. Tolerances stand, with their reasons, in the files of `run_command/`.
//!
//! The runs are coarse (two linear elements per Hertz half width, 30 positions): they last about a second, and what is claimed
//! here holds at any resolution. How figures converge is shown by `gearwear validate`.

mod face;
mod failures;
mod files;
mod friction;
mod home;
mod inputs;
mod kinks;
mod models;
mod moved_nodes;
mod oil_and_heat;
mod own_mesh;
mod random;
mod refusals;
mod resume;
mod threads;
