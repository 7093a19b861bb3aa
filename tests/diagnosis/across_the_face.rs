//! Claim: what differs from place to place across the face is a discrepancy, and a wedge is named with its size.
//!
//! Source: two tests of the independent program (`validation/blind`, a wedge of 3.0 µm, traces at three places, 2 % noise; the command and
//! the truth are in `tests/data/wedge/README.md`). With one smooth surface for all places the misfits of both ends cancel, and the answer
//! is that nothing is missing.
//! Tolerance: the name; the slope within two of its standard deviations, which are below a quarter of it.

use std::path::Path;

use gearwear::learn::Measured;
use gearwear::learn::diagnose::{Fidelity, Verdict, diagnose};
use gearwear::measure::{FacePlace, Quantity};
use gearwear::study::Study;

use crate::{diagnosed_of, layout, names, noisy, says, study};

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

/// A wedge far below the prior's standard deviation (8 µm) does little off mid-face, and still in proportion. What it is mistaken for, a shaft that
/// bends, has starts near it; the wedge must be fitted from as near, or the look-alike takes the name.
#[test]
fn a_small_wedge_is_not_left_to_its_look_alikes() {
    let truth = study("[[effect]]\nkind = \"lead_misalignment\"\nslope = 0.4");
    let mut layout = layout(&truth);
    let half = 0.45 * truth.gears.face_width;
    let depths = (layout.observations.iter_mut()).filter(|o| o.quantity == Quantity::WearDepth);
    for (i, o) in depths.enumerate() {
        o.face = Some(FacePlace::At([-half, 0.0, half][i % 3]));
    }
    let found = diagnosed_of(noisy(&truth, layout, 0.0, 0.02, 5));
    assert!(names(&found, "lead_misalignment"), "{}", says(&found));
    let own = (found.screened.iter())
        .find(|s| s.effects == ["lead_misalignment"] && s.form.is_empty())
        .unwrap();
    assert!(own.evidence_gain > 5.0, "{own:?}");
}
