//! Claim: teeth that differ wear each class for itself, in the sequence in which they meet.
//!
//! Sources: the model of one tooth (classes of teeth that stand alike); springs of tooth pairs in closed form; equilibrium of torque; the
//! whole hunting sequence of a small pair; rotation of the numbering. Tolerances: rounding, where the same numbers are computed another
//! way; stated where a mean mate stands for all.

#![expect(clippy::print_stderr, reason = "figures that the guide cites")]

use gearwear::effects::{Combined, Surroundings, find};
use gearwear::simulate::forward::{Conditions, Forward, GearSet};
use gearwear::simulate::history::{Progress, ToothState, WearState, line_load};
use gearwear::simulate::members::Members;
use gearwear::simulate::numerics::Numerics;
use gearwear::study::Study;
use gearwear::wear::acting::Acting;

mod common;
#[path = "teeth/program.rs"]
mod program;

const PAPER: &str = include_str!("../validation/paper/study.toml");

/// Coarse: what is asked here does not depend on resolution.
fn numerics() -> Numerics {
    Numerics {
        elements_per_half_width: 2.0,
        positions: 20,
        ..Numerics::default()
    }
}

/// The published pair, or one of so many teeth with shifted profiles, with a table of its teeth.
fn set(teeth: Option<[u32; 2]>, table: &str) -> GearSet {
    let mut text = format!("{PAPER}\n{table}");
    if let Some([pinion, gear]) = teeth {
        for (from, to) in [
            (
                "centre_distance = 80.0",
                "# the distance that the shifts ask for:",
            ),
            ("teeth = 27", &format!("teeth = {pinion}")),
            ("teeth = 53", &format!("teeth = {gear}")),
            ("profile_shift = 0.0", "profile_shift = 0.4"),
            ("bore_diameter = 25.0", "bore_diameter = 8.0"),
            ("bore_diameter = 40.0", "bore_diameter = 8.0"),
        ] {
            text = text.replace(from, to);
        }
    }
    Study::parse(&text, "study.toml").unwrap().gear_set()
}

/// 40 N m, 300 000 revolutions.
fn conditions() -> Conditions {
    Conditions {
        torque: 4e4,
        speed: 2000.0,
        misalignment: 0.0,
        cycles: 3e5,
        coefficient: [6e-10; 2],
    }
}

fn members(set: &GearSet) -> Members {
    set.members(&numerics(), &[4e4], &[0.0]).unwrap()
}

fn acting(name: &str, parameters: &[(&str, f64)]) -> Acting {
    let card = find(name).unwrap();
    let mut effects = Combined::default();
    effects.push(card.hook, (card.build)(&card.values(parameters).unwrap()));
    Acting {
        effects,
        surroundings: Surroundings::default(),
        torque: 40.0,
        speed: 2000.0,
        reversed: false,
        face_width: 33.0,
    }
}

fn worn(forward: &mut Forward<'_>) -> (WearState, Progress) {
    let (mut progress, mut last) = (None, None);
    let store = &mut |state| last = Some(state);
    forward
        .wear(&mut progress, &[3e5], &mut |_| true, store)
        .unwrap();
    (last.unwrap(), progress.unwrap())
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    let scale = b.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
    let off = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    off.fold(0.0, f64::max) / scale
}

/// Classes whose teeth stand in their places to 1e-14 µm are the model of one tooth: every second tooth (two classes), one tooth (it, two on either
/// side, the rest), and groups around a gear.
#[test]
fn classes_that_stand_alike_wear_as_one_tooth() {
    let set = set(None, "");
    let members = members(&set);
    for elastic in [true, false] {
        let members = elastic.then_some(&members);
        let plain = Forward::new(&set, members, conditions(), numerics());
        let (one, _) = worn(&mut plain.unwrap());
        for (name, parameters, classes) in [
            (
                "pitch_error",
                vec![("deviation", 1e-14), ("alternate", 1.0)],
                2 + 1,
            ),
            ("pitch_error", vec![("deviation", 1e-14)], 6 + 1),
            (
                "run_out",
                vec![("amplitude", 1e-14), ("on_gear", 1.0)],
                8 + 1,
            ),
        ] {
            let acting = acting(name, &parameters);
            let mut forward =
                Forward::with_effects(&set, members, conditions(), numerics(), Some(&acting))
                    .unwrap();
            let (state, _) = worn(&mut forward);
            assert_eq!(state.teeth.len(), classes, "{name} {parameters:?}");
            for class in &state.teeth {
                let off = largest_difference(&class.depth, &one.depth[class.side]);
                assert!(off < 1e-12, "{name} {parameters:?}: {off:e}");
            }
        }
    }
}

