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

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::FemError;
use super::assemble::lame_constants;
use super::triangle::{Element, ShapeAt, element_count};
use super::waves::{Prism, Wave};
use crate::mesh::Mesh;
use crate::numeric::Vec2;
use crate::numeric::quadrature::TRIANGLE_7;

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

/// One shape (P, Q, ψ) at each node.
#[derive(Debug, Clone)]
pub struct EndShape(Vec<[f64; 3]>);

impl EndShape {
    /// In the plane at a node: p = (P, Q).
    fn in_plane(&self, node: u32) -> Vec2 {
        let [p, q, _] = self.0[node as usize];
        Vec2::new(p, q)
    }
}

/// Integrals over the length of products of q, g and g' with each other and with a wave's cosine or sine.
struct Along {
    q_cos: f64,
    slope_cos: f64,
    g_sin: f64,
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
        let norm = if wave == 0 {
            self.length
        } else {
            0.5 * self.length
        };
        let mut waves = self.motions.iter().flat_map(|modes| &modes.waves);
        let own = waves.find(|own| own.wave == wave);
        own.map_or(0.0, |own| norm * own.in_plane.column(point).norm_squared())
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

/// Nodal forces of a shape, without the integrals over the length that they go with.
struct EndForces {
    /// With ∫ q cos: of the stresses in the plane; along the axis σ_zz, times the wave number.
    by_q: Vec<[f64; 3]>,
    /// With ∫ g' cos.
    by_slope: Vec<[f64; 3]>,
    /// With ∫ g sin: of σ_zx and σ_zy; in the plane times the wave number.
    by_g: Vec<[f64; 3]>,
}

impl EndForces {
    /// L_n: on one wave, integrated over the length.
    fn on_wave(&self, wave: usize, length: f64) -> Vec<[f64; 3]> {
        let number = wave as f64 * std::f64::consts::PI / length;
        let Along {
            q_cos,
            slope_cos,
            g_sin,
        } = along(wave, length);
        let nodes = self.by_q.iter().zip(&self.by_slope).zip(&self.by_g);
        nodes
            .map(|((q, slope), g)| {
                let in_plane =
                    |d: usize| q_cos * q[d] + slope_cos * slope[d] + number * g_sin * g[d];
                [
                    in_plane(0),
                    in_plane(1),
                    number * q_cos * q[2] + g_sin * g[2],
                ]
            })
            .collect()
    }
}

/// Strains of a shape at a point, without their functions of z.
struct Strains {
    xx: f64,
    yy: f64,
    xy: f64,
    /// ψ
    axial: f64,
    /// p + ∇ψ
    shear: Vec2,
}

fn along(wave: usize, length: f64) -> Along {
    let number = wave as f64 * std::f64::consts::PI / length;
    match wave {
        0 => Along {
            q_cos: length * length / 6.0,
            slope_cos: -2.0,
            g_sin: 0.0,
        },
        _ => Along {
            q_cos: -2.0 / (number * number),
            slope_cos: 0.0,
            g_sin: 2.0 / number,
        },
    }
}

impl Prism<'_> {
    /// Shapes for the ends under some `loads` (nodes, and directions in the plane): what the prism does along its axis, in waves of the wave numbers `answering` (1/mm), if
    /// σ_zz of the mirrors under these loads is taken off, for the even load and the longest wave along the `length`; and in waves of `pushed` under loads along the axis there.
    ///
    /// # Errors
    /// [`FemError`] if a stiffness cannot be factored.
    pub fn end_shapes(
        &self,
        length: f64,
        loads: &[(u32, Vec2)],
        answering: &[f64],
        pushed: &[f64],
    ) -> Result<Vec<EndShape>, FemError> {
        let mut forces = Vec::new();
        for number in [0.0, std::f64::consts::PI / length] {
            let wave = self.wave(number)?;
            for &(node, load) in loads {
                let mut nodal = vec![[0.0; 3]; self.nodes()];
                nodal[node as usize] = [load.x, load.y, 0.0];
                forces.push(self.axial_forces(&wave.field(&nodal), number)?);
            }
        }
        let mut shapes = Vec::new();
        for &number in answering {
            let wave = self.wave(number)?;
            let own = forces.par_iter().map(|f| self.end_shape(&wave.field(f)));
            shapes.extend(own.collect::<Vec<_>>());
        }
        for &number in pushed {
            let wave = self.wave(number)?;
            for &(node, _) in loads {
                let mut nodal = vec![[0.0; 3]; self.nodes()];
                nodal[node as usize][2] = 1.0;
                shapes.push(self.end_shape(&wave.field(&nodal)));
            }
        }
        Ok(shapes)
    }

    /// Nodal forces ∫ N σ_zz dA along the axis, of a wave's field.
    fn axial_forces(
        &self,
        field: &[[f64; 3]],
        wave_number: f64,
    ) -> Result<Vec<[f64; 3]>, FemError> {
        let (lambda, mu) = lame_constants(self.material);
        let mut forces = vec![[0.0; 3]; field.len()];
        self.at_points(|element, at, weight| {
            let nodes = || element.nodes().iter().zip(&at.gradient).zip(&at.value);
            let stress: f64 = nodes()
                .map(|((&node, gradient), value)| {
                    let [u, v, w] = field[node as usize];
                    lambda * (gradient.x * u + gradient.y * v)
                        + (lambda + 2.0 * mu) * wave_number * value * w
                })
                .sum();
            for ((&node, _), value) in nodes() {
                forces[node as usize][2] += weight * value * stress;
            }
        })?;
        Ok(forces)
    }

