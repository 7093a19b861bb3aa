//! A skin that wears unlike what lies under it: decarburised or plated (softer), nitride layer (harder).
//!
//! ```text
//! f = 1 + (Q − 1)(1 − exp(−(h/d)^m))        h µm worn so far, Q inner over skin coefficient, m = 1; k is the skin's
//! ```

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "surface_layer",
    hook: Hook::WearFactor,
    formula: "wear_factor = 1 + (ratio - 1)*(1 - exp(-(depth/thickness)^steepness))",
    source: "our own smooth form of wear inverse to a hardness that changes with depth (Archard, J. Appl. Phys. 24 (1953) 981: k = K/H). Layer thicknesses of 3 to 20 µm are engineering judgement, and the prior is wider; a carburised case changes by less than 1 % over 10 µm.",
    signature: "a kink at the same depth everywhere, the pinion's root first; so at other cycles for each point, member and torque",
    confounded_with: &["running_in", "coating", "debris_abrasion"],
    separated_by: "depth over cycles at points that wear three to ten times apart; two torques",
    left_out: "a hardness profile: the coefficient alone changes with depth",
    needs: &[],
    params: &[
        Param::new(
            "ratio",
            "-",
            "wear coefficient inside over that of the skin",
            2.0,
            (0.02, 50.0),
            Prior::LogNormal {
                median: 1.5,
                spread: 2.5,
            },
        )
        .neutral(1.0),
        Param::new(
            "thickness",
            "um",
            "depth over which the skin passes into the inside",
            8.0,
            (0.2, 500.0),
            Prior::LogNormal {
                median: 4.0,
                spread: 4.0,
            },
        ),
        Param::new(
            "steepness",
            "-",
            "power of depth: 1 passes evenly, 3 within half a thickness",
            1.0,
            (0.5, 6.0),
            Prior::LogNormal {
                median: 1.0,
                spread: 2.0,
            },
        )
        .fixed(),
    ],
    forms: &[Form {
        name: "steep",
        settings: &[("steepness", 3.0)],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(SurfaceLayer {
            ratio: p[0],
            thickness: p[1],
            steepness: p[2],
        })
    },
};

struct SurfaceLayer {
    ratio: f64,
    thickness: f64,
    steepness: f64,
}

impl Effect for SurfaceLayer {
    fn wear_factor(&self, at: &Local) -> f64 {
        1.0 + (self.ratio - 1.0) * (1.0 - (-(at.depth / self.thickness).powf(self.steepness)).exp())
    }
}