/// Unworn, the analytic model's pairs are springs of which the stiffness follows from its own shares without deviations: with every
/// second tooth of an even number standing proud by d, pairs 1 and 2 carry w_i = c_i (δ − g_i) with c_1 (δ − g_1) + c_2 (δ − g_2) = w.
#[test]
fn proud_teeth_carry_what_springs_say() {
    let set = set(Some([12, 13]), "");
    let mut plain = Forward::new(&set, None, conditions(), numerics()).unwrap();
    let even = plain
        .contacts_at(&vec![0.0; plain.cycle().stations.count()])
        .unwrap();
    let base = plain.cycle().pair.pinion.base_radius;
    for um in [-3.0, 2.0, 40.0] {
        let acting = acting("pitch_error", &[("deviation", um), ("alternate", 1.0)]);
        let mut forward =
            Forward::with_effects(&set, None, conditions(), numerics(), Some(&acting)).unwrap();
        let stations = forward.cycle().stations.count();
        let passages = forward.all_contacts_at(&vec![0.0; 2 * stations]).unwrap();
        let mut compared = 0;
        for (q, position) in forward.cycle().positions.iter().enumerate() {
            let loads: Vec<f64> = (position.pairs.iter())
                .map(|pair| line_load(pair, &even[q]))
                .collect();
            let touching: Vec<usize> = (0..loads.len()).filter(|i| loads[*i] > 0.0).collect();
            let [first, second] = touching[..] else {
                continue;
            };
            // pairs that are there for part of the position's time only share otherwise
            let total: f64 = loads.iter().sum();
            let rho = |i: usize| position.pairs[i].frame.rho[0];
            let step = forward.cycle().pair.base_pitch / 20.0;
            let gears = &forward.cycle().pair;
            if rho(first) < gears.rho_a + step || rho(second) > gears.rho_e - step {
                continue;
            }
            let approach = even[q].approach * base;
            let c = [loads[first], loads[second]].map(|load| load / approach);
            for (passage, contacts) in passages.iter().enumerate() {
                for own in 0..2 {
                    // the own tooth is odd in the first passage, its neighbour in the second
                    let is_odd = |i: usize| (i == own) == (passage == 0);
                    let gap = [0, 1].map(|i| if is_odd(i) { 1e-3 * um } else { 0.0 });
                    let closed = (total + c[0] * gap[0] + c[1] * gap[1]) / (c[0] + c[1]);
                    let mut springs = [0, 1].map(|i| c[i] * (closed - gap[i]));
                    if springs[0] < 0.0 {
                        springs = [0.0, total];
                    } else if springs[1] < 0.0 {
                        springs = [total, 0.0];
                    }
                    let index = [first, second][own];
                    let found = line_load(&position.pairs[index], &contacts[q]);
                    let off = (found - springs[own]).abs() / total;
                    assert!(off < 1e-9, "{um} µm, position {q}: {found} {springs:?}");
                    compared += 1;
                }
            }
        }
        assert!(compared > 10);
    }
}

