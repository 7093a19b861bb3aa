//! The mesh cycle: every position of one base pitch, the tooth pairs that can touch there, and the operators that carry
//! gaps and wear between their contact grids and the flanks. All of it follows from the gear pair alone, so it is built
//! once and shared by every load, wear state and contact model.

use rayon::prelude::*;

use crate::contact::deposit::{Travel, deposit};
use crate::contact::frame::{Frame, Touch};
use crate::contact::mortar::{Facing, Trace, couple};
use crate::gear::{Gear, Pair, ToothContact, contacts_at};
use crate::numeric::cross;
use crate::numeric::sparse::SparseRows;

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

/// How far beyond that the distance of corners is still known, in base pitches: one more tooth on either side.
const BEYOND: f64 = 1.0;

/// Where the worn depth of each flank is kept: ascending arc coordinates of the pinion's and the gear's flank, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Stations {
    /// Arc coordinates, pinion then gear.
    pub arc: [Vec<f64>; 2],
}

impl Stations {
    /// Evenly spaced stations, at most `spacing` (mm) apart, from the form circle to the tip.
    pub fn new(pair: &Pair, spacing: f64) -> Self {
        let count = |gear: &Gear| {
            let length = gear.arc(gear.rho_last) - gear.arc(gear.rho_form);
            (length / spacing).ceil().max(2.0) as usize
        };
        Self::even(pair, [count(&pair.pinion), count(&pair.gear)])
    }

    /// As many evenly spaced stations for the same gears at another mounting: one more would shift them all, which a fit of the
    /// mounting sees as a jump.
    pub fn like(&self, pair: &Pair) -> Self {
        Self::even(pair, [0, 1].map(|side| self.arc[side].len() - 1))
    }

    fn even(pair: &Pair, counts: [usize; 2]) -> Self {
        let even = |gear: &Gear, count: usize| {
            let (from, to) = (gear.arc(gear.rho_form), gear.arc(gear.rho_last));
            (0..=count)
                .map(|i| from + (to - from) * i as f64 / count as f64)
                .collect()
        };
        Self {
            arc: [even(&pair.pinion, counts[0]), even(&pair.gear, counts[1])],
        }
    }

    /// Number of stations on both flanks.
    pub fn count(&self) -> usize {
        self.arc[0].len() + self.arc[1].len()
    }
}

/// One tooth pair at one mesh position.
#[derive(Debug, Clone)]
pub struct PairContact {
    /// Number j of the pair: the pinion's tooth j meets the gear's tooth −j.
    pub tooth: i32,
    /// Path of contact from the pitch point, mm.
    pub path: f64,
    /// Contact frame.
    pub frame: Frame,
    /// Multiplier nodes along the tangent, mm.
    pub xi: Vec<f64>,
    /// First of this pair's unknowns among the position's.
    pub offset: usize,
    /// ∫ N_k dξ, mm.
    pub length: Vec<f64>,
    /// ∫ N_k ξ dξ, mm².
    pub moment: Vec<f64>,
    /// Weighted gap per worn depth (mm, both positive) at the stations of the pinion and of the gear.
    pub opening: [SparseRows; 2],
    /// Depth rate at the stations per (k p) at the hats: mm per cycle for k p in 1/mm.
    pub wear: [SparseRows; 2],
    /// Arc coordinates of the multiplier nodes on each flank, mm.
    pub arc: [Vec<f64>; 2],
    /// What faces what at ξ = 0.
    pub facing: Facing,
    /// Signed sliding distance per path of contact, mm/mm (its sign changes at the pitch point).
    pub slip: f64,
    /// Sliding distance that the position stands for, mm.
    pub slid: f64,
}

/// One mesh position.
#[derive(Debug, Clone)]
pub struct Position {
    /// Pinion rotation from the pitch point, in base pitches; somewhat below 0 to somewhat below 1.
    pub theta: f64,
    /// Tooth pairs that can touch, by ascending path.
    pub pairs: Vec<PairContact>,
    /// Weighted gap of the unworn flanks, all pairs' unknowns in a row.
    pub gap: Vec<f64>,
    /// Weighted lever arm about the pinion's centre: closing of the gap per rotation (mm·mm/rad).
    pub arm: Vec<f64>,
    /// Smallest distance, before wear, of a tooth pair that was left out as out of reach, mm: of those where the pinion's tip
    /// corner would touch, and the gear's.
    pub left_out: [f64; 2],
}

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

