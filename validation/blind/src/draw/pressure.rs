//! Causes that change the wear coefficient with the pressure.

use super::{Context, Terms};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    terms.parameters = match (name, form) {
        ("pressure_exponent", "local" | "hertz") => {
            terms.limit = 2.0;
            terms.drivers = &["position", "torque"];
            vec![
                ("excess_exponent", d.uniform(0.2, 1.2)),
                (
                    "reference_pressure",
                    if form == "local" { 1000.0 } else { c.p0 },
                ),
            ]
        }
        ("pressure_exponent", "threshold") => {
            terms.limit = 12.0;
            terms.drivers = &["position", "torque"];
            vec![
                ("gain", d.uniform(1.0, 4.0)),
                ("threshold", c.p0 * d.uniform(0.45, 0.7)),
                ("scale", c.p0),
            ]
        }
        ("severe_transition", _) => {
            terms.limit = 30.0;
            terms.drivers = &["position", "torque"];
            let pc = c.p0 * d.uniform(0.85, 1.1);
            vec![
                ("gain", d.log_uniform(0.5, 5.0)),
                ("critical", pc),
                (
                    "width",
                    pc * if form == "ramp" {
                        d.uniform(0.1, 0.25)
                    } else {
                        d.uniform(0.03, 0.05)
                    },
                ),
            ]
        }
        _ => return None,
    };
    Some(terms)
}
