//! The laws: one file for each effect of the catalogue.

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
mod lead_crowning;
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
mod run_out;
mod running_in;
mod severe_transition;
mod shaft_deflection;
mod sliding_speed_exponent;
mod surface_layer;
mod thermal_expansion;
mod tip_relief;

use super::Card;

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
    &lead_crowning::CARD,
    &shaft_deflection::CARD,
    &radial_misalignment::CARD,
    &tip_relief::CARD,
    &profile_slope::CARD,
    &profile_form::CARD,
    &pitch_error::CARD,
    &run_out::CARD,
];
