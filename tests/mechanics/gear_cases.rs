//! Claim: whole gears touch, bend, share load and wear as independent programs and closed forms say.
//!
//! Sources: closed forms of spur gear geometry, Hertz, ISO 6336-1 and the wear of a passing contact; FZG type C as a public
//! gear program reports it; stiffness, load share and root stress by an independent finite-element program with prescribed
//! Hertz pressures. Tolerances: printed digits for formulas; 1.5 % stiffness and pressure, 0.02 share, 3 % transmission
//! error (5 % peak to peak, which corner contact lowers), 5 % root stress, 3 % wear depth, 0.5 % worn area.
//!
//! Quick resolution: 4 flank edges per Hertz half width. The validation repeats all with 8.

use std::sync::LazyLock;

use gearwear::verify::contact_and_wear::{Effort, FAMILIES as OTHERS};
use gearwear::verify::gear_pairs::{Bench, GearCase, Teeth};
use gearwear::verify::gears::{self, FAMILIES};
use gearwear::verify::{
    CaseError, Measured, gear_contact, gear_geometry, gear_stiffness, gear_wear,
};

static BENCHES: LazyLock<Vec<Bench>> =
    LazyLock::new(|| gears::benches(gears::numerics(Effort::Quick)).unwrap());

fn check(all: Result<Vec<Measured>, CaseError>) {
    let all = all.unwrap();
    assert!(!all.is_empty());
    let failed: Vec<String> = all
        .iter()
        .filter(|m| !m.passed())
        .map(ToString::to_string)
        .collect();
    assert!(failed.is_empty(), "\n{}", failed.join("\n"));
}

#[test]
fn geometry_is_that_of_the_table() {
    check(gear_geometry::all());
}

#[test]
fn formulas_give_the_published_values() {
    check(gear_stiffness::formula());
    check(gear_contact::formula());
    check(gear_wear::formula());
}

#[test]
fn contact_pressure_is_hertzian_and_in_equilibrium() {
    check(gears::contact(&BENCHES));
}

#[test]
fn tooth_pairs_are_as_stiff_as_the_independent_program_says() {
    check(gears::stiffness(&BENCHES));
}

#[test]
fn load_sharing_and_transmission_error() {
    check(gears::sharing(&BENCHES, 24));
}

#[test]
fn root_stress_is_that_of_the_independent_program() {
    check(gears::root(&BENCHES));
}

#[test]
fn a_pass_wears_what_load_and_sliding_say() {
    check(gears::passes(Effort::Quick));
}

#[test]
fn wear_evens_out_and_needs_no_new_condensation() {
    check(gears::history(Effort::Quick));
}

#[test]
fn every_family_names_its_cases_once() {
    for family in FAMILIES {
        assert!(!family.ids.is_empty());
        assert!(OTHERS.iter().all(|o| o.title != family.title));
    }
}

#[test]
fn a_softer_material_is_noticed() {
    // 2 % of E is 2 % of the angle: outside the 1.5 % of E2
    let mut case = GearCase::reference().unwrap();
    for material in &mut case.set.materials {
        material.youngs_modulus *= 0.98;
    }
    let torque = case.torque;
    let bench = Bench::new(case, gears::numerics(Effort::Quick)).unwrap();
    let solved = bench.solve(&[0.0], torque, Teeth::All).unwrap();
    let angle = 1e6 * solved.contacts[0].approach;
    assert!(!Measured::relative("E2", "angle", angle, 344.56, 0.015).passed());
}
