//! Mixed lubrication: the thicker the oil film against the roughness, the less wear.
//!
//! ```text
//! f = c + (1 − c)/(1 + (λ/λ0)^q)        c = 0; else what a full film leaves of the wear
//! λ = h_min/Rq        Dowson and Higginson's minimum film of a line contact
//! ```
//! The roughness stays what the study states; that it falls in running-in is not modelled.

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "film_thickness",
    hook: Hook::WearFactor,
    formula: "wear_factor = floor + (1 - floor)/(1 + (film_ratio/lambda0)^exponent)",
    source: "film: D. Dowson, G.R. Higginson, Elasto-hydrodynamic Lubrication (1966), h_min = 2.65 R U^0.70 G^0.54 W^-0.13; the smooth factor replaces the piecewise linear one of M. Priest, C.M. Taylor, Wear 241 (2000) 193-203 (1 below 0.5, none above 4), whose coefficients could not be checked.",
    signature: "wear falls with speed and viscosity, more at the pinion's tip than its root; hardly any dependence on torque",
    confounded_with: &["sliding_speed_exponent", "oxidative", "running_in"],
    separated_by: "speeds five times apart, or another viscosity at equal speed; not identifiable where the film ratio stays far below lambda0",
    left_out: "starvation, thermal thinning at the inlet and surfaces that run in: a smooth steady isothermal film over the stated roughness",
    needs: &[
        "lubricant.viscosity",
        "lubricant.pressure_viscosity",
        "lubricant.roughness",
    ],
    params: &[
        Param::new(
            "lambda0",
            "-",
            "film ratio at which the wear is halved",
            1.0,
            (0.02, 50.0),
            Prior::LogNormal {
                median: 1.0,
                spread: 2.5,
            },
        )
        .neutral(f64::INFINITY),
        Param::new(
            "exponent",
            "-",
            "steepness of the fall",
            2.0,
            (0.2, 10.0),
            Prior::Uniform {
                low: 1.0,
                high: 6.0,
            },
        ),
        Param::new(
            "floor",
            "-",
            "share of the wear that the thickest film leaves",
            0.0,
            (0.0, 1.0),
            Prior::Uniform {
                low: 0.0,
                high: 1.0,
            },
        )
        .fixed(),
    ],
    forms: &[Form {
        name: "never to nothing",
        settings: &[("exponent", 4.0), ("floor", 0.2)],
        frees: &["floor"],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(FilmThickness {
            lambda0: p[0],
            exponent: p[1],
            floor: p[2],
        })
    },
};

struct FilmThickness {
    lambda0: f64,
    exponent: f64,
    floor: f64,
}

impl Effect for FilmThickness {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        let thin = 1.0 / (1.0 + (at.film_ratio / self.lambda0).powf(self.exponent));
        self.floor + (1.0 - self.floor) * thin
    }
}
