//! Running-in: fresh flanks wear faster until their asperities are gone.
//!
//! ```text
//! k(n) = k (1 + A exp(−n/N))              A (-) excess at n = 0, N pinion cycles
//! k(n) = k (1 + A (1 + n/(q N))^−q)       the same start, a longer tail; q → ∞ is the exponential
//! n counted in contacts of the member itself: the gear's excess lasts longer by the ratio of teeth
//! k(h) = k (1 + A exp(−h/h_r))            local memory: gone with the depth worn, h_r (µm) about Rz
//! ```

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "running_in",
    hook: Hook::WearFactor,
    formula: "wear_factor = 1 + amplitude*exp(-cycles/decay_cycles)",
    source: "C.A. Queener, T.C. Smith, W.L. Mitchell, Transient wear of machine parts, Wear 8 (1965) 391-400 (exponential); P.J. Blau, On the nature of running-in, Tribol. Int. 38 (2006) 1007-1012; the hyperbolic tail as in R. Kumar, B. Prakash, A. Sethuramiah (2002). Titles checked, the papers' equations not re-read.",
    signature: "early excess on both flanks, gone after about three decay times; in the shape of the base wear, straight later, nothing at the pitch point",
    confounded_with: &[
        "surface_layer",
        "coating",
        "roughness_polish",
        "lubricant_ageing",
        "debris_abrasion",
    ],
    separated_by: "checkpoints before half a decay time and after three; two torques (counted in cycles or in depth); the depth at the pitch point",
    left_out: "surfaces: the excess dies out with cycles or depth, whatever the load",
    needs: &[],
    params: &[
        Param::new(
            "amplitude",
            "-",
            "excess of the initial wear coefficient over the steady one",
            3.0,
            (0.0, 50.0),
            Prior::LogNormal {
                median: 3.0,
                spread: 2.5,
            },
        )
        .neutral(0.0),
        Param::new(
            "decay_cycles",
            "pinion cycles",
            "cycles in which the excess falls to 1/e",
            1e5,
            (1e2, 1e9),
            Prior::LogNormal {
                median: 1e5,
                spread: 4.0,
            },
        ),
        Param::new(
            "shape",
            "-",
            "exponent of a hyperbolic decay with the same initial slope; inf is the exponential",
            f64::INFINITY,
            (0.2, f64::INFINITY),
            Prior::LogNormal {
                median: 1.5,
                spread: 1.5,
            },
        )
        .fixed(),
        Param::new(
            "decay_depth",
            "um",
            "depth worn in which the excess falls to 1/e; inf if it does not follow the depth",
            f64::INFINITY,
            (1e-2, f64::INFINITY),
            Prior::LogNormal {
                median: 3.0,
                spread: 4.0,
            },
        )
        .fixed(),
        Param::either(
            "own_contacts",
            "0: the decay is counted in pinion cycles; 1: in contacts of the member itself",
        ),
    ],
    forms: &[
        Form {
            name: "counted in own contacts",
            settings: &[("own_contacts", 1.0)],
            of_ratio: true,
            ..Form::PLAIN
        },
        Form {
            name: "hyperbolic",
            settings: &[("shape", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "steep hyperbolic",
            settings: &[("shape", 2.0)],
            ..Form::PLAIN
        },
        Form {
            name: "local memory",
            settings: &[("decay_cycles", 1e9), ("decay_depth", 3.0)],
            frees: &["decay_depth"],
            idle: &["decay_cycles"],
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(RunningIn {
            amplitude: p[0],
            decay_cycles: p[1],
            shape: p[2],
            decay_depth: p[3],
            own_contacts: p[4],
        })
    },
};

struct RunningIn {
    amplitude: f64,
    decay_cycles: f64,
    shape: f64,
    decay_depth: f64,
    own_contacts: f64,
}

impl Effect for RunningIn {
    /// Unless it remembers the depth.
    fn is_even(&self) -> bool {
        self.decay_depth.is_infinite()
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        let counted = at.cycles.powf(1.0 - self.own_contacts) * at.contacts.powf(self.own_contacts);
        let x = counted / self.decay_cycles;
        let left = if self.shape.is_infinite() {
            (-x).exp()
        } else {
            (1.0 + x / self.shape).powf(-self.shape)
        };
        1.0 + self.amplitude * left * (-at.depth / self.decay_depth).exp()
    }
}
