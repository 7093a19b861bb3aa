//! One mesh position: the tooth pairs that can touch there, and the operators that carry gaps and wear between their grids and the flanks.

use super::grid::grid;
use super::motion::Motion;
use super::{CORNER_MARGIN, CycleSpec, Stations};
use crate::contact::deposit::{Travel, deposit};
use crate::contact::frame::{Frame, Touch};
use crate::contact::mortar::{Facing, Trace, couple};
use crate::gear::{Pair, ToothContact, contacts_at};
use crate::numeric::cross;
use crate::numeric::sparse::SparseRows;

/// How far beyond that the distance of corners is still known, in base pitches: one more tooth on either side.
const BEYOND: f64 = 1.0;

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
