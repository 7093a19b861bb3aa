//! Wear that is not proportional to pressure.
//!
//! ```text
//! dh = k p_ref (p/p_ref)^m v dt,   so k is multiplied by (p/p_ref)^(m − 1)      p MPa, here and now
//!                                  or  by (p_H/p_ref)^(m − 1)      p_H MPa, Hertz's for the load of the pair, alike over the contact
//!                                  or  by 1 + g max(0, p − p_t)/p_ref, linear above a threshold
//! ```
//! Over Hertz's ellipse the first two are the same but for a constant; where wear or a corner makes another shape they are not.
//! Below [`LEAST_PRESSURE`] the factor stays what it is there: with m < 1 it would grow without bound as p goes to zero, while
//! the wear p^m goes to zero.

use crate::effects::{Card, Effect, Form, Hook, Local, Param, ParamRole, Prior};

/// Pressure below which the factor no longer changes, MPa.
const LEAST_PRESSURE: f64 = 1e-3;

pub(super) const CARD: Card = Card {
    name: "pressure_exponent",
    hook: Hook::WearFactor,
    formula: "wear_factor = (max((1 - hertz)*p + hertz*p_hertz, 0.001)/reference_pressure)^(exponent - 1)",
    source: "generalised Archard law with a power of the pressure, after S.K. Rhee, Wear equation for polymers sliding against metal surfaces, Wear 16 (1970) 431-445 (W = K P^a v^b t^c); slow-speed gear wear about sigma_H^1.4 after Plewe (1980), quoted in AGMA 925-A03. Neither re-read: the power law is used, no figure of theirs.",
    signature: "single contact and pinion root wear more than the tip (exponent above 1); wear grows with torque as T^((m+1)/2), no dependence on speed, none on time except by conformity",
    confounded_with: &[
        "severe_transition",
        "dynamic_load",
        "lead_misalignment",
        "micropitting",
    ],
    separated_by: "three torques on one flank shape, with replicates",
    left_out: "a cause: an empirical power of the pressure",
    needs: &[],
    params: &[
        Param::new(
            "exponent",
            "-",
            "power m of the pressure; 1 is Archard's law",
            1.5,
            (0.2, 5.0),
            Prior::Uniform {
                low: 0.5,
                high: 3.0,
            },
        )
        .role(ParamRole::PressureSharpness)
        .neutral(1.0),
        Param::new(
            "reference_pressure",
            "MPa",
            "pressure at which the factor is 1",
            1000.0,
            (1.0, 1e4),
            Prior::LogNormal {
                median: 1000.0,
                spread: 1.5,
            },
        )
        .fixed(),
        Param::new(
            "gain",
            "-",
            "growth above a threshold: of the factor, over the reference pressure",
            0.0,
            (0.0, 100.0),
            Prior::LogNormal {
                median: 3.0,
                spread: 2.5,
            },
        )
        .neutral(0.0)
        .fixed(),
        Param::either(
            "hertz",
            "0 for the pressure here and now, 1 for Hertz's under the load of the pair",
        ),
        Param::new(
            "threshold",
            "MPa",
            "pressure from which that growth sets in",
            500.0,
            (1.0, 5000.0),
            Prior::LogNormal {
                median: 500.0,
                spread: 1.6,
            },
        )
        .fixed(),
    ],
    forms: &[
        Form {
            name: "Hertz pressure",
            settings: &[("hertz", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "linear above a threshold",
            settings: &[("exponent", 1.0), ("gain", 3.0)],
            frees: &["gain", "threshold"],
            idle: &["exponent"],
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(PressureExponent {
            exponent: p[0],
            reference_pressure: p[1],
            gain: p[2],
            hertz: p[3],
            threshold: p[4],
        })
    },
};

struct PressureExponent {
    exponent: f64,
    reference_pressure: f64,
    gain: f64,
    hertz: f64,
    threshold: f64,
}

impl Effect for PressureExponent {
    /// If it follows Hertz's pressure alone.
    fn is_even(&self) -> bool {
        self.hertz == 1.0 && self.gain == 0.0
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        let pressure = (1.0 - self.hertz) * at.pressure + self.hertz * at.hertz_pressure;
        let power =
            (pressure.max(LEAST_PRESSURE) / self.reference_pressure).powf(self.exponent - 1.0);
        let above = (at.pressure - self.threshold).max(0.0) / self.reference_pressure;
        power * (1.0 + self.gain * above)
    }
}
