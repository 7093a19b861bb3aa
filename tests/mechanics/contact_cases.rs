//! Claim: mortar coupling, unilateral contact and condensed elements solve the contact problems with known solutions.
//!
//! Sources: Hertz, Cattaneo and Mindlin, the flat punch (closed forms in `analytic`); the contact patch test of El-Abbasi &
//! Bathe with the numbers of Code_Aster SSNP121; NAFEMS contact benchmark 1; invariances that need no source. Tolerances
//! are those of the benchmark list: rounding (1e-8) where mortar integration is exact, 0.3 to 3 % where the mesh decides.

use gearwear::contact::unilateral::{Drive, UnilateralError};
use gearwear::fem::structured::Order;
use gearwear::verify::contact_and_wear::{Effort, FAMILIES};
use gearwear::verify::hertz_cylinders::{Cylinders, Grid, run};
use gearwear::verify::{CaseError, Measured};

fn check(id: &str) {
    let mut count = 0;
    for family in FAMILIES.iter().filter(|f| f.ids.contains(&id)) {
        let all = (family.run)(Effort::Quick).unwrap();
        let failed: Vec<String> = all
            .iter()
            .filter(|m| !m.passed())
            .map(ToString::to_string)
            .collect();
        assert!(
            failed.is_empty(),
            "{}:\n{}",
            family.title,
            failed.join("\n")
        );
        count += all.len();
    }
    assert!(count > 0, "no case {id}");
}

#[test]
fn patch_test_is_passed_on_any_meshes() {
    check("B1");
}

#[test]
fn half_cylinders_press_as_hertz_says() {
    check("B2");
}

#[test]
fn cylinder_on_block_meets_the_nafems_values() {
    check("B3");
}

#[test]
fn partial_slip_follows_cattaneo_and_mindlin() {
    check("B5");
}

#[test]
fn flat_punch_has_its_singular_pressure() {
    check("B6");
}

#[test]
fn contact_does_not_depend_on_how_it_is_put() {
    check("B7");
}

#[test]
fn wrong_load_and_wrong_element_order_are_noticed() {
    // one percent of load is 0.5 % of peak pressure: outside the 0.3 % of B2
    let case = Cylinders::benchmark(16, Order::Quadratic, Grid::Nodes);
    let pair = case.build().unwrap();
    let heavy = pair.solve(Drive::Load(1.01 * case.load())).unwrap();
    let peak = heavy.pressure.iter().fold(0.0f64, |m, p| m.max(*p)) / case.peak();
    assert!(
        !Measured::absolute("B2", "p(0)/p0", peak, 1.0, 3e-3).passed(),
        "{peak}"
    );
    // linear triangles at the same resolution miss the peak by 3 %
    let (linear, ..) = run(&Cylinders::benchmark(16, Order::Linear, Grid::Corners)).unwrap();
    assert!((linear.centre - 1.0).abs() > 0.02, "{linear:?}");
}

#[test]
fn a_load_that_pulls_is_refused() {
    let case = Cylinders::benchmark(6, Order::Quadratic, Grid::Corners);
    let error = case.build().unwrap().solve(Drive::Load(-1.0)).unwrap_err();
    assert_eq!(
        error,
        CaseError::Contact(UnilateralError::BadLoad { load: -1.0 })
    );
}
