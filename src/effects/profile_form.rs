//! Waviness of the flank as made.
//!
//! ```text
//! e = A cos(2π j x + φ)        x from 0 at the start to 1 at the end of the path of contact, on the pinion
//! ```
//! Only the sum of both flanks' deviations enters the contact, so it stands on the pinion alone.

use std::f64::consts::{PI, TAU};

use super::{Card, Effect, Hook, Param, Prior, ProfileAt};
use crate::gear::Member;

pub(super) const CARD: Card = Card {
    name: "profile_form",
    hook: Hook::Profile,
    formula: "profile = pinion*amplitude*cos(2*pi*waves*along + phase)",
    source: "profile form deviation f_falpha of ISO 1328-1 as one wave; 1 to 5 um is engineering judgement.",
    signature: "waves printed into the wear of both members, mirrored, then worn off",
    confounded_with: &["plastic_deformation", "dynamic_load", "profile_slope"],
    separated_by: "the profile as made",
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
        ),
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
    ],
    forms: &[],
    build: |p| {
        Box::new(ProfileForm {
            amplitude: p[0],
            phase: p[1],
            waves: p[2],
        })
    },
};

struct ProfileForm {
    amplitude: f64,
    phase: f64,
    waves: f64,
}

impl Effect for ProfileForm {
    fn profile(&self, at: &ProfileAt) -> f64 {
        if at.member == Member::Gear {
            return 0.0;
        }
        // adding zero turns −0 into 0
        self.amplitude * (TAU * self.waves * at.along + self.phase).cos() + 0.0
    }
}
