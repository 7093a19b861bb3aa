//! Floor 1: closed-form reference solutions, each with its own tests.
//!
//! Contact: [`hertz_line`], [`cattaneo`], [`half_plane`]. Wear: [`winkler`], [`punch_wear`], [`cylinder_wear`],
//! [`archard_pass`]. Gears: [`iso6336`]. Elasticity: [`lame_ring`],
//! [`cantilever`]. Forces are per mm of width unless said otherwise.

pub mod archard_pass;
pub mod cantilever;
pub mod cattaneo;
pub mod cylinder_wear;
pub mod half_plane;
pub mod half_plane_elements;
pub mod hertz_line;
pub mod iso6336;
pub mod lame_ring;
pub mod punch_wear;
pub mod winkler;
