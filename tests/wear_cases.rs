//! Claim: the wear integrator with the product's contact solver reproduces the exact and near-exact wear solutions.
//!
//! Sources: closed forms (Winkler foundation, conservation of worn area) and tables of an independent boundary-element
//! program (elastic half plane); each library function names its own. Tolerances are those of the benchmark list: 0.1 to
//! 0.5 % where the solution is exact, 2 % where the table is, rounding for the balance of worn area.

use gearwear::verify::{
    CaseError, Measured,
    sliding::{self, DEFAULT_TOLERANCE, SlidingContact},
    wear_half_plane, wear_punch, wear_steps, wear_tolerance, wear_winkler,
};

fn check(measured: Result<Vec<Measured>, CaseError>) {
    let all = measured.unwrap();
    let text: Vec<String> = all.iter().map(ToString::to_string).collect();
    eprintln!("{}", text.join("\n"));
    assert!(all.iter().all(Measured::passed), "{}", text.join("\n"));
}

#[test]
fn block_wears_evenly() {
    check(wear_winkler::uniform_block(DEFAULT_TOLERANCE));
}

#[test]
fn full_winkler_contact_relaxes_exponentially() {
    check(wear_winkler::full_winkler(DEFAULT_TOLERANCE));
}

#[test]
fn parabola_on_winkler_grows() {
    check(wear_winkler::parabola(20, DEFAULT_TOLERANCE));
}

#[test]
fn cylinder_on_half_plane_wears() {
    check(wear_half_plane::cylinder(20, 3.0, DEFAULT_TOLERANCE));
}

#[test]
fn punch_pressure_evens_out() {
    check(Ok(wear_punch::eigenvalues(400)));
    check(wear_punch::straight(60, DEFAULT_TOLERANCE));
    check(wear_punch::tilted(60, DEFAULT_TOLERANCE));
}

#[test]
fn orders_and_limits_of_steps() {
    check(wear_steps::orders());
    check(wear_steps::explicit_limit(40, DEFAULT_TOLERANCE));
}

#[test]
fn halving_the_step_tolerance_changes_little() {
    check(wear_tolerance::halving(20));
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
    let error = (end.pressure[40] / p0 / wear_winkler::parabola_pressure(2.0) - 1.0).abs();
    assert!(error > 5e-3, "error {error}");
}
