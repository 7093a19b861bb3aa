//! Floor 6: the forward model, from a gear pair and its conditions to a wear history.

pub mod balance;
pub mod blanks;
pub mod checkpoint;
pub mod deck;
pub mod fields;
pub mod forward;
pub mod gather;
pub mod gear_set;
pub mod history;
mod kinks;
pub mod members;
pub mod models;
pub mod numerics;
mod oil_and_heat;
pub mod one_position;
pub mod paper_run;
pub mod result;
pub mod root_stress;
pub mod run;
mod stated;
pub mod touching_strip;
mod turn;
pub mod wear_state;
pub mod worn_away;
