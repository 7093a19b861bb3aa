//! Mild wear turns severe where the load passes a limit.
//!
//! ```text
//! f = 1 + (Q − 1)/(1 + exp((x_c − x)/(δ x_c)))       x = p max(v, 0.02)^n, n = 0: pressure, n = 1: p v
//! ```
//! p is the largest pressure that the point sees, or Hertz's for the load of the pair on the unworn flanks: wear flattens the first, and a
//! limit as sharp as this one tells them apart.

use crate::effects::{Card, Effect, Form, Hook, Local, Param, ParamRole, Prior};

pub(super) const CARD: Card = Card {
    name: "severe_transition",
    hook: Hook::WearFactor,
    formula: "wear_factor = 1 + (ratio - 1)/(1 + exp((1 - ((1 - hertz)*p_max + hertz*p_hertz)*max(v_slide, 0.02)^speed_exponent/limit)/width))",
    source: "J.F. Archard, W. Hirst, The wear of metals under unlubricated conditions, Proc. R. Soc. A 236 (1956) 397-410; N.C. Welsh (1965); wear maps of S.C. Lim, M.F. Ashby, Acta Metall. 35 (1987) 1-24. They give the jump and its size; the logistic step is our own smoothing of it. Papers not re-read.",
    signature: "a band with sharp edges where pressure is highest, above some torque; with a speed exponent at the pinion's root; may end as wear lowers the pressure",
    confounded_with: &["pressure_exponent", "plastic_deformation", "tip_relief"],
    separated_by: "torques just below and just above the jump",
    left_out: "what makes the change: the coefficient passes from one level to another at a limit",
    needs: &[],
    params: &[
        Param::new(
            "ratio",
            "-",
            "severe over mild wear coefficient",
            10.0,
            (0.1, 300.0),
            Prior::LogNormal {
                median: 10.0,
                spread: 3.0,
            },
        )
        .neutral(1.0),
        Param::new(
            "limit",
            "MPa (m/s)^n",
            "peak pressure, or its product with the sliding speed, of the transition",
            800.0,
            (10.0, 1e4),
            Prior::LogNormal {
                median: 800.0,
                spread: 1.5,
            },
        )
        .role(ParamRole::PressureSharpness),
        Param::new(
            "width",
            "-",
            "width of the transition relative to its limit",
            0.04,
            (0.005, 0.5),
            Prior::LogNormal {
                median: 0.04,
                spread: 1.5,
            },
        ),
        Param::new(
            "speed_exponent",
            "-",
            "power of the sliding speed (m/s) beside the pressure",
            0.0,
            (0.0, 2.0),
            Prior::Uniform {
                low: 0.0,
                high: 1.0,
            },
        )
        .fixed(),
        Param::either(
            "hertz",
            "0 for the largest pressure the point sees, 1 for Hertz's under the load of the pair",
        ),
    ],
    forms: &[
        Form {
            name: "Hertz pressure",
            settings: &[("hertz", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "pressure times speed",
            settings: &[("speed_exponent", 1.0), ("limit", 500.0)],
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(SevereTransition {
            ratio: p[0],
            limit: p[1],
            width: p[2],
            speed_exponent: p[3],
            hertz: p[4],
        })
    },
};

struct SevereTransition {
    ratio: f64,
    limit: f64,
    width: f64,
    speed_exponent: f64,
    hertz: f64,
}

impl Effect for SevereTransition {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        let pressure = (1.0 - self.hertz) * at.peak_pressure + self.hertz * at.hertz_pressure;
        let x = pressure * at.floored_sliding().powf(self.speed_exponent);
        1.0 + (self.ratio - 1.0) / (1.0 + ((1.0 - x / self.limit) / self.width).exp())
    }
}
