//! The hidden causes, each with its strength first among its parameters: strength 0 is the base model.

use std::f64::consts::PI;

use crate::dice::Dice;
use crate::hidden::{Conditions, Hidden, Seen, Spot};
use crate::involute::Mating;

/// Whether the diagnosis may know the cause, and in this form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// In the catalogue, in its form.
    Single,
    /// In the catalogue, in another form.
    Foreign,
    /// Not in the catalogue.
    Outside,
}

#[derive(Clone, Debug)]
pub struct Law {
    /// Name in the catalogue (or our own, outside it).
    pub name: &'static str,
    pub form: &'static str,
    pub class: Class,
    pub parameters: Vec<(&'static str, f64)>,
    /// What the difference depends on most.
    pub drivers: &'static [&'static str],
    /// Largest |strength| that makes sense.
    pub limit: f64,
}

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
    /// Line load, N/mm.
    pub load: f64,
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
            vec![("amplitude", d.log_uniform(0.5, 4.0)), ("decay_cycles", c.cycles * d.log_uniform(0.03, 0.4))]
        }
        ("running_in", "hyperbolic") => {
            limit = 20.0;
            drivers = cycles;
            vec![("amplitude", d.log_uniform(0.5, 4.0)), ("decay_cycles", c.cycles * d.log_uniform(0.02, 0.2)), ("power", d.uniform(1.0, 2.0))]
        }
        ("running_in", "power") => {
            limit = 0.75;
            drivers = cycles;
            vec![("lost_exponent", d.uniform(0.1, 0.5)), ("from_cycles", 0.003 * c.cycles), ("reference_cycles", 0.3 * c.cycles)]
        }
        ("pressure_exponent", "local" | "hertz") => {
            limit = 2.0;
            drivers = &["position", "torque"];
            vec![("excess_exponent", d.uniform(0.2, 1.2)), ("reference_pressure", if form == "local" { 1000.0 } else { c.p0 })]
        }
        ("pressure_exponent", "threshold") => {
            limit = 12.0;
            drivers = &["position", "torque"];
            vec![("gain", d.uniform(1.0, 4.0)), ("threshold", c.p0 * d.uniform(0.45, 0.7)), ("scale", c.p0)]
        }
        ("film_thickness", "rational") => {
            limit = 30.0;
            drivers = &["speed", "position"];
            vec![("strength", d.log_uniform(0.3, 3.0)), ("exponent", d.uniform(1.0, 4.0)), ("reference_film", c.film)]
        }
        ("film_thickness", "step") => {
            limit = 0.95;
            drivers = &["speed", "position"];
            vec![("drop", d.uniform(0.3, 0.8)), ("middle", c.film * d.uniform(0.6, 1.1)), ("width", c.film * d.uniform(0.25, 0.5))]
        }
        ("film_thickness", "decay") => {
            limit = 4.0;
            drivers = &["speed", "position"];
            vec![("strength", d.uniform(0.3, 2.0)), ("reference_film", c.film)]
        }
        ("micropitting", _) => {
            let q = d.uniform(2.0, 7.0);
            let per = (c.p0 / 1000.0).powf(q) * c.cycles / 1e6;
            let mut v = vec![("rate", 0.15 * c.depth / per), ("exponent", q), ("reference_pressure", 1000.0)];
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
            vec![("gain", d.log_uniform(0.5, 3.0)), ("reference_area", c.worn * if form == "linear" { 1.0 } else { d.uniform(0.2, 0.5) })]
        }
        ("lubricant_ageing", _) => {
            limit = 15.0;
            drivers = cycles;
            vec![("gain", d.log_uniform(0.5, 3.0)), ("hours", hours * if form == "linear" { 1.0 } else { d.uniform(0.2, 0.8) })]
        }
        ("tip_relief", _) => {
            limit = 40.0;
            vec![("amount", d.uniform(4.0, 12.0)), ("length", path * d.uniform(0.18, 0.4))]
        }
        ("roughness_polish", _) => {
            limit = 4.0;
            drivers = &["cycles", "position", "depth"];
            vec![("height", 0.1 * c.depth), ("contacts", c.cycles * d.log_uniform(0.02, 0.15))]
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
            vec![("asymmetry", d.uniform(0.1, 0.6) * if d.unit() < 0.25 { -1.0 } else { 1.0 })]
        }
        ("approach_recess", _) => {
            limit = 1.5;
            vec![("asymmetry", d.uniform(0.1, 0.6)), ("ramp", path * d.uniform(0.05, 0.2))]
        }
        ("member_hardness", _) => {
            limit = 1.6;
            drivers = &["member"];
            vec![("log_ratio", d.uniform(0.1, 0.5) * d.sign())]
        }
        ("surface_layer", "exponential") => {
            limit = 12.0;
            drivers = &["depth", "cycles"];
            vec![("gain", d.log_uniform(0.5, 3.0)), ("layer", c.depth * d.uniform(0.1, 0.5))]
        }
        ("surface_layer", _) => {
            limit = 12.0;
            drivers = &["depth", "cycles"];
            vec![("gain", d.log_uniform(0.5, 3.0)), ("layer", c.depth * d.uniform(0.1, 0.35)), ("width", c.depth * d.uniform(0.03, 0.08))]
        }
        ("coating", _) => {
            limit = 14.0;
            drivers = &["depth", "cycles"];
            vec![("hardness_gain", d.log_uniform(1.0, 6.0)), ("thickness", (c.depth * d.uniform(0.05, 0.25)).clamp(0.3, 5.0))]
        }
        ("flash_temperature", "exponential") => {
            limit = 6.0 / c.flash;
            drivers = &["position", "speed", "torque"];
            vec![("per_kelvin", d.uniform(0.2, 1.5) / c.flash), ("bulk_reference", 60.0)]
        }
        ("flash_temperature", _) => {
            limit = 0.45 / c.flash;
            drivers = &["position", "speed", "torque"];
            vec![("softening_per_kelvin", d.uniform(0.1, 0.4) / c.flash)]
        }
        ("sliding_speed_exponent", "power") => {
            limit = 1.0;
            drivers = &["position", "speed"];
            vec![("exponent", d.uniform(0.15, 0.6) * d.sign()), ("reference", 1e-3 * sliding(c, 0.5 * c.pair.end))]
        }
        ("sliding_speed_exponent", _) => {
            limit = 15.0;
            drivers = &["position", "speed"];
            vec![("gain", d.log_uniform(0.5, 3.0)), ("half_speed", 1e-3 * sliding(c, c.pair.end) * d.uniform(0.5, 1.5))]
        }
        ("severe_transition", _) => {
            limit = 30.0;
            drivers = &["position", "torque"];
            let pc = c.p0 * d.uniform(0.85, 1.1);
            vec![("gain", d.log_uniform(0.5, 5.0)), ("critical", pc), ("width", pc * if form == "ramp" { d.uniform(0.1, 0.25) } else { d.uniform(0.03, 0.05) })]
        }
        ("oxidative", _) => {
            limit = 1.0;
            drivers = &["position", "speed"];
            vec![("part", d.uniform(0.2, 0.7)), ("reference", 1e-3 * sliding(c, 0.4 * c.pair.end))]
        }
        ("profile_slope", "linear") => {
            limit = 20.0;
            vec![("amount", d.uniform(3.0, 9.0) * d.sign())]
        }
        ("profile_slope", _) => {
            limit = 20.0;
            vec![("amount", d.uniform(3.0, 9.0) * d.sign()), ("curve", d.uniform(-0.35, 0.35))]
        }
        ("profile_form", "cosine") => {
            limit = 8.0;
            vec![("amount", d.uniform(1.0, 3.0)), ("waves", d.uniform(1.5, 4.0)), ("phase", d.uniform(0.0, 2.0 * PI))]
        }
        ("profile_form", _) => {
            limit = 8.0;
            vec![("amount", d.uniform(1.0, 3.0)), ("waves", d.uniform(1.5, 3.0)), ("phase", d.uniform(0.0, 2.0 * PI)), ("second", d.uniform(0.2, 0.5)), ("second_phase", d.uniform(0.0, 2.0 * PI))]
        }
        ("extra_flexibility", _) => {
            limit = 0.2;
            vec![("compliance", d.uniform(0.01, 0.05))]
        }
        ("radial_misalignment", _) => {
            limit = 0.22 * c.module;
            vec![("shift", c.module * d.uniform(0.02, 0.08) * if d.unit() < 0.2 { -0.3 } else { 1.0 })]
        }
        ("bearing_compliance", "linear") => {
            limit = 0.2 * c.module;
            drivers = &["position", "torque"];
            vec![("shift_at_reference", c.module * d.uniform(0.02, 0.06)), ("reference_torque", c.torque)]
        }
        ("bearing_compliance", _) => {
            limit = 0.2 * c.module;
            drivers = &["position", "torque"];
            vec![("clearance", c.module * d.uniform(0.02, 0.06)), ("closing_torque", c.torque * d.uniform(0.5, 1.5))]
        }
        ("thermal_expansion", _) => {
            limit = 0.12 * c.module;
            drivers = &["position", "speed", "torque"];
            vec![("shift_at_reference", c.module * d.uniform(0.01, 0.04)), ("reference_power", c.torque * c.speed)]
        }
        ("dynamic_load", _) => {
            limit = 0.7;
            drivers = &["position", "speed"];
            let mut v = vec![("amplitude", d.uniform(0.05, 0.3)), ("resonance", c.speed * d.uniform(0.8, 1.6)), ("damping", d.uniform(0.06, 0.12)), ("phase", d.uniform(0.0, 2.0 * PI))];
            if form == "two_harmonics" {
                v.push(("second", d.uniform(0.2, 0.5)));
            }
            v
        }
        ("plastic_deformation", _) => {
            limit = 6.0;
            vec![("dent", 0.12 * c.depth), ("onset", c.p0 * d.uniform(0.65, 0.9)), ("span", c.p0 * d.uniform(0.15, 0.4)), ("cycles", c.cycles * 0.004)]
        }
        ("starvation_band", _) => {
            limit = 8.0;
            vec![("gain", d.log_uniform(0.3, 1.5)), ("centre", c.pair.start + path * d.uniform(0.15, 0.85)), ("width", path * d.uniform(0.04, 0.1))]
        }
        ("growing_scuff", _) => {
            limit = 8.0;
            vec![("gain", d.log_uniform(0.4, 2.0)), ("length_at_end", path * d.uniform(0.2, 0.4)), ("cycles", c.cycles)]
        }
        ("on_off_blocks", _) => {
            limit = 0.95;
            drivers = cycles;
            vec![("loss", d.uniform(0.3, 0.8)), ("block", c.cycles * d.uniform(0.16, 0.3)), ("phase", d.uniform(0.0, 1.0))]
        }
        ("gear_hardness_waves", _) => {
            limit = 0.9;
            drivers = &["position", "member"];
            vec![("amplitude", d.uniform(0.15, 0.6)), ("length", pb * d.uniform(0.2, 0.45)), ("phase", d.uniform(0.0, 2.0 * PI))]
        }
        ("load_moved_band", _) => {
            limit = 8.0;
            drivers = &["position", "torque"];
            vec![("gain", d.log_uniform(0.4, 2.0)), ("centre_at_reference", c.pair.end * d.uniform(0.35, 0.6)), ("width", path * d.uniform(0.05, 0.1)), ("reference_torque", c.torque)]
        }
        ("members_swap", _) => {
            limit = 3.0;
            drivers = &["cycles", "member", "depth"];
            vec![("log_ratio", d.uniform(0.2, 0.7)), ("cycles", c.cycles * d.uniform(0.3, 0.5))]
        }
        ("half_flank_oil_failure", _) => {
            limit = 8.0;
            drivers = &["position", "cycles"];
            vec![("gain", d.log_uniform(0.4, 2.0)), ("from_cycles", c.cycles * d.uniform(0.3, 0.6)), ("side", d.sign())]
        }
        ("humidity_cycle", _) => {
            limit = 0.95;
            drivers = cycles;
            vec![("amplitude", d.uniform(0.3, 0.8)), ("period", c.cycles * d.uniform(0.35, 0.6)), ("phase", d.uniform(0.0, 2.0 * PI))]
        }
        ("gear_groove", _) => {
            limit = 25.0;
            vec![("depth", d.uniform(2.0, 8.0)), ("centre", c.pair.start + path * d.uniform(0.3, 0.8)), ("width", path * d.uniform(0.05, 0.1))]
        }
        ("gear_tip_plating", _) => {
            limit = 0.95;
            drivers = &["position", "member"];
            vec![("loss", d.uniform(0.3, 0.8)), ("length", path * d.uniform(0.12, 0.25))]
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

impl Law {
    pub fn strength(&self) -> f64 {
        self.parameters[0].1
    }
    pub fn with_strength(&self, v: f64) -> Self {
        let mut l = self.clone();
        l.parameters[0].1 = v;
        l
    }
    fn p(&self, k: usize) -> f64 {
        self.parameters[k].1
    }
    /// Material moves, it is not lost: weighing would not see it.
    pub fn moves_material(&self) -> bool {
        self.name == "plastic_deformation"
    }
}

fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}

