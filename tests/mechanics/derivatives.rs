//! Claim: the derivatives that a wear history carries are those of the numbers it gives, on the steps it takes.
//!
//! Source: central differences of whole histories that are worn again along the same steps, contact and all. Tolerance: 1e-4 of the
//! derivative's largest value over both flanks.

use gearwear::effects::{CATALOGUE, Card, Combined, Hook, Surroundings};
use gearwear::simulate::forward::{Conditions, Forward, GearSet, Variation};
use gearwear::simulate::history::{HistoryTangents, Progress};
use gearwear::simulate::members::Members;
use gearwear::simulate::numerics::Numerics;
use gearwear::study::Study;
use gearwear::wear::acting::Acting;

const STUDY: &str = include_str!("../../validation/paper/study.toml");
const TOLERANCE: f64 = 1e-4;
const CYCLES: f64 = 3e5;
const COEFFICIENT: f64 = 6e-10;
/// How far laws are asked along a tangent, relative: short, for laws and contacts have kinks.
const LAW: f64 = 1e-7;
/// How far apart the compared histories lie, relative: where the first distance is too far for a history that is bent as much as this (with
/// `profile_slope` by the analytic model differences are off by 1.0e-2, 1.1e-3, 9.9e-5 and 1.1e-5 at 3e-7, 1e-7, 3e-8 and 1e-8, as the square), the second is not;
/// it is too near for laws as steep as `dynamic_load`, where rounding leaves 1.5e-4. A wrong derivative misses both.
const APART: [f64; 2] = [3e-7, 1e-8];

/// Laws that turn on which place of a corner's contact is pressed most, or is hottest, at their default values on so coarse a mesh: derivatives grow
/// from step to step there, no two histories are close, and there is nothing to compare. Here they are less steep.
const STEADY: [(&str, &[(&str, f64)]); 2] = [
    ("severe_transition", &[("ratio", 2.0), ("width", 0.3)]),
    ("oxidative", &[("activation_energy", 20.0)]),
];

fn set() -> GearSet {
    Study::parse(STUDY, "study.toml").unwrap().gear_set()
}

/// Coarse: what is asked here does not depend on resolution.
fn numerics() -> Numerics {
    Numerics {
        elements_per_half_width: 2.0,
        positions: 40,
        step_tolerance: 4e-3,
        condense_after: 0.1,
        room: 1.4,
        ..Numerics::default()
    }
}

fn template<'a>(set: &'a GearSet, members: Option<&'a Members>) -> Forward<'a> {
    let conditions = Conditions {
        torque: 1e5,
        speed: 2000.0,
        misalignment: 0.0,
        cycles: CYCLES,
        coefficient: [COEFFICIENT; 2],
    };
    Forward::new(set, members, conditions, numerics()).unwrap()
}

fn acting(card: &Card, values: &[f64]) -> Acting {
    let mut effects = Combined::default();
    effects.push(card.hook, (card.build)(values));
    Acting {
        effects,
        surroundings: Surroundings {
            contact_modulus: 115_385.0,
            viscosity_pa_s: Some(0.015),
            pressure_viscosity_per_gpa: Some(18.0),
            roughness_um: Some(0.5),
            friction_coefficient: Some(0.06),
            contact_coefficient: Some(13_000.0),
            bulk_temperature_c: Some(60.0),
            flank_temperature_c: Some(60.0),
        },
        torque: 100.0,
        speed: 2000.0,
        reversed: false,
        face_width: 33.0,
    }
}

/// A history with its derivatives, and the cycles of its steps.
fn differentiated(
    template: &Forward<'_>,
    acting: Option<&Acting>,
    variations: &[Variation],
) -> (Progress, HistoryTangents, Vec<f64>) {
    let mut forward = template.again([COEFFICIENT; 2], acting).unwrap();
    let (mut progress, mut tangents) = (None, HistoryTangents::default());
    let mut steps = Vec::new();
    let with = (variations, &mut tangents);
    forward
        .wear_with_tangents(&mut progress, CYCLES, with, &mut |_, progress, _| {
            steps.push(progress.stand.n);
            true
        })
        .unwrap();
    (progress.unwrap(), tangents, steps)
}

