//! Density and Young's modulus of a member that no material has together: the mass follows from the one, the contact from the other.

use crate::gear::Member;
use crate::study::Study;

/// Steels, by density in kg/m³ and by Young's modulus in MPa; cast and stainless ones among them. Aluminium bronzes are as heavy, and softer.
const STEEL_DENSITY: [f64; 2] = [7600.0, 8100.0];
const STEEL_MODULUS: [f64; 2] = [150e3, 240e3];
const MODULUS_AT_THAT_DENSITY: [f64; 2] = [100e3, 240e3];
/// Plastics, filled ones among them: the stiffest and the heaviest.
const PLASTIC_MODULUS: f64 = 30e3;
const PLASTIC_DENSITY: f64 = 2600.0;

/// A question for each member, or for both at once, whose density and modulus do not belong together.
pub(super) fn materials(study: &Study) -> Vec<String> {
    let of = |member: Member| {
        let material = study.materials.of(member);
        let (density, modulus) = (material.density_kg_m3, material.elastic.youngs_modulus);
        at_odds(density, modulus).then_some((density, modulus))
    };
    let said = |whose: &str, (density, modulus): (f64, f64)| {
        format!(
            "{whose} density, {density} kg/m³, and its Young's modulus, {modulus} MPa, are not those of one material (steel: 7850 and 206000; \
             POM: 1410 and about 2800): look at both, the masses follow from the one and the contact from the other"
        )
    };
    match Member::BOTH.map(of) {
        [Some(pinion), Some(gear)] if pinion == gear => vec![said("the material's", pinion)],
        each => (each.into_iter().zip(["the pinion's", "the gear's"]))
            .filter_map(|(found, whose)| Some(said(whose, found?)))
            .collect(),
    }
}

fn at_odds(density: f64, modulus: f64) -> bool {
    let within = |x: f64, [low, high]: [f64; 2]| low <= x && x <= high;
    within(density, STEEL_DENSITY) && !within(modulus, MODULUS_AT_THAT_DENSITY)
        || modulus < PLASTIC_MODULUS && density > PLASTIC_DENSITY
        || within(modulus, STEEL_MODULUS) && density < PLASTIC_DENSITY
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn real_materials_are_not_asked_about() {
        // steel, stainless steel, cast iron, bronze, aluminium bronze, titanium, aluminium, POM, PA 6 with glass, PEEK with carbon
        for (density, modulus) in [
            (7850.0, 206e3),
            (8000.0, 193e3),
            (7200.0, 110e3),
            (8800.0, 110e3),
            (7600.0, 115e3),
            (4500.0, 115e3),
            (2700.0, 70e3),
            (1410.0, 2800.0),
            (1360.0, 9500.0),
            (1450.0, 25e3),
        ] {
            assert!(!at_odds(density, modulus), "{density} {modulus}");
        }
    }

    #[test]
    fn a_modulus_in_another_unit_and_a_density_left_as_it_was_are() {
        // 20.6 GPa for 206, POM with the density of steel, steel with that of POM, g/cm³ taken for kg/m³
        for (density, modulus) in [
            (7850.0, 20.6e3),
            (7850.0, 2800.0),
            (1410.0, 206e3),
            (7.85, 206e3),
        ] {
            assert!(at_odds(density, modulus), "{density} {modulus}");
        }
    }
}
