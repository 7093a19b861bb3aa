//! Claim: the wear integrator with the product's contact solver reproduces the exact and near-exact wear solutions at the
//! default step tolerance.
//!
//! Sources: closed forms (Winkler foundation, conservation of worn area) and tables of an independent boundary-element
//! program (elastic half plane), all in `analytic`. Tolerances are those of the benchmark list: 0.1 to 0.5 % where the
//! solution is exact, 2 % (5 % near a corner) where it is tabulated, rounding for the balance of worn area.

use gearwear::analytic::winkler::centre_pressure_ratio;
use gearwear::verify::contact_and_wear::{Effort, FAMILIES};
use gearwear::verify::sliding::{self, DEFAULT_TOLERANCE, SlidingContact};
use gearwear::verify::wear_winkler;

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
fn block_wears_evenly() {
    check("F2");
}

#[test]
fn full_winkler_contact_relaxes_at_second_order() {
    check("F3");
}

#[test]
fn parabola_on_winkler_grows_towards_even_pressure() {
    check("F4");
}

#[test]
fn elastic_cylinder_wears() {
    check("F6");
}

#[test]
fn punch_pressure_evens_out() {
    check("F7");
}

#[test]
fn explicit_limit_does_not_bind_the_integrator() {
    check("F8");
}

#[test]
fn three_percent_more_wear_is_noticed() {
    // the tolerance of F4 must be able to fail: the same case with a wear coefficient 3 % too large, tau = 2
    let (radius, foundation, load) = (10.0, 1000.0, 1000.0 / 120.0);
    let x = sliding::even_grid(-1.0, 1.0, 80);
    let gap = |x: f64| x * x / (2.0 * radius);
    let mut system = SlidingContact::new(x, gap, wear_winkler::winkler, load, 1.03e-4);
    let end = &sliding::history(&mut system, &[20.0], DEFAULT_TOLERANCE, 1e-5).unwrap()[0];
    let p0 = foundation * 0.25 / (2.0 * radius);
    let error = (end.pressure[40] / p0 / centre_pressure_ratio(2.0) - 1.0).abs();
    assert!(error > 5e-3, "error {error}");
}
