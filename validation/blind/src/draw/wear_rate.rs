//! Causes that change the wear coefficient.

use super::{Context, Terms, sliding};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    let path = c.pair.end - c.pair.start;
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