fn slip(seen: &Seen) -> f64 {
    (seen.u[0] - seen.u[1]).abs()
}

/// Blok's flash temperature, K.
pub fn flash(load: f64, u: [f64; 2], half: f64, friction: f64) -> f64 {
    let contact = 13_000.0 * (2.0 * half * 1e-3).sqrt();
    1.11 * friction * load * 1e3 * (u[0].abs().sqrt() - u[1].abs().sqrt()).abs() / contact
}

/// Dowson and Higginson's minimum film over the roughness.
pub fn film(load: f64, curvature: f64, u: [f64; 2], e_star: f64, c: &Conditions) -> f64 {
    let e2 = 2.0 * e_star * 1e6;
    let r = curvature * 1e-3;
    let speed = c.viscosity * 0.5 * (u[0] + u[1]) / (e2 * r);
    let material = c.pressure_viscosity * 1e-9 * e2;
    let w = load.max(1e-6) * 1e3 / (e2 * r);
    2.65 * r * speed.powf(0.7) * material.powf(0.54) * w.powf(-0.13) * 1e6 / c.roughness
}

fn member_path(pair: &Mating, member: usize, rho: f64) -> f64 {
    if member == 0 { rho - pair.c1 } else { pair.c2 - rho }
}

impl Hidden for Law {
    fn has_factor(&self) -> bool {
        matches!(
            self.name,
            "pressure_exponent" | "film_thickness" | "approach_recess" | "flash_temperature"
                | "sliding_speed_exponent" | "severe_transition" | "oxidative" | "starvation_band" | "load_moved_band"
        )
    }

