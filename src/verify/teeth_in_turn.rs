//! S2: teeth that differ, each class worn for itself in the sequence in which teeth meet.
//!
//! ```text
//! springs    w_i = c_i (δ − g_i),  c_1 (δ − g_1) + c_2 (δ − g_2) = w      two pairs, teeth with the gaps g_i; c_i from the loads without gaps
//! ```

use crate::effects::{Combined, Surroundings, find};
use crate::simulate::forward::{Conditions, Forward, GearSet};
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::wear_state::{WearState, line_load};
use crate::study::Study;
use crate::verify::contact_and_wear::Effort;
use crate::verify::{CaseError, Measured};
use crate::wear::acting::Acting;

/// The id of these cases.
pub const ID: &str = "S2";

/// Whence the targets come.
pub const SOURCE: &str =
    "the model of one tooth; springs of tooth pairs in closed form; the whole hunting sequence";

/// Why the tolerances are what they are.
pub const REASON: &str = "1e-12 and 1e-9: the same numbers another way, to rounding; a mean mate in place of all mates is an approximation, bounded by what \
     teeth differ by";

const PAPER: &str = include_str!("../../validation/paper/study.toml");

/// Pinion revolutions of the histories.
const REVOLUTIONS: f64 = 3e5;

/// N mm.
const TORQUE: f64 = 4e4;

/// All of them.
///
/// # Errors
/// [`CaseError`] if a pair cannot be built or its contact not solved.
pub fn all(_: Effort) -> Result<Vec<Measured>, CaseError> {
    let mut out = alike()?;
    out.extend(proud_teeth()?);
    out.extend(mean_mates()?);
    Ok(out)
}

/// Coarse: what is asked here does not depend on resolution.
fn numerics() -> Numerics {
    Numerics {
        elements_per_half_width: 2.0,
        positions: 20,
        ..Numerics::default()
    }
}

fn conditions() -> Conditions {
    Conditions {
        torque: TORQUE,
        speed: 2000.0,
        misalignment: 0.0,
        cycles: REVOLUTIONS,
        coefficient: [6e-10; 2],
    }
}

fn parsed(text: &str) -> Result<GearSet, CaseError> {
    let study = Study::parse(text, "study.toml").map_err(CaseError::gears)?;
    Ok(study.gear_set())
}

/// A pair of 12 and 13 teeth with shifted profiles, with a table of its teeth: 156 meetings, so that all can be followed.
fn small_pair(table: &str) -> Result<GearSet, CaseError> {
    let mut text = format!("{PAPER}\n{table}");
    for (from, to) in [
        (
            "centre_distance = 80.0",
            "# the distance that the shifts ask for:",
        ),
        ("teeth = 27", "teeth = 12"),
        ("teeth = 53", "teeth = 13"),
        ("profile_shift = 0.0", "profile_shift = 0.4"),
        ("bore_diameter = 25.0", "bore_diameter = 8.0"),
        ("bore_diameter = 40.0", "bore_diameter = 8.0"),
    ] {
        text = text.replace(from, to);
    }
    parsed(&text)
}

/// The catalogue's effect with these parameters.
fn acting(name: &str, parameters: &[(&str, f64)]) -> Result<Acting, CaseError> {
    let card = find(name).map_err(CaseError::gears)?;
    let mut effects = Combined::default();
    let values = card.values(parameters).map_err(CaseError::gears)?;
    effects.push(card.hook, (card.build)(&values));
    Ok(Acting {
        effects,
        surroundings: Surroundings::default(),
        torque: 1e-3 * TORQUE,
        speed: 2000.0,
        reversed: false,
        face_width: 33.0,
    })
}

fn forward<'m>(
    set: &'m GearSet,
    members: Option<&'m Members>,
    acting: Option<&'m Acting>,
) -> Result<Forward<'m>, CaseError> {
    Forward::with_effects(set, members, conditions(), numerics(), acting).map_err(CaseError::gears)
}

fn worn(mut forward: Forward<'_>) -> Result<WearState, CaseError> {
    let (mut progress, mut last) = (None, None);
    let store = &mut |state| last = Some(state);
    forward
        .wear(&mut progress, &[REVOLUTIONS], &mut |_| true, store)
        .map_err(CaseError::gears)?;
    last.ok_or_else(|| CaseError::gears("no state was stored"))
}

/// Largest difference over the largest of `b`.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let scale = b.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
    let off = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    off.fold(0.0, f64::max) / scale
}

