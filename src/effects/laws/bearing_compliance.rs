//! Shafts and bearings give way under load: the centre distance grows with torque.
//!
//! ```text
//! Δa = (q F sin α_w + c_b (1 − exp(−F/F_c)))/1000 mm        q µm/N both shafts together, c_b µm clearance
//! ```

use crate::effects::{Card, Effect, Form, Hook, OperationChange, OperationState, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "bearing_compliance",
    hook: Hook::Operation,
    formula: "added_centre_distance = (flexibility*normal_force*sin(working_pressure_angle) + clearance*(1 - exp(-normal_force/closing_force)))/1000",
    source: "the separating force F sin(alpha_w) on springs; stiffness of 50 to 500 N/µm per side and clearances of 10 to 60 µm are engineering judgement, as is the exponential with which the clearance closes.",
    signature: "a radial misalignment that grows with torque; at one torque it is a radial misalignment",
    confounded_with: &["radial_misalignment", "thermal_expansion"],
    separated_by: "two torques at the same temperature",
    left_out: "shafts that tilt (the face stays evenly loaded) and the ripple of the load over a mesh cycle: the mean normal force alone moves the axes",
    needs: &[],
    params: &[
        Param::new(
            "flexibility",
            "um/N",
            "growth of the centre distance per separating force",
            0.01,
            (0.0, 1.0),
            Prior::LogNormal {
                median: 0.01,
                spread: 2.5,
            },
        )
        .neutral(0.0),
        Param::new(
            "clearance",
            "um",
            "clearance taken up by the load",
            0.0,
            (0.0, 500.0),
            Prior::LogNormal {
                median: 25.0,
                spread: 2.5,
            },
        )
        .neutral(0.0)
        .fixed(),
        Param::new(
            "closing_force",
            "N",
            "normal force over which the clearance is taken up",
            500.0,
            (1.0, 1e6),
            Prior::LogNormal {
                median: 500.0,
                spread: 4.0,
            },
        )
        .fixed(),
    ],
    forms: &[Form {
        name: "clearance",
        settings: &[("flexibility", 0.0), ("clearance", 25.0)],
        frees: &["clearance", "closing_force"],
        idle: &["flexibility"],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(BearingCompliance {
            flexibility: p[0],
            clearance: p[1],
            closing_force: p[2],
        })
    },
};

struct BearingCompliance {
    flexibility: f64,
    clearance: f64,
    closing_force: f64,
}

impl Effect for BearingCompliance {
    fn operation(&self, state: &OperationState) -> OperationChange {
        let force = state.normal_force;
        let spring = self.flexibility * force * state.working_pressure_angle.sin();
        let clearance = self.clearance * (1.0 - (-force / self.closing_force).exp());
        OperationChange {
            centre_distance: 1e-3 * (spring + clearance),
        }
    }
}
