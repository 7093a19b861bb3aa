//! gearwear: finite-element contact and wear of spur and helical gears.
//!
//! ```text
//! study.toml -> study::Study -> simulate::Setup -> wear history -> simulate::Run -> report
//!                                  gear::Pair -> mesh::Mesh -> fem::Body -> contact -> wear
//! ```
//!
//! Modules stand on floors; a module imports itself and floors below its own only (`tests/layers.rs` guards this).
//! Lengths are mm, forces N, stresses MPa (N/mm²) throughout; angles are radians inside the program.
//!
//! A study's wear with the analytic contact model; `members` in place of `None` makes it finite elements:
//!
//! ```
//! use gearwear::simulate::forward::Forward;
//! use gearwear::study::Study;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let study = Study::parse(
//!     r#"
//!     [gears]
//!     module = 2.0
//!     pressure_angle = 20.0
//!     face_width = 33.0
//!     [gears.pinion]
//!     teeth = 27
//!     bore_diameter = 25.0
//!     [gears.gear]
//!     teeth = 53
//!     bore_diameter = 40.0
//!     [material]
//!     youngs_modulus = 2.1e5
//!     poisson_ratio = 0.3
//!     density = 7850.0
//!     [operation]
//!     torque = 100.0
//!     speed = 2000.0
//!     [wear]
//!     coefficient = 6e-10
//!     cycles = 1e4
//!     [numerics]
//!     elements_per_half_width = 2
//!     positions = 30
//!     "#,
//!     "study.toml",
//! )?;
//! let set = study.gear_set();
//! let conditions = study.operation.simulated(&study.wear);
//! let mut forward = Forward::new(&set, None, conditions, study.resolution())?;
//!
//! let mut deepest = 0.0;
//! forward.wear(&mut None, &[conditions.cycles], &mut |_| true, &mut |state| {
//!     deepest = state.depth[0].iter().copied().fold(0.0, f64::max);
//! })?;
//! assert!(deepest > 1e-4 && deepest < 2e-3, "{deepest} mm");
//! # Ok(())
//! # }
//! ```

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
pub mod serve;
pub mod simulate;
pub mod source_text;
pub mod study;
pub mod tribology;
pub mod verify;
pub mod wear;
