//! Floor 4: contact between two flanks: mortar coupling, unilateral contact, load sharing.

pub mod alteration;
pub mod cycle;
pub mod deposit;
pub mod fem;
pub mod frame;
pub mod hertz;
pub mod model;
pub mod mortar;
mod touch;
pub mod unilateral;
