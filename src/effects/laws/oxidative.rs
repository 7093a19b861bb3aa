//! Mild oxidational wear: an oxide grows between contacts and is rubbed off when it is thick enough.
//!
//! ```text
//! f = 1 − a + a (v_ref/max(v, 0.02))^s exp(−(Q/R) (1/T_c − 1/T_ref))        a = 1, s = 1, T in K, R = 8.314 J/(mol K)
//! ```
//! Wear per sliding distance falls as 1/v because the oxide grows in time, not in distance. The exponent is kept within ±30.
//! a is the part of the wear that is oxidational; the rest follows the base law.

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

/// Gas constant, kJ/(mol K) (CODATA 2018).
const GAS: f64 = 8.314_462_618e-3;
/// 0 °C in K.
const ZERO_CELSIUS: f64 = 273.15;

pub(super) const CARD: Card = Card {
    name: "oxidative",
    hook: Hook::WearFactor,
    formula: "wear_factor = 1 - part + part*(reference_speed/max(v_slide, 0.02))^speed_exponent*exp(min(max(activation_energy/0.008314462618*(1/(reference_temperature + 273.15) - 1/max(bulk_temperature + flash_temperature + 273.15, 100)), -30), 30))",
    source: "T.F.J. Quinn, Review of oxidational wear, Tribol. Int. 16 (1983) 257-271 and 305-315, and Quinn (1971): oxide to a critical thickness of 1 to 3 µm, Arrhenius growth; abstract read, and the Arrhenius term as Eq. (3.63) of R.G. Bayer, Mechanical Wear Fundamentals and Testing. Linear growth (wear as 1/v) is taken; parabolic growth gives the square root of the exponential.",
    signature: "the same loss per contact wherever there is sliding; Arrhenius in the oil temperature; wear per cycle as 1/n",
    confounded_with: &[
        "sliding_speed_exponent",
        "corrosive_loss",
        "film_thickness",
        "flash_temperature",
    ],
    separated_by: "oil temperature 20 K up and down",
    left_out: "the oxide's own balance: its steady rate by speed and temperature",
    needs: &[
        "lubricant.friction_coefficient",
        "thermal.bulk_temperature",
        "thermal.conductivity",
        "thermal.specific_heat",
    ],
    params: &[
        Param::new(
            "activation_energy",
            "kJ/mol",
            "activation energy of the oxide's growth",
            100.0,
            (0.0, 300.0),
            Prior::Uniform {
                low: 50.0,
                high: 210.0,
            },
        )
        .neutral(0.0),
        Param::new(
            "speed_exponent",
            "-",
            "power of 1/v; 1 for an oxide that grows in time",
            1.0,
            (0.0, 2.0),
            Prior::Normal { mean: 1.0, sd: 0.2 },
        )
        .neutral(0.0)
        .fixed(),
        Param::new(
            "reference_temperature",
            "degC",
            "contact temperature at which the Arrhenius term is 1",
            60.0,
            (-50.0, 300.0),
            Prior::Normal {
                mean: 60.0,
                sd: 20.0,
            },
        )
        .fixed(),
        Param::new(
            "reference_speed",
            "m/s",
            "sliding speed at which the speed term is 1",
            1.0,
            (0.01, 100.0),
            Prior::LogNormal {
                median: 1.0,
                spread: 2.0,
            },
        )
        .fixed(),
        Param::new(
            "part",
            "-",
            "part of the wear that is oxidational",
            1.0,
            (0.0, 1.0),
            Prior::Uniform {
                low: 0.0,
                high: 1.0,
            },
        )
        .neutral(0.0)
        .fixed(),
    ],
    forms: &[Form {
        name: "part of the wear",
        settings: &[("part", 0.3)],
        frees: &["part"],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(Oxidative {
            activation_energy: p[0],
            speed_exponent: p[1],
            reference_temperature: p[2],
            reference_speed: p[3],
            part: p[4],
        })
    },
};

struct Oxidative {
    activation_energy: f64,
    speed_exponent: f64,
    reference_temperature: f64,
    reference_speed: f64,
    part: f64,
}

impl Effect for Oxidative {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        let kelvin = (at.bulk_temperature + at.flash_temperature + ZERO_CELSIUS).max(100.0);
        let inverse = 1.0 / (self.reference_temperature + ZERO_CELSIUS) - 1.0 / kelvin;
        let exponent = (self.activation_energy / GAS * inverse).clamp(-30.0, 30.0);
        let speed = (self.reference_speed / at.floored_sliding()).powf(self.speed_exponent);
        1.0 - self.part + self.part * (speed * exponent.exp())
    }
}
