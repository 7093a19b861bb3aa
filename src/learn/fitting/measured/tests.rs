//! Everything that is measured, differentiated: against central differences of histories along the same steps.

use std::path::Path;

use super::Measured;
use crate::effects::{CATALOGUE, Combined, Hook, find};
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::gear_model::GearModel;
use crate::learn::prediction::observe::Reading;
use crate::learn::prediction::predictor::{Move, Predictor};
use crate::measure::Dataset;
use crate::simulate::forward::ContactKind;
use crate::study::{EffectModel, EffectSpec, Study};

const ROWS: &str = "test,member,cycles,quantity,position,value,sigma\n\
    A,pinion,2e5,wear_depth,25.9,1,1\n\
    A,pinion,4e5,wear_depth,27.3,1,1\n\
    A,gear,4e5,wear_depth,52.4,1,1\n\
    A,pinion,4e5,mass_loss,,1,1\n\
    A,gear,4e5,mass_loss,,1,1\n\
    A,pair,4e5,transmission_error,0.1,1,1\n\
    A,pair,4e5,transmission_error,0.6,1,1\n\
    A,pinion,4e5,load_share,25.9,1,1\n\
    A,pinion,4e5,load_share,27.9,1,1\n\
    A,pinion,4e5,contact_pressure,27.0,1,1\n\
    A,pair,4e5,mesh_stiffness,0.3,1,1\n\
    A,pair,4e5,mean_lag,,1,1\n\
    A,pinion,4e5,span_loss,4,1,1\n\
    A,gear,4e5,chordal_loss,53.1,1,1\n";

fn study() -> Study {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("validation/challenges/running_in_L1/study.toml");
    let text = std::fs::read_to_string(file).unwrap();
    let coarse = "[numerics]\nelements_per_half_width = 3\npositions = 40\n";
    Study::parse(&format!("{text}\n{coarse}"), "study.toml").unwrap()
}

/// Measured are 1 µm. The first history is followed however deep it goes, later ones not beyond four times that depth; what was given up is not begun
/// again, and less of it is.
#[test]
fn wear_far_deeper_than_measured_is_given_up_after_the_first_history() {
    let study = study();
    let rows =
        "test,member,cycles,quantity,position,value,sigma\nA,pinion,4e5,wear_depth,27.3,1,1\n";
    let data = Dataset::parse(rows, "m.csv", &study.known()).unwrap();
    let measured = Measured::new(&study, data);
    let workshop = measured.workshop(ContactKind::Hertz).unwrap();
    let bench = measured.bench(&workshop).unwrap();
    let model = || GearModel::new(&bench, Box::new(|_| Combined::default()));
    let (k, wild) = (study.wear.coefficient, 30.0 * study.wear.coefficient);
    let free = model();
    let [usual, deep] = [k, wild].map(|k| free.predict(0, k, &[]).unwrap());
    let bounded = model().giving_up();
    assert_eq!(bounded.predict(0, k, &[]).unwrap(), usual);
    let error = bounded.predict(0, wild, &[]).unwrap_err();
    assert!(error.reason.contains("deeper than"), "{error}");
    assert_eq!(bounded.predict(0, wild, &[]).unwrap_err(), error);
    assert_eq!(
        bounded.predict(0, 2.0 * k, &[]).unwrap(),
        free.predict(0, 2.0 * k, &[]).unwrap()
    );
    let begins_wild = model().giving_up();
    assert_eq!(begins_wild.predict(0, wild, &[]).unwrap(), deep);
}

/// How far apart the compared histories lie, relative: the first is too far for a history that is bent or has a kink there, the second too near
/// for steep laws. A wrong derivative misses both.
const APART: [f64; 2] = [3e-7, 1e-8];
/// Rounding of a value, relative.
const ROUNDING: f64 = 1e-13;

