//! What a model predicts of the measurements of a test, with derivatives.
//!
//! ```text
//! Bench (tests on gears and meshes) -> GearModel (wear histories) -> observe -> Evaluator (each point once)
//! ```

pub(super) mod anchored;
pub(super) mod bench;
pub(super) mod evaluate;
pub(super) mod fidelity;
pub(super) mod gear_model;
mod mountings;
pub(super) mod observe;
pub(super) mod predictor;
pub(super) mod standard_test;
pub(super) mod trajectory;
