//! Chemical loss of every exposed surface, with or without contact.
//!
//! ```text
//! Δh = r t_c/100 · ½ (1 + √(1 + 100/t_p)) / √(1 + t/t_p)     r µm in the first 100 h run, t_c h from one contact of the member to its next, t h run
//! ```
//! t_p → ∞: a constant rate. Finite: the products stay on the surface and slow the attack, which then goes with √t. The first 100 h take
//! r with any t_p, so that what a fit says of the one depends little on the other.
//! Standstill is not counted.

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

/// Hours for which the rate is given.
const HOURS: f64 = 100.0;

pub(super) const CARD: Card = Card {
    name: "corrosive_loss",
    hook: Hook::AddedDepth,
    formula: "added_depth = rate/100*contact_hours*(1 + sqrt(1 + 100/protective_hours))/2/sqrt(1 + hours/protective_hours)",
    source: "uniform corrosion at a constant rate per time, plain kinematics: contact_hours = 1/(60 n) of the pinion and z2/z1 times that of the gear. The range of 0.01 to 1 µm per 100 h is engineering judgement. Slowing by a layer of products, linear first and parabolic later: B.E. Deal, A.S. Grove, J. Appl. Phys. 36 (1965) 3770-3778, for oxide on silicon; not re-read.",
    signature: "depth everywhere, also at the pitch point and on the unloaded flank; per cycle as 1/n; no dependence on torque; more mass than profile lost",
    confounded_with: &["roughness_polish", "micropitting", "oxidative"],
    separated_by: "the unloaded flank and the root as a datum; weighing; two checkpoints. A trace whose level is unknown hides it altogether",
    left_out: "attack at standstill, and oil chemistry: the rate is given",
    needs: &[],
    params: &[
        Param::new(
            "rate",
            "um per 100 h",
            "depth lost in the first 100 hours run",
            0.1,
            (0.0, 100.0),
            Prior::LogNormal {
                median: 0.1,
                spread: 4.0,
            },
        )
        .neutral(0.0),
        Param::new(
            "protective_hours",
            "h",
            "hours run after which a layer of products has slowed the loss to 0.71 of that of a fresh surface; inf: it does not protect",
            f64::INFINITY,
            (1e-3, f64::INFINITY),
            Prior::LogNormal {
                median: 30.0,
                spread: 5.0,
            },
        )
        .fixed(),
    ],
    forms: &[Form {
        name: "protective layer",
        frees: &["protective_hours"],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(CorrosiveLoss {
            rate: p[0],
            protective_hours: p[1],
        })
    },
};

struct CorrosiveLoss {
    rate: f64,
    protective_hours: f64,
}

impl Effect for CorrosiveLoss {
    fn added_depth(&self, at: &Local) -> f64 {
        let slowed = (1.0 + at.hours / self.protective_hours).sqrt();
        let fresh = 0.5 * (1.0 + (1.0 + HOURS / self.protective_hours).sqrt());
        self.rate / HOURS * at.contact_hours * fresh / slowed
    }
}
