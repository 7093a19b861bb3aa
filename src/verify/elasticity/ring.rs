//! A4 thick ring and A5 the same nearly incompressible.

use std::f64::consts::FRAC_PI_2;

use crate::analytic::lame_ring::LameRing;
use crate::fem::structured::{Diagonals, Order, Patch};
use crate::fem::{Axis, Body, FemError, Stress, edge_traction, nodal_stress};
use crate::material::Elastic;
use crate::numeric::Vec2;
use crate::verify::Measured;

/// A4: ring 10 to 20 mm under 100 MPa inside, E 210 000 MPa, nu 0.3; stresses and displacements of Lamé within 0.5 %.
///
/// A quarter with symmetry lines, 12 x 16 cells of two T6; the worst node of each circle counts.
pub fn a4_thick_ring() -> Result<Vec<Measured>, FemError> {
    let ring = ring(0.3);
    let solved = solve(&ring, (12, 16), Order::Quadratic, Diagonals::Alternating)?;
    Ok([
        solved.displacements("A4", 0.005),
        solved.hoop_stresses("A4", 0.005),
    ]
    .concat())
}

/// A5: A4 with nu 0.4999, everything within 2 %: T6 displacements do not lock even on a coarse mesh (8 x 12 cells). The
/// mean stress, which nearly incompressible displacement elements know badly, needs 64 x 64 cells for the same figure.
pub fn a5_nearly_incompressible() -> Result<Vec<Measured>, FemError> {
    let ring = ring(0.4999);
    let coarse = solve(&ring, (8, 12), Order::Quadratic, Diagonals::Alternating)?;
    let fine = solve(&ring, (64, 64), Order::Quadratic, Diagonals::Alternating)?;
    Ok([
        coarse.displacements("A5", 0.02),
        fine.hoop_stresses("A5", 0.02),
    ]
    .concat())
}

/// Displacement of the bore over Lamé's with T3 on 16 x 24 cells (the nodes of the coarse mesh of A5), worst node: what is
/// left of the flexibility when linear triangles lock. Documentation, not a requirement.
pub fn linear_triangle_locking(poisson_ratio: f64, diagonals: Diagonals) -> Result<f64, FemError> {
    let figures =
        solve(&ring(poisson_ratio), (16, 24), Order::Linear, diagonals)?.displacements("A5", 0.02);
    Ok(figures[0].value / figures[0].target)
}

fn ring(poisson_ratio: f64) -> LameRing {
    LameRing {
        inner: 10.0,
        outer: 20.0,
        pressure: 100.0,
        youngs_modulus: 2.1e5,
        poisson_ratio,
    }
}

struct Solved<'a> {
    ring: &'a LameRing,
    patch: Patch,
    displacement: Vec<Vec2>,
    stress: Vec<Stress>,
}

fn solve<'a>(
    ring: &'a LameRing,
    cells: (usize, usize),
    order: Order,
    diagonals: Diagonals,
) -> Result<Solved<'a>, FemError> {
    let material = Elastic {
        youngs_modulus: ring.youngs_modulus,
        poisson_ratio: ring.poisson_ratio,
    };
    let patch = Patch::with_diagonals(cells.0, cells.1, order, diagonals, |s, t| {
        let (sin, cos) = (t * FRAC_PI_2).sin_cos();
        (ring.inner + (ring.outer - ring.inner) * s) * Vec2::new(cos, sin)
    })?;
    let fixed: Vec<_> = patch
        .bottom
        .iter()
        .map(|&n| (n, Axis::Y))
        .chain(patch.top.iter().map(|&n| (n, Axis::X)))
        .collect();
    let body = Body::with_fixed_dofs(&patch.mesh, material, &fixed, &[])?;
    let displacement = body.solve(&edge_traction(&patch.mesh, &patch.left, |_, normal| {
        -ring.pressure * normal
    }))?;
    let stress = nodal_stress(&patch.mesh, material, &displacement)?;
    Ok(Solved {
        ring,
        patch,
        displacement,
        stress,
    })
}

impl Solved<'_> {
    /// Radial displacement of the inner and outer circle.
    fn displacements(&self, id: &'static str, tolerance: f64) -> Vec<Measured> {
        let radial = |n: usize, e: Vec2| self.displacement[n].dot(&e);
        let target = |r: f64| self.ring.displacement(r);
        self.both_circles(id, "radial displacement, mm", tolerance, target, radial)
    }

    /// Hoop stress on the inner and outer circle.
    fn hoop_stresses(&self, id: &'static str, tolerance: f64) -> Vec<Measured> {
        let hoop = |n: usize, e: Vec2| {
            let s = &self.stress[n];
            s.xx * e.y * e.y + s.yy * e.x * e.x - 2.0 * s.xy * e.x * e.y
        };
        self.both_circles(
            id,
            "hoop stress, MPa",
            tolerance,
            |r| self.ring.hoop_stress(r),
            hoop,
        )
    }

    /// The value farthest from its target on each circle; `value` is given the node and the radial direction.
    fn both_circles(
        &self,
        id: &'static str,
        name: &str,
        tolerance: f64,
        target: impl Fn(f64) -> f64,
        value: impl Fn(usize, Vec2) -> f64,
    ) -> Vec<Measured> {
        [
            (&self.patch.left, self.ring.inner),
            (&self.patch.right, self.ring.outer),
        ]
        .into_iter()
        .map(|(nodes, radius)| {
            let target = target(radius);
            let values = nodes
                .iter()
                .map(|&n| value(n as usize, self.patch.mesh.points[n as usize].normalize()));
            let farther = |a: f64, b: f64| {
                if (b - target).abs() > (a - target).abs() {
                    b
                } else {
                    a
                }
            };
            let worst = values.fold(target, farther);
            Measured::relative(
                id,
                format!("{name}, at radius {radius} mm"),
                worst,
                target,
                tolerance,
            )
        })
        .collect()
    }
}
