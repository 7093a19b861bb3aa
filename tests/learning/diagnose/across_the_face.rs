//! Claim: what differs from place to place across the face is a discrepancy, and a wedge is named with its size.
//!
//! Source: two tests of the independent program (`validation/blind`, a wedge of 3.0 µm, traces at three places, 2 % noise; the command and
//! the truth are in `tests/data/wedge/README.md`). With one smooth surface for all places the misfits of both ends cancel, and the answer
//! is that nothing is missing.
//! Tolerance: the name; the slope within two of its standard deviations, which are below a quarter of it.

use std::path::Path;

use gearwear::learn::Measured;
use gearwear::learn::diagnose::{Fidelity, Verdict, diagnose};
use gearwear::study::Study;

use super::{names, noisy, says};

const SLOPE_UM: f64 = 3.0;

#[test]
fn a_wedge_measured_at_three_places_is_named() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/wedge/study.toml");
    let study = Study::load(&path).unwrap();
    let measured = Measured::new(&study, study.dataset().unwrap());
    let found = diagnose(&measured, Fidelity::Middle, &|_, _| {}).unwrap();
    assert_eq!(found.verdict, Verdict::Effect, "{}", says(&found));
    assert!(names(&found, "lead_misalignment"), "{}", says(&found));
    // the verdict is the ranking's first
    let slope = &found.ranking[0].parameters[0];
    assert_eq!(slope.name, "slope");
    assert!(slope.sigma < 0.25 * SLOPE_UM, "{slope:?}");
    assert!(
        (slope.value.abs() - SLOPE_UM).abs() < 2.0 * slope.sigma,
        "{slope:?}"
    );
}

/// A wedge far below the prior's standard deviation (8 µm) still acts in proportion off mid-face. What it is mistaken for, a shaft that bends, has
/// starts near it; unless the wedge is fitted from as near, the look-alike takes the name. One test, so that nothing tells the two apart.
#[test]
fn a_small_wedge_is_not_left_to_its_look_alikes() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/wedge/study.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let of = |effects: &str| {
        let text = format!("{text}\n{effects}");
        let mut study = Study::parse(&text, &path.display().to_string()).unwrap();
        study.tests.truncate(1);
        study
    };
    let truth = of("[[effect]]\nkind = \"lead_misalignment\"\nslope = 1.0");
    let base = of("");
    let mut data = Study::load(&path).unwrap().dataset().unwrap();
    data.tests.truncate(1);
    data.observations.retain(|o| o.test == 0);
    let data = noisy(&truth, data, 0.0, [0.004, 0.0], 5);
    let found = diagnose(&Measured::new(&base, data), Fidelity::Middle, &|_, _| {}).unwrap();
    assert!(names(&found, "lead_misalignment"), "{}", says(&found));
}
