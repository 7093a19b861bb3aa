//! Claim: an effect that the analytic contact model knows too poorly is not left behind its look-alike.
//!
//! Source: two tests of the independent program (`validation/blind`, Coulomb friction of 0.35 in the contact, 2 % noise; the command
//! and the truth are in `tests/data/friction/README.md`). Screened, friction stands far behind a coefficient that differs between approach
//! and recess; by finite elements it stands before it. Left as screened, the wrong twin takes the name at 0.997.
//! Also measurements of the model itself, of two of the tests of `validation/challenges/none_L2`, with a power of the local pressure.
//! Tolerance: the order of the two, and that the wrong one is not named.

use std::path::Path;

use gearwear::learn::Measured;
use gearwear::learn::diagnose::{Diagnosis, Fidelity, diagnose};
use gearwear::study::Study;

use super::{names, noisy, says};

#[test]
fn friction_is_not_left_behind_approach_and_recess() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/friction/study.toml");
    let study = Study::load(&path).unwrap();
    let measured = Measured::new(&study, study.dataset().unwrap());
    let screened = diagnose(&measured, Fidelity::Screening, &|_, _| {}).unwrap();
    let found = diagnose(&measured, Fidelity::Middle, &|_, _| {}).unwrap();
    // what makes the case: the screening has them the wrong way round
    let share = |of: &Diagnosis, name: &str| of.probabilities[name];
    assert!(
        share(&screened, "approach_recess") > share(&screened, "friction_load"),
        "{}",
        says(&screened)
    );
    assert!(names(&found, "friction_load"), "{}", says(&found));
    assert!(
        share(&found, "friction_load") > share(&found, "approach_recess"),
        "{}",
        says(&found)
    );
}

/// On a worn flank the analytic model's own pressure is so rough that it sees nothing in a power of it: what Hertz's pressure leaves was explained
/// by a second effect.
#[test]
fn a_power_of_the_local_pressure_is_fitted_by_finite_elements() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("validation/challenges/none_L2/study.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let read = |effects: &str| {
        let text =
            format!("{text}\n[numerics]\npositions = 40\nelements_per_half_width = 3\n{effects}");
        Study::parse(&text, &path.display().to_string()).unwrap()
    };
    let truth = read("[[effect]]\nkind = \"pressure_exponent\"\nexponent = 1.4\n");
    let mut layout = truth.dataset().unwrap();
    layout.observations.retain(|o| o.test < 2);
    let data = noisy(&truth, layout, 0.0, [0.02, 0.02], 3);
    let study = read("");
    let measured = Measured::new(&study, data);
    let found = diagnose(&measured, Fidelity::Middle, &|_, _| {}).unwrap();
    assert!(names(&found, "pressure_exponent"), "{}", says(&found));
    assert!(found.probabilities["pressure_exponent"] > 0.9);
    assert_eq!(found.ranking[0].form, "", "{}", says(&found));
}
