//! Floor 3: physical effects that the base model lacks: one file each, and a user's own by formula.
//!
//! ```text
//! CATALOGUE -> Card { formula, source, parameters with ranges and priors } -> build -> Box<dyn Effect> -> hooks
//! study's expression -> formula::Formula -------------------------------------------^
//! ```
//! The base model is dry Archard wear with one constant coefficient for both members; frictionless, quasi-static contact;
//! perfect involutes at the nominal centre distance, all teeth alike. An effect is a pure function of what its hook is
//! given ([`Local`], [`ProfileAt`], [`OperationState`]) and knows no mesh and no solver.
//!
//! To add one: a file with a `CARD` and an `impl Effect`, its `mod` line and its line in [`CATALOGUE`].

mod card;
mod combined;
mod effect;
mod error;
mod expression;
pub mod formula;
mod local;
mod prior;
mod surroundings;
pub mod variables;

mod approach_recess;
mod bearing_compliance;
mod coating;
mod corrosive_loss;
mod debris_abrasion;
mod dynamic_load;
mod energy_wear;
mod extra_flexibility;
mod film_thickness;
mod flash_temperature;
mod friction_load;
mod lead_misalignment;
mod lubricant_ageing;
mod member_hardness;
mod micropitting;
mod oxidative;
mod pitch_error;
mod plastic_deformation;
mod pressure_exponent;
mod profile_form;
mod profile_slope;
mod radial_misalignment;
mod roughness_polish;
mod running_in;
mod severe_transition;
mod sliding_speed_exponent;
mod surface_layer;
mod thermal_expansion;
mod tip_relief;

pub use card::{Card, Form, Param};
pub use combined::Combined;
pub use effect::{Effect, Hook, OperationChange, OperationState};
pub use error::EffectError;
pub use local::{Local, ProfileAt, SLIDING_FLOOR};
pub use prior::Prior;
pub use surroundings::{REFERENCE_TEMPERATURE, Surroundings};

/// Every effect there is, in the order in which they are listed.
pub static CATALOGUE: &[&Card] = &[
    &running_in::CARD,
    &pressure_exponent::CARD,
    &severe_transition::CARD,
    &film_thickness::CARD,
    &flash_temperature::CARD,
    &sliding_speed_exponent::CARD,
    &oxidative::CARD,
    &surface_layer::CARD,
    &coating::CARD,
    &micropitting::CARD,
    &debris_abrasion::CARD,
    &lubricant_ageing::CARD,
    &corrosive_loss::CARD,
    &approach_recess::CARD,
    &member_hardness::CARD,
    &energy_wear::CARD,
    &roughness_polish::CARD,
    &plastic_deformation::CARD,
    &friction_load::CARD,
    &dynamic_load::CARD,
    &extra_flexibility::CARD,
    &bearing_compliance::CARD,
    &thermal_expansion::CARD,
    &lead_misalignment::CARD,
    &radial_misalignment::CARD,
    &tip_relief::CARD,
    &profile_slope::CARD,
    &profile_form::CARD,
    &pitch_error::CARD,
];

/// The card of an effect.
///
/// # Errors
/// [`EffectError::UnknownEffect`] with the nearest name.
pub fn find(name: &str) -> Result<&'static Card, EffectError> {
    CATALOGUE
        .iter()
        .find(|card| card.name == name)
        .copied()
        .ok_or_else(|| EffectError::UnknownEffect {
            name: name.to_owned(),
            nearest: error::nearest(name, CATALOGUE.iter().map(|card| card.name))
                .unwrap_or_default()
                .to_owned(),
        })
}
