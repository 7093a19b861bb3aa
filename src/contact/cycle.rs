//! The mesh cycle: every position of one base pitch, the tooth pairs that can touch there, and the operators that carry
//! gaps and wear between their contact grids and the flanks. All of it follows from the gear pair alone, so it is built
//! once and shared by every load, wear state and contact model.

mod grid;
mod motion;
mod position;
mod stations;

use rayon::prelude::*;

use crate::contact::frame::Frame;
use crate::gear::{Pair, contacts_at};

pub use position::{PairContact, Position};
pub use stations::Stations;

/// How finely a mesh cycle is resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleSpec {
    /// Mesh positions per base pitch.
    pub positions: usize,
    /// Spacing of the contact grid, mm.
    pub spacing: f64,
    /// Half width of the strip in which that spacing is even, mm; outside it grows, or wide strips would cost what few contacts use.
    pub even: f64,
    /// Half width of the strip in which contact is looked for, mm.
    pub window: f64,
    /// Tooth pairs farther apart than this are left out, mm.
    pub reach: f64,
}

/// How far outside the path of contact corners are looked at, in base pitches: even those of gears of 86 and 116 teeth are more than a
/// quarter of a module apart there, the most that flanks may close by. (Up to 2.75 base pitches the distance grows steadily.)
pub(super) const CORNER_MARGIN: f64 = 1.5;

/// The mesh cycle of one gear pair at one centre distance.
#[derive(Debug, Clone)]
pub struct Cycle {
    /// Working geometry.
    pub pair: Pair,
    /// Resolution.
    pub spec: CycleSpec,
    /// Stations of the worn depth.
    pub stations: Stations,
    /// Positions by ascending rotation.
    pub positions: Vec<Position>,
}

impl Cycle {
    /// The pinion's teeth that can touch somewhere in the mesh cycle (the gear's have the opposite numbers).
    pub fn teeth(pair: &Pair, spec: CycleSpec) -> Vec<i32> {
        let half = 0.5 / spec.positions as f64;
        let mut teeth: Vec<i32> = rotations(pair, spec)
            .into_iter()
            .flat_map(|theta| [theta - half, theta + half])
            .flat_map(|theta| teeth_at(pair, spec, theta))
            .collect();
        teeth.sort_unstable();
        teeth.dedup();
        teeth
    }

    /// The rotation `theta` (base pitches, any) taken where a cycle of this resolution takes it: only there the teeth of
    /// [`Cycle::teeth`] suffice.
    pub fn home(pair: &Pair, spec: CycleSpec, theta: f64) -> f64 {
        let start = rotations(pair, spec)[0] - 0.5 / spec.positions as f64;
        start + (theta - start).rem_euclid(1.0)
    }

    /// Builds all positions, in parallel.
    pub fn new(pair: &Pair, stations: &Stations, spec: CycleSpec) -> Self {
        let positions = rotations(pair, spec)
            .into_par_iter()
            .map(|theta| Position::new(pair, stations, spec, theta))
            .collect();
        Self {
            pair: pair.clone(),
            spec,
            stations: stations.clone(),
            positions,
        }
    }

    /// Index of the position nearest to the rotation `phase` (base pitches, modulo 1).
    pub fn nearest(&self, phase: f64) -> usize {
        let distance = |q: usize| {
            let d = (self.positions[q].theta - phase).rem_euclid(1.0);
            d.min(1.0 - d)
        };
        (0..self.positions.len())
            .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
            .unwrap_or(0)
    }
}

/// Rotations of all positions, evenly spaced over one base pitch around the pitch point.
///
/// Which base pitch decides how many teeth must be meshed finely: it is placed so that they are fewest.
pub(super) fn rotations(pair: &Pair, spec: CycleSpec) -> Vec<f64> {
    let n = spec.positions;
    let rotation = |q: usize| (q as f64 + 0.5) / n as f64;
    // the teeth between a position's neighbours, so that any rotation finds its teeth
    let edges: Vec<Vec<i32>> = (0..=n)
        .map(|q| teeth_at(pair, spec, q as f64 / n as f64))
        .collect();
    let teeth: Vec<Vec<i32>> = edges.windows(2).map(|e| e.concat()).collect();
    // teeth numbers grow by one where a rotation is taken one base pitch earlier
    let span = |shifted: usize| {
        let all = || {
            (0..n).flat_map(|q| {
                teeth[q]
                    .iter()
                    .map(move |t| t + i32::from(q + shifted >= n))
            })
        };
        all().max().unwrap_or(0) - all().min().unwrap_or(0)
    };
    let shifted = (0..=n / 2).min_by_key(|&m| (span(m), m)).unwrap_or(0);
    (n - shifted..n)
        .map(|q| rotation(q) - 1.0)
        .chain((0..n - shifted).map(rotation))
        .collect()
}

fn teeth_at(pair: &Pair, spec: CycleSpec, theta: f64) -> Vec<i32> {
    contacts_at(pair, theta, CORNER_MARGIN * pair.base_pitch)
        .into_iter()
        .filter(|contact| {
            Frame::new(pair, contact.path).is_some_and(|f| f.separation <= spec.reach)
        })
        .map(|contact| contact.pinion_tooth)
        .collect()
}