    fn has_spot(&self) -> bool {
        matches!(
            self.name,
            "running_in" | "micropitting" | "debris_abrasion" | "lubricant_ageing" | "roughness_polish" | "corrosive_loss"
                | "member_hardness" | "surface_layer" | "coating" | "plastic_deformation" | "growing_scuff" | "on_off_blocks"
                | "gear_hardness_waves" | "members_swap" | "half_flank_oil_failure" | "humidity_cycle" | "gear_tip_plating"
        )
    }

    fn factor(&self, x: &Seen) -> f64 {
        let a = self.p(0);
        match (self.name, self.form) {
            ("pressure_exponent", "local") => (x.pressure / self.p(1)).powf(a),
            ("pressure_exponent", "hertz") => (x.p0 / self.p(1)).powf(a),
            ("pressure_exponent", _) => 1.0 + a * ((x.pressure - self.p(1)) / self.p(2)).max(0.0),
            ("film_thickness", form) => {
                let l = film(x.load, x.curvature, x.u, x.e_star, x.conditions);
                match form {
                    "rational" => 1.0 / (1.0 + a * (l / self.p(2)).powf(self.p(1))),
                    "step" => 1.0 - a * logistic(2.0 * (l - self.p(1)) / self.p(2)),
                    _ => (-a * l / self.p(1)).exp(),
                }
            }
            ("approach_recess", "step") => if x.s < 0.0 { 1.0 + a } else { 1.0 },
            ("approach_recess", _) => 1.0 + 0.5 * a * (1.0 - (x.s / self.p(1)).tanh()),
            ("flash_temperature", "exponential") => {
                let t = flash(x.load, x.u, x.half, x.conditions.friction);
                (a * (t + x.conditions.bulk - self.p(1))).exp()
            }
            ("flash_temperature", _) => {
                let t = flash(x.load, x.u, x.half, x.conditions.friction);
                1.0 / (1.0 - (a * t).min(0.9))
            }
            ("sliding_speed_exponent", "power") => (slip(x).max(0.02) / self.p(1)).powf(a),
            ("sliding_speed_exponent", _) => 1.0 + a * slip(x) / (slip(x) + self.p(1)),
            ("severe_transition", "logistic") => 1.0 + a * logistic((x.p0 - self.p(1)) / self.p(2)),
            ("severe_transition", _) => 1.0 + a * ((x.p0 - self.p(1)) / self.p(2) + 0.5).clamp(0.0, 1.0),
            ("oxidative", _) => 1.0 - a + a * self.p(1) / slip(x).max(0.02),
            ("starvation_band", _) => 1.0 + a * (-((x.s - self.p(1)) / self.p(2)).powi(2)).exp(),
            ("load_moved_band", _) => {
                let at = self.p(1) * x.conditions.torque / self.p(3);
                1.0 + a * (-((x.s - at) / self.p(2)).powi(2)).exp()
            }
            _ => 1.0,
        }
    }

