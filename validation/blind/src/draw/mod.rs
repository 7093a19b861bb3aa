//! Which causes there are, and their parameters drawn to suit a pair of gears and its tests.

mod added_depth;
mod forces;
mod in_time;
mod mesh;
mod outside;
mod pressure;
mod rubbing;
mod surface;

use std::f64::consts::PI;

use crate::dice::Dice;
use crate::involute::Mating;
use crate::laws::{Class, Law};
use crate::uneven::{self, Uneven};

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
    pub uneven: Uneven,
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

/// Known causes that act through forces; kept apart so that what a seed draws of the others stays.
pub const FORCE: &[(&str, &str)] = &[
    ("friction_load", "coulomb"),
    ("friction_load", "recess"),
    ("dynamic_load", "mean_and_ripple"),
    ("energy_wear", "mean_tooth_friction"),
    ("energy_wear", "rolling_and_sliding"),
];

/// All known causes.
pub const KNOWN: &[&[(&str, &str)]] = &[CATALOGUE, uneven::FACE, uneven::TEETH, FORCE];

/// The first form of a name is the catalogue's.
pub fn class_of(name: &str, form: Option<&str>) -> Class {
    match KNOWN.iter().copied().flatten().find(|c| c.0 == name) {
        Some(first) if form.is_none_or(|f| f == first.1) => Class::Single,
        Some(_) => Class::Foreign,
        None => Class::Outside,
    }
}

/// What is drawn of a law.
struct Terms {
    parameters: Vec<(&'static str, f64)>,
    drivers: &'static [&'static str],
    /// Largest |strength| that makes sense.
    limit: f64,
}

impl Default for Terms {
    fn default() -> Self {
        Self {
            parameters: Vec::new(),
            drivers: &["position"],
            limit: f64::INFINITY,
        }
    }
}

type Draw = fn(&str, &str, &Context, &mut Dice) -> Option<Terms>;

const FILES: [Draw; 9] = [
    in_time::draw,
    pressure::draw,
    rubbing::draw,
    surface::draw,
    added_depth::draw,
    mesh::draw,
    outside::draw,
    forces::draw,
    uneven_flanks,
];

pub fn draw(name: &'static str, form: &'static str, c: &Context, d: &mut Dice) -> Law {
    let terms = FILES.iter().find_map(|draw| draw(name, form, c, d));
    let Some(terms) = terms else {
        unreachable!("no law {name} {form}")
    };
    Law {
        name,
        form,
        class: class_of(name, Some(form)),
        parameters: terms.parameters,
        drivers: terms.drivers,
        limit: terms.limit,
    }
}

/// Leads and teeth that differ, um; see [`uneven`].
fn uneven_flanks(name: &str, form: &str, c: &Context, d: &mut Dice) -> Option<Terms> {
    let (side, member) = (c.uneven.side, c.uneven.member as f64);
    let turn = 2.0 * PI;
    let (parameters, limit) = match (name, form) {
        ("lead_misalignment", "wedge") => {
            (vec![("amount", d.uniform(4.0, 15.0)), ("side", side)], 60.0)
        }
        ("lead_misalignment", _) => (
            vec![
                ("amount", d.uniform(4.0, 15.0)),
                ("side", side),
                ("bend", d.uniform(0.1, 0.3) * d.sign()),
            ],
            60.0,
        ),
        ("lead_crowning", "parabola") => (vec![("amount", d.uniform(3.0, 12.0))], 40.0),
        ("lead_crowning", _) => (
            vec![
                ("amount", d.uniform(3.0, 12.0)),
                ("length", d.uniform(0.15, 0.35)),
            ],
            40.0,
        ),
        ("pitch_error", _) => (
            vec![
                ("deviation", d.uniform(2.0, 8.0) * d.sign()),
                ("member", member),
            ],
            25.0,
        ),
        ("run_out", "eccentric") => (
            vec![
                ("eccentricity", 1e3 * c.module * d.uniform(0.01, 0.03)),
                ("phase", turn * d.unit()),
                ("member", member),
            ],
            60.0 * c.module,
        ),
        ("run_out", _) => (
            vec![
                ("amplitude", d.uniform(5.0, 20.0)),
                ("phase", turn * d.unit()),
                ("member", member),
            ],
            60.0,
        ),
        _ => return None,
    };
    Some(Terms {
        parameters,
        limit,
        ..Terms::default()
    })
}

/// Sliding speed at path s in the reference test, mm/s.
fn sliding(c: &Context, s: f64) -> f64 {
    let w = c.speed * PI / 30.0;
    w * (1.0 + c.pair.pinion.z as f64 / c.pair.gear.z as f64) * s.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::involute::Tooth;

    /// Every form of every cause is drawn in one place.
    #[test]
    fn each_form_is_drawn_once() {
        let (p, g) = (
            Tooth::new(2.0, 27, 0.0, 12.5),
            Tooth::new(2.0, 53, 0.0, 20.0),
        );
        let c = Context {
            pair: Mating::new(&p, &g, 80.0),
            module: 2.0,
            torque: 100.0,
            speed: 2000.0,
            cycles: 1e6,
            depth: 10.0,
            p0: 900.0,
            film: 0.5,
            flash: 10.0,
            worn: 0.1,
            uneven: Uneven {
                side: 1.0,
                member: 0,
            },
        };
        let known = KNOWN.iter().copied().flatten().copied();
        for (name, form) in known.chain(OUTSIDE.iter().map(|&n| (n, "own"))) {
            let drawn = |f: &&Draw| f(name, form, &c, &mut Dice::new(1)).is_some();
            assert_eq!(FILES.iter().filter(drawn).count(), 1, "{name}:{form}");
        }
    }
}
