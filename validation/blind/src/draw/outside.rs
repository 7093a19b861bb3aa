//! Causes that the catalogue lacks.

use std::f64::consts::PI;

use super::{Context, Terms};
use crate::dice::Dice;

pub(super) fn draw(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let mut terms = Terms::default();
    let path = c.pair.end - c.pair.start;
    let pb = c.pair.pb;
    terms.parameters = match (name, form) {
        ("starvation_band", _) => {
            terms.limit = 8.0;
            vec![
                ("gain", d.log_uniform(0.3, 1.5)),
                ("centre", c.pair.start + path * d.uniform(0.15, 0.85)),
                ("width", path * d.uniform(0.04, 0.1)),
            ]
        }
        ("growing_scuff", _) => {
            terms.limit = 8.0;
            vec![
                ("gain", d.log_uniform(0.4, 2.0)),
                ("length_at_end", path * d.uniform(0.2, 0.4)),
                ("cycles", c.cycles),
            ]
        }
        ("on_off_blocks", _) => {
            terms.limit = 0.95;
            terms.drivers = &["cycles", "depth"];
            vec![
                ("loss", d.uniform(0.3, 0.8)),
                ("block", c.cycles * d.uniform(0.16, 0.3)),
                ("phase", d.uniform(0.0, 1.0)),
            ]
        }
        ("gear_hardness_waves", _) => {
            terms.limit = 0.9;
            terms.drivers = &["position", "member"];
            vec![
                ("amplitude", d.uniform(0.15, 0.6)),
                ("length", pb * d.uniform(0.2, 0.45)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
            ]
        }
        ("load_moved_band", _) => {
            terms.limit = 8.0;
            terms.drivers = &["position", "torque"];
            vec![
                ("gain", d.log_uniform(0.4, 2.0)),
                ("centre_at_reference", c.pair.end * d.uniform(0.35, 0.6)),
                ("width", path * d.uniform(0.05, 0.1)),
                ("reference_torque", c.torque),
            ]
        }
        ("members_swap", _) => {
            terms.limit = 3.0;
            terms.drivers = &["cycles", "member", "depth"];
            vec![
                ("log_ratio", d.uniform(0.2, 0.7)),
                ("cycles", c.cycles * d.uniform(0.3, 0.5)),
            ]
        }
        ("half_flank_oil_failure", _) => {
            terms.limit = 8.0;
            terms.drivers = &["position", "cycles"];
            vec![
                ("gain", d.log_uniform(0.4, 2.0)),
                ("from_cycles", c.cycles * d.uniform(0.3, 0.6)),
                ("side", d.sign()),
            ]
        }
        ("humidity_cycle", _) => {
            terms.limit = 0.95;
            terms.drivers = &["cycles", "depth"];
            vec![
                ("amplitude", d.uniform(0.3, 0.8)),
                ("period", c.cycles * d.uniform(0.35, 0.6)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
            ]
        }
        ("gear_groove", _) => {
            terms.limit = 25.0;
            vec![
                ("depth", d.uniform(2.0, 8.0)),
                ("centre", c.pair.start + path * d.uniform(0.3, 0.8)),
                ("width", path * d.uniform(0.05, 0.1)),
            ]
        }
        ("gear_tip_plating", _) => {
            terms.limit = 0.95;
            terms.drivers = &["position", "member"];
            vec![
                ("loss", d.uniform(0.3, 0.8)),
                ("length", path * d.uniform(0.12, 0.25)),
            ]
        }
        _ => return None,
    };
    Some(terms)
}
