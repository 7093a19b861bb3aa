//! What a prismatic body gives way by more where its ends are free than where they are mirrors, as [`super::Prism`] has them.
//!
//! Mirrors carry σ_zz. Taking it off is a field that the waves along the axis do not hold, for their w is 0 at the ends. To them are added
//!
//! ```text
//! u_x, u_y = P(x, y) q(z), Q(x, y) q(z),   u_z = ψ(x, y) g(z),   q' = g          at amplitudes a_k, k by shape
//! both ends apart      g = 1 − 2z/b,  q = z − z²/b          both ends the same way  g = 1,  q = z − b/2         b the length
//! ```
//! of which the waves and g are complete for w. q follows the slope that u_x, u_y have at a free end, where σ_zx = 0, if P, Q = −∂ψ/∂x, −∂ψ/∂y; cosines alone
//! would find it slowly. Work and energy (h_0 = b, h_n = b/2; x_n, F_n amplitudes of wave n; L_n from the strains' products):
//!
//! ```text
//! ½ Σ_n h_n x_nᵀ K_n x_n + Σ_n x_nᵀ L_n a + ½ aᵀ S_0 a  =  least with  Σ_n (h_n x_n + q_n p a)·F_n,      q_n = ∫ q cos κ_n z dz
//! S = S_0 − Σ_n L_nᵀ K_n⁻¹ L_n/h_n,     t_n = q_n p − K_n⁻¹ L_n,     a = S⁻¹ Σ_n t_nᵀ F_n,      wave n moves by t_n a/h_n more
//! ```
//! A Ritz method for the ends: any set of shapes (P, Q, ψ) gives part of what they give way by, and never too much. Ritz, J. reine angew. Math. 135 (1909).

mod end_shape;

use nalgebra::DMatrix;
use rayon::prelude::*;

pub use self::end_shape::EndShape;
use self::end_shape::{EndForces, along};
use super::FemError;
use super::waves::{Prism, Wave};
use crate::numeric::Vec2;

/// Of the stiffness of the shapes together, relative to the largest: below that two are the same.
const SAME: f64 = 1e-9;

/// How the two ends of a prism move along its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum EndMotion {
    /// From each other or together: what even waves come with.
    Apart,
    /// Both the same way: odd waves.
    Along,
}

impl EndMotion {
    /// What a wave comes with; 0 is the even load.
    fn of_wave(wave: usize) -> Self {
        if wave.is_multiple_of(2) {
            Self::Apart
        } else {
            Self::Along
        }
    }
}

/// How points of a prism's section follow the modes of its free ends.
#[derive(Debug)]
pub struct EndModes {
    length: f64,
    points: usize,
    motions: [MotionModes; 2],
}

/// Modes of one motion of the ends: S^(−1/2) times what the shapes do at the points, by mode (row) and point (column).
#[derive(Debug)]
struct MotionModes {
    motion: EndMotion,
    waves: Vec<WaveMotion>,
    /// ψ
    axial: DMatrix<f64>,
}

/// How a wave follows the modes.
#[derive(Debug)]
struct WaveMotion {
    wave: usize,
    /// t_n/h_n, with the cosine.
    in_plane: DMatrix<f64>,
    /// −K_n⁻¹ L_n/h_n along the axis, with the sine.
    axial: DMatrix<f64>,
}

impl EndModes {
    /// Amplitude of a wave (0 the even load), mm, that a point moves by more between free ends, per N/mm of that of the load on it.
    pub fn of_wave(&self, wave: usize, point: usize) -> f64 {
        self.between([wave, point], [wave, point])
    }

    /// Amplitude, mm, that the wave and point `moved` get per N/mm of that of the wave and point `loaded`.
    pub fn between(&self, moved: [usize; 2], loaded: [usize; 2]) -> f64 {
        let norm = match loaded[0] {
            0 => self.length,
            _ => 0.5 * self.length,
        };
        let of_motion = |modes: &MotionModes| {
            let own = |[wave, point]: [usize; 2]| {
                let wave = modes.waves.iter().find(|own| own.wave == wave)?;
                Some(wave.in_plane.column(point))
            };
            Some(own(moved)?.dot(&own(loaded)?))
        };
        norm * self.motions.iter().filter_map(of_motion).sum::<f64>()
    }

    /// What a load, N per mm, on a length dz at `z` (mm from one end) does to the modes (rows) at the points (columns), over dz; the modes move the points by the
    /// same times their amplitudes. The load pushes along the points' directions and, `inclined` times that, along the axis. Of waves the first `most` are taken.
    pub fn at(&self, z: f64, inclined: f64, most: usize) -> DMatrix<f64> {
        let count = |modes: &MotionModes| modes.axial.nrows();
        let mut all = DMatrix::zeros(self.motions.iter().map(count).sum(), self.points);
        let mut first = 0;
        for modes in &self.motions {
            let g = match modes.motion {
                EndMotion::Apart => 1.0 - 2.0 * z / self.length,
                EndMotion::Along => 1.0,
            };
            let mut own = &modes.axial * (g * inclined);
            for wave in modes.waves.iter().filter(|wave| wave.wave < most) {
                let phase = wave.wave as f64 * std::f64::consts::PI * z / self.length;
                own += &wave.in_plane * phase.cos() + &wave.axial * (phase.sin() * inclined);
            }
            all.rows_mut(first, own.nrows()).copy_from(&own);
            first += own.nrows();
        }
        all
    }
}

