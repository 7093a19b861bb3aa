//! A member does not turn true: its teeth stand at angles off by a wave over its turn, their profiles true (a cumulative pitch deviation), or its axis
//! lies off.
//!
//! ```text
//! e_i = f_e cos(2π i/z + φ)        µm along the path of contact, i counted from the measured tooth in the order of coming into mesh
//! a_i = a + e cos(2π i/z + φ)      an axis that lies off by e; of the measured tooth a + e cos φ = a + axis_shift
//! ```
//! Positive: the tooth stands back. An axis that lies off moves all pairs in mesh together: loads stay shared as they are, teeth alike, and each tooth
//! of the member meets the mate at a distance of the axes of its own. To first order in e the mate, whose teeth meet them all, wears as at the
//! mean distance, and so do all teeth of the member together.

use std::f64::consts::{PI, TAU};

use crate::effects::{
    Card, Effect, Form, Hook, Impossible, OperationChange, OperationState, Param, ParamRole, Prior,
    Tooth,
};
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
    separated_by: "measuring four teeth or more around the member; an axis that lies off from a misalignment: measuring both members, or their masses",
    left_out: "of an axis that lies off all but what the measured tooth feels: other teeth of the member, the mate, masses and what is read of the mesh are those at the mean distance of the axes (a single run is that of the measured tooth throughout), and the mate that the measured tooth meets is worn as by that tooth alone; differences between the mates that a tooth meets; teeth between three around the member wear by the wave through these. Teeth at angles off not beside slices of the face",
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
        Param::new(
            "axis_shift",
            "um",
            "how much farther from the mate's axis the measured tooth meets it because its member's axis lies off; only with amplitude = 0",
            0.0,
            (-1000.0, 1000.0),
            Prior::Normal {
                mean: 0.0,
                sd: 40.0,
            },
        )
        .neutral(0.0)
        .role(ParamRole::MeasuredTooth)
        .fixed(),
    ],
    forms: &[
        Form {
            name: "on the gear",
            settings: &[("on_gear", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "axis of the pinion lies off",
            settings: &[("amplitude", 0.0), ("axis_shift", 20.0)],
            frees: &["axis_shift"],
            idle: &["amplitude", "phase"],
            signature: ECCENTRIC,
            ..Form::PLAIN
        },
        Form {
            name: "axis of the gear lies off",
            settings: &[("amplitude", 0.0), ("on_gear", 1.0), ("axis_shift", 20.0)],
            frees: &["axis_shift"],
            idle: &["amplitude", "phase"],
            signature: ECCENTRIC,
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(RunOut {
            amplitude: p[0],
            phase: p[1],
            member: if p[2] < 0.5 {
                Member::Pinion
            } else {
                Member::Gear
            },
            axis_shift: p[3],
        })
    },
};

const ECCENTRIC: &str = "the measured tooth of one member wears as at another distance of the axes, the mate and the masses do not";

/// Teeth around the member whose wear is computed: what the wave does to wear is a wave too, to 0.1 % of the depth where it is 20 µm.
const AROUND: usize = 3;

struct RunOut {
    amplitude: f64,
    phase: f64,
    member: Member,
    axis_shift: f64,
}

impl RunOut {
    /// Whether all teeth stand in their places, so that it is the axis that lies off.
    fn of_the_axis(&self) -> bool {
        self.amplitude == 0.0
    }
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

    fn operation(&self, _: &OperationState) -> OperationChange {
        let shift = if self.of_the_axis() {
            1e-3 * self.axis_shift
        } else {
            0.0
        };
        OperationChange {
            centre_distance: shift,
        }
    }

    fn acts_through(&self) -> Option<Hook> {
        self.of_the_axis().then_some(Hook::Operation)
    }

    fn of_measured_tooth(&self) -> Option<Member> {
        self.of_the_axis().then_some(self.member)
    }

    fn impossible(&self) -> Option<Impossible> {
        (!self.of_the_axis() && self.axis_shift != 0.0).then(|| Impossible {
            parameter: "axis_shift",
            why: "is that of teeth which stand in their places, and amplitude is not 0",
            allowed: "0 um, or amplitude = 0".to_owned(),
            hint: "an axis that lies off is amplitude = 0 with axis_shift, teeth at angles off are amplitude and phase",
        })
    }
}
