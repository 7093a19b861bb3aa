//! Claim: a learned law is what its knots and values say, on the members it names and through the hook it names; in a wear history it
//! does what the formula does that its values are taken from, the closer the finer its knots; what cannot be read is refused at its place;
//! fitted to measurements with a hidden law it finds that law's shape, and predicts tests that it was not fitted to.
//!
//! Source: exponentials and linear interpolation by hand; the time change n → ∫ f dn, which makes the base model of a law of the cycles;
//! Archard's law, in which a constant factor is another k; the formulas themselves as the program's formula effects compute them;
//! made-up measurements with a hidden formula.
//! Tolerance: rounding for values by hand; 1e-9 for another k; a rate of 1.7 to 2.3 for the second order of linear interpolation.

use std::f64::consts::TAU;

use gearwear::effects::{Combined, Effect, Hook, Learned, Local, ProfileAt, Surroundings, formula};
use gearwear::gear::Member;
use gearwear::simulate::forward::{Conditions, Forward, GearSet};
use gearwear::simulate::numerics::Numerics;
use gearwear::simulate::wear_state::{WearState, worn_area};
use gearwear::study::{LearnedLaw, Study};
use gearwear::wear::acting::Acting;

mod fitted;
mod refused;

const BASE: &str = include_str!("../../validation/challenges/none_L2/study.toml");

fn local(member: Member, cycles: f64) -> Local {
    Local {
        member,
        radius: 26.4,
        path: -2.0,
        approach: true,
        curvature: [7.0, 20.0],
        rolling: [1.5, 2.0],
        pressure: 800.0,
        peak_pressure: 900.0,
        hertz_pressure: 880.0,
        line_load: 100.0,
        half_width: 0.05,
        normal_load: 120.0,
        depth: 1.0,
        cycles,
        contacts: cycles,
        hours: 1.0,
        contact_hours: 1e-5,
        worn_volume: 1.0,
        torque: 100.0,
        speed: 2000.0,
        base_radius: 25.4,
        base_pitch: 5.9,
        film_ratio: 0.5,
        friction: 0.06,
        flash_temperature: 20.0,
        bulk_temperature: 60.0,
    }
}

fn entry(keys: &str) -> String {
    format!("{BASE}\n[[effect]]\nkind = \"learned\"\n{keys}\n")
}

