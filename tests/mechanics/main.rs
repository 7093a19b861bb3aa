//! The forward model: gears, elasticity, contact, wear and the effects, against closed forms, benchmarks and published numbers.
//!
//! Few targets, each of many files: every target links the whole library anew, and tests of one target share both cores.

mod analytic;
#[path = "../common/mod.rs"]
mod common;
mod contact_cases;
mod derivatives;
mod effects;
mod effects_in_a_run;
mod elasticity;
mod face;
mod gear_cases;
mod gear_geometry;
mod helix;
mod mesh_quality;
mod models;
mod paper_model;
mod study_effects;
mod teeth;
mod tied_slices;
mod wear_cases;