/// Each contact balances the torque, so the passages' own pairs do in the mean over all teeth: exactly where the classes hold every
/// neighbourhood there is, to what wear makes of the teeth counted to the rest where they do not.
#[test]
fn the_mean_torque_over_all_teeth_is_the_pinions() {
    for (teeth, parameters, tolerance) in [
        (
            Some([12, 13]),
            vec![("deviation", -5.0), ("alternate", 1.0)],
            1e-9,
        ),
        (None, vec![("deviation", -5.0)], 1e-4),
    ] {
        let set = set(teeth, "");
        let members = members(&set);
        let acting = acting("pitch_error", &parameters);
        let mut forward = Forward::with_effects(
            &set,
            Some(&members),
            conditions(),
            numerics(),
            Some(&acting),
        )
        .unwrap();
        let (state, progress) = worn(&mut forward);
        let contacts = forward.contacts_at(&progress.stand.u).unwrap();
        for (q, position) in forward.cycle().positions.iter().enumerate() {
            let carried: f64 = (0..position.pairs.len())
                .map(|index| forward.moment(q, index, &contacts[q]))
                .sum();
            let off = (carried / forward.torque() - 1.0).abs();
            assert!(off < tolerance, "{parameters:?}, position {q}: {off:e}");
        }
        let (law, geometry) = (progress.balance.law, progress.balance.geometry);
        for side in 0..2 {
            let off = (law[side] / geometry[side] - 1.0).abs();
            assert!(off < 5e-3, "{parameters:?}: areas {off:e}");
        }
        // the proud tooth wears deeper than those beside it
        let deepest = |class: usize| {
            state.teeth[class]
                .depth
                .iter()
                .fold(0.0, |m: f64, h| m.max(*h))
        };
        assert!(
            deepest(0) > 1.02 * deepest(1),
            "{} {}",
            deepest(0),
            deepest(1)
        );
    }
}

/// The mean mate against every meeting of a pair whose teeth all meet (12 and 13, 156 meetings), both members out of place: a tooth is
/// off by no more than a fifth of what teeth differ by, the mean teeth by no more than a twentieth, and less than in proportion where
/// deviations are small.
#[test]
fn a_mean_mate_stands_for_all_mates() {
    let off = |scale: f64| {
        let back = [0, 3, -2, 1, 0, -3, 2, 0, 1, -1, 4, 0].map(|um| scale * f64::from(um));
        let wave = |i: usize| 6.0 * scale * (std::f64::consts::TAU * i as f64 / 13.0).cos();
        let wave: Vec<f64> = (0..13).map(wave).collect();
        let run = |hunting: &str| {
            let table = format!(
                "[teeth]\nhunting = \"{hunting}\"\n\
                 [teeth.pinion]\npitch_deviations = {back:?}\nclasses = 12\n\
                 [teeth.gear]\npitch_deviations = {wave:?}\nclasses = 13\n"
            );
            let set = set(Some([12, 13]), &table);
            let mut forward = Forward::new(&set, None, conditions(), numerics()).unwrap();
            worn(&mut forward).0
        };
        let (full, average) = (run("full"), run("average"));
        assert_eq!((full.teeth.len(), average.teeth.len()), (25, 25));
        let (mut worst, mut spread): (f64, f64) = (0.0, 0.0);
        for (a, b) in average.teeth.iter().zip(&full.teeth) {
            assert_eq!((a.side, &a.teeth), (b.side, &b.teeth));
            worst = worst.max(largest_difference(&a.depth, &b.depth));
            spread = spread.max(largest_difference(&b.depth, &full.depth[b.side]));
        }
        let mean = [0, 1].map(|side| largest_difference(&average.depth[side], &full.depth[side]));
        let mean = mean[0].max(mean[1]);
        eprintln!(
            "deviations times {scale}: a tooth is off by {worst:.2e}, the mean teeth by {mean:.2e}, teeth differ by {spread:.2e}"
        );
        assert!(worst < 0.2 * spread && mean < 0.05 * spread);
        worst
    };
    let (large, small) = (off(1.0), off(0.1));
    assert!(large < 0.05 && small < 0.1 * large, "{large} {small}");
}

/// Where the teeth of one member are all alike, and every tooth meets every other, its mean is each of its teeth: nothing is left out.
#[test]
fn a_mate_whose_teeth_are_alike_is_its_mean() {
    let run = |hunting: &str| {
        let table = format!(
            "[teeth]\nhunting = \"{hunting}\"\n[teeth.pinion]\npitch_pattern = [0, 3, -2, 5]\nclasses = 12\n"
        );
        let set = set(Some([12, 13]), &table);
        let mut forward = Forward::new(&set, None, conditions(), numerics()).unwrap();
        worn(&mut forward).0
    };
    let (full, average) = (run("full"), run("average"));
    // one of each place in the pattern and the gear's teeth, against all teeth
    assert_eq!((full.teeth.len(), average.teeth.len()), (25, 5));
    for class in &full.teeth {
        let same = |c: &&ToothState| c.side == class.side && c.teeth.contains(&class.teeth[0]);
        let alike = average.teeth.iter().find(same).unwrap();
        let off = largest_difference(&class.depth, &alike.depth);
        assert!(off < 1e-6, "{:?}: {off:e}", class.teeth);
    }
}

