//! Material taken off the tips of both members or of one, besides what the study states of the gears.
//!
//! ```text
//! e = C w_member (1 − d/L)^n for d < L, else 0        d mm from the tip along the path of contact, n = 1: linear, w: 1, or 0 on the other member
//! ```

use crate::effects::{Card, Effect, Form, Hook, Param, Prior, ProfileAt};
use crate::gear::Member;

pub(super) const CARD: Card = Card {
    name: "tip_relief",
    hook: Hook::Profile,
    formula: "profile = amount*(pinion*on_pinion + (1 - pinion)*on_gear)*max(0, 1 - from_tip/length)^exponent",
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
        part(
            "on_pinion",
            "part of the amount that the pinion's tips have",
        ),
        part("on_gear", "part of the amount that the gear's tips have"),
    ],
    forms: &[
        Form {
            name: "parabolic",
            settings: &[("exponent", 2.0)],
            ..Form::PLAIN
        },
        Form {
            name: "on the pinion alone",
            settings: &[("on_gear", 0.0)],
            signature: "less load and wear at the end of the path, where the pinion's tips leave contact; fades with torque and as it wears off",
            ..Form::PLAIN
        },
        Form {
            name: "on the gear alone",
            settings: &[("on_pinion", 0.0)],
            signature: "less load and wear at the start of the path, where the gear's tips enter contact; fades with torque and as it wears off",
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(TipRelief {
            amount: p[0],
            length: p[1],
            exponent: p[2],
            parts: [p[3], p[4]],
        })
    },
};

/// A choice of form: whether a member's tips are relieved.
const fn part(name: &'static str, meaning: &'static str) -> Param {
    let prior = Prior::Uniform {
        low: 0.0,
        high: 1.0,
    };
    Param::new(name, "-", meaning, 1.0, (0.0, 1.0), prior).fixed()
}

struct TipRelief {
    amount: f64,
    length: f64,
    exponent: f64,
    /// Of the amount on pinion and gear.
    parts: [f64; 2],
}

impl Effect for TipRelief {
    fn profile(&self, at: &ProfileAt) -> f64 {
        let [pinion, gear] = self.parts;
        let part = match at.member {
            Member::Pinion => pinion,
            Member::Gear => gear,
        };
        self.amount
            * part
            * (1.0 - at.from_tip / self.length)
                .max(0.0)
                .powf(self.exponent)
    }
}
