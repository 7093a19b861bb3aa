//! Waviness of the flank as made.
//!
//! ```text
//! e = A cos(2π j x + φ) + A₂ cos(2π j₂ x + φ₂)        x from 0 at the start to 1 at the end of the path of contact, on the pinion
//! ```
//! Only the sum of both flanks' deviations enters the contact, so it stands on the pinion alone.

use std::f64::consts::{PI, TAU};

use crate::effects::{Card, Effect, Form, Hook, Param, ParamRole, Prior, ProfileAt};
use crate::gear::Member;

/// Amplitude, phase and waves of second waves to begin with, each turned to the phase that serves best.
const SECOND_WAVES: [&[f64]; 10] = [
    &[0.5, 0.0, 0.7],
    &[0.5, 0.0, 1.0],
    &[0.5, 0.0, 1.5],
    &[0.5, 0.0, 2.0],
    &[0.5, 0.0, 2.5],
    &[0.5, 0.0, 3.0],
    &[0.5, 0.0, 4.0],
    &[0.5, 0.0, 5.0],
    &[0.5, 0.0, 6.5],
    &[0.5, 0.0, 8.5],
];

pub(super) const CARD: Card = Card {
    name: "profile_form",
    hook: Hook::Profile,
    formula: "profile = pinion*(amplitude*cos(2*pi*waves*along + phase) + second_amplitude*cos(2*pi*second_waves*along + second_phase))",
    source: "profile form deviation f_falpha of ISO 1328-1 as one wave, or two; 1 to 5 µm is engineering judgement.",
    signature: "waves printed into the wear of both members, mirrored, then worn off",
    confounded_with: &["plastic_deformation", "dynamic_load", "profile_slope"],
    separated_by: "the profile as made",
    left_out: "nothing of the contact: the waves are part of the gap and wear away; both flanks' waves as one",
    needs: &[],
    params: &[
        Param::new(
            "amplitude",
            "um",
            "amplitude of the wave",
            2.0,
            (0.0, 50.0),
            Prior::LogNormal {
                median: 2.0,
                spread: 1.8,
            },
        )
        .neutral(0.0),
        Param::new(
            "phase",
            "rad",
            "phase at the start of the path",
            0.0,
            (-PI, PI),
            Prior::Uniform { low: -PI, high: PI },
        )
        .role(ParamRole::WavePhase),
        Param::new(
            "waves",
            "-",
            "waves along the path of contact",
            2.0,
            (0.5, 12.0),
            Prior::LogNormal {
                median: 2.0,
                spread: 1.6,
            },
        ),
        Param::new(
            "second_amplitude",
            "um",
            "amplitude of a second wave, of either sign",
            0.0,
            (-50.0, 50.0),
            Prior::Normal { mean: 0.0, sd: 2.0 },
        )
        .neutral(0.0)
        .fixed(),
        Param::new(
            "second_phase",
            "rad",
            "its phase at the start of the path",
            0.0,
            (-PI, PI),
            Prior::Uniform { low: -PI, high: PI },
        )
        .role(ParamRole::WavePhase)
        .fixed(),
        Param::new(
            "second_waves",
            "-",
            "its waves along the path of contact",
            4.0,
            (0.5, 12.0),
            Prior::LogNormal {
                median: 4.0,
                spread: 1.8,
            },
        )
        .fixed(),
    ],
    forms: &[Form {
        name: "two waves",
        frees: &["second_amplitude", "second_phase", "second_waves"],
        grown: &SECOND_WAVES,
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(ProfileForm {
            amplitude: p[0],
            phase: p[1],
            waves: p[2],
            second: [p[3], p[4], p[5]],
        })
    },
};

struct ProfileForm {
    amplitude: f64,
    phase: f64,
    waves: f64,
    /// Amplitude, phase and waves of a second wave.
    second: [f64; 3],
}

impl Effect for ProfileForm {
    fn profile(&self, at: &ProfileAt) -> f64 {
        if at.member == Member::Gear {
            return 0.0;
        }
        let wave = |amplitude: f64, phase: f64, waves: f64| {
            amplitude * (TAU * waves * at.along + phase).cos()
        };
        let [amplitude, phase, waves] = self.second;
        // adding zero turns −0 into 0
        wave(self.amplitude, self.phase, self.waves) + wave(amplitude, phase, waves) + 0.0
    }
}
