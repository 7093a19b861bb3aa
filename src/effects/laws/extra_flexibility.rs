//! Rim, web or hub give way besides the teeth.
//!
//! ```text
//! 1/c_i → 1/c_i + q        q mm µm/N, the same for every tooth pair
//! ```

use crate::effects::{Card, Effect, Hook, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "extra_flexibility",
    hook: Hook::Compliance,
    formula: "compliance = flexibility",
    source: "springs in series; up to 0.05 mm·µm/N, as much as a tooth pair of steel itself (c' about 14 N/(mm·µm), ISO 6336-1), is engineering judgement.",
    signature: "load shared more evenly, more wear at both ends of the path; the single contact zone unchanged",
    confounded_with: &["tip_relief", "pitch_error"],
    separated_by: "several torques, since a relief acts as its height times stiffness over torque; the transmission error over torque",
    left_out: "the coupling between pairs and the shape of rim and web: each pair has a spring of its own in series",
    needs: &[],
    params: &[Param::new(
        "flexibility",
        "mm um/N",
        "deflection of each tooth pair per line load",
        0.02,
        (0.0, 1.0),
        Prior::HalfNormal { sd: 0.03 },
    )
    .neutral(0.0)],
    forms: &[],
    build: |p| Box::new(ExtraFlexibility { flexibility: p[0] }),
};

struct ExtraFlexibility {
    flexibility: f64,
}

impl Effect for ExtraFlexibility {
    fn compliance(&self) -> f64 {
        self.flexibility
    }
}
