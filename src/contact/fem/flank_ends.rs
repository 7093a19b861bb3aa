//! What the flanks of one member give way by more because the ends of its face are free: the modes of [`FreeEnds`] on a mesh of its section.
//!
//! ```text
//! e_ij = (b/N) T_i · T_j,     T_i = Σ_n c_n(i) S^(−1/2) t_n(ρ_i)/h_n + s T_i^z         slices i and j of N, flank points ρ_i and ρ_j, face b
//! ```
//! T_i^z is what the modes do along the axis (`EndModes::at`). s = ± sin β_b: with C/cos β_b for all that gives way, the wheels' bending by the axial force is
//! cos β_b times what it should be (3 % less at 14°), its share in the rest exact.
//!
//! The shapes are what a tooth does along the axis under loads from root to tip.

use nalgebra::DMatrix;

use super::flank_waves::{Flank, NEIGHBOURS};
use crate::fem::{EndModes, FemError, FreeEnds, Prism};
use crate::numeric::Vec2;

/// Wave numbers that teeth answer in along the axis, 1/module: an end is felt over about the thickness of a tooth.
const SHAPE_WAVES: [f64; 3] = [0.3, 1.0, 3.0];
/// Those that wheels answer axial forces in, 1/module.
const PUSHED_WAVES: [f64; 3] = [0.02, 0.1, 0.5];
/// Loads from root to tip that they answer.
const SHAPE_LOADS: usize = 3;
/// Waves that the ends' own energy is found with, if there are not as many slices.
pub(super) const LEAST_WAVES: usize = 12;

/// A slice and a place on its flank, of a tooth.
#[derive(Debug, Clone, Copy)]
pub(super) struct FacePlace {
    pub(super) slice: usize,
    /// Of the flank's points.
    pub(super) weights: [(usize, f64); 2],
}

/// How far free ends let one member's flanks give way.
#[derive(Debug)]
pub(super) struct FlankEnds {
    /// By tooth from −[`NEIGHBOURS`] on and slice: T √(b/N), by mode (row) and flank point (column).
    felt: Vec<Vec<DMatrix<f64>>>,
}

impl FlankEnds {
    /// Displacement, mm per N/mm, at a place on tooth `tooth` per line load at one of tooth 0.
    pub(super) fn between(&self, tooth: i32, to: FacePlace, from: FacePlace) -> f64 {
        let Some(there) = usize::try_from(tooth + NEIGHBOURS)
            .ok()
            .and_then(|place| self.felt.get(place))
        else {
            return 0.0;
        };
        let (there, here) = (
            &there[to.slice],
            &self.felt[NEIGHBOURS as usize][from.slice],
        );
        if there.ncols() == 0 {
            return 0.0;
        }
        let mut sum = 0.0;
        for (i, a) in to.weights {
            for (j, b) in from.weights {
                sum += a * b * there.column(i).dot(&here.column(j));
            }
        }
        sum
    }

    /// The ends of a prism `width` mm long whose flanks are loaded, along the axis too where that is `inclined`.
    pub(super) fn of_prism<'p>(
        prism: &'p Prism<'p>,
        flanks: &[Flank],
        module: f64,
        width: f64,
        inclined: bool,
    ) -> Result<FreeEnds<'p>, FemError> {
        let loaded = &flanks[NEIGHBOURS as usize];
        let last = loaded.nodes.len() - 1;
        let load = |place: usize| {
            let index = place * last / (SHAPE_LOADS - 1);
            (loaded.nodes[index], loaded.normals[index])
        };
        let loads: Vec<(u32, Vec2)> = (0..SHAPE_LOADS).map(load).collect();
        let answering = SHAPE_WAVES.map(|n| n / module);
        let pushed = PUSHED_WAVES.map(|n| n / module);
        let pushed: &[f64] = if inclined { &pushed } else { &[] };
        let shapes = prism.end_shapes(width, &loads, &answering, pushed)?;
        let points = (flanks.iter())
            .flat_map(|flank| {
                flank
                    .nodes
                    .iter()
                    .copied()
                    .zip(flank.normals.iter().copied())
            })
            .collect();
        FreeEnds::new(prism, shapes, points, width)
    }

    /// Of ends with these modes, of a face `width` (mm) in so many `slices`. Loads push along the axis too, `inclined` times what they are.
    pub(super) fn new(
        modes: &EndModes,
        flanks: &[Flank],
        width: f64,
        slices: usize,
        inclined: f64,
    ) -> Self {
        let thickness = width / slices as f64;
        // loads of slices hold no shorter waves than they are
        let of_slice = |slice: usize| {
            modes.at((slice as f64 + 0.5) * thickness, inclined, slices) * thickness.sqrt()
        };
        let by_slice: Vec<DMatrix<f64>> = (0..slices).map(of_slice).collect();
        let mut first = 0;
        let of_flank = |flank: &Flank| {
            let count = flank.nodes.len();
            first += count;
            let own = |all: &DMatrix<f64>| all.columns(first - count, count).into_owned();
            by_slice.iter().map(own).collect()
        };
        Self {
            felt: flanks.iter().map(of_flank).collect(),
        }
    }
}
