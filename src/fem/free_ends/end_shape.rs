//! Shapes that move the ends of a prism: where they come from, their energy, and the forces on the waves that they come with.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::EndMotion;
use crate::fem::FemError;
use crate::fem::assemble::lame_constants;
use crate::fem::triangle::{Element, ShapeAt, element_count};
use crate::fem::waves::Prism;
use crate::mesh::Mesh;
use crate::numeric::Vec2;
use crate::numeric::quadrature::TRIANGLE_7;

/// One shape (P, Q, ψ) at each node.
#[derive(Debug, Clone)]
pub struct EndShape(pub(super) Vec<[f64; 3]>);

impl EndShape {
    /// In the plane at a node: p = (P, Q).
    pub(super) fn in_plane(&self, node: u32) -> Vec2 {
        let [p, q, _] = self.0[node as usize];
        Vec2::new(p, q)
    }
}

/// Integrals over the length of products of q, g and g' with each other and with a wave's cosine or sine.
pub(super) struct Along {
    pub(super) q_cos: f64,
    slope_cos: f64,
    g_sin: f64,
}

/// Nodal forces of a shape, without the integrals over the length that they go with.
pub(super) struct EndForces {
    /// With ∫ q cos: of the stresses in the plane; along the axis σ_zz, times the wave number.
    by_q: Vec<[f64; 3]>,
    /// With ∫ g' cos.
    by_slope: Vec<[f64; 3]>,
    /// With ∫ g sin: of σ_zx and σ_zy; in the plane times the wave number.
    by_g: Vec<[f64; 3]>,
}

impl EndForces {
    /// L_n: on one wave, integrated over the length.
    pub(super) fn on_wave(&self, wave: usize, length: f64) -> Vec<[f64; 3]> {
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

/// Of wave `wave`, 0 the even load.
pub(super) fn along(wave: usize, length: f64) -> Along {
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
    pub(super) fn end_energy(
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
    pub(super) fn end_forces(&self, shape: &EndShape) -> Result<EndForces, FemError> {
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