impl Position {
    /// The position at pinion rotation `theta` (base pitches from the pitch point).
    pub fn new(pair: &Pair, stations: &Stations, spec: CycleSpec, theta: f64) -> Self {
        let mut out = Self {
            theta,
            pairs: Vec::new(),
            gap: Vec::new(),
            arm: Vec::new(),
            left_out: [f64::INFINITY; 2],
        };
        let [start, .., end] = pair.path_points();
        let margin = CORNER_MARGIN * pair.base_pitch;
        for ToothContact {
            pinion_tooth: tooth,
            path,
            ..
        } in contacts_at(pair, theta, margin + BEYOND * pair.base_pitch)
        {
            let Some(frame) = Frame::new(pair, path) else {
                continue;
            };
            let beyond = path < start - margin || path > end + margin;
            if beyond || frame.separation > spec.reach {
                let nearest = &mut out.left_out[usize::from(frame.touch == Touch::GearTip)];
                *nearest = nearest.min(frame.separation);
                continue;
            }
            let (low, high) = frame.extent(spec.window);
            let Some(xi) = grid(low, high, spec) else {
                continue;
            };
            out.add(pair, stations, spec, tooth, path, frame, xi);
        }
        out
    }

    #[expect(
        clippy::too_many_arguments,
        reason = "one caller; the arguments are the locals of the loop above"
    )]
    fn add(
        &mut self,
        pair: &Pair,
        stations: &Stations,
        spec: CycleSpec,
        tooth: i32,
        path: f64,
        frame: Frame,
        xi: Vec<f64>,
    ) {
        let traces = [0, 1].map(|side| Trace {
            side,
            arc: &stations.arc[side],
            order: 1,
        });
        let coupling = couple(&xi, |x| frame.facing(pair, x), &traces);
        let arc_at: Vec<[f64; 2]> = xi.iter().map(|&x| frame.facing(pair, x).arc).collect();
        let arc = [0, 1].map(|side| arc_at.iter().map(|a| a[side]).collect::<Vec<f64>>());
        let motion = Motion::at(pair, path, &frame);
        let travel = motion.speed.map(|speed| Travel {
            step: pair.base_pitch / spec.positions as f64,
            speed,
            slip: motion.slip,
            slip_slope: motion.slip_slope,
        });
        let wear = [0, 1].map(|side| deposit(&xi, &arc[side], &stations.arc[side], travel[side]));
        let lever = cross(frame.origin, frame.normal);
        self.arm.extend(
            coupling
                .length
                .iter()
                .zip(&coupling.moment)
                .map(|(l, m)| lever * l + m),
        );
        let offset = self.gap.len();
        self.gap.extend(&coupling.gap);
        let [first, second]: [SparseRows; 2] =
            coupling.traces.try_into().expect("two traces were given");
        self.pairs.push(PairContact {
            tooth,
            path,
            facing: frame.facing(pair, 0.0),
            frame,
            xi,
            offset,
            length: coupling.length,
            moment: coupling.moment,
            opening: [first, second],
            wear,
            arc,
            slip: motion.slip,
            slid: travel[0].slid(),
        });
    }

    /// Weighted gaps with the worn depth (mm) of both flanks added.
    pub fn worn_gap(&self, depth: [&[f64]; 2]) -> Vec<f64> {
        let mut gap = self.gap.clone();
        self.open(depth, &mut gap);
        gap
    }

    /// Adds the weighted gaps that missing material (mm at the stations of both flanks) opens.
    pub fn open(&self, depth: [&[f64]; 2], gap: &mut [f64]) {
        for pair in &self.pairs {
            for k in 0..pair.xi.len() {
                for (opening, depth) in pair.opening.iter().zip(depth) {
                    gap[pair.offset + k] += opening.dot(k, depth);
                }
            }
        }
    }

    /// As [`Position::open`], with depths of each pair's own.
    pub fn open_each(&self, depths: &[[&[f64]; 2]], gap: &mut [f64]) {
        for (pair, depth) in self.pairs.iter().zip(depths) {
            for k in 0..pair.xi.len() {
                for (opening, depth) in pair.opening.iter().zip(depth) {
                    gap[pair.offset + k] += opening.dot(k, depth);
                }
            }
        }
    }

    /// The rotation between 0 and 1, base pitches.
    pub fn phase(&self) -> f64 {
        self.theta.rem_euclid(1.0)
    }

    /// Number of a tooth pair counted from the rotation [`Position::phase`].
    pub fn pair_number(&self, pair: &PairContact) -> i32 {
        pair.tooth + self.theta.floor() as i32
    }

    /// The tooth pair that owns unknown `k`.
    pub fn owner(&self, k: usize) -> usize {
        self.pairs.partition_point(|p| p.offset <= k) - 1
    }
}

/// Growth of the grid's spacing from one node to the next outside its even part, and the most it grows to.
const GROWTH: f64 = 1.15;
const COARSEST: f64 = 8.0;