fn study(keys: &str) -> Study {
    Study::parse(&entry(keys), "study.toml").unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_factor_is_the_exponential_of_what_lies_between_the_knots() {
    let study = study(
        "name = \"what we found\"\nacts = \"wear_factor\"\ndriver = \"cycles\"\nknots = [0, 1e5, 3e5]\nvalues = [0.0, 0.5, -0.5]",
    );
    assert_eq!(study.effects()[0].name, "learned:cycles");
    let law = study.effect_model().stated();
    assert!(law.acts(Hook::WearFactor) && !law.acts(Hook::AddedDepth));
    for (cycles, logarithm) in [
        (0.0, 0.0),
        (5e4, 0.25),
        (1e5, 0.5),
        (2e5, 0.0),
        (3e5, -0.5),
        (9e9, -0.5),
    ] {
        for member in Member::BOTH {
            let factor = law.wear_factor(&local(member, cycles));
            assert!((factor - f64::exp(logarithm)).abs() < 1e-15, "{cycles}");
        }
    }
}

#[test]
fn it_acts_on_its_member_through_its_hook_alone() {
    let added = study(
        "acts = \"added_depth\"\ndriver = \"depth\"\nmember = \"gear\"\nknots = [0, 2]\nvalues = [0, 1e-6]",
    );
    assert_eq!(added.effects()[0].name, "learned:depth:gear");
    let law = added.effect_model().stated();
    assert_eq!(law.added_depth(&local(Member::Gear, 0.0)), 0.5e-6);
    assert_eq!(law.added_depth(&local(Member::Pinion, 0.0)), 0.0);
    assert_eq!(law.wear_factor(&local(Member::Gear, 0.0)), 1.0);
    let made = study(
        "acts = \"profile\"\ndriver = \"along\"\nmember = \"pinion\"\nknots = [0, 1]\nvalues = [-4, 4]",
    );
    let law = made.effect_model().stated();
    let at = |member| ProfileAt {
        member,
        radius: 27.0,
        path: 0.0,
        from_tip: 1.0,
        along: 0.75,
    };
    assert_eq!(law.profile(&at(Member::Pinion)), 2.0);
    assert_eq!(law.profile(&at(Member::Gear)), 0.0);
}

/// 2 a |u1 − u2|/u per contact, by hand: 0.1 mm × 0.5/1.5 and 0.5/2.
#[test]
fn the_slid_distance_counts_contacts() {
    let pinion = local(Member::Pinion, 3e5).slid_distance();
    assert!((pinion - 3e5 * 0.1e-3 * 0.5 / 1.5).abs() < 1e-9, "{pinion}");
    let gear = local(Member::Gear, 3e5).slid_distance();
    assert!((gear - 3e5 * 0.1e-3 * 0.5 / 2.0).abs() < 1e-9, "{gear}");
}

#[test]
fn it_is_freed_whole_and_written_back_as_values() {
    let keys = "acts = \"wear_factor\"\ndriver = \"cycles\"\nknots = [0, 1e5, 2e5, 3e5]\nvalues = [0.3, 0.1, -0.1, -0.3]\n\
                [fit]\nfree = [\"wear.coefficient\", \"learned:cycles\"]";
    let study = study(keys);
    let names: Vec<&str> = study.free().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names[..2], ["wear.coefficient", "learned:cycles.z1"]);
    let held = |study: &Study| {
        study
            .effect_model()
            .stated()
            .wear_factor(&local(Member::Gear, 5e4))
    };
    let before = held(&study);
    assert!((before - f64::exp(0.2)).abs() < 1e-15);
    // a coefficient moved in the study's text moves its values as the same coefficient moves the model
    let moved = study.free()[1].value + 0.7;
    let model = study
        .effect_model()
        .build(&|name| (name == "learned:cycles.z1").then_some(moved));
    let mut edit = study.edit();
    edit.set("learned:cycles.z1", moved);
    let new = edit.finish("study.toml").unwrap();
    let by_model = model.wear_factor(&local(Member::Gear, 5e4));
    assert!((by_model / before - 1.0).abs() > 0.05);
    assert!((held(&new) / by_model - 1.0).abs() < 1e-5);
    assert_eq!(new.free().len(), study.free().len());
    let twice = keys.replace(
        "\"learned:cycles\"]",
        "\"learned:cycles\", \"learned:cycles.z1\"]",
    );
    let error = Study::parse(&entry(&twice), "study.toml").unwrap_err();
    assert!(error.to_string().contains("stands there twice"), "{error}");
}

fn set() -> GearSet {
    Study::parse(BASE, "study.toml").unwrap().gear_set()
}

/// Coarse but with fine wear steps: what is compared has the same contact.
fn numerics() -> Numerics {
    Numerics {
        elements_per_half_width: 2.0,
        positions: 32,
        step_tolerance: 2e-5,
        ..Numerics::default()
    }
}

fn worn(
    set: &GearSet,
    k: [f64; 2],
    cycles: f64,
    effect: Option<(Hook, Box<dyn Effect>)>,
) -> WearState {
    let mut effects = Combined::default();
    let acts = effect.is_some();
    if let Some((hook, effect)) = effect {
        effects.push(hook, effect);
    }
    let acting = Acting {
        effects,
        surroundings: Surroundings {
            contact_modulus: 115_385.0,
            viscosity_pa_s: None,
            pressure_viscosity_per_gpa: None,
            roughness_um: None,
            friction_coefficient: None,
            contact_coefficient: None,
            bulk_temperature_c: None,
            flank_temperature_c: None,
        },
        torque: 100.0,
        speed: 2000.0,
        reversed: false,
        face_width: 33.0,
    };
    let conditions = Conditions {
        torque: 1e5,
        speed: 2000.0,
        misalignment: 0.0,
        cycles,
        coefficient: k,
    };
    let acting = acts.then_some(&acting);
    let mut forward = Forward::with_effects(set, None, conditions, numerics(), acting).unwrap();
    let mut progress = None;
    forward
        .wear_to(&mut progress, cycles, &mut |_, _| true)
        .unwrap();
    forward.state(&progress.unwrap()).unwrap()
}

/// A law with the values of `logarithm` at `count` knots from `from` to `to`.
fn law(
    driver: &str,
    member: Option<Member>,
    [from, to]: [f64; 2],
    count: usize,
    logarithm: impl Fn(f64) -> f64,
) -> Box<dyn Effect> {
    let knots: Vec<f64> = (0..count)
        .map(|i| from + (to - from) * i as f64 / (count - 1) as f64)
        .collect();
    let values = knots.iter().map(|x| logarithm(*x)).collect();
    Learned::new(Hook::WearFactor, driver, member, &knots)
        .unwrap()
        .build(values)
}