/// Tolerance: 1e-4 of each kind's largest derivative. What moves the axes is differentiated by differences itself, and not looked at.
fn check(kind: ContactKind, names: &[&str]) {
    let study = study();
    let data = Dataset::parse(ROWS, "m.csv", &study.known()).unwrap();
    let measured = Measured::new(&study, data);
    let workshop = measured.workshop(kind).unwrap();
    let bench = measured.bench(&workshop).unwrap();
    let k = 3.0 * study.wear.coefficient;
    let mut missed = Vec::new();
    for name in names {
        let card = find(name).unwrap();
        let effects = EffectModel::new(vec![EffectSpec::of_card(card, &[]).unwrap()]);
        let fitted: Vec<_> = (effects.parameters())
            .filter(|p| p.card.is_some_and(|card| card.fitted))
            .collect();
        let known: Vec<String> = fitted.iter().map(|p| p.name.clone()).collect();
        let values: Vec<f64> = fitted.iter().map(|p| p.value).collect();
        let build = |values: &[f64]| {
            effects.build(&|name| {
                let place = known.iter().position(|known| known == name)?;
                values.get(place).copied()
            })
        };
        let model = GearModel::new(&bench, Box::new(build)).stretching(effects.stretches_time());
        let moved = |place: usize, by: f64| {
            let mut values = values.clone();
            values[place] += by;
            values
        };
        let size = |place: usize| values[place].abs().max(1e-3);
        let moves: Vec<Move> = (0..values.len())
            .map(|place| Move {
                parameters: moved(place, 1e-7 * size(place)),
                step: 1e-7 * size(place),
            })
            .collect();
        let found = model.linearise(0, k, &values, &moves);
        let found = found.unwrap_or_else(|| panic!("{name}: no trend")).unwrap();
        assert_eq!(found.values, model.predict(0, k, &values).unwrap());
        let first = if card.hook == Hook::Operation {
            values.len()
        } else {
            0
        };
        for column in first..=values.len() {
            // apart by how much, and both ends
            let differences = APART.map(|apart| {
                let at = |sign: f64| {
                    let (to, moved) = if column == values.len() {
                        (k * (sign * apart).exp(), values.clone())
                    } else {
                        (k, moved(column, sign * apart * size(column)))
                    };
                    model.predict_along(0, (k, &values), (to, &moved)).unwrap()
                };
                let unit = if column == values.len() {
                    1.0
                } else {
                    size(column)
                };
                (2.0 * apart * unit, at(-1.0), at(1.0))
            });
            // depths, masses, transmission errors, shares, the others
            for kind in [
                0..3,
                3..5,
                5..7,
                7..9,
                9..10,
                10..11,
                11..12,
                12..13,
                13..14,
            ] {
                for row in kind.clone() {
                    let exact = found.derivatives[(row, column)];
                    let agrees = differences.iter().any(|(apart, low, high)| {
                        let slope = |row: usize| (high[row] - low[row]) / apart;
                        let largest = kind.clone().map(|row| slope(row).abs()).fold(0.0, f64::max);
                        let rounding = ROUNDING * found.values[row].abs() / apart;
                        (exact - slope(row)).abs() <= 1e-4 * largest + rounding
                    });
                    if !agrees {
                        missed.push(format!(
                            "{name} {column} row {row}: {exact} against {:?}",
                            differences
                                .each_ref()
                                .map(|(apart, low, high)| (high[row] - low[row]) / apart),
                        ));
                    }
                }
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// One law of every kind: with a clock and without, local and of the pair's load, added, displaced, of load, flexibility, profile, pitch, axes.
const KINDS: [&str; 11] = [
    "running_in",
    "pressure_exponent",
    "film_thickness",
    "debris_abrasion",
    "plastic_deformation",
    "dynamic_load",
    "friction_load",
    "extra_flexibility",
    "tip_relief",
    "pitch_error",
    "bearing_compliance",
];

#[test]
fn what_is_measured_is_differentiated_by_finite_elements() {
    check(ContactKind::Fem, &KINDS);
}

#[test]
fn what_is_measured_is_differentiated_by_the_analytic_model() {
    let all: Vec<&str> = CATALOGUE.iter().map(|card| card.name).collect();
    check(ContactKind::Hertz, &all);
}

/// However many distances of the axes were looked at before, by whichever model: each is worn at its own, to the last bit.
#[test]
fn kept_mountings_are_those_of_the_own_distance() {
    let study = study();
    let data = Dataset::parse(ROWS, "m.csv", &study.known()).unwrap();
    let measured = Measured::new(&study, data);
    let card = find("radial_misalignment").unwrap();
    let moved = EffectModel::new(vec![EffectSpec::of_card(card, &[]).unwrap()]);
    let at = |bench: &Bench<'_>, amount: f64| {
        let model = GearModel::of_effects(bench, &moved, vec!["radial_misalignment.amount"]);
        model.predict(0, study.wear.coefficient, &[amount]).unwrap()
    };
    let workshop = measured.workshop(ContactKind::Hertz).unwrap();
    let fresh = |amount: f64| at(&measured.bench(&workshop).unwrap(), amount);
    let amounts: Vec<f64> = (1..=10).map(|i| 0.004 * f64::from(i)).collect();
    let own: Vec<Vec<f64>> = amounts.iter().map(|amount| fresh(*amount)).collect();
    assert!(own.windows(2).all(|two| two[0] != two[1]));
    let bench = measured.bench(&workshop).unwrap();
    for _ in 0..2 {
        for (amount, own) in amounts.iter().zip(&own).rev() {
            assert_eq!(at(&bench, *amount), *own, "{amount}");
        }
    }
}

/// Of a member whose axis lies off, what is measured on its flank and what its gauges feel are those of the pair at the shifted distance of the axes, all
/// else that of the base model to the last bit. Derivatives: those of either, and against central differences, of which the wear steps' roughness
/// leaves 1e-3 of the largest.
#[test]
fn an_axis_that_lies_off_moves_the_measured_tooth_alone() {
    const SHIFT: f64 = 30.0;
    let study = study();
    let data = Dataset::parse(ROWS, "m.csv", &study.known()).unwrap();
    let measured = Measured::new(&study, data);
    let k = 3.0 * study.wear.coefficient;
    let effects = |name: &str, stated: &[(&str, f64)]| {
        EffectModel::new(vec![
            EffectSpec::of_card(find(name).unwrap(), stated).unwrap(),
        ])
    };
    for kind in [ContactKind::Hertz, ContactKind::Fem] {
        let workshop = measured.workshop(kind).unwrap();
        let bench = measured.bench(&workshop).unwrap();
        let moved = effects("radial_misalignment", &[]);
        let base = EffectModel::new(Vec::new());
        let by_mm = 1e-3;
        let at = |effects: &EffectModel, name: &str, value: f64| {
            let model = GearModel::of_effects(&bench, effects, vec![name]);
            let step = 1e-7 * value;
            let moves = [Move {
                parameters: vec![value + step],
                step,
            }];
            let linear = model.linearise(0, k, &[value], &moves).unwrap().unwrap();
            assert_eq!(linear.values, model.predict(0, k, &[value]).unwrap());
            linear
        };
        let moved = at(&moved, "radial_misalignment.amount", by_mm * SHIFT);
        let base = {
            let model = GearModel::of_effects(&bench, &base, Vec::<&str>::new());
            model.linearise(0, k, &[], &[]).unwrap().unwrap()
        };
        // depths, pressure, span and chord by their member
        for (on_gear, own) in [(0.0, vec![0, 1, 9, 12]), (1.0, vec![2, 13])] {
            let stated = [("amplitude", 0.0), ("on_gear", on_gear)];
            let eccentric = effects("run_out", &stated);
            let found = at(&eccentric, "run_out.axis_shift", SHIFT);
            let model = GearModel::of_effects(&bench, &eccentric, vec!["run_out.axis_shift"]);
            let apart = 2.0;
            let [low, high] = [-1.0, 1.0].map(|sign| {
                let to = [SHIFT + sign * apart];
                model.predict_along(0, (k, &[SHIFT]), (k, &to)).unwrap()
            });
            for row in 0..found.values.len() {
                let (slope, by_k) = (found.derivatives[(row, 0)], found.derivatives[(row, 1)]);
                let difference = (high[row] - low[row]) / (2.0 * apart);
                if own.contains(&row) {
                    assert_eq!(found.values[row], moved.values[row], "{kind:?} {row}");
                    let expected = by_mm * moved.derivatives[(row, 0)];
                    assert!((slope / expected - 1.0).abs() < 1e-6, "{slope} {expected}");
                    assert_eq!(by_k, moved.derivatives[(row, 1)], "{kind:?} {row}");
                    assert_ne!(slope, 0.0, "{kind:?} {row}");
                    let off = (slope - difference).abs() / difference.abs();
                    assert!(off < 1e-3, "{kind:?} {row}: {slope} against {difference}");
                } else {
                    assert_eq!(found.values[row], base.values[row], "{kind:?} {row}");
                    assert_eq!(by_k, base.derivatives[(row, 0)], "{kind:?} {row}");
                    assert_eq!((slope, difference), (0.0, 0.0), "{kind:?} {row}");
                }
            }
            // without a shift the tooth is still told from the others
            let none = model.linearise(
                0,
                k,
                &[0.0],
                &[Move {
                    parameters: vec![1e-5],
                    step: 1e-5,
                }],
            );
            let none = none.unwrap().unwrap();
            assert!(own.iter().all(|row| none.derivatives[(*row, 0)] != 0.0));
        }
    }
}

/// Flanks that have lost h everywhere, normal to themselves, meet as before when the pinion has turned by h/r_b1: the path of contact is the common
/// tangent of the base circles. Tolerance: edges, where a turned flank ends elsewhere.
#[test]
fn an_even_loss_is_a_lag_of_its_depth_over_the_base_radius() {
    let study = study();
    let data = Dataset::parse(ROWS, "m.csv", &study.known()).unwrap();
    let row = data.observations[11].clone();
    let measured = Measured::new(&study, data);
    for kind in [ContactKind::Fem, ContactKind::Hertz] {
        let workshop = measured.workshop(kind).unwrap();
        let bench = measured.bench(&workshop).unwrap();
        let mut forward = bench.forward(0, study.wear.coefficient, None).unwrap();
        let [pinion, gear] = forward.cycle().stations.arc.each_ref().map(Vec::len);
        let mut u = vec![1e-3; pinion];
        u.extend(vec![2e-3; gear]);
        let worn = crate::learn::prediction::trajectory::Node {
            u,
            ..Default::default()
        };
        let base = forward.cycle().pair.pinion.base_radius;
        let lag = Reading::new(&mut forward, &worn, bench.set(), &[])
            .of(&row)
            .unwrap();
        let expected = 1e6 * 3e-3 / base;
        assert!(
            (lag / expected - 1.0).abs() < 2e-3,
            "{kind:?}: {lag}, {expected}"
        );
    }
}

/// An even loss h takes h from the span, and turns the flank by h/r_b: what that takes from the chord.
#[test]
fn an_even_loss_is_felt_by_span_and_chord() {
    let study = study();
    let data = Dataset::parse(ROWS, "m.csv", &study.known()).unwrap();
    let rows = [data.observations[12].clone(), data.observations[13].clone()];
    let measured = Measured::new(&study, data);
    for kind in [ContactKind::Fem, ContactKind::Hertz] {
        let workshop = measured.workshop(kind).unwrap();
        let bench = measured.bench(&workshop).unwrap();
        let mut forward = bench.forward(0, study.wear.coefficient, None).unwrap();
        let stations = &forward.cycle().stations.arc;
        let (pinion, gear) = (5e-3, 8e-3);
        let mut u = vec![pinion; stations[0].len()];
        u.extend(vec![gear; stations[1].len()]);
        let worn = crate::learn::prediction::trajectory::Node {
            u,
            ..Default::default()
        };
        let set = bench.set();
        let r = rows[1].position.unwrap();
        let half = set.gears[1].half_angle(r);
        let turned = 0.5 * gear / set.gears[1].base_radius;
        let expected = [pinion, 2.0 * r * (half.sin() - (half - turned).sin())];
        let mut reading = Reading::new(&mut forward, &worn, set, &[]);
        for (row, expected) in rows.iter().zip(expected) {
            let found = 1e-3 * reading.of(row).unwrap();
            assert!(
                (found - expected).abs() < 1e-9,
                "{kind:?}: {found}, {expected}"
            );
        }
    }
}

/// Tests at temperatures of their own are computed as with the modulus and the k of each: 40 °C is half way in both tables, of the modulus and of ln k.
#[test]
fn each_test_has_the_modulus_and_k_of_its_temperature() {
    const PLASTIC: &str = include_str!("../../../cli/examples/plastic-steel.toml");
    const LATER: &str = "gear,5e5,mass_loss,,1,1\n";
    let plain = PLASTIC
        .replace(
            "# elements_per_half_width = 8",
            "elements_per_half_width = 2",
        )
        .replace("positions = 100", "positions = 24");
    let (head, tests) = plain.split_once("[[test]]").unwrap();
    let rest = &tests[tests.find("[measurements]").unwrap()..];
    let study_of = |head: &str, tests: &str| {
        Study::parse(&format!("{head}{tests}{rest}"), "study.toml").unwrap()
    };
    let predicted = |study: &Study, kind, test: usize, k: f64| {
        let ids: Vec<&str> = study.tests.iter().map(|test| test.id.as_str()).collect();
        let rows: String = ids
            .iter()
            .map(|id| format!("{id},{LATER}{id},pair,5e5,mean_lag,,1,1\n"))
            .collect();
        let head = ROWS.lines().next().unwrap();
        let data = Dataset::parse(&format!("{head}\n{rows}"), "m.csv", &study.known()).unwrap();
        let measured = Measured::new(study, data);
        let workshop = measured.workshop(kind).unwrap();
        let bench = measured.bench(&workshop).unwrap();
        GearModel::new(&bench, Box::new(|_| Combined::default()))
            .predict(test, k, &[])
            .unwrap()
    };
    let warm = head
        .replacen(
            "youngs_modulus = 2800.0",
            "temperatures = [20, 60]\nmoduli = [2800, 1800]\nyoungs_modulus = 2800.0",
            1,
        )
        .replacen(
            "coefficient = 2e-9 ",
            "temperatures = [20, 60]\nfactors = [1, 4]\ncoefficient = 2e-9 ",
            1,
        );
    let both = study_of(
        &warm,
        "[[test]]\nid = \"A\"\n[[test]]\nid = \"B\"\nbulk_temperature = 60\n",
    );
    for kind in [ContactKind::Hertz, ContactKind::Fem] {
        for (test, modulus, factor) in [(0, "2300.0", 2.0), (1, "1800.0", 4.0)] {
            let alone = head.replacen(
                "youngs_modulus = 2800.0",
                &format!("youngs_modulus = {modulus}"),
                1,
            );
            let alone = study_of(&alone, "[[test]]\nid = \"A\"\n");
            let expected = predicted(&alone, kind, 0, factor * 2e-9);
            let found = predicted(&both, kind, test, 2e-9);
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    (found / expected - 1.0).abs() < 1e-8,
                    "{kind:?} {test}: {found}, {expected}"
                );
            }
        }
    }
}