/// Nodes in [low, high]: whole multiples of the spacing, farther apart outside the even part; where the strip ends at a tip or
/// root the last node sits on the end itself.
fn grid(low: f64, high: f64, spec: CycleSpec) -> Option<Vec<f64>> {
    let h = spec.spacing;
    if high - low < 2.0 * h {
        return None;
    }
    let farthest = low.abs().max(high.abs());
    let mut side = vec![0.0];
    let mut step = h;
    while side[side.len() - 1] <= farthest {
        let next = side.len() as f64 * h;
        if next <= spec.even {
            side.push(next);
        } else {
            step = (GROWTH * step).min(COARSEST * h);
            side.push(side[side.len() - 1] + step);
        }
    }
    let below = side[1..].iter().rev().map(|x| -x);
    let mut xi: Vec<f64> = below
        .chain(side.iter().copied())
        .filter(|x| (low..=high).contains(x))
        .collect();
    if xi.len() < 2 {
        return None;
    }
    if low > -spec.window {
        if xi[0] - low > 0.5 * (xi[1] - xi[0]) {
            xi.insert(0, low)
        } else {
            xi[0] = low
        }
    }
    if high < spec.window {
        let end = xi.len() - 1;
        if high - xi[end] > 0.5 * (xi[end] - xi[end - 1]) {
            xi.push(high)
        } else {
            xi[end] = high
        }
    }
    (xi.len() > 2).then_some(xi)
}

/// How a contact moves along both flanks and slides, per path of contact.
struct Motion {
    speed: [f64; 2],
    slip: f64,
    slip_slope: f64,
}

impl Motion {
    fn at(pair: &Pair, path: f64, frame: &Frame) -> Self {
        let scale = (1.0 + 1.0 / pair.speed_ratio) / pair.pinion.base_radius;
        let slip = scale * frame.sliding_arm(pair);
        if frame.touch == Touch::Flanks {
            let speed = [
                frame.rho[0] / pair.pinion.base_radius,
                -frame.rho[1] / pair.gear.base_radius,
            ];
            return Self {
                speed,
                slip,
                slip_slope: scale,
            };
        }
        // a corner stays on its own flank; the motion of its foot by a difference taken away from the path's end
        let side = usize::from(frame.touch == Touch::PinionTip);
        let outward = 1e-4 * pair.base_pitch * if side == 0 { -1.0 } else { 1.0 };
        let gear = [&pair.pinion, &pair.gear][side];
        let (mut speed, mut slip_slope) = ([0.0; 2], scale);
        if let Some(next) = Frame::new(pair, path + outward) {
            speed[side] = (gear.arc(next.rho[side]) - gear.arc(frame.rho[side])) / outward;
            slip_slope = scale * (next.sliding_arm(pair) - frame.sliding_arm(pair)) / outward;
        }
        Self {
            speed,
            slip,
            slip_slope,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::frame::tests::reference;

    #[test]
    fn the_grid_is_even_where_it_should_be_and_ends_where_flanks_do() {
        let spec = CycleSpec {
            positions: 10,
            spacing: 0.1,
            even: 1.0,
            window: 5.0,
            reach: 0.0,
        };
        let xi = grid(-5.0, 2.03, spec).unwrap();
        let zero = xi.iter().position(|x| *x == 0.0).unwrap();
        for k in -10i32..=10 {
            let at = (zero as i32 + k) as usize;
            assert_eq!(xi[at], f64::from(k) * 0.1);
        }
        assert_eq!(xi[xi.len() - 1], 2.03);
        assert!(xi[0] >= -5.0 && xi[0] < -5.0 + 0.8);
        let steps: Vec<f64> = xi.windows(2).map(|w| w[1] - w[0]).collect();
        assert!(
            steps.iter().all(|s| (0.05..=0.8 + 1e-9).contains(s)),
            "{steps:?}"
        );
        for two in steps[1..steps.len() - 1].windows(2) {
            assert!((two[0] / two[1]).max(two[1] / two[0]) < 1.15 + 1e-9);
        }
        assert!(xi.len() < 50, "{}", xi.len());
    }

    #[test]
    fn stations_at_another_mounting_are_as_many_and_end_at_its_flanks() {
        let pair = reference();
        let stations = Stations::new(&pair, 0.013);
        let moved = Pair::new(pair.pinion.clone(), pair.gear.clone(), 80.0, 0.7).unwrap();
        let like = stations.like(&moved);
        assert_eq!(like.count(), stations.count());
        for (arc, gear) in like.arc.iter().zip([&moved.pinion, &moved.gear]) {
            let ends = [gear.arc(gear.rho_form), gear.arc(gear.rho_tip)];
            let off = [arc[0] - ends[0], arc[arc.len() - 1] - ends[1]];
            assert!(off.iter().all(|off| off.abs() < 1e-12), "{off:?}");
            let step = (ends[1] - ends[0]) / (arc.len() - 1) as f64;
            assert!(step <= 0.013 + 1e-12);
            for two in arc.windows(2) {
                assert!((two[1] - two[0] - step).abs() < 1e-9);
            }
        }
    }
}
