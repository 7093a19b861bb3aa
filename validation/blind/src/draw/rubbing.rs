//! Causes that change the wear coefficient with film, heat and sliding.

use super::{Context, Terms, sliding};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    let path = c.pair.end - c.pair.start;
    terms.parameters = match (name, form) {
        ("film_thickness", "rational") => {
            terms.limit = 30.0;
            terms.drivers = &["speed", "position"];
            vec![
                ("strength", d.log_uniform(0.3, 3.0)),
                ("exponent", d.uniform(1.0, 4.0)),
                ("reference_film", c.film),
            ]
        }
        ("film_thickness", "step") => {
            terms.limit = 0.95;
            terms.drivers = &["speed", "position"];
            vec![
                ("drop", d.uniform(0.3, 0.8)),
                ("middle", c.film * d.uniform(0.6, 1.1)),
                ("width", c.film * d.uniform(0.25, 0.5)),
            ]
        }
        ("film_thickness", "decay") => {
            terms.limit = 4.0;
            terms.drivers = &["speed", "position"];
            vec![
                ("strength", d.uniform(0.3, 2.0)),
                ("reference_film", c.film),
            ]
        }
        ("approach_recess", "step") => {
            terms.limit = 1.5;
            vec![(
                "asymmetry",
                d.uniform(0.1, 0.6) * if d.unit() < 0.25 { -1.0 } else { 1.0 },
            )]
        }
        ("approach_recess", _) => {
            terms.limit = 1.5;
            vec![
                ("asymmetry", d.uniform(0.1, 0.6)),
                ("ramp", path * d.uniform(0.05, 0.2)),
            ]
        }
        ("flash_temperature", "exponential") => {
            terms.limit = 6.0 / c.flash;
            terms.drivers = &["position", "speed", "torque"];
            vec![
                ("per_kelvin", d.uniform(0.2, 1.5) / c.flash),
                ("bulk_reference", 60.0),
            ]
        }
        ("flash_temperature", _) => {
            terms.limit = 0.45 / c.flash;
            terms.drivers = &["position", "speed", "torque"];
            vec![("softening_per_kelvin", d.uniform(0.1, 0.4) / c.flash)]
        }
        ("sliding_speed_exponent", "power") => {
            terms.limit = 1.0;
            terms.drivers = &["position", "speed"];
            vec![
                ("exponent", d.uniform(0.15, 0.6) * d.sign()),
                ("reference", 1e-3 * sliding(c, 0.5 * c.pair.end)),
            ]
        }
        ("sliding_speed_exponent", _) => {
            terms.limit = 15.0;
            terms.drivers = &["position", "speed"];
            vec![
                ("gain", d.log_uniform(0.5, 3.0)),
                (
                    "half_speed",
                    1e-3 * sliding(c, c.pair.end) * d.uniform(0.5, 1.5),
                ),
            ]
        }
        ("oxidative", _) => {
            terms.limit = 1.0;
            terms.drivers = &["position", "speed"];
            vec![
                ("part", d.uniform(0.2, 0.7)),
                ("reference", 1e-3 * sliding(c, 0.4 * c.pair.end)),
            ]
        }
        _ => return None,
    };
    Some(terms)
}