    fn local(&self, x: &Spot) -> f64 {
        let a = self.p(0);
        let n = x.cycles;
        let hours = n / (60.0 * x.conditions.speed);
        match (self.name, self.form) {
            ("running_in", "exponential") => 1.0 + a * (-n / self.p(1)).exp(),
            ("running_in", "contacts") => 1.0 + a * (-n * x.contacts_per_cycle / self.p(1)).exp(),
            ("running_in", "hyperbolic") => 1.0 + a * (1.0 + n / self.p(1)).powf(-self.p(2)),
            ("running_in", _) => (1.0 - a) * ((n + self.p(1)) / self.p(2)).powf(-a),
            ("debris_abrasion", "linear") => 1.0 + a * x.worn / self.p(1),
            ("debris_abrasion", _) => 1.0 + a * (1.0 - (-x.worn / self.p(1)).exp()),
            ("lubricant_ageing", "linear") => 1.0 + a * hours / self.p(1),
            ("lubricant_ageing", _) => 1.0 + a * (1.0 - (-hours / self.p(1)).exp()),
            ("member_hardness", "ratio") => (a * (0.5 - x.member as f64)).exp(),
            ("member_hardness", _) => if x.member == 1 { (-a).exp() } else { 1.0 },
            ("surface_layer", "exponential") => 1.0 + a * (1.0 - (-x.depth.max(0.0) / self.p(1)).exp()),
            ("surface_layer", _) => 1.0 + a * logistic((x.depth - self.p(1)) / self.p(2)),
            ("coating", "step") => {
                let through = logistic((x.depth - self.p(1)) / (0.04 * self.p(1)));
                through + (1.0 - through) / (1.0 + a)
            }
            ("coating", _) => {
                let through = (x.depth / self.p(1) - 0.5).clamp(0.0, 1.0);
                through + (1.0 - through) / (1.0 + a)
            }
            ("growing_scuff", _) if x.member == 0 => {
                let length = self.p(1) * (n / self.p(2)).sqrt();
                1.0 + a * logistic((x.start + length - x.s) / (0.06 * self.p(1)))
            }
            ("on_off_blocks", _) => {
                // A soft square wave: wear is lower in every second block.
                let phase = 2.0 * PI * (n / (2.0 * self.p(1)) + self.p(2));
                1.0 - a * logistic(12.0 * phase.sin())
            }
            ("gear_hardness_waves", _) if x.member == 1 => 1.0 + a * (2.0 * PI * x.s / self.p(1) + self.p(2)).cos(),
            ("members_swap", _) => {
                // The pinion wears faster early, the gear late.
                let side = ((self.p(1) - n) / (0.5 * self.p(1))).tanh();
                (a * side * (0.5 - x.member as f64)).exp()
            }
            ("half_flank_oil_failure", _) => {
                let late = logistic((n - self.p(1)) / (0.02 * self.p(1)));
                if x.s * self.p(2) > 0.0 { 1.0 + a * late } else { 1.0 }
            }
            ("humidity_cycle", _) => 1.0 + a * (2.0 * PI * n / self.p(1) + self.p(2)).sin(),
            ("gear_tip_plating", _) if x.member == 1 => 1.0 - a * logistic((x.start + self.p(1) - x.s) / (0.08 * self.p(1))),
            _ => 1.0,
        }
    }

