//! The measured tooth stands off its place.
//!
//! ```text
//! e_0 = f_pt, e_j = 0 for its neighbours        µm along the path of contact, positive: the tooth stands back
//! ```
//! Runout, the same deviation spread over a turn, averages out over a hunting ratio and is not modelled.

use crate::effects::{Card, Effect, Hook, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "pitch_error",
    hook: Hook::ToothOffset,
    formula: "tooth_offset = deviation",
    source: "single pitch deviation f_pt of ISO 1328-1; 3 to 15 um are classes 5 to 8.",
    signature: "the measured tooth carries less or more in both double contact zones; teeth differ; once per turn in the transmission error",
    confounded_with: &["profile_slope", "extra_flexibility", "tip_relief"],
    separated_by: "measuring four teeth or more",
    left_out: "the wear of the neighbours: they wear as the measured tooth does",
    needs: &[],
    params: &[Param::new(
        "deviation",
        "um",
        "how far the measured tooth stands back from its neighbours",
        5.0,
        (-200.0, 200.0),
        Prior::Normal { mean: 0.0, sd: 8.0 },
    )
    .neutral(0.0)],
    forms: &[],
    build: |p| Box::new(PitchError { deviation: p[0] }),
};

struct PitchError {
    deviation: f64,
}

impl Effect for PitchError {
    fn tooth_offset(&self, tooth: i32) -> f64 {
        if tooth == 0 { self.deviation } else { 0.0 }
    }
}