    /// The shape of which ψ is the displacement along the axis of a wave's `field`, with P, Q = −∇ψ as means of what the elements at a node have; held where the prism is.
    fn end_shape(&self, field: &[[f64; 3]]) -> EndShape {
        let mut slope = vec![(Vec2::zeros(), 0usize); field.len()];
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let middles = [[0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
        let places = [corners, middles].concat();
        for index in 0..element_count(&self.mesh.cells) {
            let element = Element::of(self.mesh, index);
            for (&node, [xi, eta]) in element.nodes().iter().zip(&places) {
                let at = element.at(*xi, *eta);
                let own = (element.nodes().iter().zip(&at.gradient))
                    .map(|(&b, gradient)| gradient * field[b as usize][2]);
                let (sum, count) = &mut slope[node as usize];
                *sum += own.sum::<Vec2>();
                *count += 1;
            }
        }
        let shape = field.iter().zip(slope).enumerate();
        let shape = shape.map(|(node, ([.., psi], (sum, count)))| {
            let slope = sum / count.max(1) as f64;
            match self.is_held(node) {
                true => [0.0; 3],
                false => [-slope.x, -slope.y, *psi],
            }
        });
        EndShape(shape.collect())
    }

    /// S_0 of shapes that move both ends so.
    fn end_energy(
        &self,
        shapes: &[EndShape],
        motion: EndMotion,
        length: f64,
    ) -> Result<DMatrix<f64>, FemError> {
        let (lambda, mu) = lame_constants(self.material);
        let b = length;
        // of q², q g', g'² and g²
        let [qq, q_slope, slopes, gg] = match motion {
            EndMotion::Apart => [b.powi(3) / 30.0, -b / 3.0, 4.0 / b, b / 3.0],
            EndMotion::Along => [b.powi(3) / 12.0, 0.0, 0.0, b],
        };
        let mut energy = DMatrix::zeros(shapes.len(), shapes.len());
        self.at_points(|element, at, weight| {
            let strains: Vec<Strains> = shapes.iter().map(|s| strains(s, element, at)).collect();
            for (k, s) in strains.iter().enumerate() {
                for (l, t) in strains[..=k].iter().enumerate() {
                    let (ds, dt) = (s.xx + s.yy, t.xx + t.yy);
                    let in_plane =
                        lambda * ds * dt + mu * (2.0 * (s.xx * t.xx + s.yy * t.yy) + s.xy * t.xy);
                    energy[(k, l)] += weight
                        * (qq * in_plane
                            + q_slope * lambda * (ds * t.axial + s.axial * dt)
                            + slopes * (lambda + 2.0 * mu) * s.axial * t.axial
                            + gg * mu * s.shear.dot(&t.shear));
                }
            }
        })?;
        energy.fill_upper_triangle_with_lower_triangle();
        Ok(energy)
    }

    /// Nodal forces of a shape on waves.
    fn end_forces(&self, shape: &EndShape) -> Result<EndForces, FemError> {
        let (lambda, mu) = lame_constants(self.material);
        let none = || vec![[0.0; 3]; self.mesh.points.len()];
        let [mut by_q, mut by_slope, mut by_g] = [none(), none(), none()];
        self.at_points(|element, at, weight| {
            let s = strains(shape, element, at);
            let mean = lambda * (s.xx + s.yy);
            let [xx, yy, xy] = [mean + 2.0 * mu * s.xx, mean + 2.0 * mu * s.yy, mu * s.xy];
            let shear = mu * s.shear;
            let nodes = element.nodes().iter().zip(&at.gradient).zip(&at.value);
            for ((&node, gradient), value) in nodes {
                let node = node as usize;
                let add = |forces: &mut Vec<[f64; 3]>, own: [f64; 3]| {
                    for (sum, own) in forces[node].iter_mut().zip(own) {
                        *sum += weight * own;
                    }
                };
                let x = gradient.x * xx + gradient.y * xy;
                let y = gradient.y * yy + gradient.x * xy;
                add(&mut by_q, [x, y, value * mean]);
                let axial = lambda * s.axial;
                add(&mut by_slope, [gradient.x * axial, gradient.y * axial, 0.0]);
                let turned = -*value * shear;
                add(&mut by_g, [turned.x, turned.y, gradient.dot(&shear)]);
            }
        })?;
        Ok(EndForces {
            by_q,
            by_slope,
            by_g,
        })
    }

    /// At the points of quadrature of all elements, with their weights.
    fn at_points(&self, mut of: impl FnMut(&Element, &ShapeAt, f64)) -> Result<(), FemError> {
        let mesh: &Mesh = self.mesh;
        for index in 0..element_count(&mesh.cells) {
            let element = Element::of(mesh, index);
            for point in &TRIANGLE_7 {
                let at = element.upright_at(point, index)?;
                of(&element, &at, point.weight * at.jacobian);
            }
        }
        Ok(())
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

fn strains(shape: &EndShape, element: &Element, at: &ShapeAt) -> Strains {
    let mut strains = Strains {
        xx: 0.0,
        yy: 0.0,
        xy: 0.0,
        axial: 0.0,
        shear: Vec2::zeros(),
    };
    let nodes = element.nodes().iter().zip(&at.gradient).zip(&at.value);
    for ((&node, gradient), value) in nodes {
        let [p, q, psi] = shape.0[node as usize];
        strains.xx += gradient.x * p;
        strains.yy += gradient.y * q;
        strains.xy += gradient.y * p + gradient.x * q;
        strains.axial += value * psi;
        strains.shear += *value * Vec2::new(p, q) + gradient * psi;
    }
    strains
}
