//! x
use gearwear::verify::*;
fn check(measured: Result<Vec<Measured>, CaseError>) {
    let all = measured.unwrap();
    let text: Vec<String> = all.iter().map(ToString::to_string).collect();
    eprintln!("{}", text.join("\n"));
}
#[test]
fn explore() {
    check(patch::all());
    for n in [12, 24, 48] {
        check(nafems_cylinder::frictionless(n));
    }
    for n in [32, 64, 128] {
        check(flat_punch::fresh(n));
    }
    let t = std::time::Instant::now();
    check(flat_punch::worn(64, 2e-3));
    eprintln!("{:?}", t.elapsed());
    let t = std::time::Instant::now();
    check(wear_block::cylinder(12, 3.0, 2e-3));
    eprintln!("{:?}", t.elapsed());
}
