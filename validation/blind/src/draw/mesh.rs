//! Causes that change the flanks, the load or the way the teeth meet, all teeth alike.

use std::f64::consts::PI;

use super::{Context, Terms};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    let path = c.pair.end - c.pair.start;
    terms.parameters = match (name, form) {
        ("tip_relief", _) => {
            terms.limit = 40.0;
            vec![
                ("amount", d.uniform(4.0, 12.0)),
                ("length", path * d.uniform(0.18, 0.4)),
            ]
        }
        ("profile_slope", "linear") => {
            terms.limit = 20.0;
            vec![("amount", d.uniform(3.0, 9.0) * d.sign())]
        }
        ("profile_slope", _) => {
            terms.limit = 20.0;
            vec![
                ("amount", d.uniform(3.0, 9.0) * d.sign()),
                ("curve", d.uniform(-0.35, 0.35)),
            ]
        }
        ("profile_form", "cosine") => {
            terms.limit = 8.0;
            vec![
                ("amount", d.uniform(1.0, 3.0)),
                ("waves", d.uniform(1.5, 4.0)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
            ]
        }
        ("profile_form", _) => {
            terms.limit = 8.0;
            vec![
                ("amount", d.uniform(1.0, 3.0)),
                ("waves", d.uniform(1.5, 3.0)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
                ("second", d.uniform(0.2, 0.5)),
                ("second_phase", d.uniform(0.0, 2.0 * PI)),
            ]
        }
        ("extra_flexibility", _) => {
            terms.limit = 0.2;
            vec![("compliance", d.uniform(0.01, 0.05))]
        }
        ("radial_misalignment", _) => {
            terms.limit = 0.22 * c.module;
            vec![(
                "shift",
                c.module * d.uniform(0.02, 0.08) * if d.unit() < 0.2 { -0.3 } else { 1.0 },
            )]
        }
        ("bearing_compliance", "linear") => {
            terms.limit = 0.2 * c.module;
            terms.drivers = &["position", "torque"];
            vec![
                ("shift_at_reference", c.module * d.uniform(0.02, 0.06)),
                ("reference_torque", c.torque),
            ]
        }
        ("bearing_compliance", _) => {
            terms.limit = 0.2 * c.module;
            terms.drivers = &["position", "torque"];
            vec![
                ("clearance", c.module * d.uniform(0.02, 0.06)),
                ("closing_torque", c.torque * d.uniform(0.5, 1.5)),
            ]
        }
        ("thermal_expansion", _) => {
            terms.limit = 0.12 * c.module;
            terms.drivers = &["position", "speed", "torque"];
            vec![
                ("shift_at_reference", c.module * d.uniform(0.01, 0.04)),
                ("reference_power", c.torque * c.speed),
            ]
        }
        ("dynamic_load", "harmonic" | "two_harmonics") => {
            terms.limit = 0.7;
            terms.drivers = &["position", "speed"];
            let mut v = vec![
                ("amplitude", d.uniform(0.05, 0.3)),
                ("resonance", c.speed * d.uniform(0.8, 1.6)),
                ("damping", d.uniform(0.06, 0.12)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
            ];
            if form == "two_harmonics" {
                v.push(("second", d.uniform(0.2, 0.5)));
            }
            v
        }
        _ => return None,
    };
    Some(terms)
}