    fn added(&self, x: &Spot) -> f64 {
        let a = self.p(0);
        let n = x.cycles;
        let touched = if x.peak > 0.0 { 1.0 } else { 0.0 };
        let per_hour = 1.0 / (60.0 * x.conditions.speed);
        match (self.name, self.form) {
            ("micropitting", form) => {
                let p = x.peak.min(2000.0) / self.p(2);
                let base = a * 1e-6 * x.contacts_per_cycle * p.powf(self.p(1));
                match form {
                    "saturating" => base * (-n / self.p(3)).exp(),
                    "dedendum" => {
                        let below = (x.member == 0) == (x.s < 0.0);
                        base * if below { 1.0 + self.p(3) } else { 1.0 }
                    }
                    _ => base,
                }
            }
            ("roughness_polish", form) => {
                let (c, per) = (n * x.contacts_per_cycle, x.contacts_per_cycle);
                let np = self.p(1);
                let slope = match form {
                    "exponential" => (-c / np).exp() / np,
                    _ => np / (c + np).powi(2),
                };
                touched * a * per * slope
            }
            ("corrosive_loss", "linear") => a * per_hour,
            ("corrosive_loss", _) => {
                // d/dn of a sqrt(t), its first minute smoothed.
                let t = n * per_hour + 0.02;
                0.5 * a * per_hour / t.sqrt()
            }
            ("plastic_deformation", form) => {
                let load = (x.peak - self.p(1)) / self.p(2);
                let part = if form == "clip" { load.clamp(0.0, 1.0) } else { logistic(4.0 * (load - 0.5)) * touched };
                a * part * (-n / self.p(3)).exp() / self.p(3)
            }
            _ => 0.0,
        }
    }