/// The same history along given steps.
fn along(
    template: &Forward<'_>,
    coefficient: [f64; 2],
    acting: Option<&Acting>,
    steps: &[f64],
) -> Progress {
    let mut forward = template.again(coefficient, acting).unwrap();
    let mut progress = None;
    forward
        .wear_along(&mut progress, steps, &mut |_| ())
        .unwrap();
    progress.unwrap()
}

/// The least error of a derivative at the distances looked at, the second of which is only asked where the first will not do.
fn least(error_at: impl Fn(f64) -> f64) -> f64 {
    let first = error_at(APART[0]);
    if first < TOLERANCE {
        first
    } else {
        error_at(APART[1])
    }
}

/// Largest difference of a derivative from central differences, over the derivative's largest value.
fn error(exact: &[f64], [low, high]: [&Progress; 2], step: f64) -> f64 {
    let largest = exact.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
    let ends = low.stand.u.iter().zip(&high.stand.u);
    let off = ends
        .zip(exact)
        .map(|((a, b), d)| ((b - a) / (2.0 * step) - d).abs());
    off.fold(0.0, f64::max) / largest
}

fn check(template: &Forward<'_>, what: &str) {
    let mut missed = Vec::new();
    let mut judge = |name: String, error: f64| {
        // a NaN is none of it
        if error.is_nan() || error >= TOLERANCE {
            missed.push((name, error));
        }
    };
    for coefficient in [[1.0, 1.0], [1.0, 0.0], [0.0, 1.0]] {
        let variation = Variation {
            coefficient,
            effects: None,
            step: LAW,
        };
        let (_, tangents, steps) = differentiated(template, None, &[variation]);
        let off = least(|apart| {
            let ends = [-apart, apart].map(|h: f64| {
                let k = coefficient.map(|w| COEFFICIENT * (w * h).exp());
                along(template, k, None, &steps)
            });
            error(&tangents.depth[0], [&ends[0], &ends[1]], apart)
        });
        judge(format!("k {coefficient:?}"), off);
    }
    for card in CATALOGUE.iter().filter(|card| card.hook != Hook::Operation) {
        let mut values = card.defaults();
        for (name, value) in STEADY.iter().filter(|s| s.0 == card.name).flat_map(|s| s.1) {
            values[card.place(name).unwrap()] = *value;
        }
        let at = |place: usize, by: f64| {
            let mut values = values.clone();
            values[place] += by;
            acting(card, &values)
        };
        let base = acting(card, &values);
        let fitted: Vec<usize> = (0..card.params.len())
            .filter(|&place| card.params[place].fitted)
            .collect();
        let size = |place: usize| values[place].abs().max(1e-3);
        let mut variations: Vec<Variation> = (fitted.iter())
            .map(|&place| {
                let step = LAW * size(place);
                Variation {
                    coefficient: [0.0; 2],
                    effects: Some(at(place, step)),
                    step,
                }
            })
            .collect();
        variations.push(Variation {
            coefficient: [1.0; 2],
            effects: None,
            step: LAW,
        });
        let (_, tangents, steps) = differentiated(template, Some(&base), &variations);
        for (&place, exact) in fitted.iter().zip(&tangents.depth) {
            let off = least(|apart| {
                let step = apart * size(place);
                let ends = [-step, step]
                    .map(|h| along(template, [COEFFICIENT; 2], Some(&at(place, h)), &steps));
                error(exact, [&ends[0], &ends[1]], step)
            });
            judge(format!("{}.{}", card.name, card.params[place].name), off);
        }
        let off = least(|apart| {
            let ends = [-apart, apart]
                .map(|h: f64| along(template, [COEFFICIENT * h.exp(); 2], Some(&base), &steps));
            error(&tangents.depth[fitted.len()], [&ends[0], &ends[1]], apart)
        });
        judge(format!("k with {}", card.name), off);
    }
    assert!(missed.is_empty(), "{what}: {missed:?}");
}

#[test]
fn derivatives_by_finite_elements_are_those_of_the_history() {
    let set = set();
    let members = set.members(&numerics(), &[1e5], &[0.0]).unwrap();
    check(&template(&set, Some(&members)), "fem");
}

#[test]
fn derivatives_of_the_analytic_model_are_those_of_the_history() {
    let set = set();
    check(&template(&set, None), "hertz");
}
