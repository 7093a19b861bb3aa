//! Meshes of half-plane-like bodies, fine where they touch: blocks, half discs and half cylinders.
//!
//! ```text
//! z = (c/2) (e^ζ + g e^−ζ),  ζ = μ + i ϑ      confocal ellipses: the surface −c < x < c is μ = 0, g falls from 1 to 0
//! w = z / (1 − i z/2R)                        bends the half plane into a disc of radius R, and the half disc |z| < 2R
//!                                             into the half cylinder with a flat top through its centre
//! ```
//! Both maps are conformal (the first nearly), so triangles keep their shape while they grow with the distance from the
//! contact. A body lies above its surface, which touches y = 0 at the origin. Edges on the surface are curved (T6 with the
//! mid-side node at the middle of the arc); all others are straight.

use crate::fem::FemError;
use crate::fem::structured::{Order, Patch};
use crate::mesh::{Cells, Mesh};
use crate::numeric::Vec2;

/// What bounds the body away from its surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outline {
    /// A half disc with this radius, mm, round the contact (before bending).
    Disc(f64),
    /// A block with this half width and height, mm.
    Block(f64, f64),
}

/// Shape and resolution of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfBodySpec<'a> {
    /// Arc coordinates of the surface's corner nodes from −c to c, mm; an even number of edges.
    pub surface: &'a [f64],
    /// Radius of the surface, mm; `None` for a flat one.
    pub radius: Option<f64>,
    /// Outer bound.
    pub outline: Outline,
    /// Height of the first row of triangles, mm.
    pub first_row: f64,
    /// Ratio of the heights of successive rows, until triangles are about as high as wide.
    pub growth: f64,
    /// Linear or quadratic triangles.
    pub order: Order,
}

/// A body with the places that supports and loads need.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfBody {
    /// The mesh, above its surface.
    pub mesh: Mesh,
    /// Surface nodes in ascending x, with mid-side nodes.
    pub surface: Vec<u32>,
    /// Arc coordinate of each surface node, mm, 0 at the origin.
    pub arc: Vec<f64>,
    /// Outer nodes, counter-clockwise (the body on the left).
    pub outer: Vec<u32>,
    /// Nodes on the line x = 0 (of a symmetric surface), from the surface up.
    pub axis: Vec<u32>,
    /// 2 for T6, 1 for T3.
    pub order: usize,
}

impl HalfBody {
    /// Meshes the body.
    ///
    /// # Errors
    /// [`FemError::Empty`] if `surface` has no edges.
    pub fn new(spec: &HalfBodySpec) -> Result<Self, FemError> {
        let edges = spec.surface.len().saturating_sub(1);
        let order = match spec.order {
            Order::Linear => 1,
            Order::Quadratic => 2,
        };
        let arc = with_middles(spec.surface, order);
        let c = flat(spec.surface[edges], spec.radius);
        let rows = with_middles(&rows(spec, c), order);
        let (columns, levels) = (arc.len(), rows.len());
        let place = |s: f64, t: f64| {
            let i = (s * (columns - 1) as f64).round() as usize;
            let j = (t * (levels - 1) as f64).round() as usize;
            let x = (flat(arc[i], spec.radius) / c).clamp(-1.0, 1.0);
            let z = confocal(x.acos(), rows[j], c, rows[levels - 1], spec.outline);
            spec.radius.map_or(z, |r| bend(z, r))
        };
        let mut patch = Patch::new(edges, (levels - 1) / order, spec.order, place)?;
        if let Outline::Block(half_width, height) = spec.outline {
            for x in [-half_width, half_width] {
                snap(
                    &mut patch.mesh,
                    patch.top.iter().step_by(order),
                    Vec2::new(x, height),
                );
            }
        }
        straighten(&mut patch.mesh, &patch.bottom);
        let axis = if arc[(columns - 1) / 2] == 0.0 {
            (0..levels)
                .map(|j| patch.node((columns - 1) / 2, j))
                .collect()
        } else {
            Vec::new()
        };
        Ok(Self {
            outer: patch.top,
            surface: patch.bottom,
            mesh: patch.mesh,
            arc,
            axis,
            order,
        })
    }
}

/// Corner nodes of a surface: `elements` (even) equal edges on −`fine`..`fine`, then as the confocal map likes them.
pub fn fine_surface(fine: f64, elements: usize) -> Vec<f64> {
    let c = fine / FINE_SHARE;
    let h = 2.0 * fine / elements as f64;
    let angle = FINE_SHARE.acos();
    let outside = (angle * c * angle.sin() / h).ceil().max(2.0) as usize;
    // keep the number of edges even whatever `elements` is
    let wing: Vec<f64> = (0..outside)
        .map(|i| c * (angle * i as f64 / outside as f64).cos())
        .collect();
    let mut x: Vec<f64> = wing.iter().map(|x| -x).collect();
    x.extend((0..=elements).map(|i| {
        if 2 * i == elements {
            0.0
        } else {
            -fine + h * i as f64
        }
    }));
    x.extend(wing.iter().rev());
    x
}

/// Share of c with equal edges.
const FINE_SHARE: f64 = 0.8;
/// Largest step of μ: triangles about three times as high as wide at most.
const LARGEST_ROW: f64 = 0.3;

/// μ of the corner rows, from 0 to the outline.
fn rows(spec: &HalfBodySpec, c: f64) -> Vec<f64> {
    let reach = match spec.outline {
        Outline::Disc(radius) => radius,
        Outline::Block(half_width, height) => half_width.min(height),
    };
    let end = (2.0 * reach / c).ln();
    let mut mu = vec![0.0];
    let mut step = spec.first_row / c;
    while mu[mu.len() - 1] < end {
        mu.push(mu[mu.len() - 1] + step);
        step = (step * spec.growth).min(LARGEST_ROW);
    }
    let stretch = end / mu[mu.len() - 1];
    mu.iter().map(|m| m * stretch).collect()
}

