//! Flanks yield where the pressure passes the shakedown limit: a dent early on, then nothing more, and no mass lost.
//!
//! ```text
//! h = h_p y (1 − exp(−n_c/N_s))        Δh its growth per contact
//! y = clip(x, 0, 1), or smooth 1/(1 + e^(4 (½ − x)))        x = (p_max − p_s)/Δp
//! first yield of a line contact: p0 = 1.67 σ_Y (Tresca) to 1.79 σ_Y (von Mises); elastic shakedown without friction: 4 k_Y
//! ```
//! The rims that the displaced material raises are not modelled.

use crate::effects::{Card, Effect, Form, Hook, Local, Param, ParamRole, Prior};

pub(super) const CARD: Card = Card {
    name: "plastic_deformation",
    hook: Hook::AddedDepth,
    formula: "added_depth = depth_limit/settling_contacts*exp(-contacts/settling_contacts)*((1 - smooth)*min(max((p_max - yield_pressure)/width, 0), 1) + smooth/(1 + exp(2 - 4*(p_max - yield_pressure)/width)))",
    source: "limits of yield and shakedown: K.L. Johnson, Contact Mechanics (1985), ch. 6 and 9 (not re-read); the approach to shakedown as his graphical method (1990) describes it. The ramp over pressure and the exponential in time are our parametric form.",
    signature: "an early dip where pressure is highest, then constant; needs torque; profile without mass loss",
    confounded_with: &[
        "severe_transition",
        "micropitting",
        "profile_form",
        "roughness_polish",
    ],
    separated_by: "an early checkpoint; weighing; an overload",
    left_out: "raised rims and residual stress: a dent of given depth where the pressure passes the limit",
    needs: &[],
    params: &[
        Param::new(
            "depth_limit",
            "um",
            "depth of the dent in the end",
            1.0,
            (0.0, 50.0),
            Prior::LogNormal {
                median: 1.0,
                spread: 2.5,
            },
        )
        .neutral(0.0),
        Param::new(
            "yield_pressure",
            "MPa",
            "peak pressure at which the flank begins to yield",
            800.0,
            (50.0, 5000.0),
            Prior::LogNormal {
                median: 800.0,
                spread: 1.5,
            },
        )
        .role(ParamRole::PressureSharpness),
        Param::new(
            "width",
            "MPa",
            "rise of the peak pressure from no dent to the full one",
            200.0,
            (1.0, 5000.0),
            Prior::LogNormal {
                median: 200.0,
                spread: 2.0,
            },
        )
        .fixed(),
        Param::new(
            "settling_contacts",
            "contacts",
            "contacts of that member in which the rest falls to 1/e",
            2000.0,
            (10.0, 1e7),
            Prior::LogNormal {
                median: 2000.0,
                spread: 3.0,
            },
        )
        .fixed(),
        Param::either(
            "smooth",
            "0 for a straight rise over the width, 1 for a logistic one of the same slope",
        ),
    ],
    forms: &[Form {
        name: "smooth",
        settings: &[("smooth", 1.0)],
        frees: &["width"],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(PlasticDeformation {
            depth_limit: p[0],
            yield_pressure: p[1],
            width: p[2],
            settling_contacts: p[3],
            smooth: p[4],
        })
    },
};

struct PlasticDeformation {
    depth_limit: f64,
    yield_pressure: f64,
    width: f64,
    settling_contacts: f64,
    smooth: f64,
}

impl Effect for PlasticDeformation {
    fn added_depth(&self, at: &Local) -> f64 {
        let x = (at.peak_pressure - self.yield_pressure) / self.width;
        let smooth = 1.0 / (1.0 + (2.0 - 4.0 * x).exp());
        let share = (1.0 - self.smooth) * x.clamp(0.0, 1.0) + self.smooth * smooth;
        self.depth_limit / self.settling_contacts
            * (-at.contacts / self.settling_contacts).exp()
            * share
    }

    fn keeps_mass(&self) -> bool {
        true
    }
}
