//! A coating that is worn through.
//!
//! ```text
//! f = 1 up to h = t (1 − δ), Q from h = t (1 + δ), linear between        k is the coating's, Q substrate over coating
//! ```

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "coating",
    hook: Hook::WearFactor,
    formula: "wear_factor = 1 + (ratio - 1)*min(max(0.5 + (depth/thickness - 1)/(2*width), 0), 1)",
    source: "two coefficients in series, Archard's law for each layer; the short ramp is ours and represents the scatter of thickness. Thicknesses of 0.5 to 5 µm for DLC, phosphate, MoS2 are engineering judgement, and the prior is wider.",
    signature: "depth stalls, then breaks through at the root first; a map of two levels",
    confounded_with: &["surface_layer", "running_in"],
    separated_by: "depth over cycles at points with different rates; friction rising between inspections",
    left_out: "a stiffness of its own, blistering and flaking: the coating only wears",
    needs: &[],
    params: &[
        Param::new(
            "ratio",
            "-",
            "wear coefficient of the substrate over that of the coating",
            10.0,
            (0.02, 300.0),
            Prior::LogNormal {
                median: 10.0,
                spread: 2.5,
            },
        )
        .neutral(1.0),
        Param::new(
            "thickness",
            "um",
            "thickness of the coating",
            2.0,
            (0.05, 100.0),
            Prior::LogNormal {
                median: 2.0,
                spread: 3.5,
            },
        ),
        Param::new(
            "width",
            "-",
            "half width of the passage relative to the thickness",
            0.1,
            (0.001, 1.0),
            Prior::LogNormal {
                median: 0.1,
                spread: 2.0,
            },
        )
        .fixed(),
    ],
    forms: &[Form {
        name: "of uneven thickness",
        settings: &[("width", 0.5)],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(Coating {
            ratio: p[0],
            thickness: p[1],
            width: p[2],
        })
    },
};

struct Coating {
    ratio: f64,
    thickness: f64,
    width: f64,
}

impl Effect for Coating {
    fn wear_factor(&self, at: &Local) -> f64 {
        let through = 0.5 + (at.depth / self.thickness - 1.0) / (2.0 * self.width);
        1.0 + (self.ratio - 1.0) * through.clamp(0.0, 1.0)
    }
}
