//! Floor 5: Archard wear of both flanks, and its integration over cycles.

pub mod acting;
pub mod archard;
pub mod factors;
mod in_turn;
pub mod integrator;
mod law;
pub mod passage;
mod shifted;
pub mod tangent;
