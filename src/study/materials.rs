//! `[material]`, `[lubricant]`, `[thermal]`: what the bodies and the oil are made of.

use super::quantity as q;
use super::reader::Table;
use crate::gear::Member;
use crate::material::Elastic;
use crate::source_text::{Diagnostic, Fault};

pub(super) const MATERIAL_KEYS: &[&str] = &[
    "youngs_modulus",
    "poisson_ratio",
    "density",
    "temperatures",
    "moduli",
];
pub(super) const MATERIAL_TABLE_KEYS: &[&str] = &[
    "youngs_modulus",
    "poisson_ratio",
    "density",
    "temperatures",
    "moduli",
    "pinion",
    "gear",
];
pub(super) const LUBRICANT_KEYS: &[&str] = &[
    "viscosity",
    "pressure_viscosity",
    "roughness",
    "friction_coefficient",
];
pub(super) const THERMAL_KEYS: &[&str] = &[
    "bulk_temperature",
    "conductivity",
    "specific_heat",
    "tooth_temperature",
    "ambient_temperature",
    "housing_resistance",
    "duty",
];

/// What one member is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus (MPa) and Poisson's ratio.
    pub elastic: Elastic,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
}

/// The materials of both members.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Materials {
    /// Of the pinion.
    pub pinion: Material,
    /// Of the gear; the same if the study has one `[material]`.
    pub gear: Material,
}

impl Materials {
    /// The material of `member`.
    pub fn of(&self, member: Member) -> &Material {
        match member {
            Member::Pinion => &self.pinion,
            Member::Gear => &self.gear,
        }
    }
}

/// `[lubricant]`; who needs a value that is not stated says so.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Lubricant {
    /// Dynamic viscosity at the operating temperature, Pa s.
    pub viscosity_pa_s: Option<f64>,
    /// Pressure viscosity coefficient, 1/GPa.
    pub pressure_viscosity_per_gpa: Option<f64>,
    /// Composite roughness Rq, µm.
    pub roughness_um: Option<f64>,
    /// Coefficient of friction.
    pub friction_coefficient: Option<f64>,
}

/// `[thermal]`; who needs a value that is not stated says so.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Thermal {
    /// Bulk temperature of the teeth, °C.
    pub bulk_temperature_c: Option<f64>,
    /// Heat conductivity, W/(m K).
    pub conductivity_w_mk: Option<f64>,
    /// Specific heat, J/(kg K).
    pub specific_heat_j_kgk: Option<f64>,
    /// Whether the teeth's temperature follows from friction losses where a test states none (VDI 2736 part 2).
    pub warm: bool,
    /// Temperature around the gears, °C; with `warm`.
    pub ambient_c: f64,
    /// Resistance of the housing to heat over its surface, K/W; with `warm`.
    pub housing_k_w: f64,
    /// Part of the time that the gears run; with `warm`.
    pub duty: f64,
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

pub(super) fn read(root: &Table<'_>) -> Result<Materials> {
    let table = root.required_table("material", MATERIAL_TABLE_KEYS)?;
    let both = table.has("pinion") || table.has("gear");
    if !both {
        let material = material(&table)?;
        return Ok(Materials {
            pinion: material,
            gear: material,
        });
    }
    if let Some(key) = MATERIAL_KEYS.iter().find(|key| table.has(key)) {
        let mut diagnostic = table
            .refuse(
                key,
                "stands beside a member's own material",
                "either [material] or [material.pinion] with [material.gear]",
            )
            .with_hint("write the values of both members out in their own tables");
        diagnostic.fault = Fault::Inconsistent;
        return Err(Box::new(diagnostic));
    }
    Ok(Materials {
        pinion: material(&table.required_table("pinion", MATERIAL_KEYS)?)?,
        gear: material(&table.required_table("gear", MATERIAL_KEYS)?)?,
    })
}

fn material(table: &Table<'_>) -> Result<Material> {
    Ok(Material {
        elastic: Elastic {
            youngs_modulus: table.required_number("youngs_modulus", &q::YOUNGS_MODULUS)?,
            poisson_ratio: table.required_number("poisson_ratio", &q::POISSON_RATIO)?,
        },
        density_kg_m3: table.required_number("density", &q::DENSITY)?,
    })
}

pub(super) fn read_lubricant(root: &Table<'_>) -> Result<Option<Lubricant>> {
    let Some(table) = root.table("lubricant", LUBRICANT_KEYS)? else {
        return Ok(None);
    };
    Ok(Some(Lubricant {
        viscosity_pa_s: table.number("viscosity", &q::VISCOSITY)?,
        pressure_viscosity_per_gpa: table.number("pressure_viscosity", &q::PRESSURE_VISCOSITY)?,
        roughness_um: table.number("roughness", &q::ROUGHNESS)?,
        friction_coefficient: table.number("friction_coefficient", &q::FRICTION)?,
    }))
}

pub(super) fn read_thermal(root: &Table<'_>) -> Result<Option<Thermal>> {
    let Some(table) = root.table("thermal", THERMAL_KEYS)? else {
        return Ok(None);
    };
    Ok(Some(Thermal {
        bulk_temperature_c: table.number("bulk_temperature", &q::TEMPERATURE)?,
        conductivity_w_mk: table.number("conductivity", &q::CONDUCTIVITY)?,
        specific_heat_j_kgk: table.number("specific_heat", &q::SPECIFIC_HEAT)?,
        warm: (table.choice("tooth_temperature", &[("vdi2736", true)])?).unwrap_or(false),
        ambient_c: (table.number("ambient_temperature", &q::TEMPERATURE)?).unwrap_or(20.0),
        housing_k_w: (table.number("housing_resistance", &q::HOUSING)?).unwrap_or(0.0),
        duty: table.number("duty", &q::DUTY)?.unwrap_or(1.0),
    }))
}
