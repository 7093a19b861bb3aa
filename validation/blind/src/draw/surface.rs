//! Causes that change the wear coefficient with what is worn.

use super::{Context, Terms};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    terms.parameters = match (name, form) {
        ("member_hardness", _) => {
            terms.limit = 1.6;
            terms.drivers = &["member"];
            vec![("log_ratio", d.uniform(0.1, 0.5) * d.sign())]
        }
        ("surface_layer", "exponential") => {
            terms.limit = 12.0;
            terms.drivers = &["depth", "cycles"];
            vec![
                ("gain", d.log_uniform(0.5, 3.0)),
                ("layer", c.depth * d.uniform(0.1, 0.5)),
            ]
        }
        ("surface_layer", _) => {
            terms.limit = 12.0;
            terms.drivers = &["depth", "cycles"];
            vec![
                ("gain", d.log_uniform(0.5, 3.0)),
                ("layer", c.depth * d.uniform(0.1, 0.35)),
                ("width", c.depth * d.uniform(0.03, 0.08)),
            ]
        }
        ("coating", _) => {
            terms.limit = 14.0;
            terms.drivers = &["depth", "cycles"];
            vec![
                ("hardness_gain", d.log_uniform(1.0, 6.0)),
                (
                    "thickness",
                    (c.depth * d.uniform(0.05, 0.25)).clamp(0.3, 5.0),
                ),
            ]
        }
        _ => return None,
    };
    Some(terms)
}
