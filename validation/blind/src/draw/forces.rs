//! Causes that act through forces: friction in the balance of torque, inertia, the work of friction.

use std::f64::consts::PI;

use super::{Context, Terms};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    terms.parameters = match (name, form) {
        ("friction_load", "coulomb") => {
            terms.limit = 0.35;
            vec![("coefficient", d.log_uniform(0.05, 0.3))]
        }
        ("friction_load", "recess") => {
            terms.limit = 0.35;
            vec![
                ("coefficient", d.log_uniform(0.05, 0.3)),
                ("recess_ratio", d.uniform(0.4, 0.9)),
            ]
        }
        ("dynamic_load", "mean_and_ripple") => {
            terms.limit = 0.5;
            terms.drivers = &["position", "speed"];
            vec![
                ("mean_rise", d.log_uniform(0.1, 0.5)),
                ("ripple_over_rise", d.log_uniform(0.3, 1.0)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
                ("reference_speed", c.speed),
            ]
        }
        ("energy_wear", _) => {
            terms.limit = 4.0;
            terms.drivers = &["position", "speed"];
            vec![
                ("exponent", d.uniform(0.7, 1.3)),
                ("reference_friction", 0.06),
            ]
        }
        _ => return None,
    };
    Some(terms)
}
