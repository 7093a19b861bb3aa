//! Floor 3: physical effects that the base model lacks: one file each in `laws`, a user's own by formula, and laws learned from
//! measurements.
//!
//! ```text
//! CATALOGUE -> Card { formula, source, parameters with ranges and priors } -> build -> Box<dyn Effect> -> hooks
//! study's expression -> formula::Formula -------------------------------------------^
//! knots and values   -> Learned ----------------------------------------------------^
//! ```
//! The base model is dry Archard wear with one constant coefficient for both members; frictionless, quasi-static contact;
//! perfect involutes at the nominal centre distance, all teeth alike. An effect is a pure function of what its hook is
//! given ([`Local`], [`ProfileAt`], [`OperationState`]) and knows no mesh and no solver.
//!
//! To add one: a file in `laws` with a `CARD` and an `impl Effect`, its `mod` line and its line in [`CATALOGUE`] there. Nothing outside
//! `laws` knows an effect by its name.

mod card;
mod combined;
mod effect;
mod error;
mod expression;
pub mod formula;
mod laws;
mod learned;
mod local;
mod prior;
mod surroundings;
pub mod variables;

pub use card::{Card, Form, Param, ParamRole};
pub use combined::Combined;
pub use effect::{
    Effect, FaceAt, Hook, Impossible, OperationChange, OperationState, Tooth, UsualTrace,
};
pub use error::EffectError;
pub use laws::CATALOGUE;
pub use learned::{LARGEST_LOGARITHM, Learned, LearnedError};
pub use local::{Local, ProfileAt, SLIDING_FLOOR};
pub use prior::Prior;
pub use surroundings::{LineContact, OilAndHeat, REFERENCE_TEMPERATURE, Surroundings};

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
