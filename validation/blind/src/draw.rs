//! Which causes there are, and their parameters drawn to suit a pair of gears and its tests.

use std::f64::consts::PI;

use crate::dice::Dice;
use crate::involute::Mating;
use crate::laws::{Class, Law};

/// What the draws are scaled with.
#[derive(Clone, Debug)]
pub struct Context {
    pub pair: Mating,
    pub module: f64,
    pub torque: f64,
    pub speed: f64,
    pub cycles: f64,
    /// Deepest wear at the end, um.
    pub depth: f64,
    /// Largest Hertz pressure in single contact, MPa.
    pub p0: f64,
    /// Film ratio at the pitch point.
    pub film: f64,
    /// Flash temperature at the start of contact, K.
    pub flash: f64,
    /// Worn area of a pinion tooth and the gear flank it wore, mm^2.
    pub worn: f64,
}

pub const CATALOGUE: &[(&str, &str)] = &[
    ("running_in", "exponential"),
    ("running_in", "hyperbolic"),
    ("running_in", "power"),
    ("running_in", "contacts"),
    ("pressure_exponent", "local"),
    ("pressure_exponent", "threshold"),
    ("pressure_exponent", "hertz"),
    ("film_thickness", "rational"),
    ("film_thickness", "step"),
    ("film_thickness", "decay"),
    ("micropitting", "power"),
    ("micropitting", "saturating"),
    ("micropitting", "dedendum"),
    ("debris_abrasion", "linear"),
    ("debris_abrasion", "saturating"),
    ("lubricant_ageing", "saturating"),
    ("lubricant_ageing", "linear"),
    ("tip_relief", "linear"),
    ("tip_relief", "parabolic"),
    ("roughness_polish", "exponential"),
    ("roughness_polish", "hyperbolic"),
    ("corrosive_loss", "linear"),
    ("corrosive_loss", "root_of_time"),
    ("approach_recess", "step"),
    ("approach_recess", "ramp"),
    ("member_hardness", "ratio"),
    ("member_hardness", "gear"),
    ("surface_layer", "exponential"),
    ("surface_layer", "logistic"),
    ("coating", "step"),
    ("coating", "blend"),
    ("flash_temperature", "exponential"),
    ("flash_temperature", "softening"),
    ("sliding_speed_exponent", "power"),
    ("sliding_speed_exponent", "saturating"),
    ("severe_transition", "logistic"),
    ("severe_transition", "ramp"),
    ("oxidative", "reciprocal"),
    ("profile_slope", "linear"),
    ("profile_slope", "curved"),
    ("profile_form", "cosine"),
    ("profile_form", "two_waves"),
    ("extra_flexibility", "constant"),
    ("radial_misalignment", "constant"),
    ("bearing_compliance", "linear"),
    ("bearing_compliance", "clearance"),
    ("thermal_expansion", "power_loss"),
    ("dynamic_load", "harmonic"),
    ("dynamic_load", "two_harmonics"),
    ("plastic_deformation", "clip"),
    ("plastic_deformation", "smooth"),
];

pub const OUTSIDE: &[&str] = &[
    "starvation_band",
    "growing_scuff",
    "on_off_blocks",
    "gear_hardness_waves",
    "load_moved_band",
    "members_swap",
    "half_flank_oil_failure",
    "humidity_cycle",
    "gear_groove",
    "gear_tip_plating",
];

/// The first form of a name is the catalogue's.
pub fn class_of(name: &str, form: Option<&str>) -> Class {
    match CATALOGUE.iter().find(|c| c.0 == name) {
        Some(first) if form.is_none_or(|f| f == first.1) => Class::Single,
        Some(_) => Class::Foreign,
        None => Class::Outside,
    }
}

