//! The teeth vibrate in the rhythm of the mesh.
//!
//! ```text
//! F = F_n (1 + κ G cos(2π s/p_b + φ)),   G = 1/√((1 − r²)² + (2ζr)²),   r = n/n_E        one degree of freedom
//! n_E = 30000/(π z1) √(c_γ/m_red) rpm        c_γ N/(mm µm), m_red kg/mm
//! ```
//! The load is kept above a twentieth of its mean: loss of contact is not modelled, nor that wear itself excites.

use std::f64::consts::TAU;

use super::{Card, Effect, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "dynamic_load",
    hook: Hook::LoadFactor,
    formula: "load_factor = max(0.05, 1 + amplitude*cos(2*pi*s/base_pitch + phase)/sqrt((1 - (speed/resonance_speed)^2)^2 + (2*damping*speed/resonance_speed)^2))",
    source: "steady response of a damped oscillator; resonance speed n_E = 30000/(pi z1) sqrt(c_gamma/m_red), ISO 6336-1 Eq. (6) as two public codes quote it, the standard itself not read. Feedback of wear on the vibration: H. Ding, A. Kahraman (2007), not modelled.",
    signature: "a ripple of one base pitch along the flank that depends on speed; none at low speed",
    confounded_with: &[
        "flash_temperature",
        "sliding_speed_exponent",
        "pressure_exponent",
        "profile_form",
    ],
    separated_by: "a slow test (below a tenth of the resonance); an accelerometer",
    needs: &[],
    params: &[
        Param::new(
            "amplitude",
            "-",
            "ripple of the load at low speed, relative to its mean",
            0.15,
            (0.0, 2.0),
            Prior::LogNormal {
                median: 0.15,
                spread: 2.0,
            },
        )
        .neutral(0.0),
        Param::new(
            "phase",
            "rad",
            "phase of the ripple at the pitch point",
            0.0,
            (-std::f64::consts::PI, std::f64::consts::PI),
            Prior::Uniform {
                low: -std::f64::consts::PI,
                high: std::f64::consts::PI,
            },
        ),
        Param::new(
            "resonance_speed",
            "rpm",
            "pinion speed at which the mesh frequency meets the resonance",
            15000.0,
            (50.0, 1e6),
            Prior::LogNormal {
                median: 15000.0,
                spread: 2.5,
            },
        ),
        Param::new(
            "damping",
            "-",
            "damping ratio",
            0.07,
            (0.01, 1.0),
            Prior::LogNormal {
                median: 0.07,
                spread: 1.4,
            },
        )
        .fixed(),
    ],
    forms: &[],
    build: |p| {
        Box::new(DynamicLoad {
            amplitude: p[0],
            phase: p[1],
            resonance_speed: p[2],
            damping: p[3],
        })
    },
};

struct DynamicLoad {
    amplitude: f64,
    phase: f64,
    resonance_speed: f64,
    damping: f64,
}

impl Effect for DynamicLoad {
    fn load_factor(&self, at: &Local) -> f64 {
        let r = at.speed / self.resonance_speed;
        let gain = 1.0 / (1.0 - r * r).hypot(2.0 * self.damping * r);
        (1.0 + self.amplitude * gain * (TAU * at.path / at.base_pitch + self.phase).cos()).max(0.05)
    }
}
