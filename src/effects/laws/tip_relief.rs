//! Material taken off the tips of both members, besides what the study states of the gears.
//!
//! ```text
//! e = C (1 − d/L)^n for d < L, else 0        d mm from the tip along the path of contact, n = 1: linear
//! ```

use crate::effects::{Card, Effect, Form, Hook, Param, Prior, ProfileAt};

pub(super) const CARD: Card = Card {
    name: "tip_relief",
    hook: Hook::Profile,
    formula: "profile = amount*max(0, 1 - from_tip/length)^exponent",
    source: "linear and parabolic tip relief of ISO 21771 and gear practice; a definition, not a law.",
    signature: "less load and wear at both ends of the path, more in single contact; fades with torque and as it wears off",
    confounded_with: &["extra_flexibility", "profile_slope", "severe_transition"],
    separated_by: "the profile as made; several torques",
    left_out: "nothing of the contact: the relief is part of the gap and wears away",
    needs: &[],
    params: &[
        Param::new(
            "amount",
            "um",
            "material removed at the tip",
            8.0,
            (0.0, 200.0),
            Prior::LogNormal {
                median: 8.0,
                spread: 2.0,
            },
        )
        .neutral(0.0),
        Param::new(
            "length",
            "mm",
            "length of the relief along the path of contact",
            2.0,
            (0.02, 50.0),
            Prior::LogNormal {
                median: 2.0,
                spread: 1.7,
            },
        ),
        Param::new(
            "exponent",
            "-",
            "1: linear; 1.5 to 2: rounded start",
            1.0,
            (0.5, 4.0),
            Prior::Uniform {
                low: 1.0,
                high: 2.0,
            },
        )
        .fixed(),
    ],
    forms: &[Form {
        name: "parabolic",
        settings: &[("exponent", 2.0)],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(TipRelief {
            amount: p[0],
            length: p[1],
            exponent: p[2],
        })
    },
};

struct TipRelief {
    amount: f64,
    length: f64,
    exponent: f64,
}

impl Effect for TipRelief {
    fn profile(&self, at: &ProfileAt) -> f64 {
        self.amount
            * (1.0 - at.from_tip / self.length)
                .max(0.0)
                .powf(self.exponent)
    }
}
