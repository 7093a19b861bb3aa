//! Causes that change the wear coefficient as time goes on or debris gathers.

use super::{Context, Terms};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    let hours = c.cycles / (60.0 * c.speed);
    terms.parameters = match (name, form) {
        ("running_in", "exponential" | "contacts") => {
            terms.limit = 20.0;
            terms.drivers = &["cycles", "depth"];
            vec![
                ("amplitude", d.log_uniform(0.5, 4.0)),
                ("decay_cycles", c.cycles * d.log_uniform(0.03, 0.4)),
            ]
        }
        ("running_in", "hyperbolic") => {
            terms.limit = 20.0;
            terms.drivers = &["cycles", "depth"];
            vec![
                ("amplitude", d.log_uniform(0.5, 4.0)),
                ("decay_cycles", c.cycles * d.log_uniform(0.02, 0.2)),
                ("power", d.uniform(1.0, 2.0)),
            ]
        }
        ("running_in", "power") => {
            terms.limit = 0.75;
            terms.drivers = &["cycles", "depth"];
            vec![
                ("lost_exponent", d.uniform(0.1, 0.5)),
                ("from_cycles", 0.003 * c.cycles),
                ("reference_cycles", 0.3 * c.cycles),
            ]
        }
        ("debris_abrasion", _) => {
            terms.limit = 15.0;
            terms.drivers = &["cycles", "depth"];
            vec![
                ("gain", d.log_uniform(0.5, 3.0)),
                (
                    "reference_area",
                    c.worn
                        * if form == "linear" {
                            1.0
                        } else {
                            d.uniform(0.2, 0.5)
                        },
                ),
            ]
        }
        ("lubricant_ageing", _) => {
            terms.limit = 15.0;
            terms.drivers = &["cycles", "depth"];
            vec![
                ("gain", d.log_uniform(0.5, 3.0)),
                (
                    "hours",
                    hours
                        * if form == "linear" {
                            1.0
                        } else {
                            d.uniform(0.2, 0.8)
                        },
                ),
            ]
        }
        _ => return None,
    };
    Some(terms)
}