/// Which tooth is called the first says nothing: with the chart moved on by some teeth each wears as it did before.
#[test]
fn the_numbering_of_teeth_is_free() {
    let chart = [0, 3, -2, 1, 0, -3, 2, 0, 1, -1, 4, 0];
    let run = |moved: usize| {
        let mut chart = chart;
        chart.rotate_right(moved);
        let table = format!("[teeth.pinion]\npitch_deviations = {chart:?}\nclasses = 12\n");
        let set = set(Some([12, 13]), &table);
        let mut forward = Forward::new(&set, None, conditions(), numerics()).unwrap();
        worn(&mut forward).0
    };
    let (first, second) = (run(0), run(5));
    for tooth in 0..12 {
        let of = |state: &WearState, tooth: usize| {
            let mut pinion = state.teeth.iter().filter(|c| c.side == 0);
            pinion
                .find(|c| c.teeth.contains(&tooth))
                .unwrap()
                .depth
                .clone()
        };
        let off = largest_difference(&of(&second, (tooth + 5) % 12), &of(&first, tooth));
        assert!(off < 1e-9, "tooth {tooth}: {off:e}");
    }
}

/// Teeth that stand back by a wave over the gear, e cos(2π i/z + φ): once per turn the lag swings by e over the pinion's base radius, to
/// what the mean over the pairs in contact takes off a wave of so many teeth, about (π ε/z)²/6.
#[test]
fn a_wave_of_pitch_deviations_swings_the_transmission_error() {
    let wave = |i: u32| 5.0 * (std::f64::consts::TAU * f64::from(i) / 53.0 + 0.7).cos();
    let wave: Vec<f64> = (0..53).map(wave).collect();
    let set = set(
        None,
        &format!("[teeth.gear]\npitch_deviations = {wave:?}\n"),
    );
    let members = members(&set);
    for members in [None, Some(&members)] {
        let mut forward = Forward::new(&set, members, conditions(), numerics()).unwrap();
        let mut states = Vec::new();
        let store = &mut |state| states.push(state);
        forward
            .wear(&mut None, &[0.0], &mut |_| true, store)
            .unwrap();
        let turn = &states[0].turn;
        assert_eq!(turn.len(), 53 * 20);
        let (mut cosine, mut sine) = (0.0, 0.0);
        for [rotation, approach] in turn {
            let angle = std::f64::consts::TAU * rotation / 53.0;
            cosine += 2.0 * approach * angle.cos() / turn.len() as f64;
            sine -= 2.0 * approach * angle.sin() / turn.len() as f64;
        }
        let expected = 5e-3 / forward.cycle().pair.pinion.base_radius;
        let amplitude = cosine.hypot(sine);
        let off = amplitude / expected - 1.0;
        let phase = sine.atan2(cosine);
        eprintln!("amplitude off by {off:.1e}, phase {phase:.4} for 0.7");
        assert!(off.abs() < 5e-3 && (phase - 0.7).abs() < 0.05);
    }
}

/// Where the numbers of teeth have a common factor the mates of a tooth are few: every second pinion tooth of 12 meets every second gear
/// tooth of 14 alone, and these wear apart; of 13 all gear teeth wear alike.
#[test]
fn teeth_with_a_common_factor_do_not_hunt() {
    for (gear, classes) in [(14, [2, 2]), (13, [2, 1])] {
        let set = set(Some([12, gear]), "");
        let acting = acting("pitch_error", &[("deviation", -4.0), ("alternate", 1.0)]);
        let mut forward =
            Forward::with_effects(&set, None, conditions(), numerics(), Some(&acting)).unwrap();
        assert_eq!(forward.sequence().map(|s| s.classes()), Some(classes));
        let (state, _) = worn(&mut forward);
        if gear == 14 {
            let area = |class: usize| state.teeth[class].depth.iter().sum::<f64>();
            // the mate of the proud teeth loses more, as they do
            assert!(area(0) > area(1) && area(2) > area(3));
        }
    }
}