/// The free ends of a prism, moved by some shapes.
pub struct FreeEnds<'p> {
    prism: &'p Prism<'p>,
    shapes: Vec<EndShape>,
    forces: Vec<EndForces>,
    points: Vec<(u32, Vec2)>,
    length: f64,
}

impl<'p> FreeEnds<'p> {
    /// `points`: nodes with the direction in the plane that is loaded and observed.
    ///
    /// # Errors
    /// [`FemError::Inverted`].
    pub fn new(
        prism: &'p Prism<'p>,
        shapes: Vec<EndShape>,
        points: Vec<(u32, Vec2)>,
        length: f64,
    ) -> Result<Self, FemError> {
        let forces = (shapes.par_iter())
            .map(|shape| prism.end_forces(shape))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            prism,
            shapes,
            forces,
            points,
            length,
        })
    }

    /// What a wave of the prism (its number in the length, 0 the even load) does under the shapes.
    pub fn answer(&self, wave: &Wave<'_>, number: usize) -> EndAnswer {
        EndAnswer::new(wave, number, self)
    }

    /// The modes, from the answers of all waves, the even load first.
    ///
    /// # Errors
    /// [`FemError::Inverted`].
    pub fn modes(&self, answers: &[EndAnswer]) -> Result<EndModes, FemError> {
        let (shapes, points) = (&self.shapes, &self.points);
        let axial = DMatrix::from_fn(shapes.len(), points.len(), |k, point| {
            shapes[k].0[points[point].0 as usize][2]
        });
        let of_motion = |motion| {
            let waves = answers.iter().enumerate();
            let own = || (waves.clone()).filter(move |(n, _)| EndMotion::of_wave(*n) == motion);
            let mut stiffness = self.prism.end_energy(shapes, motion, self.length)?;
            for (_, answer) in own() {
                stiffness -= &answer.work;
            }
            let softening = inverse_root(&stiffness);
            let wave = |(n, answer): (usize, &EndAnswer)| WaveMotion {
                wave: n,
                in_plane: &softening * &answer.in_plane,
                axial: &softening * &answer.axial,
            };
            Ok(MotionModes {
                motion,
                waves: own().map(wave).collect(),
                axial: &softening * &axial,
            })
        };
        Ok(EndModes {
            length: self.length,
            points: points.len(),
            motions: [of_motion(EndMotion::Apart)?, of_motion(EndMotion::Along)?],
        })
    }
}

/// What a wave does under the shapes.
#[derive(Debug)]
pub struct EndAnswer {
    /// L_nᵀ K_n⁻¹ L_n/h_n.
    work: DMatrix<f64>,
    /// As in [`WaveMotion`], by shape (row) and point (column).
    in_plane: DMatrix<f64>,
    axial: DMatrix<f64>,
}

impl EndAnswer {
    fn new(wave: &Wave<'_>, number: usize, ends: &FreeEnds<'_>) -> Self {
        let FreeEnds {
            shapes,
            forces,
            points,
            ..
        } = ends;
        let length = ends.length;
        let norm = if number == 0 { length } else { 0.5 * length };
        let forces: Vec<Vec<[f64; 3]>> =
            (forces.iter()).map(|f| f.on_wave(number, length)).collect();
        let fields: Vec<Vec<[f64; 3]>> = forces.iter().map(|f| wave.field(f)).collect();
        let work = |k: usize, l: usize| {
            let pairs = forces[k].iter().flatten().zip(fields[l].iter().flatten());
            pairs.map(|(f, u)| f * u).sum::<f64>() / norm
        };
        let share = along(number, length).q_cos;
        let in_plane = |k: usize, point: usize| {
            let (node, direction) = points[point];
            let [x, y, _] = fields[k][node as usize];
            let moved = share * shapes[k].in_plane(node) - Vec2::new(x, y);
            moved.dot(&direction) / norm
        };
        let axial = |k: usize, point: usize| -fields[k][points[point].0 as usize][2] / norm;
        Self {
            work: DMatrix::from_fn(shapes.len(), shapes.len(), work),
            in_plane: DMatrix::from_fn(shapes.len(), points.len(), in_plane),
            axial: DMatrix::from_fn(shapes.len(), points.len(), axial),
        }
    }
}

/// A matrix whose square, from its transpose, is the inverse of a symmetric one, without directions that are hardly there.
fn inverse_root(stiffness: &DMatrix<f64>) -> DMatrix<f64> {
    let spectrum = (0.5 * (stiffness + stiffness.transpose())).symmetric_eigen();
    let (values, vectors) = (&spectrum.eigenvalues, &spectrum.eigenvectors);
    let least = SAME * values.max();
    let kept: Vec<usize> = (0..values.len()).filter(|&m| values[m] > least).collect();
    DMatrix::from_fn(kept.len(), values.len(), |row, shape| {
        vectors[(shape, kept[row])] / values[kept[row]].sqrt()
    })
}