/// The nodes of a chain: corners and, for order 2, the middles between them.
fn with_middles(corners: &[f64], order: usize) -> Vec<f64> {
    if order == 1 {
        return corners.to_vec();
    }
    let mut out: Vec<f64> = corners
        .windows(2)
        .flat_map(|w| [w[0], 0.5 * (w[0] + w[1])])
        .collect();
    out.extend(corners.last());
    out
}

/// Place on the real axis that bends to the arc coordinate `arc`.
fn flat(arc: f64, radius: Option<f64>) -> f64 {
    radius.map_or(arc, |r| 2.0 * r * (arc / (2.0 * r)).tan())
}

fn bend(z: Vec2, radius: f64) -> Vec2 {
    // z / (1 − i z/2R) with 1 − i z/2R = (1 + y/2R) − i x/2R
    let d = Vec2::new(1.0 + z.y / (2.0 * radius), -z.x / (2.0 * radius));
    Vec2::new(z.x * d.x + z.y * d.y, z.y * d.x - z.x * d.y) / d.norm_squared()
}

fn confocal(theta: f64, mu: f64, c: f64, end: f64, outline: Outline) -> Vec2 {
    let g = 1.0 - (mu / end).powi(2);
    let (grow, fall) = (mu.exp(), g * (-mu).exp());
    let z = Vec2::new((grow + fall) * theta.cos(), (grow - fall) * theta.sin()) * (0.5 * c);
    match outline {
        Outline::Disc(_) => z,
        Outline::Block(half_width, height) => {
            let reach = half_width.min(height);
            let start = 0.4 * end;
            let blend = ((mu - start) / (end - start)).max(0.0).powi(2);
            let direction = z / z.norm().max(f64::MIN_POSITIVE);
            let to_outline = (half_width / direction.x.abs()).min(height / direction.y.abs());
            z * (1.0 + blend * (to_outline / reach - 1.0))
        }
    }
}

/// Moves the nearest of `nodes` to `corner`.
fn snap<'a>(mesh: &mut Mesh, nodes: impl Iterator<Item = &'a u32>, corner: Vec2) {
    let distance = |n: u32| (mesh.points[n as usize] - corner).norm();
    if let Some(&nearest) = nodes.min_by(|a, b| distance(**a).total_cmp(&distance(**b))) {
        mesh.points[nearest as usize] = corner;
    }
}

/// Puts mid-side nodes on straight edges, except those of the surface.
fn straighten(mesh: &mut Mesh, surface: &[u32]) {
    let Cells::T6(cells) = &mesh.cells else {
        return;
    };
    let mut on_surface = vec![false; mesh.points.len()];
    surface.iter().for_each(|&n| on_surface[n as usize] = true);
    for cell in cells {
        for (a, b, middle) in [(0, 1, 3), (1, 2, 4), (2, 0, 5)] {
            let (a, b, middle) = (cell[a] as usize, cell[b] as usize, cell[middle] as usize);
            if !on_surface[middle] {
                mesh.points[middle] = 0.5 * (mesh.points[a] + mesh.points[b]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_cylinder_has_its_outline_and_its_area() {
        let surface = fine_surface(0.9, 16);
        let spec = HalfBodySpec {
            surface: &surface,
            radius: Some(8.0),
            outline: Outline::Disc(16.0),
            first_row: 0.1,
            growth: 1.2,
            order: Order::Quadratic,
        };
        let body = HalfBody::new(&spec).unwrap();
        for &n in &body.surface {
            let p = body.mesh.points[n as usize];
            assert!(((p - Vec2::new(0.0, 8.0)).norm() - 8.0).abs() < 1e-12);
        }
        for &n in &body.outer {
            assert!((body.mesh.points[n as usize].y - 8.0).abs() < 1e-12);
        }
        for &n in &body.axis {
            assert!(body.mesh.points[n as usize].x.abs() < 1e-12);
        }
        let Cells::T6(cells) = &body.mesh.cells else {
            panic!("quadratic was asked for")
        };
        let areas: Vec<f64> = cells
            .iter()
            .map(|c| {
                let [a, b, c] = [0, 1, 2].map(|i| body.mesh.points[c[i] as usize]);
                0.5 * crate::numeric::cross(b - a, c - a)
            })
            .collect();
        assert!(areas.iter().all(|a| *a > 0.0));
        let total: f64 = areas.iter().sum();
        // chords of the circle lose a little
        assert!(
            (total / (0.5 * std::f64::consts::PI * 64.0) - 1.0).abs() < 0.02,
            "{total}"
        );
    }

    #[test]
    fn block_reaches_its_sides() {
        let surface = fine_surface(1.0, 12);
        let spec = HalfBodySpec {
            surface: &surface,
            radius: None,
            outline: Outline::Block(20.0, 40.0),
            first_row: 0.2,
            growth: 1.2,
            order: Order::Quadratic,
        };
        let body = HalfBody::new(&spec).unwrap();
        let size = body
            .mesh
            .points
            .iter()
            .fold(Vec2::zeros(), |m: Vec2, p| m.sup(&p.abs()));
        let corners = body
            .outer
            .iter()
            .map(|&n| body.mesh.points[n as usize].abs());
        assert_eq!(corners.filter(|p| *p == Vec2::new(20.0, 40.0)).count(), 2);
        assert!((size.x - 20.0).abs() < 1e-12 && (size.y - 40.0).abs() < 1e-12);
    }
}
