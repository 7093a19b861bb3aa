//! What the forward model needs of a study.

use super::{EffectSpec, Materials, Operation, Order, Study, Wear, effect};
use crate::contact::slices::Slices;
use crate::effects::Surroundings;
use crate::gear::Member;
use crate::material::{Elastic, contact_modulus};
use crate::simulate::forward::{Conditions, GearSet};
use crate::simulate::numerics::Numerics;
use crate::tribology::flash_temperature::contact_coefficient;
use crate::wear::acting::Acting;

impl Study {
    /// The gears with their materials at the temperature of `[operation]`.
    pub fn gear_set(&self) -> GearSet {
        self.gear_set_at(&self.operation)
    }

    /// The elastic constants of pinion and gear at the temperature of `conditions`.
    pub fn elastic_at(&self, conditions: &Operation) -> [Elastic; 2] {
        let Materials { pinion, gear } = self.materials;
        self.temperatures
            .elastic([pinion.elastic, gear.elastic], conditions)
    }

    /// `[wear]` at the temperature of `conditions`: a table's factor stands in the members' own.
    pub fn wear_at(&self, conditions: &Operation) -> Wear {
        let factor = self.temperatures.wear_factor(conditions);
        Wear {
            members: self.wear.members.map(|member| factor * member),
            ..self.wear
        }
    }

    /// The gears with their materials at the temperature of `conditions`.
    pub fn gear_set_at(&self, conditions: &Operation) -> GearSet {
        let Materials { pinion, gear } = self.materials;
        GearSet {
            gears: [self.gears.pinion.clone(), self.gears.gear.clone()],
            materials: self.elastic_at(conditions),
            densities: [pinion.density_kg_m3, gear.density_kg_m3],
            centre_distance: self.gears.centre_distance,
            face_width: self.gears.face_width,
            face: self.face.clone(),
            teeth: self.teeth.clone(),
        }
    }

    /// Resolution of the simulation.
    pub fn resolution(&self) -> Numerics {
        let stated = &self.numerics;
        let coefficient = self
            .lubricant
            .and_then(|l| l.friction_coefficient)
            .unwrap_or(0.0);
        Numerics {
            order: match stated.order {
                Order::Linear => 1,
                Order::Quadratic => 2,
            },
            elements_per_half_width: stated.elements_per_half_width as f64,
            gives_way: !stated.edges_stated,
            positions: self.positions(),
            step_tolerance: stated.step_tolerance,
            friction: if stated.friction { coefficient } else { 0.0 },
            ..Numerics::default()
        }
    }

    /// Mesh positions on a base pitch: those stated, or up to a quarter more where slices of helical gears come to lie nearer to their places.
    fn positions(&self) -> usize {
        let (stated, pitches) = (self.numerics.positions, self.gears.pinion.turned_per_mm());
        if pitches == 0.0 || self.face.slices < 2 {
            return stated;
        }
        Slices::even(self.face.slices, self.gears.face_width).positions_that_hold(pitches, stated)
    }

    /// Oil and heat around the contact under `conditions` (the study's operation or a test's, whose viscosity and bulk
    /// temperature they hold).
    ///
    /// Members of different density have the mean of their thermal contact coefficients B_M = √(k ρ c), N/(m s^½ K).
    pub fn surroundings(&self, conditions: &Operation) -> Surroundings {
        let Materials { pinion, gear } = self.materials;
        let lubricant = self.lubricant.unwrap_or_default();
        let thermal = self.thermal.unwrap_or_default();
        let heat = thermal.conductivity_w_mk.zip(thermal.specific_heat_j_kgk);
        let contact_coefficient = heat.map(|(conductivity, specific_heat)| {
            let of = |density| contact_coefficient(conductivity, density, specific_heat);
            0.5 * (of(pinion.density_kg_m3) + of(gear.density_kg_m3))
        });
        Surroundings {
            contact_modulus: {
                let [pinion, gear] = self.elastic_at(conditions);
                contact_modulus(pinion, gear)
            },
            viscosity_pa_s: conditions.viscosity_pa_s,
            pressure_viscosity_per_gpa: lubricant.pressure_viscosity_per_gpa,
            roughness_um: lubricant.roughness_um,
            friction_coefficient: lubricant.friction_coefficient,
            contact_coefficient,
            bulk_temperature_c: conditions.bulk_temperature_c,
            flank_temperature_c: conditions.flank_temperature_c,
        }
    }

    /// Whether the study states an optional key of `[lubricant]` or `[thermal]` that effects may need
    /// (`lubricant.viscosity`).
    pub fn states(&self, key: &str) -> bool {
        effect::is_stated(key, self.lubricant, self.thermal)
    }

    /// Whether the study states every optional key that an effect needs with its values, and what it needs besides can be.
    pub fn suits(&self, effect: &EffectSpec) -> bool {
        let of_teeth = effect.acts_on_teeth();
        effect.needs().iter().all(|key| self.states(key)) && !(of_teeth && self.face.slices > 1)
    }

    /// Whether the study's tables by temperature, if it has any, hold a bulk temperature.
    pub fn holds_temperature(&self, celsius: f64) -> bool {
        self.temperatures.hold(celsius)
    }

    /// Whether the bulk temperatures of the tests differ.
    pub fn temperatures_differ(&self) -> bool {
        let of = |test: &super::Test| test.conditions.bulk_temperature_c;
        self.tests.windows(2).any(|two| of(&two[0]) != of(&two[1]))
    }

    /// The study's effects with their stated values under some conditions; `None` if it has none.
    pub fn acting(&self, conditions: &Operation) -> Option<Acting> {
        let effects = self.effect_model().stated();
        (!effects.is_empty()).then(|| Acting {
            effects,
            surroundings: self.surroundings(conditions),
            torque: 1e-3 * conditions.torque_nmm,
            speed: conditions.speed_rpm,
            reversed: conditions.reversed,
            face_width: self.gears.face_width,
        })
    }

    /// Names of the members whose mesh is the user's own.
    pub fn own_meshes(&self) -> [(Member, Option<&std::path::Path>); 2] {
        [
            (Member::Pinion, self.numerics.mesh_pinion.as_deref()),
            (Member::Gear, self.numerics.mesh_gear.as_deref()),
        ]
    }
}

impl Operation {
    /// The conditions of a simulation with the wear coefficients of `wear`.
    pub fn simulated(&self, wear: &Wear) -> Conditions {
        Conditions {
            torque: self.torque_nmm,
            speed: self.speed_rpm,
            misalignment: self.misalignment_mm,
            cycles: self.cycles,
            coefficient: wear.members.map(|factor| factor * wear.coefficient),
        }
    }
}
