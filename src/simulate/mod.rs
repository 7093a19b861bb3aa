//! Floor 6: the forward model, from a gear pair and its conditions to a wear history.

pub mod checkpoint;
pub mod fields;
pub mod forward;
pub mod history;
pub mod members;
pub mod numerics;
pub mod result;
