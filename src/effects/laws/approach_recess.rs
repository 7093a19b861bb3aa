//! More (or less) wear in approach than in recess.
//!
//! ```text
//! f = 1 + (a/2)(1 + tanh(d/w))        d mm: |s|, positive in approach and negative in recess; w mm about the contact's half width
//! ```

use crate::effects::{Card, Effect, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "approach_recess",
    hook: Hook::WearFactor,
    formula: "wear_factor = 1 + asymmetry/2*(1 + tanh((2*approach - 1)*abs(s)/width))",
    source: "parametric; the basis is the higher friction of approach, where debris is driven outwards. S. Wu, H.S. Cheng, J. Tribol. 115 (1993) 493-500, find most wear at the start of engagement (abstract, there from load and film). The tanh is our smoothing over the width of the contact.",
    signature: "pinion dedendum and gear addendum up together; a step between the halves of both flanks",
    confounded_with: &["friction_load", "film_thickness", "radial_misalignment"],
    separated_by: "reversing the drive: it follows the approach, geometry does not",
    left_out: "the cause of the difference: the factor stands for friction, debris and oil supply without computing them",
    needs: &[],
    params: &[
        Param::new(
            "asymmetry",
            "-",
            "excess of wear in approach",
            0.5,
            (-0.95, 20.0),
            Prior::Uniform {
                low: -0.5,
                high: 1.5,
            },
        )
        .neutral(0.0),
        Param::new(
            "width",
            "mm",
            "distance from the pitch point over which the step is smoothed",
            0.09,
            (1e-3, 2.0),
            Prior::LogNormal {
                median: 0.09,
                spread: 1.5,
            },
        )
        .fixed(),
    ],
    forms: &[],
    build: |p| {
        Box::new(ApproachRecess {
            asymmetry: p[0],
            width: p[1],
        })
    },
};

struct ApproachRecess {
    asymmetry: f64,
    width: f64,
}

impl Effect for ApproachRecess {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        let ahead = if at.approach {
            at.path.abs()
        } else {
            -at.path.abs()
        };
        1.0 + 0.5 * self.asymmetry * (1.0 + (ahead / self.width).tanh())
    }
}
