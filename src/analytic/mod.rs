//! Floor 1: closed-form reference solutions, each with its own tests.

pub mod half_plane_elements;
