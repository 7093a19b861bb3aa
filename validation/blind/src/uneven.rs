//! Causes that make flanks of one member differ: leads across the face, teeth that stand proud, run-out.

use crate::dice::Dice;
use crate::laws::Law;
use crate::layout::{self, Layout};
use crate::rig::Rig;

/// Names and forms; the first form of a name is the plain one.
pub const FACE: &[(&str, &str)] = &[
    ("lead_misalignment", "wedge"),
    ("lead_misalignment", "bent"),
    ("lead_crowning", "parabola"),
    ("lead_crowning", "end_relief"),
];

pub const TEETH: &[(&str, &str)] = &[
    ("pitch_error", "one_tooth"),
    ("pitch_error", "alternate"),
    ("run_out", "eccentric"),
    ("run_out", "indexing"),
];

/// Slices of the face.
const SLICES: usize = 9;
/// Neighbours of a proud tooth on either side that have a flank of their own.
const NEIGHBOURS: usize = 2;
/// Teeth that stand for all of an eccentric gear.
const PHASES: usize = 8;

/// What is uneven, before any strength.
#[derive(Clone, Debug)]
pub struct Uneven {
    /// Which end of the face is the loaded one, -1 or 1.
    pub side: f64,
    pub member: usize,
}

impl Uneven {
    /// None: these gears do not suit the cause.
    pub fn draw(named: &[(&str, &str)], rig: &Rig, d: &mut Dice) -> Option<Self> {
        let side = d.sign();
        let first = d.below(2);
        let z = [rig.pinion.z, rig.gear.z];
        let suited = |&m: &usize| named.iter().all(|&law| suits(law, m, z));
        let member = [first, 1 - first].into_iter().find(suited)?;
        Some(Self { side, member })
    }
}

fn is(law: &Law, list: &[(&str, &str)]) -> bool {
    list.contains(&(law.name, law.form))
}

/// Material missing on both flanks together, um at eta half face widths from mid-face; what is missing everywhere alike does not count.
pub fn missing(law: &Law, eta: f64) -> f64 {
    let p = |k: usize| law.parameters[k].1;
    match (law.name, law.form) {
        // The loaded end is the one where material stands.
        ("lead_misalignment", "wedge") => -0.5 * p(0) * p(1) * eta,
        ("lead_misalignment", _) => p(0) * (-0.5 * p(1) * eta + p(2) * eta * eta),
        ("lead_crowning", "parabola") => p(0) * eta * eta,
        ("lead_crowning", _) => p(0) * ((eta.abs() - 1.0) / p(1) + 1.0).max(0.0),
        _ => 0.0,
    }
}

/// Distance of the axes of an eccentric gear over its turn, from the mean, mm; the measured tooth is the first.
pub fn centres(law: &Law) -> Vec<f64> {
    if (law.name, law.form) != ("run_out", "eccentric") {
        return vec![0.0];
    }
    let turn = |k: usize| 2.0 * std::f64::consts::PI * k as f64 / PHASES as f64;
    (0..PHASES)
        .map(|k| 1e-3 * law.parameters[0].1 * (turn(k) + law.parameters[1].1).cos())
        .collect()
}

/// The layout under these laws, at most one of which is uneven. `near`: places of the mesh that can touch.
pub fn layout(laws: &[Law], z: [usize; 2], near: std::ops::RangeInclusive<i64>) -> Layout {
    if laws.iter().any(|l| is(l, FACE)) {
        let all = |eta: f64| laws.iter().map(|l| missing(l, eta)).sum();
        return Layout::face(SLICES, &all);
    }
    match laws.iter().find(|l| is(l, TEETH)) {
        None => Layout::even(),
        Some(law) if law.form == "eccentric" => Layout::phases(member(law), PHASES),
        Some(law) => {
            let m = member(law);
            let own = classes(law, z[m]);
            let other = mates(law, z);
            let (back, level) = (set_back(law, z[m]), vec![0.0; z[1 - m]]);
            let both = |a, b| if m == 0 { [a, b] } else { [b, a] };
            let teeth: [&Vec<usize>; 2] = both(&own, &other);
            let sides = if m == 0 {
                [&back, &level]
            } else {
                [&level, &back]
            };
            Layout::teeth(teeth.map(Vec::as_slice), sides.map(Vec::as_slice), near)
        }
    }
}

/// Whether gears with these teeth can have the cause, and wear as the layout says: every tooth of the mate must meet every tooth of the uneven
/// member (teeth without a common factor), or what repeats must repeat with the common factor.
pub fn suits(law: (&str, &str), member: usize, z: [usize; 2]) -> bool {
    match law {
        ("pitch_error", "alternate") => z[member].is_multiple_of(2),
        ("run_out", "indexing") => z[member] <= 30 && layout::gcd(z[0], z[1]) == 1,
        ("pitch_error" | "run_out", _) => layout::gcd(z[0], z[1]) == 1,
        _ => true,
    }
}

/// The member that is uneven.
pub fn member(law: &Law) -> usize {
    let stated = law.parameters.iter().find(|p| p.0 == "member");
    stated.map_or(0, |p| p.1 as usize)
}

fn classes(law: &Law, z: usize) -> Vec<usize> {
    match law.form {
        "one_tooth" => layout::around_one(z, NEIGHBOURS),
        "alternate" => (0..z).map(|i| i % 2).collect(),
        _ => (0..z).collect(),
    }
}

/// Alternate teeth are met by the same tooth of the mate for ever if both have an even number.
fn mates(law: &Law, z: [usize; 2]) -> Vec<usize> {
    let other = z[1 - member(law)];
    let apart = law.form == "alternate" && other.is_multiple_of(2);
    (0..other).map(|i| if apart { i % 2 } else { 0 }).collect()
}

/// mm that each tooth stands back.
fn set_back(law: &Law, z: usize) -> Vec<f64> {
    let p = |k: usize| law.parameters[k].1;
    let um = |i: usize| match law.form {
        "one_tooth" => {
            if i == 0 {
                p(0)
            } else {
                0.0
            }
        }
        "alternate" => {
            if i.is_multiple_of(2) {
                p(0)
            } else {
                0.0
            }
        }
        _ => {
            let turn = 2.0 * std::f64::consts::PI * i as f64 / z as f64;
            p(0) * (turn + p(1)).sin()
        }
    };
    (0..z).map(|i| 1e-3 * um(i)).collect()
}
