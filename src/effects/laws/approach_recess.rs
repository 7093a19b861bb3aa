//! More (or less) wear in approach than in recess.
//!
//! ```text
//! f = 1 + (a/2)(1 + tanh(d/w))        d mm: |s|, positive in approach and negative in recess; w mm about the contact's half width
//! f = 1 + a max(0, d)/p_b              growing with the distance from the pitch point
//! ```

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "approach_recess",
    hook: Hook::WearFactor,
    formula: "wear_factor = max(0, 1 + asymmetry*((1 - growing)/2*(1 + tanh((2*approach - 1)*abs(s)/width)) + growing*max(0, (2*approach - 1)*abs(s))/base_pitch))",
    source: "parametric; the basis is the higher friction of approach, where debris is driven outwards. S. Wu, H.S. Cheng, J. Tribol. 115 (1993) 493-500, find most wear at the start of engagement (abstract, there from load and film). The tanh is our smoothing over the width of the contact.",
    signature: "pinion dedendum and gear addendum up together; a step between the halves of both flanks",
    confounded_with: &["friction_load", "film_thickness", "radial_misalignment"],
    separated_by: "reversing the drive: it follows the approach, geometry does not",
    left_out: "the cause of the difference: the factor represents friction, debris and oil supply without computing them",
    needs: &[],
    params: &[
        Param::new(
            "asymmetry",
            "-",
            "excess of wear in approach",
            0.5,
            (-0.95, 20.0),
            // no wall but where the factor would end
            Prior::Normal { mean: 0.0, sd: 0.8 },
        )
        .neutral(0.0),
        Param::new(
            "width",
            "mm",
            "distance from the pitch point over which the step is smoothed",
            0.09,
            (1e-3, 20.0),
            Prior::LogNormal {
                median: 0.8,
                spread: 3.0,
            },
        )
        .fixed(),
        Param::either(
            "growing",
            "1: the excess grows with the distance from the pitch point, and is reached a base pitch away; 0: a step",
        ),
    ],
    forms: &[
        Form {
            name: "growing",
            settings: &[("growing", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "gradual",
            settings: &[("width", 0.8)],
            frees: &["width"],
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(ApproachRecess {
            asymmetry: p[0],
            width: p[1],
            growing: p[2],
        })
    },
};

struct ApproachRecess {
    asymmetry: f64,
    width: f64,
    growing: f64,
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
        let step = 0.5 * (1.0 + (ahead / self.width).tanh());
        let grown = ahead.max(0.0) / at.base_pitch;
        // a path reaches little more than a base pitch from the pitch point
        (1.0 + self.asymmetry * ((1.0 - self.growing) * step + self.growing * grown)).max(0.0)
    }
}
