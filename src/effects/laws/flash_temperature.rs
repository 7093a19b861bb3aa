//! Contacts that run hot wear faster: softening of the flank, loss of the boundary film.
//!
//! ```text
//! T_c = T_bulk + ΔT,   f = exp(β (T_c − T_ref))              ΔT Blok's flash temperature
//!                      f = (1 − β (T_c − T_ref)/n)^−n        n = 1: hardness falls linearly; n → ∞ is the exponential
//!                      f = 1 + (Q − 1)/(1 + exp((T_t − T_c)/w))          activated: the film fails about T_t
//! ```
//! The exponent is kept within ±30 and the base above 1e-3, so that no state gives an infinite factor.

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "flash_temperature",
    hook: Hook::WearFactor,
    formula: "wear_factor = exp(min(max(sensitivity*(bulk_temperature + flash_temperature - reference_temperature), -30), 30))",
    source: "flash temperature: H. Blok (1937) in the form of ISO/TS 6336-20, its factor 1.11 derived again in the tests; B_M of steel agrees with the standard's 435 N/(mm^0.5 m^0.5 s^0.5 K) as public codes quote it. That wear follows the contact temperature exponentially, or as 1/(1 - beta dT) by the hardness, is common use, without a single source.",
    signature: "most at both ends of the path, none at the pitch point, more at speed; grows as T^(3/4) and n^(1/2), more at the root than at the tip; the bulk part multiplies everywhere",
    confounded_with: &[
        "sliding_speed_exponent",
        "dynamic_load",
        "energy_wear",
        "oxidative",
    ],
    separated_by: "the same sliding at another oil temperature; high speed with high torque",
    left_out: "the heat balance of the gears: the bulk temperature is the stated one, and friction heats by one coefficient",
    needs: &[
        "lubricant.friction_coefficient",
        "thermal.bulk_temperature",
        "thermal.conductivity",
        "thermal.specific_heat",
    ],
    params: &[
        Param::new(
            "sensitivity",
            "1/K",
            "relative growth of wear per kelvin",
            0.008,
            (0.0, 0.2),
            Prior::LogNormal {
                median: 0.008,
                spread: 2.0,
            },
        )
        .neutral(0.0),
        Param::new(
            "reference_temperature",
            "degC",
            "contact temperature at which the factor is 1",
            60.0,
            (-50.0, 300.0),
            Prior::Normal {
                mean: 60.0,
                sd: 20.0,
            },
        )
        .fixed(),
        Param::new(
            "shape",
            "-",
            "1: softening with linearly falling hardness; inf is the exponential",
            f64::INFINITY,
            (0.5, f64::INFINITY),
            Prior::LogNormal {
                median: 2.0,
                spread: 2.0,
            },
        )
        .fixed(),
        Param::new(
            "ratio",
            "-",
            "wear above a transition temperature over that below",
            1.0,
            (0.01, 300.0),
            Prior::LogNormal {
                median: 5.0,
                spread: 2.5,
            },
        )
        .neutral(1.0)
        .fixed(),
        Param::new(
            "transition",
            "degC",
            "contact temperature of the transition",
            80.0,
            (-50.0, 500.0),
            Prior::Normal {
                mean: 80.0,
                sd: 30.0,
            },
        )
        .fixed(),
        Param::new(
            "transition_width",
            "K",
            "scale of the transition",
            5.0,
            (0.1, 100.0),
            Prior::LogNormal {
                median: 5.0,
                spread: 2.0,
            },
        )
        .fixed(),
    ],
    forms: &[
        Form {
            name: "softening",
            settings: &[("shape", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "activated",
            settings: &[("sensitivity", 0.0), ("ratio", 5.0)],
            frees: &["ratio", "transition", "transition_width"],
            idle: &["sensitivity"],
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(FlashTemperature {
            sensitivity: p[0],
            reference_temperature: p[1],
            shape: p[2],
            ratio: p[3],
            transition: p[4],
            transition_width: p[5],
        })
    },
};

struct FlashTemperature {
    sensitivity: f64,
    reference_temperature: f64,
    shape: f64,
    ratio: f64,
    transition: f64,
    transition_width: f64,
}

impl Effect for FlashTemperature {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        let contact = at.bulk_temperature + at.flash_temperature;
        let x = self.sensitivity * (contact - self.reference_temperature);
        let exponent = if self.shape.is_infinite() {
            x
        } else {
            -self.shape * (1.0 - x / self.shape).max(1e-3).ln()
        };
        let short_of = (self.transition - contact) / self.transition_width;
        let activated = 1.0 + (self.ratio - 1.0) / (1.0 + short_of.exp());
        exponent.clamp(-30.0, 30.0).exp() * activated
    }
}
