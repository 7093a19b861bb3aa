//! Floor 1: closed-form reference solutions, each with its own tests.

pub mod half_plane_elements;
pub mod hertz_line;
pub mod iso6336;