pub fn draw(name: &'static str, form: &'static str, c: &Context, d: &mut Dice) -> Law {
    let path = c.pair.end - c.pair.start;
    let hours = c.cycles / (60.0 * c.speed);
    let pb = c.pair.pb;
    let mut limit = f64::INFINITY;
    let mut drivers: &'static [&'static str] = &["position"];
    let cycles: &'static [&'static str] = &["cycles", "depth"];
    let p: Vec<(&'static str, f64)> = match (name, form) {
        ("running_in", "exponential" | "contacts") => {
            limit = 20.0;
            drivers = cycles;
            vec![
                ("amplitude", d.log_uniform(0.5, 4.0)),
                ("decay_cycles", c.cycles * d.log_uniform(0.03, 0.4)),
            ]
        }
        ("running_in", "hyperbolic") => {
            limit = 20.0;
            drivers = cycles;
            vec![
                ("amplitude", d.log_uniform(0.5, 4.0)),
                ("decay_cycles", c.cycles * d.log_uniform(0.02, 0.2)),
                ("power", d.uniform(1.0, 2.0)),
            ]
        }
        ("running_in", "power") => {
            limit = 0.75;
            drivers = cycles;
            vec![
                ("lost_exponent", d.uniform(0.1, 0.5)),
                ("from_cycles", 0.003 * c.cycles),
                ("reference_cycles", 0.3 * c.cycles),
            ]
        }
        ("pressure_exponent", "local" | "hertz") => {
            limit = 2.0;
            drivers = &["position", "torque"];
            vec![
                ("excess_exponent", d.uniform(0.2, 1.2)),
                (
                    "reference_pressure",
                    if form == "local" { 1000.0 } else { c.p0 },
                ),
            ]
        }
        ("pressure_exponent", "threshold") => {
            limit = 12.0;
            drivers = &["position", "torque"];
            vec![
                ("gain", d.uniform(1.0, 4.0)),
                ("threshold", c.p0 * d.uniform(0.45, 0.7)),
                ("scale", c.p0),
            ]
        }
        ("film_thickness", "rational") => {
            limit = 30.0;
            drivers = &["speed", "position"];
            vec![
                ("strength", d.log_uniform(0.3, 3.0)),
                ("exponent", d.uniform(1.0, 4.0)),
                ("reference_film", c.film),
            ]
        }
        ("film_thickness", "step") => {
            limit = 0.95;
            drivers = &["speed", "position"];
            vec![
                ("drop", d.uniform(0.3, 0.8)),
                ("middle", c.film * d.uniform(0.6, 1.1)),
                ("width", c.film * d.uniform(0.25, 0.5)),
            ]
        }
        ("film_thickness", "decay") => {
            limit = 4.0;
            drivers = &["speed", "position"];
            vec![
                ("strength", d.uniform(0.3, 2.0)),
                ("reference_film", c.film),
            ]
        }
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
        ("debris_abrasion", _) => {
            limit = 15.0;
            drivers = cycles;
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
            limit = 15.0;
            drivers = cycles;
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
        ("tip_relief", _) => {
            limit = 40.0;
            vec![
                ("amount", d.uniform(4.0, 12.0)),
                ("length", path * d.uniform(0.18, 0.4)),
            ]
        }
        ("roughness_polish", _) => {
            limit = 4.0;
            drivers = &["cycles", "position", "depth"];
            vec![
                ("height", 0.1 * c.depth),
                ("contacts", c.cycles * d.log_uniform(0.02, 0.15)),
            ]
        }
        ("corrosive_loss", "linear") => {
            drivers = &["position", "cycles", "speed"];
            vec![("um_per_hour", 0.1 * c.depth / hours)]
        }
        ("corrosive_loss", _) => {
            drivers = &["position", "cycles", "speed"];
            vec![("um_per_root_hour", 0.1 * c.depth / hours.sqrt())]
        }
        ("approach_recess", "step") => {
            limit = 1.5;
            vec![(
                "asymmetry",
                d.uniform(0.1, 0.6) * if d.unit() < 0.25 { -1.0 } else { 1.0 },
            )]
        }
        ("approach_recess", _) => {
            limit = 1.5;
            vec![
                ("asymmetry", d.uniform(0.1, 0.6)),
                ("ramp", path * d.uniform(0.05, 0.2)),
            ]
        }
        ("member_hardness", _) => {
            limit = 1.6;
            drivers = &["member"];
            vec![("log_ratio", d.uniform(0.1, 0.5) * d.sign())]
        }
        ("surface_layer", "exponential") => {
            limit = 12.0;
            drivers = &["depth", "cycles"];
            vec![
                ("gain", d.log_uniform(0.5, 3.0)),
                ("layer", c.depth * d.uniform(0.1, 0.5)),
            ]
        }
        ("surface_layer", _) => {
            limit = 12.0;
            drivers = &["depth", "cycles"];
            vec![
                ("gain", d.log_uniform(0.5, 3.0)),
                ("layer", c.depth * d.uniform(0.1, 0.35)),
                ("width", c.depth * d.uniform(0.03, 0.08)),
            ]
        }
        ("coating", _) => {
            limit = 14.0;
            drivers = &["depth", "cycles"];
            vec![
                ("hardness_gain", d.log_uniform(1.0, 6.0)),
                (
                    "thickness",
                    (c.depth * d.uniform(0.05, 0.25)).clamp(0.3, 5.0),
                ),
            ]
        }
        ("flash_temperature", "exponential") => {
            limit = 6.0 / c.flash;
            drivers = &["position", "speed", "torque"];
            vec![
                ("per_kelvin", d.uniform(0.2, 1.5) / c.flash),
                ("bulk_reference", 60.0),
            ]
        }
        ("flash_temperature", _) => {
            limit = 0.45 / c.flash;
            drivers = &["position", "speed", "torque"];
            vec![("softening_per_kelvin", d.uniform(0.1, 0.4) / c.flash)]
        }
        ("sliding_speed_exponent", "power") => {
            limit = 1.0;
            drivers = &["position", "speed"];
            vec![
                ("exponent", d.uniform(0.15, 0.6) * d.sign()),
                ("reference", 1e-3 * sliding(c, 0.5 * c.pair.end)),
            ]
        }
        ("sliding_speed_exponent", _) => {
            limit = 15.0;
            drivers = &["position", "speed"];
            vec![
                ("gain", d.log_uniform(0.5, 3.0)),
                (
                    "half_speed",
                    1e-3 * sliding(c, c.pair.end) * d.uniform(0.5, 1.5),
                ),
            ]
        }
        ("severe_transition", _) => {
            limit = 30.0;
            drivers = &["position", "torque"];
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
            limit = 1.0;
            drivers = &["position", "speed"];
            vec![
                ("part", d.uniform(0.2, 0.7)),
                ("reference", 1e-3 * sliding(c, 0.4 * c.pair.end)),
            ]
        }
        ("profile_slope", "linear") => {
            limit = 20.0;
            vec![("amount", d.uniform(3.0, 9.0) * d.sign())]
        }
        ("profile_slope", _) => {
            limit = 20.0;
            vec![
                ("amount", d.uniform(3.0, 9.0) * d.sign()),
                ("curve", d.uniform(-0.35, 0.35)),
            ]
        }
        ("profile_form", "cosine") => {
            limit = 8.0;
            vec![
                ("amount", d.uniform(1.0, 3.0)),
                ("waves", d.uniform(1.5, 4.0)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
            ]
        }
        ("profile_form", _) => {
            limit = 8.0;
            vec![
                ("amount", d.uniform(1.0, 3.0)),
                ("waves", d.uniform(1.5, 3.0)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
                ("second", d.uniform(0.2, 0.5)),
                ("second_phase", d.uniform(0.0, 2.0 * PI)),
            ]
        }
        ("extra_flexibility", _) => {
            limit = 0.2;
            vec![("compliance", d.uniform(0.01, 0.05))]
        }
        ("radial_misalignment", _) => {
            limit = 0.22 * c.module;
            vec![(
                "shift",
                c.module * d.uniform(0.02, 0.08) * if d.unit() < 0.2 { -0.3 } else { 1.0 },
            )]
        }
        ("bearing_compliance", "linear") => {
            limit = 0.2 * c.module;
            drivers = &["position", "torque"];
            vec![
                ("shift_at_reference", c.module * d.uniform(0.02, 0.06)),
                ("reference_torque", c.torque),
            ]
        }
        ("bearing_compliance", _) => {
            limit = 0.2 * c.module;
            drivers = &["position", "torque"];
            vec![
                ("clearance", c.module * d.uniform(0.02, 0.06)),
                ("closing_torque", c.torque * d.uniform(0.5, 1.5)),
            ]
        }
        ("thermal_expansion", _) => {
            limit = 0.12 * c.module;
            drivers = &["position", "speed", "torque"];
            vec![
                ("shift_at_reference", c.module * d.uniform(0.01, 0.04)),
                ("reference_power", c.torque * c.speed),
            ]
        }
        ("dynamic_load", _) => {
            limit = 0.7;
            drivers = &["position", "speed"];
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
        ("plastic_deformation", _) => {
            limit = 6.0;
            vec![
                ("dent", 0.12 * c.depth),
                ("onset", c.p0 * d.uniform(0.65, 0.9)),
                ("span", c.p0 * d.uniform(0.15, 0.4)),
                ("cycles", c.cycles * 0.004),
            ]
        }
        ("starvation_band", _) => {
            limit = 8.0;
            vec![
                ("gain", d.log_uniform(0.3, 1.5)),
                ("centre", c.pair.start + path * d.uniform(0.15, 0.85)),
                ("width", path * d.uniform(0.04, 0.1)),
            ]
        }
        ("growing_scuff", _) => {
            limit = 8.0;
            vec![
                ("gain", d.log_uniform(0.4, 2.0)),
                ("length_at_end", path * d.uniform(0.2, 0.4)),
                ("cycles", c.cycles),
            ]
        }
        ("on_off_blocks", _) => {
            limit = 0.95;
            drivers = cycles;
            vec![
                ("loss", d.uniform(0.3, 0.8)),
                ("block", c.cycles * d.uniform(0.16, 0.3)),
                ("phase", d.uniform(0.0, 1.0)),
            ]
        }
        ("gear_hardness_waves", _) => {
            limit = 0.9;
            drivers = &["position", "member"];
            vec![
                ("amplitude", d.uniform(0.15, 0.6)),
                ("length", pb * d.uniform(0.2, 0.45)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
            ]
        }
        ("load_moved_band", _) => {
            limit = 8.0;
            drivers = &["position", "torque"];
            vec![
                ("gain", d.log_uniform(0.4, 2.0)),
                ("centre_at_reference", c.pair.end * d.uniform(0.35, 0.6)),
                ("width", path * d.uniform(0.05, 0.1)),
                ("reference_torque", c.torque),
            ]
        }
        ("members_swap", _) => {
            limit = 3.0;
            drivers = &["cycles", "member", "depth"];
            vec![
                ("log_ratio", d.uniform(0.2, 0.7)),
                ("cycles", c.cycles * d.uniform(0.3, 0.5)),
            ]
        }
        ("half_flank_oil_failure", _) => {
            limit = 8.0;
            drivers = &["position", "cycles"];
            vec![
                ("gain", d.log_uniform(0.4, 2.0)),
                ("from_cycles", c.cycles * d.uniform(0.3, 0.6)),
                ("side", d.sign()),
            ]
        }
        ("humidity_cycle", _) => {
            limit = 0.95;
            drivers = cycles;
            vec![
                ("amplitude", d.uniform(0.3, 0.8)),
                ("period", c.cycles * d.uniform(0.35, 0.6)),
                ("phase", d.uniform(0.0, 2.0 * PI)),
            ]
        }
        ("gear_groove", _) => {
            limit = 25.0;
            vec![
                ("depth", d.uniform(2.0, 8.0)),
                ("centre", c.pair.start + path * d.uniform(0.3, 0.8)),
                ("width", path * d.uniform(0.05, 0.1)),
            ]
        }
        ("gear_tip_plating", _) => {
            limit = 0.95;
            drivers = &["position", "member"];
            vec![
                ("loss", d.uniform(0.3, 0.8)),
                ("length", path * d.uniform(0.12, 0.25)),
            ]
        }
        _ => unreachable!("no law {name} {form}"),
    };
    Law {
        name,
        form,
        class: class_of(name, Some(form)),
        parameters: p,
        drivers,
        limit,
    }
}

/// Sliding speed at path s in the reference test, mm/s.
fn sliding(c: &Context, s: f64) -> f64 {
    let w = c.speed * PI / 30.0;
    w * (1.0 + c.pair.pinion.z as f64 / c.pair.gear.z as f64) * s.abs()
}
