//! Teeth of a member stand at angles off by a wave over its turn, their profiles true: a cumulative pitch deviation.
//!
//! ```text
//! e_i = f_e cos(2π i/z + φ)        µm along the path of contact, i counted from the measured tooth in the order of coming into mesh
//! ```
//! Positive: the tooth stands back. An axis that lies off moves all pairs in mesh together instead, loads stay shared as they are, and the measured
//! tooth meets its mates at another distance of the axes: `radial_misalignment` for that tooth.

use std::f64::consts::{PI, TAU};

use crate::effects::{Card, Effect, Form, Hook, Param, ParamRole, Prior, Tooth};
use crate::gear::{Member, ToothClasses};

pub(super) const CARD: Card = Card {
    name: "run_out",
    hook: Hook::ToothOffset,
    // of the measured tooth
    formula: "tooth_offset = amplitude*cos(phase)",
    source: "cumulative pitch deviation F_p of ISO 1328-1 as one wave over the turn, of which the amplitude is half; 5 to 40 µm.",
    signature: "teeth of one member differ, once per turn; the measured tooth carries a little more or less than its neighbours in both double contact zones; once per turn in the transmission error",
    confounded_with: &[
        "pitch_error",
        "radial_misalignment",
        "profile_slope",
        "extra_flexibility",
    ],
    separated_by: "measuring four teeth or more around the member",
    left_out: "an axis that lies off: it moves all pairs in mesh together and changes the distance of the axes, radial_misalignment for the measured tooth; differences between the mates that a tooth meets; teeth between three around the member wear by the wave through these. Not beside slices of the face",
    needs: &[],
    params: &[
        Param::new(
            "amplitude",
            "um",
            "how far the tooth that stands back most does",
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
        Param::either("on_gear", "0: teeth of the pinion; 1: of the gear"),
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

/// Teeth around the member whose wear is computed: what the wave does to wear is a wave too, to 0.1 % of the depth where it is 20 µm.
const AROUND: usize = 3;

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
            // without a wave a zero, and not a negative one
            self.amplitude * (turn(tooth) + self.phase).cos() + 0.0
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

    fn tooth_classes(&self) -> ToothClasses {
        ToothClasses::Wave(AROUND)
    }
}
