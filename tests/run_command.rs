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
mod common;
#[path = "common/vtu.rs"]
mod vtu;

#[path = "run_command/face.rs"]
mod face;
#[path = "run_command/failures.rs"]
mod failures;
#[path = "run_command/files.rs"]
mod files;
#[path = "run_command/friction.rs"]
mod friction;
#[path = "run_command/home.rs"]
mod home;
#[path = "run_command/inputs.rs"]
mod inputs;
#[path = "run_command/kinks.rs"]
mod kinks;
#[path = "run_command/models.rs"]
mod models;
#[path = "run_command/moved_nodes.rs"]
mod moved_nodes;
#[path = "run_command/oil_and_heat.rs"]
mod oil_and_heat;
#[path = "run_command/own_mesh.rs"]
mod own_mesh;
#[path = "run_command/random.rs"]
mod random;
#[path = "run_command/refusals.rs"]
mod refusals;
#[path = "run_command/resume.rs"]
mod resume;
#[path = "run_command/threads.rs"]
mod threads;
