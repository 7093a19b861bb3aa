//! gearwear: finite-element contact and wear of spur gears.
//!
//! ```text
//! study.toml -> study::Study -> simulate::Setup -> wear history -> simulate::Run -> report
//!                                  gear::Pair -> mesh::Mesh -> fem::Body -> contact -> wear
//! ```
//!
//! Modules stand on floors; a module imports itself and floors below its own only (`tests/layers.rs` guards this).
//! Lengths are mm, forces N, stresses MPa (N/mm²) throughout; angles are radians inside the program.

pub mod analytic;
pub mod cli;
pub mod contact;
pub mod effects;
pub mod fem;
pub mod gear;
pub mod learn;
pub mod material;
pub mod measure;
pub mod mesh;
pub mod numeric;
pub mod paper;
pub mod report;
pub mod simulate;
pub mod source_text;
pub mod study;
pub mod tribology;
pub mod verify;
pub mod wear;
