//! Floor 2: formulas of lubrication and friction that effects and contact share.
//!
//! Plain numbers in, plain numbers out. Lengths mm, speeds mm/s, loads N/mm, stresses MPa; oil data keep the units they are
//! quoted in, and then the name says so (`viscosity_pa_s`).

pub mod film;
pub mod flash_temperature;
pub mod friction;
pub mod sliding;
pub mod tooth_temperature;

#[cfg(test)]
mod tests;
