//! The centre distance is not the stated one.
//!
//! ```text
//! a = a0 + Δa,   cos α_w = (r_b1 + r_b2)/a
//! ```

use crate::effects::{Card, Effect, Hook, OperationChange, OperationState, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "radial_misalignment",
    hook: Hook::Operation,
    formula: "added_centre_distance = amount",
    source: "involute kinematics at another centre distance (ISO 21771; any gear book).",
    signature: "the pitch point's dip and the start edge shift outwards on the pinion; the zones of double contact shrink",
    confounded_with: &["bearing_compliance", "thermal_expansion", "approach_recess"],
    separated_by: "the place of the dip and of the start edge give it directly; other torques and temperatures tell it from its look-alikes",
    left_out: "nothing: the gears are mounted at the other centre distance",
    needs: &[],
    params: &[Param::new(
        "amount",
        "mm",
        "added to the centre distance",
        0.1,
        (-2.0, 2.0),
        Prior::Normal {
            mean: 0.0,
            sd: 0.15,
        },
    )
    .neutral(0.0)],
    forms: &[],
    build: |p| Box::new(RadialMisalignment { amount: p[0] }),
};

struct RadialMisalignment {
    amount: f64,
}

impl Effect for RadialMisalignment {
    fn operation(&self, _: &OperationState) -> OperationChange {
        OperationChange {
            centre_distance: self.amount,
        }
    }
}
