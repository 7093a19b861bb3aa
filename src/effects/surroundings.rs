//! Oil and heat around the contact: fills in what a [`Local`] says about film, friction and temperature.

use super::local::Local;
use crate::tribology::film::{Film, film_ratio};
use crate::tribology::flash_temperature::{HeatSource, flash_rise};
use crate::tribology::friction::{Flank, local_coefficient};

/// What the study states about oil and heat; anything may be missing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surroundings {
    /// Contact modulus E*, MPa.
    pub contact_modulus: f64,
    /// Dynamic viscosity, Pa s.
    pub viscosity_pa_s: Option<f64>,
    /// Pressure-viscosity coefficient, 1/GPa.
    pub pressure_viscosity_per_gpa: Option<f64>,
    /// Composite roughness Rq, µm.
    pub roughness_um: Option<f64>,
    /// Stated coefficient of friction: heats the contact, and stands for the local one where that cannot be told.
    pub friction_coefficient: Option<f64>,
    /// Thermal contact coefficient B_M, N/(m s^½ K).
    pub contact_coefficient: Option<f64>,
    /// Bulk temperature, °C.
    pub bulk_temperature_c: Option<f64>,
}

/// Bulk temperature where none is stated: the one at which lengths are measured, °C.
pub const REFERENCE_TEMPERATURE: f64 = 20.0;

/// Ra of one of two like flanks over their composite Rq: √(2/π) for Gaussian heights, over √2 for the composite.
const RA_PER_COMPOSITE_RQ: f64 = 0.564_189_583_547_756_3;

/// Least speed (mm/s), load (N/mm) and radius (mm) at which oil formulas are asked; they have poles at zero.
const FLOOR: f64 = 1e-3;

impl Surroundings {
    /// Sets `film_ratio`, `friction`, `flash_temperature` and `bulk_temperature` from the contact that `local` describes.
    ///
    /// Film: Dowson and Higginson's minimum over Rq. Friction: the local coefficient of [`crate::tribology::friction`] if viscosity and roughness are
    /// stated, else the stated one. Flash temperature: [`crate::tribology::flash_temperature`] with the stated friction.
    pub fn complete(&self, local: &mut Local) {
        let load = local.line_load.max(FLOOR);
        let radius = local.relative_radius().max(FLOOR);
        let rolling = local.rolling.map(|u| 1e3 * u);
        let sum = (rolling[0] + rolling[1]).abs().max(FLOOR);
        local.film_ratio = match (
            self.viscosity_pa_s,
            self.pressure_viscosity_per_gpa,
            self.roughness_um,
        ) {
            (Some(viscosity_pa_s), Some(pressure_viscosity_per_gpa), Some(roughness)) => {
                let film = Film {
                    load,
                    radius,
                    contact_modulus: self.contact_modulus,
                    entraining_speed: 0.5 * sum,
                    viscosity_pa_s,
                    pressure_viscosity_per_gpa,
                };
                film_ratio(film.minimum(), roughness)
            }
            _ => 0.0,
        };
        local.friction = match (self.viscosity_pa_s, self.roughness_um) {
            (Some(viscosity_pa_s), Some(roughness)) => local_coefficient(&Flank {
                load,
                rolling_sum: sum,
                radius,
                viscosity_pa_s,
                roughness_ra_um: RA_PER_COMPOSITE_RQ * roughness,
                lubricant: 1.0,
            }),
            _ => self.friction_coefficient.unwrap_or(0.0),
        };
        local.flash_temperature = match (self.friction_coefficient, self.contact_coefficient) {
            (Some(friction), Some(coefficient)) => flash_rise(
                &HeatSource {
                    load: local.line_load,
                    friction,
                    rolling,
                    half_width: local.half_width,
                },
                coefficient,
            ),
            _ => 0.0,
        };
        local.bulk_temperature = self.bulk_temperature_c.unwrap_or(REFERENCE_TEMPERATURE);
    }
}
