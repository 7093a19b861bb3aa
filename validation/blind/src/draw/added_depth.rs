//! Causes that take or move material besides Archard's wear.

use super::{Context, Terms};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    let hours = c.cycles / (60.0 * c.speed);
    terms.parameters = match (name, form) {
        ("micropitting", _) => {
            let q = d.uniform(2.0, 7.0);
            let per = (c.p0 / 1000.0).powf(q) * c.cycles / 1e6;
            let mut v = vec![
                ("rate", 0.15 * c.depth / per),
                ("exponent", q),
                ("reference_pressure", 1000.0),
            ];
            if form == "saturating" {
                v.push(("saturation_cycles", c.cycles * d.uniform(0.4, 1.2)));
            }
            if form == "dedendum" {
                v.push(("asymmetry", d.uniform(0.3, 1.0)));
            }
            v
        }
        ("roughness_polish", _) => {
            terms.limit = 4.0;
            terms.drivers = &["cycles", "position", "depth"];
            vec![
                ("height", 0.1 * c.depth),
                ("contacts", c.cycles * d.log_uniform(0.02, 0.15)),
            ]
        }
        ("corrosive_loss", "linear") => {
            terms.drivers = &["position", "cycles", "speed"];
            vec![("um_per_hour", 0.1 * c.depth / hours)]
        }
        ("corrosive_loss", _) => {
            terms.drivers = &["position", "cycles", "speed"];
            vec![("um_per_root_hour", 0.1 * c.depth / hours.sqrt())]
        }
        ("plastic_deformation", _) => {
            terms.limit = 6.0;
            vec![
                ("dent", 0.12 * c.depth),
                ("onset", c.p0 * d.uniform(0.65, 0.9)),
                ("span", c.p0 * d.uniform(0.15, 0.4)),
                ("cycles", c.cycles * 0.004),
            ]
        }
        _ => return None,
    };
    Some(terms)
}
