//! Claim: teeth that differ wear each class for itself, in the sequence in which they meet.
//!
//! Sources: the model of one tooth (classes of teeth that stand alike); springs of tooth pairs in closed form; equilibrium of torque; the
//! whole hunting sequence of a small pair; rotation of the numbering. Tolerances: rounding, where the same numbers are computed another
//! way; stated where a mean mate stands for all.

#![expect(clippy::print_stderr, reason = "figures that the guide cites")]

use gearwear::effects::{Combined, Surroundings, find};
use gearwear::simulate::forward::{Conditions, Forward, GearSet};
use gearwear::simulate::history::{Progress, WearState, line_load};
use gearwear::simulate::members::Members;
use gearwear::simulate::numerics::Numerics;
use gearwear::study::Study;
use gearwear::wear::acting::Acting;

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

/// Classes whose teeth stand in their places are the model of one tooth: every second tooth (two classes), one tooth (it, two on either
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
                vec![("deviation", 0.0), ("alternate", 1.0)],
                2 + 1,
            ),
            ("pitch_error", vec![("deviation", 0.0)], 6 + 1),
            ("run_out", vec![("amplitude", 0.0), ("on_gear", 1.0)], 8 + 1),
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

/// The mean mate against every meeting of a pair whose teeth all meet (12 and 13, 156 meetings), both members out of place: each tooth's
/// largest depth within 1 % of it, the mean teeth's within 0.2 %.
#[test]
fn a_mean_mate_stands_for_all_mates() {
    let chart = "[teeth.pinion]\npitch_deviations = [0, 3, -2, 1, 0, -3, 2, 0, 1, -1, 4, 0]\nclasses = 12\n\
                 [teeth.gear]\neccentricity = 6.0\nclasses = 13\n";
    let run = |hunting: &str| {
        let set = set(
            Some([12, 13]),
            &format!("[teeth]\nhunting = \"{hunting}\"\n{chart}"),
        );
        let mut forward = Forward::new(&set, None, conditions(), numerics()).unwrap();
        worn(&mut forward).0
    };
    let (full, average) = (run("full"), run("average"));
    assert_eq!((full.teeth.len(), average.teeth.len()), (25, 25));
    let mut worst: f64 = 0.0;
    for (a, b) in average.teeth.iter().zip(&full.teeth) {
        assert_eq!((a.side, &a.teeth), (b.side, &b.teeth));
        worst = worst.max(largest_difference(&a.depth, &b.depth));
    }
    let mean = [0, 1].map(|side| largest_difference(&average.depth[side], &full.depth[side]));
    eprintln!("mean mate against all mates: a tooth {worst:.2e}, the mean teeth {mean:.2e?}");
    assert!(worst < 1e-2, "{worst}");
    assert!(mean[0] < 2e-3 && mean[1] < 2e-3, "{mean:?}");
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

/// A chart that is wrong is one error with its place.
#[test]
fn charts_that_are_wrong_are_refused() {
    let parse = |table: &str| {
        let text = format!("{PAPER}\n{table}");
        Study::parse(&text, "study.toml").unwrap_err().to_string()
    };
    let slices = "[face]\nslices = 5\n[teeth.pinion]\neccentricity = 5\n";
    let paper = parse("[teeth.pinion]\npitch_deviations = [1, 2, 3]\n");
    for part in [
        "pitch_deviations",
        "3 deviations for 27 teeth",
        "study.toml:",
    ] {
        assert!(paper.contains(part), "{part}: {paper}");
    }
    for (table, part) in [
        ("[teeth.gear]\neccentricity = -3\n", "eccentricity"),
        (
            "[teeth.gear]\neccentricity_phase = 30\n",
            "eccentricity is missing",
        ),
        ("[teeth]\nhunting = \"full\"\n", "1431 different meetings"),
        ("[teeth.pinion]\nclasses = 0\n", "classes"),
        (slices, "one section"),
        (
            "[teeth.pinion]\npitch_file = \"nowhere.csv\"\n",
            "nowhere.csv",
        ),
    ] {
        let error = parse(table);
        assert!(error.contains(part), "{part}: {error}");
    }
}
