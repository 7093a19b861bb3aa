//! Chemical loss of every exposed surface, with or without contact.
//!
//! ```text
//! Δh = r t_c/100 / √(1 + t/t_p)        r µm per 100 h run, t_c h from one contact of the member to its next, t h run
//! ```
//! t_p → ∞: a constant rate. Finite: the products stay on the surface and slow the attack, which then goes with √t.
//! Standstill is not counted.

use super::{Card, Effect, Form, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "corrosive_loss",
    hook: Hook::AddedDepth,
    formula: "added_depth = rate/100*contact_hours/sqrt(1 + hours/protective_hours)",
    source: "uniform corrosion at a constant rate per time, plain kinematics: contact_hours = 1/(60 n) of the pinion and z2/z1 times that of the gear. The range of 0.01 to 1 um per 100 h is engineering judgement. Slowing by a layer of products, linear first and parabolic later: B.E. Deal, A.S. Grove, J. Appl. Phys. 36 (1965) 3770-3778, for oxide on silicon; not re-read.",
    signature: "depth everywhere, also at the pitch point and on the unloaded flank; per cycle as 1/n; no dependence on torque; more mass than profile lost",
    confounded_with: &["roughness_polish", "micropitting", "oxidative"],
    separated_by: "the unloaded flank and the root as a datum; weighing; two checkpoints. A trace whose level is unknown hides it altogether",
    needs: &[],
    params: &[
        Param::new(
            "rate",
            "um per 100 h",
            "depth lost in 100 hours run, of a fresh surface",
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
            "hours run after which a layer of products has slowed the loss to 0.71 of that; inf: it does not protect",
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
        grown: &[&[1.0], &[20.0]],
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
        self.rate / 100.0 * at.contact_hours / (1.0 + at.hours / self.protective_hours).sqrt()
    }
}
