//! x
use gearwear::verify::hertz_cylinders::*;
use gearwear::verify::*;
fn check(measured: Result<Vec<Measured>, CaseError>) {
    let all = measured.unwrap();
    let text: Vec<String> = all.iter().map(ToString::to_string).collect();
    eprintln!("{}", text.join("\n"));
}
#[test]
fn explore() {
    check(hertz(&[6, 10, 16, 32, 64], Grid::Corners));
    check(hertz(&[6, 10, 16, 32, 64], Grid::Nodes));
    check(finite_body_effect(32));
    check(partial_slip(16));
    check(partial_slip(32));
}
