//! Floor 4: contact between two flanks: mortar coupling, unilateral contact, load sharing.

pub mod alteration;
pub mod contact_point;
pub mod cycle;
pub mod deposit;
pub mod fem;
pub mod frame;
pub mod hertz;
pub mod model;
pub mod mortar;
pub mod sequence;
pub mod slices;
pub mod strips;
pub mod tangent;
pub mod unilateral;
