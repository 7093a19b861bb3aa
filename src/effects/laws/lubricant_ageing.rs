//! The oil's additives are used up in running hours.
//!
//! ```text
//! f = 1 + (Q − 1)(1 − exp(−t/τ))        t h run, Q aged over fresh
//! ```
//! That heat shortens τ is not modelled.

use crate::effects::{Card, Effect, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "lubricant_ageing",
    hook: Hook::WearFactor,
    formula: "wear_factor = 1 + (ratio - 1)*(1 - exp(-hours/life))",
    source: "first-order depletion of an additive, a parametric form without a single source; no figure of the literature enters.",
    signature: "depth bends upwards in hours run, not in cycles or depth; unchanged shape along the flank",
    confounded_with: &["debris_abrasion", "surface_layer", "running_in"],
    separated_by: "two speeds at equal cycles; fresh oil",
    left_out: "temperature: hours alone use up the additives",
    needs: &[],
    params: &[
        Param::new(
            "ratio",
            "-",
            "wear coefficient in aged over that in fresh oil",
            2.0,
            (0.1, 50.0),
            Prior::LogNormal {
                median: 2.0,
                spread: 2.0,
            },
        )
        .neutral(1.0),
        Param::new(
            "life",
            "h",
            "running hours in which the additives fall to 1/e",
            100.0,
            (0.01, 1e5),
            Prior::LogNormal {
                median: 100.0,
                spread: 5.0,
            },
        ),
    ],
    forms: &[],
    build: |p| {
        Box::new(LubricantAgeing {
            ratio: p[0],
            life: p[1],
        })
    },
};

struct LubricantAgeing {
    ratio: f64,
    life: f64,
}

impl Effect for LubricantAgeing {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        1.0 + (self.ratio - 1.0) * (1.0 - (-at.hours / self.life).exp())
    }
}
