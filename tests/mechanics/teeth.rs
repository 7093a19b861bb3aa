//! Claim: teeth that differ wear each class for itself, in the sequence in which they meet.
//!
//! Sources: the model of one tooth (classes of teeth that stand alike); springs of tooth pairs in closed form; equilibrium of torque; the
//! whole hunting sequence of a small pair; rotation of the numbering. Tolerances: rounding, where the same numbers are computed another
//! way; stated where a mean mate stands for all.

#![expect(clippy::print_stderr, reason = "figures that the guide cites")]

use gearwear::effects::{Combined, Surroundings, find};
use gearwear::simulate::forward::{Conditions, Forward, GearSet};
use gearwear::simulate::history::Progress;
use gearwear::simulate::members::Members;
use gearwear::simulate::numerics::Numerics;
use gearwear::simulate::wear_state::{ToothState, WearState, worn_area};
use gearwear::study::Study;
use gearwear::verify::contact_and_wear::Effort;
use gearwear::verify::teeth_in_turn;
use gearwear::wear::acting::Acting;

mod program;

const PAPER: &str = include_str!("../../validation/paper/study.toml");

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

/// Classes that stand alike against one tooth, loads of proud teeth against springs, a mean mate against all mates.
#[test]
fn the_validation_family_of_teeth_passes() {
    let figures = teeth_in_turn::all(Effort::Quick).unwrap();
    assert_eq!(figures.len(), 14);
    for figure in &figures {
        eprintln!("{figure}");
        assert!(figure.passed(), "{figure}");
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

/// Where the teeth of one member are all alike its mean, over those that a tooth meets, is each of them: nothing is left out, with a common factor or
/// without one, whichever member has the chart.
#[test]
fn a_mate_whose_teeth_are_alike_is_its_mean() {
    let pattern = "pitch_pattern = [0, 3, -2, 5]";
    let chart = "pitch_deviations = [0, 3, -2, 5, 1, -3, 4, 0, 2, -4, 0, 1]";
    // of 12 and 13 one of each place in the pattern and the gear's teeth; of 12 and 15 each tooth and the three remainders
    for (teeth, member, stated, classes) in [
        ([12, 13], "pinion", pattern, [25, 5]),
        ([12, 15], "pinion", chart, [27, 15]),
        ([15, 12], "gear", chart, [27, 15]),
    ] {
        let run = |hunting: &str| {
            let table = format!(
                "[teeth]\nhunting = \"{hunting}\"\n[teeth.{member}]\n{stated}\nclasses = 12\n"
            );
            let set = set(Some(teeth), &table);
            let mut forward = Forward::new(&set, None, conditions(), numerics()).unwrap();
            worn(&mut forward).0
        };
        let (full, average) = (run("full"), run("average"));
        assert_eq!([full.teeth.len(), average.teeth.len()], classes);
        for class in &full.teeth {
            let same = |c: &&ToothState| c.side == class.side && c.teeth.contains(&class.teeth[0]);
            let alike = average.teeth.iter().find(same).unwrap();
            let off = largest_difference(&class.depth, &alike.depth);
            assert!(off < 1e-6, "{teeth:?} {:?}: {off:e}", class.teeth);
        }
    }
}

/// What one member loses the other one does, with k and profiles alike, also where the mates' chart and an effect's wave tell teeth apart together.
#[test]
fn both_members_lose_the_same_where_a_chart_meets_a_wave() {
    for on_gear in [0.0, 1.0] {
        let set = set(Some([12, 18]), "[teeth.pinion]\npitch_pattern = [-5, 0]\n");
        let acting = acting("run_out", &[("amplitude", 5.0), ("on_gear", on_gear)]);
        let mut forward =
            Forward::with_effects(&set, None, conditions(), numerics(), Some(&acting)).unwrap();
        let stations = forward.cycle().stations.arc.clone();
        let (state, _) = worn(&mut forward);
        let lost = [0, 1].map(|m| [12.0, 18.0][m] * worn_area(&stations[m], &state.depth[m]));
        assert!(
            (lost[1] / lost[0] - 1.0).abs() < 0.02,
            "{on_gear}: {lost:?}"
        );
    }
}

/// With a chart effects across the face act as in the analytic model, on one section.
#[test]
fn a_chart_leaves_one_section_to_effects_across_the_face() {
    let set = set(None, "[teeth.pinion]\npitch_pattern = [-5, 0]\n");
    let acting = acting("lead_misalignment", &[("slope", 10.0)]);
    let mut forward =
        Forward::with_effects(&set, None, conditions(), numerics(), Some(&acting)).unwrap();
    let (state, _) = worn(&mut forward);
    assert!(state.slices.is_empty() && state.teeth.len() > 2);
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

/// Teeth along a wave: three whose wear is computed against a chart with every tooth for itself, by the analytic model, worn by 30 µm; also where a tooth
/// meets the same mates for ever, so that the wave comes to the mate's teeth too.
#[test]
fn three_teeth_stand_for_all_along_a_wave() {
    for (teeth, shown) in [(None, [0, 9, 20]), (Some([12, 24]), [0, 5, 9])] {
        let count = teeth.map_or(27, |[pinion, _]| pinion);
        let back =
            |i: u32| 20.0 * (std::f64::consts::TAU * f64::from(i) / f64::from(count) + 0.3).cos();
        let chart: Vec<f64> = (0..count).map(back).collect();
        let chart = set(
            teeth,
            &format!("[teeth.pinion]\npitch_deviations = {chart:?}\n"),
        );
        let conditions = Conditions {
            coefficient: [3e-9; 2],
            ..conditions()
        };
        let mut each = Forward::new(&chart, None, conditions, numerics()).unwrap();
        let (each, _) = worn(&mut each);
        let plain = set(teeth, "");
        let wave = acting("run_out", &[("amplitude", 20.0), ("phase", 0.3)]);
        let mut few =
            Forward::with_effects(&plain, None, conditions, numerics(), Some(&wave)).unwrap();
        let classes = if teeth.is_some() { [3, 3] } else { [3, 1] };
        assert_eq!(few.sequence().map(|s| s.classes()), Some(classes));
        let (few, _) = worn(&mut few);
        let of = |state: &WearState, side: usize, tooth: usize| -> Vec<f64> {
            let own = |t: &&ToothState| t.side == side && t.teeth.contains(&tooth);
            state.teeth.iter().find(own).unwrap().depth.clone()
        };
        let spread = largest_difference(&of(&each, 0, shown[0]), &of(&each, 0, shown[2]));
        for side in 0..2 {
            for tooth in shown {
                let off = largest_difference(&of(&few, side, tooth), &of(&each, side, tooth));
                eprintln!(
                    "{count} teeth, side {side}, tooth {tooth}: {off:.1e} where teeth differ by {spread:.1e}"
                );
                assert!(off < 0.02, "side {side}, tooth {tooth}: {off}");
            }
        }
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
