//! Floor 4: contact between two flanks: mortar coupling, unilateral contact, load sharing.

pub mod unilateral;
pub mod mortar;
pub mod deposit;
pub mod cycle;
pub mod frame;
pub mod fem;
pub mod model;
