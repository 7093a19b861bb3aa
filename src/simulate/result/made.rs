//! What the study states of the gears and of friction, for the record of a run.

use crate::gear::{Face, Teeth};

/// How the gears are made, as the study states it: of helical gears in the normal section.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Made {
    /// Centre distance without misalignment, mm.
    pub centre_distance: f64,
    /// Addendum of the basic rack, modules.
    pub addendum: f64,
    /// Dedendum of the basic rack, modules.
    pub dedendum: f64,
    /// Tip radius of the cutting rack, modules.
    pub fillet_radius: f64,
    /// Pinion and gear.
    pub wheels: [MadeWheel; 2],
    /// What the flanks lack across the face.
    pub face: Face,
    /// Where the teeth stand.
    pub teeth: Teeth,
}

/// How one member is made.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MadeWheel {
    /// What is taken off the tooth's thickness at the reference circle, mm.
    pub thickness_reduction: f64,
    /// Linear tip relief at the tip circle, µm.
    pub tip_relief_um: f64,
    /// Its length along the path of contact, mm.
    pub tip_relief_length: f64,
    /// Radius of the rounding at the tip corner, mm.
    pub tip_rounding: f64,
    /// Whether a measured profile was given.
    pub measured_profile: bool,
}

/// Which friction was used for what.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Friction {
    /// Coefficient of Coulomb friction in the contact, 0 for none.
    pub contact: f64,
    /// Whether the study asks for it and the contact model knows none.
    pub not_used: bool,
    /// Whether effects put friction into the contact besides.
    pub by_effects: bool,
    /// The stated coefficient, of which the flash temperature follows.
    pub stated: Option<f64>,
    /// What losses are computed with.
    pub losses: LossFriction,
}

/// The friction that losses are computed with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LossFriction {
    /// None follows from the study.
    #[default]
    Unknown,
    /// The stated coefficient.
    Stated,
    /// The local one, of viscosity, roughness, load and speed.
    FromOil,
}