/// What stands apart, the effect that says so, and its parameters.
type Kind<'k> = (&'k str, &'k str, &'k [(&'k str, f64)]);

/// Classes whose teeth stand in their places to 1e-14 µm are the model of one tooth: every second tooth (two classes), one tooth (it, two on
/// either side, the rest), and groups around a gear.
fn alike() -> Result<Vec<Measured>, CaseError> {
    let set = parsed(PAPER)?;
    let members = set
        .members(&numerics(), &[TORQUE], &[0.0])
        .map_err(CaseError::gears)?;
    let kinds: [Kind<'_>; 3] = [
        (
            "every second tooth",
            "pitch_error",
            &[("deviation", 1e-14), ("alternate", 1.0)],
        ),
        ("one tooth", "pitch_error", &[("deviation", 1e-14)]),
        (
            "groups around the gear",
            "run_out",
            &[("amplitude", 1e-14), ("on_gear", 1.0)],
        ),
    ];
    let mut out = Vec::new();
    for (model, members) in [("finite elements", Some(&members)), ("analytic", None)] {
        let one = worn(forward(&set, members, None)?)?;
        for (kind, effect, parameters) in kinds {
            let acting = acting(effect, parameters)?;
            let state = worn(forward(&set, members, Some(&acting))?)?;
            let off = state
                .teeth
                .iter()
                .map(|class| apart(&class.depth, &one.depth[class.side]));
            out.push(Measured::bound(
                ID,
                format!(
                    "{kind} for itself, {model}: depth of {} classes against one tooth",
                    state.teeth.len()
                ),
                off.fold(0.0, f64::max),
                1e-12,
            ));
        }
    }
    Ok(out)
}

/// Unworn, the analytic model's pairs are springs, whose stiffness follows from its own loads without deviations: what two pairs carry where
/// every second tooth stands proud or back.
fn proud_teeth() -> Result<Vec<Measured>, CaseError> {
    let set = small_pair("")?;
    let mut plain = forward(&set, None, None)?;
    let unworn = vec![0.0; plain.cycle().stations.count()];
    let even = plain.contacts_at(&unworn).map_err(CaseError::gears)?;
    let mut out = Vec::new();
    for um in [-3.0, 2.0, 40.0] {
        let acting = acting("pitch_error", &[("deviation", um), ("alternate", 1.0)])?;
        let mut forward = forward(&set, None, Some(&acting))?;
        let stations = forward.cycle().stations.count();
        let passages = forward
            .all_contacts_at(&vec![0.0; 2 * stations])
            .map_err(CaseError::gears)?;
        let gears = &forward.cycle().pair;
        let step = gears.base_pitch / 20.0;
        let (mut worst, mut compared): (f64, usize) = (0.0, 0);
        for (q, position) in forward.cycle().positions.iter().enumerate() {
            let loads: Vec<f64> = (position.pairs.iter())
                .map(|pair| line_load(pair, &even[q]))
                .collect();
            let touching: Vec<usize> = (0..loads.len()).filter(|i| loads[*i] > 0.0).collect();
            let [first, second] = touching[..] else {
                continue;
            };
            // pairs that are there for part of the position's time only share otherwise
            let rho = |i: usize| position.pairs[i].frame.rho[0];
            if rho(first) < gears.rho_a + step || rho(second) > gears.rho_e - step {
                continue;
            }
            let total: f64 = loads.iter().sum();
            let approach = even[q].approach * gears.pinion.base_radius;
            let c = [loads[first], loads[second]].map(|load| load / approach);
            for (passage, contacts) in passages.iter().enumerate() {
                for own in 0..2 {
                    // the own tooth is odd in the first passage, its neighbour in the second
                    let is_odd = |i: usize| (i == own) == (passage == 0);
                    let gaps = [0, 1].map(|i| if is_odd(i) { 1e-3 * um } else { 0.0 });
                    let index = [first, second][own];
                    let found = line_load(&position.pairs[index], &contacts[q]);
                    worst = worst.max((found - springs(c, gaps, total)[own]).abs() / total);
                    compared += 1;
                }
            }
        }
        out.push(Measured::bound(
            ID,
            format!("every second tooth back by {um} µm: loads of two pairs against springs, {compared} places"),
            worst,
            1e-9,
        ));
    }
    Ok(out)
}

/// Loads of two springs `c` with `gaps` that carry `total` together; none pulls.
fn springs(c: [f64; 2], gaps: [f64; 2], total: f64) -> [f64; 2] {
    let closed = (total + c[0] * gaps[0] + c[1] * gaps[1]) / (c[0] + c[1]);
    let loads = [0, 1].map(|i| c[i] * (closed - gaps[i]));
    if loads[0] < 0.0 {
        [0.0, total]
    } else if loads[1] < 0.0 {
        [total, 0.0]
    } else {
        loads
    }
}

/// The mean mate against every meeting, both members out of place: a tooth is off by no more than a fifth of what teeth differ by, the mean tooth
/// by no more than a twentieth, and by less than in proportion where deviations are small.
fn mean_mates() -> Result<Vec<Measured>, CaseError> {
    let mut out = Vec::new();
    let mut worst_of = Vec::new();
    for scale in [1.0, 0.1] {
        let back = [0, 3, -2, 1, 0, -3, 2, 0, 1, -1, 4, 0].map(|um| scale * f64::from(um));
        let wave = |i: usize| 6.0 * scale * (std::f64::consts::TAU * i as f64 / 13.0).cos();
        let wave: Vec<f64> = (0..13).map(wave).collect();
        let run = |hunting: &str| {
            let set = small_pair(&format!(
                "[teeth]\nhunting = \"{hunting}\"\n\
                 [teeth.pinion]\npitch_deviations = {back:?}\nclasses = 12\n\
                 [teeth.gear]\npitch_deviations = {wave:?}\nclasses = 13\n"
            ))?;
            worn(forward(&set, None, None)?)
        };
        let (full, average) = (run("full")?, run("average")?);
        let (mut worst, mut spread): (f64, f64) = (0.0, 0.0);
        for (a, b) in average.teeth.iter().zip(&full.teeth) {
            worst = worst.max(apart(&a.depth, &b.depth));
            spread = spread.max(apart(&b.depth, &full.depth[b.side]));
        }
        let mean = [0, 1].map(|side| apart(&average.depth[side], &full.depth[side]));
        for (what, off, share) in [
            ("a tooth", worst, 0.2),
            ("the mean tooth", mean[0].max(mean[1]), 0.05),
        ] {
            out.push(Measured::bound(
                ID,
                format!(
                    "12 and 13 teeth, deviations of {:.1} µm: depth of {what} by mean mates against all 156 meetings, over what teeth differ by",
                    6.0 * scale
                ),
                off / spread,
                share,
            ));
        }
        worst_of.push(worst);
    }
    out.push(Measured::bound(
        ID,
        "12 and 13 teeth: that error with a tenth of the deviations, over the error with all of them",
        worst_of[1] / worst_of[0],
        0.1,
    ));
    Ok(out)
}
