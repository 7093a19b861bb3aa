//! Chemical loss of every exposed surface, with or without contact.
//!
//! ```text
//! Δh = r t_c/100        r µm per 100 h run, t_c h from one contact of the member to its next
//! ```
//! Standstill is not counted.

use super::{Card, Effect, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "corrosive_loss",
    hook: Hook::AddedDepth,
    formula: "added_depth = rate/100*contact_hours",
    source: "uniform corrosion at a constant rate per time, plain kinematics: contact_hours = 1/(60 n) of the pinion and z2/z1 times that of the gear. The range of 0.01 to 1 um per 100 h is engineering judgement.",
    signature: "depth everywhere, also at the pitch point and on the unloaded flank; per cycle as 1/n; no dependence on torque; more mass than profile lost",
    confounded_with: &["roughness_polish", "micropitting", "oxidative"],
    separated_by: "the unloaded flank and the root as a datum; weighing; two checkpoints. A trace whose level is unknown hides it altogether",
    needs: &[],
    params: &[Param::new(
        "rate",
        "um per 100 h",
        "depth lost in 100 hours run",
        0.1,
        (0.0, 100.0),
        Prior::LogNormal {
            median: 0.1,
            spread: 4.0,
        },
    )
    .neutral(0.0)],
    forms: &[],
    build: |p| Box::new(CorrosiveLoss { rate: p[0] }),
};

struct CorrosiveLoss {
    rate: f64,
}

impl Effect for CorrosiveLoss {
    fn added_depth(&self, at: &Local) -> f64 {
        self.rate / 100.0 * at.contact_hours
    }
}
