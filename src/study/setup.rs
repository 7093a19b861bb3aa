//! What the forward model needs of a study.

use super::{Materials, Operation, Order, Study, Wear};
use crate::gear::Member;
use crate::simulate::forward::{Conditions, GearSet};
use crate::simulate::numerics::Numerics;

impl Study {
    /// The gears with their materials.
    pub fn gear_set(&self) -> GearSet {
        let Materials { pinion, gear } = self.materials;
        GearSet {
            gears: [self.gears.pinion.clone(), self.gears.gear.clone()],
            materials: [pinion.elastic, gear.elastic],
            densities: [pinion.density_kg_m3, gear.density_kg_m3],
            centre_distance: self.gears.centre_distance,
            face_width: self.gears.face_width,
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
            positions: stated.positions,
            step_tolerance: stated.step_tolerance,
            friction: if stated.friction { coefficient } else { 0.0 },
            ..Numerics::default()
        }
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
    /// The conditions of a simulation with the wear coefficient of `wear` on both members.
    pub fn simulated(&self, wear: &Wear) -> Conditions {
        Conditions {
            torque: self.torque_nmm,
            speed: self.speed_rpm,
            misalignment: self.misalignment_mm,
            cycles: self.cycles,
            coefficient: [wear.coefficient; 2],
        }
    }
}