    fn profile(&self, member: usize, pair: &Mating, rho: f64) -> f64 {
        let a = self.p(0);
        let s = member_path(pair, member, rho);
        let path = pair.end - pair.start;
        match (self.name, self.form) {
            ("tip_relief", form) => {
                let from_tip = if member == 0 { pair.end - s } else { s - pair.start };
                let x = (1.0 - from_tip / self.p(1)).max(0.0);
                a * if form == "linear" { x } else { x * x }
            }
            ("profile_slope", form) if member == 0 => {
                let x = (s - pair.start) / path;
                let curve = if form == "linear" { 0.0 } else { self.p(1) };
                // Missing material from zero up, whichever end is low.
                if a > 0.0 {
                    a * (x + curve * x * (x - 1.0) * 2.0)
                } else {
                    -a * ((1.0 - x) + curve * x * (x - 1.0) * 2.0)
                }
            }
            ("profile_form", form) if member == 0 => {
                let x = (s - pair.start) / path;
                let mut v = 1.0 + (2.0 * PI * self.p(1) * x + self.p(2)).cos();
                if form == "two_waves" {
                    v += self.p(3) * (2.0 * PI * 2.3 * self.p(1) * x + self.p(4)).cos();
                }
                a * v
            }
            ("gear_groove", _) if member == 1 => a * (-((s - self.p(1)) / self.p(2)).powi(2)).exp(),
            _ => 0.0,
        }
    }

    fn load(&self, theta: f64, c: &Conditions, _: &Mating) -> f64 {
        if self.name != "dynamic_load" {
            return 1.0;
        }
        let gain = |r: f64| 1.0 / ((1.0 - r * r).powi(2) + (2.0 * self.p(2) * r).powi(2)).sqrt();
        // At speed 0 only the amplitude would be left: count what the speed adds.
        let r = c.speed / self.p(1);
        let first = self.p(0) * gain(r) * r * r;
        let mut v = first * (2.0 * PI * theta + self.p(3)).cos();
        if self.form == "two_harmonics" {
            let r2 = 2.0 * r;
            v += self.p(4) * self.p(0) * gain(r2) * r * r * (4.0 * PI * theta + self.p(3)).cos();
        }
        1.0 + v.clamp(-0.8, 2.0)
    }

    fn softness(&self) -> f64 {
        if self.name == "extra_flexibility" { self.p(0) } else { 0.0 }
    }

    fn shift(&self, c: &Conditions, _: f64) -> f64 {
        let a = self.p(0);
        match (self.name, self.form) {
            ("radial_misalignment", _) => a,
            ("bearing_compliance", "linear") => a * c.torque / self.p(1),
            ("bearing_compliance", _) => a * (1.0 - (-c.torque / self.p(1)).exp()),
            ("thermal_expansion", _) => a * c.torque * c.speed / self.p(1),
            _ => 0.0,
        }
    }
}