fn largest_difference(a: &WearState, b: &WearState) -> f64 {
    let depths = a.depth.iter().flatten().zip(b.depth.iter().flatten());
    depths.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Errors fall with the square of the knots' spacing, for a law of time and for one of the place on the flank.
#[test]
fn a_law_with_a_formulas_values_gives_the_formulas_wear_as_its_knots_are_refined() {
    let set = set();
    let k = [5e-10; 2];
    type Logarithm = fn(f64) -> f64;
    let cases: [(&str, [f64; 2], &str, Logarithm); 2] = [
        ("cycles", [0.0, 1e5], "exp(0.8*sin(2*pi*cycles/6e4))", |n| {
            0.8 * (TAU * n / 6e4).sin()
        }),
        ("s", [-5.5, 5.5], "exp(0.8*sin(2*pi*s/5))", |s| {
            0.8 * (TAU * s / 5.0).sin()
        }),
    ];
    for (driver, range, text, logarithm) in cases {
        let formula = formula::Formula::new(Hook::WearFactor, text, &[]).unwrap();
        let exact = worn(&set, k, 1e5, Some((Hook::WearFactor, formula.build(&[]))));
        let deepest = exact.depth.iter().flatten().fold(0.0f64, |m, d| m.max(*d));
        let error = |count: usize| {
            let law = law(driver, None, range, count, logarithm);
            let with = worn(&set, k, 1e5, Some((Hook::WearFactor, law)));
            largest_difference(&with, &exact) / deepest
        };
        let (coarse, fine) = (error(33), error(129));
        let rate = (coarse / fine).ln() / 4f64.ln();
        assert!(
            (1.7..2.3).contains(&rate),
            "{driver}: {coarse:e} {fine:e}, rate {rate}"
        );
        assert!(fine < 2e-3, "{driver}: {fine:e}");
    }
}

/// A factor f(n) on k is the base model at ∫ f dn cycles; for ln f falling linearly from 1 to −1 over N cycles that is N sinh 1.
#[test]
fn a_law_of_the_cycles_is_another_clock() {
    let set = set();
    let end = 1e5;
    let law = law("cycles", None, [0.0, end], 2, |n| 1.0 - 2.0 * n / end);
    let with = worn(&set, [5e-10; 2], end, Some((Hook::WearFactor, law)));
    let base = worn(&set, [5e-10; 2], end * 1f64.sinh(), None);
    for side in 0..2 {
        let conditions = Conditions {
            torque: 1e5,
            speed: 2000.0,
            misalignment: 0.0,
            cycles: end,
            coefficient: [5e-10; 2],
        };
        let forward = Forward::new(&set, None, conditions, numerics()).unwrap();
        let stations = &forward.cycle().stations.arc[side];
        let ratio = worn_area(stations, &with.depth[side]) / worn_area(stations, &base.depth[side]);
        assert!((ratio - 1.0).abs() < 2e-4, "{ratio}");
    }
}

#[test]
fn a_constant_law_is_another_k_of_its_members() {
    let set = set();
    let factor = f64::exp(0.6);
    for (member, k) in [
        (None, [factor; 2]),
        (Some(Member::Pinion), [factor, 1.0]),
        (Some(Member::Gear), [1.0, factor]),
    ] {
        for driver in ["depth", "cycles"] {
            let law = law(driver, member, [0.0, 1e5], 3, |_| 0.6);
            let with = worn(&set, [5e-10; 2], 5e4, Some((Hook::WearFactor, law)));
            let base = worn(&set, k.map(|f| 5e-10 * f), 5e4, None);
            let deepest = base.depth.iter().flatten().fold(0.0f64, |m, d| m.max(*d));
            let off = largest_difference(&with, &base) / deepest;
            assert!(off < 1e-9, "{member:?} {driver}: {off:e}");
        }
    }
}

#[test]
fn a_law_in_code_is_the_law_in_the_file() {
    let knots = [0.0, 1e5, 4e5];
    let law = Learned::new(Hook::WearFactor, "cycles", Some(Member::Gear), &knots).unwrap();
    let learned = LearnedLaw::new(law, vec![0.5, -0.25, 0.0], 0.5, 1e5);
    let read = Study::parse(
        &format!("{BASE}\n[[effect]]\n{}\n", learned.lines().join("\n")),
        "study.toml",
    )
    .unwrap_or_else(|e| panic!("{e}"));
    let spec = learned.spec();
    assert_eq!(
        (&read.effects()[0].law, &read.effects()[0].parameters),
        (&spec.law, &spec.parameters)
    );
}
