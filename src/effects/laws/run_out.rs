//! A member turns about an axis that is not its own.
//!
//! ```text
//! e_i = f_e cos(2π i/z + φ)        µm along the path of contact, i counted from the measured tooth in the order of coming into mesh
//! ```
//! Positive: the tooth stands back. What run-out does to the depth of engagement is not in it.

use std::f64::consts::{PI, TAU};

use crate::effects::{Card, Effect, Form, Hook, Param, ParamRole, Prior, Tooth};
use crate::gear::Member;

pub(super) const CARD: Card = Card {
    name: "run_out",
    hook: Hook::ToothOffset,
    // of the measured tooth
    formula: "tooth_offset = amplitude*cos(phase)",
    source: "run-out F_r of ISO 1328-2 is twice the eccentricity; 5 to 40 um.",
    signature: "teeth of one member differ, once per turn; the measured tooth carries a little more or less than its neighbours in both double contact zones; once per turn in the transmission error",
    confounded_with: &["pitch_error", "profile_slope", "extra_flexibility"],
    separated_by: "measuring four teeth or more around the member",
    left_out: "the depth of engagement, which changes with the turn; differences between the mates that a tooth meets; groups of teeth wear as one. Not beside slices of the face",
    needs: &[],
    params: &[
        Param::new(
            "amplitude",
            "um",
            "eccentricity",
            10.0,
            (0.0, 500.0),
            Prior::LogNormal {
                median: 10.0,
                spread: 2.0,
            },
        )
        .neutral(0.0),
        Param::new(
            "phase",
            "rad",
            "phase of the measured tooth: 0 where it stands back most",
            0.0,
            (-PI, PI),
            Prior::Uniform { low: -PI, high: PI },
        )
        .role(ParamRole::WavePhase),
        Param::either("on_gear", "0: the pinion runs out; 1: the gear"),
    ],
    forms: &[Form {
        name: "on the gear",
        settings: &[("on_gear", 1.0)],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(RunOut {
            amplitude: p[0],
            phase: p[1],
            member: if p[2] < 0.5 {
                Member::Pinion
            } else {
                Member::Gear
            },
        })
    },
};

/// Groups of teeth around the member: wear differs between them by less than traces are told apart by.
const GROUPS: usize = 8;

struct RunOut {
    amplitude: f64,
    phase: f64,
    member: Member,
}

fn turn(tooth: Tooth) -> f64 {
    TAU * tooth.number as f64 / tooth.of as f64
}

impl Effect for RunOut {
    fn tooth_offset(&self, tooth: Tooth) -> f64 {
        if tooth.member == self.member {
            self.amplitude * (turn(tooth) + self.phase).cos()
        } else {
            0.0
        }
    }

    fn tooth_kind(&self, tooth: Tooth) -> Vec<f64> {
        if tooth.member == self.member {
            vec![turn(tooth).cos(), turn(tooth).sin()]
        } else {
            vec![0.0; 2]
        }
    }

    fn tooth_classes(&self) -> usize {
        GROUPS
    }
}
