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
    /// Stated coefficient of friction: heats the contact, and stands for the local one where that is not known.
    pub friction_coefficient: Option<f64>,
    /// Thermal contact coefficient B_M, N/(m s^½ K).
    pub contact_coefficient: Option<f64>,
    /// Bulk temperature, °C.
    pub bulk_temperature_c: Option<f64>,
    /// Temperature of the flanks, °C; above that of the bulk where friction losses warm the teeth.
    pub flank_temperature_c: Option<f64>,
}

/// Bulk temperature where none is stated: the one at which lengths are measured, °C.
pub const REFERENCE_TEMPERATURE: f64 = 20.0;

/// Ra of one of two like flanks over their composite Rq: √(2/π) for Gaussian heights, over √2 for the composite.
const RA_PER_COMPOSITE_RQ: f64 = 0.564_189_583_547_756_3;

/// Least speed (mm/s), load (N/mm) and radius (mm) at which oil formulas are asked; they have poles at zero.
const FLOOR: f64 = 1e-3;

/// A line contact as film, friction and heat see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineContact {
    /// Load per face width, N/mm.
    pub line_load: f64,
    /// Relative radius of curvature, mm.
    pub relative_radius: f64,
    /// Rolling speeds of pinion and gear flank, m/s.
    pub rolling: [f64; 2],
    /// Half width, mm.
    pub half_width: f64,
}

/// Film, friction and heat of a contact; none where the study does not state what it follows from.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OilAndHeat {
    /// Film ratio λ.
    pub film_ratio: Option<f64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Rise of the contact temperature over the bulk, K.
    pub flash_temperature: Option<f64>,
}

impl Surroundings {
    /// Temperatures of flank and root where friction losses make them, °C: stated ones are the same for both.
    pub fn warmed_teeth_c(&self) -> Option<[f64; 2]> {
        let (flank, root) = self.flank_temperature_c.zip(self.bulk_temperature_c)?;
        (flank != root).then_some([flank, root])
    }

    /// Sets `film_ratio`, `friction`, `flash_temperature` and `bulk_temperature` from the contact that `local` describes; 0 where
    /// [`Surroundings::at`] has none.
    pub fn complete(&self, local: &mut Local) {
        let found = self.at(&LineContact {
            line_load: local.line_load,
            relative_radius: local.relative_radius(),
            rolling: local.rolling,
            half_width: local.half_width,
        });
        local.film_ratio = found.film_ratio.unwrap_or(0.0);
        local.friction = found.friction.unwrap_or(0.0);
        local.flash_temperature = found.flash_temperature.unwrap_or(0.0);
        local.bulk_temperature = self.bulk_temperature_c.unwrap_or(REFERENCE_TEMPERATURE);
    }

    /// Film, friction and heat of `contact`.
    ///
    /// Film: Dowson and Higginson's minimum over Rq. Friction: the local coefficient of [`crate::tribology::friction`] if viscosity and roughness are
    /// stated, else the stated one. Flash temperature: [`crate::tribology::flash_temperature`] with the stated friction.
    pub fn at(&self, contact: &LineContact) -> OilAndHeat {
        let load = contact.line_load.max(FLOOR);
        let radius = contact.relative_radius.max(FLOOR);
        let rolling = contact.rolling.map(|u| 1e3 * u);
        let sum = (rolling[0] + rolling[1]).abs().max(FLOOR);
        let oil = self.viscosity_pa_s.zip(self.roughness_um);
        let film = oil.zip(self.pressure_viscosity_per_gpa);
        let heat = self.friction_coefficient.zip(self.contact_coefficient);
        OilAndHeat {
            film_ratio: film.map(
                |((viscosity_pa_s, roughness), pressure_viscosity_per_gpa)| {
                    let film = Film {
                        load,
                        radius,
                        contact_modulus: self.contact_modulus,
                        entraining_speed: 0.5 * sum,
                        viscosity_pa_s,
                        pressure_viscosity_per_gpa,
                    };
                    film_ratio(film.minimum(), roughness)
                },
            ),
            friction: match oil {
                Some((viscosity_pa_s, roughness)) => Some(local_coefficient(&Flank {
                    load,
                    rolling_sum: sum,
                    radius,
                    viscosity_pa_s,
                    roughness_ra_um: RA_PER_COMPOSITE_RQ * roughness,
                    lubricant: 1.0,
                })),
                None => self.friction_coefficient,
            },
            flash_temperature: heat.map(|(friction, coefficient)| {
                let source = HeatSource {
                    load: contact.line_load,
                    friction,
                    rolling,
                    half_width: contact.half_width,
                };
                flash_rise(&source, coefficient)
            }),
        }
    }
}
