//! Floor 1: closed-form reference solutions, each with its own tests.

pub mod cantilever;
pub mod lame_ring;
