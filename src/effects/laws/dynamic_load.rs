//! The teeth vibrate in the rhythm of the mesh.
//!
//! ```text
//! F = F_n (1 + m u² + κ u^e G(r) cos(2π s/p_b + φ) + κ₂ u^e G(2r) cos(4π s/p_b + φ₂)),   r = n/n_E,  u = n/n_ref
//! G(r) = 1/√((1 − r²)² + (2ζr)²)        one degree of freedom; κ₂ = 0: the first harmonic alone, m = 0: the mean stays
//! n_E = 30000/(π z1) √(c_γ/m_red) rpm        c_γ N/(mm µm), m_red kg/mm
//! ```
//! The load is kept above a twentieth of its mean: loss of contact is not modelled, nor that wear itself excites.

use std::f64::consts::{PI, TAU};

use crate::effects::{Card, Effect, Form, Hook, Local, Param, ParamRole, Prior};

pub(super) const CARD: Card = Card {
    name: "dynamic_load",
    hook: Hook::LoadFactor,
    formula: "load_factor = max(0.05, 1 + mean_rise*(speed/reference_speed)^2 + (speed/reference_speed)^speed_exponent*amplitude*cos(2*pi*s/base_pitch + phase)/sqrt((1 - (speed/resonance_speed)^2)^2 + (2*damping*speed/resonance_speed)^2) + (speed/reference_speed)^speed_exponent*second_amplitude*cos(4*pi*s/base_pitch + second_phase)/sqrt((1 - (2*speed/resonance_speed)^2)^2 + (4*damping*speed/resonance_speed)^2))",
    source: "steady response of a damped oscillator; resonance speed n_E = 30000/(pi z1) sqrt(c_gamma/m_red), ISO 6336-1 Eq. (6) as two public codes quote it, the standard itself not read. Mean load and ripple apart, growing with powers of the speed: parametric, as the inertia forces of deviations do below the resonance. Feedback of wear on the vibration: H. Ding, A. Kahraman (2007), not modelled.",
    signature: "a ripple of one base pitch along the flank, largest near the resonance speed",
    confounded_with: &[
        "flash_temperature",
        "sliding_speed_exponent",
        "pressure_exponent",
        "profile_form",
    ],
    separated_by: "tests at several speeds, one near the resonance and one below a tenth of it; an accelerometer",
    left_out: "the equation of motion: the ripple is given, follows no transmission error and is not fed by wear; teeth never part",
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
            (-PI, PI),
            Prior::Uniform { low: -PI, high: PI },
        )
        .role(ParamRole::WavePhase),
        Param::new(
            "resonance_speed",
            "rpm",
            "pinion speed at which the mesh frequency meets the resonance",
            15000.0,
            (50.0, 1e6),
            Prior::LogNormal {
                median: 15000.0,
                spread: 4.0,
            },
        )
        .role(ParamRole::IdentifyingSpeed),
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
        Param::new(
            "mean_rise",
            "-",
            "rise of the mean load at the reference speed; it grows with the square of the speed",
            0.0,
            (0.0, 10.0),
            Prior::LogNormal {
                median: 0.1,
                spread: 2.5,
            },
        )
        .neutral(0.0)
        .role(ParamRole::IdentifyingSpeed)
        .fixed(),
        Param::new(
            "speed_exponent",
            "-",
            "power of the speed with which the ripple grows, besides the resonance",
            0.0,
            (0.0, 4.0),
            Prior::Normal { mean: 1.0, sd: 1.0 },
        )
        .fixed(),
        Param::new(
            "reference_speed",
            "rpm",
            "pinion speed at which rise and ripple are stated where they grow with powers of the speed",
            2000.0,
            (1.0, 1e6),
            Prior::LogNormal {
                median: 2000.0,
                spread: 2.0,
            },
        )
        .fixed(),
        Param::new(
            "second_amplitude",
            "-",
            "ripple twice as fast, of either sign",
            0.0,
            (-2.0, 2.0),
            Prior::Normal { mean: 0.0, sd: 0.1 },
        )
        .neutral(0.0)
        .fixed(),
        Param::new(
            "second_phase",
            "rad",
            "its phase at the pitch point",
            0.0,
            (-PI, PI),
            Prior::Uniform { low: -PI, high: PI },
        )
        .role(ParamRole::WavePhase)
        .fixed(),
    ],
    forms: &[
        Form {
            name: "two harmonics",
            frees: &["second_amplitude", "second_phase"],
            grown: &[&[0.05, 0.0]],
            ..Form::PLAIN
        },
        Form {
            name: "mean and ripple",
            settings: &[
                ("resonance_speed", 1e6),
                ("mean_rise", 0.1),
                ("speed_exponent", 1.0),
            ],
            frees: &["mean_rise", "speed_exponent"],
            idle: &["resonance_speed"],
            signature: "a ripple of one base pitch along the flank and a higher mean load, both growing with the speed",
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(DynamicLoad {
            amplitude: p[0],
            phase: p[1],
            resonance_speed: p[2],
            damping: p[3],
            mean_rise: p[4],
            speed_exponent: p[5],
            reference_speed: p[6],
            second_amplitude: p[7],
            second_phase: p[8],
        })
    },
};

struct DynamicLoad {
    amplitude: f64,
    phase: f64,
    resonance_speed: f64,
    damping: f64,
    second_amplitude: f64,
    second_phase: f64,
    mean_rise: f64,
    speed_exponent: f64,
    reference_speed: f64,
}

impl DynamicLoad {
    /// Ripple of the load by harmonic number `times` of the mesh, relative to its mean.
    fn ripple(&self, at: &Local, times: f64, amplitude: f64, phase: f64) -> f64 {
        let r = times * at.speed / self.resonance_speed;
        let gain = 1.0 / (1.0 - r * r).hypot(2.0 * self.damping * r);
        amplitude * gain * (times * TAU * at.path / at.base_pitch + phase).cos()
    }
}

impl Effect for DynamicLoad {
    fn load_factor(&self, at: &Local) -> f64 {
        let first = self.ripple(at, 1.0, self.amplitude, self.phase);
        let second = self.ripple(at, 2.0, self.second_amplitude, self.second_phase);
        let speed = at.speed / self.reference_speed;
        let mean = 1.0 + self.mean_rise * speed.powi(2);
        (mean + speed.powf(self.speed_exponent) * (first + second)).max(0.05)
    }
}
