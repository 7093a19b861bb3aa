//! Flanks rub: friction turns the force between them, which moves its lever and bends the teeth.
//!
//! ```text
//! µ(s) = µ₀ (w/(v_Σ ρ))^m · (1 in approach, q in recess)        w N/mm, v_Σ m/s sum of the rolling speeds, ρ mm
//! ```
//! By finite elements it is Coulomb friction in the contact itself, fully slipping, against the sliding. Analytically only the lever moves:
//!
//! ```text
//! T1 = Σ F_i (r_b1 ± µ ρ1_i)        − in approach, + in recess: loads are higher before the pitch point than after it
//! ```

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "friction_load",
    hook: Hook::Friction,
    formula: "added_friction = coefficient*(normal_load/(2*max(v_roll, 0.01)*max(relative_radius, 0.01)))^load_exponent*(approach + (1 - approach)*recess_ratio)",
    source: "Coulomb friction with the direction of sliding. Moments of normal and friction force about the pinion's centre: statics, checked by hand in the tests. Exponent 0.2: the mean tooth friction of ISO/TR 14179-2.",
    signature: "a small step of the load at the pitch point; of 2 mu rho1/r_b1, in the transmission error too; teeth bend less in approach, more in recess",
    confounded_with: &["approach_recess"],
    separated_by: "measured torque loss; reversed drive",
    left_out: "sticking: flanks slip everywhere, so the force turns over in a jump at the pitch point; the friction coefficient does not follow wear",
    needs: &[],
    params: &[
        Param::new(
            "coefficient",
            "-",
            "coefficient of friction (where the load counts: at w = v_sum rho in N/mm, m/s and mm)",
            0.06,
            (0.0, 1.0),
            Prior::LogNormal {
                median: 0.06,
                spread: 1.8,
            },
        )
        .neutral(0.0),
        Param::new(
            "load_exponent",
            "-",
            "power of load over rolling speed and relative radius; 0: one coefficient everywhere",
            0.0,
            (0.0, 1.0),
            Prior::Uniform {
                low: 0.0,
                high: 1.0,
            },
        )
        .fixed(),
        Param::new(
            "recess_ratio",
            "-",
            "coefficient in recess over that in approach",
            1.0,
            (0.0, 10.0),
            Prior::LogNormal {
                median: 1.0,
                spread: 1.5,
            },
        )
        .fixed(),
    ],
    forms: &[
        Form {
            name: "other in recess",
            frees: &["recess_ratio"],
            grown: &[&[0.7], &[1.4]],
            ..Form::PLAIN
        },
        Form {
            name: "of load and speed",
            settings: &[("load_exponent", 0.2)],
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(FrictionLoad {
            coefficient: p[0],
            load_exponent: p[1],
            recess_ratio: p[2],
        })
    },
};

/// Least rolling speed, m/s, and relative radius, mm: the power law has no bound at a standing or pointed contact.
const LEAST: f64 = 0.01;

struct FrictionLoad {
    coefficient: f64,
    load_exponent: f64,
    recess_ratio: f64,
}

impl Effect for FrictionLoad {
    fn friction(&self, at: &Local) -> f64 {
        let rolling = 2.0 * at.entraining_speed().max(LEAST);
        let load = at.normal_load / (rolling * at.relative_radius().max(LEAST));
        let of_side = if at.approach { 1.0 } else { self.recess_ratio };
        self.coefficient * load.powf(self.load_exponent) * of_side
    }
}
