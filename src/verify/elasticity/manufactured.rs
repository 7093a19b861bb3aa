//! A3: convergence to a manufactured solution.

use std::f64::consts::PI;

use super::STEEL;
use crate::fem::structured::{Order, Patch};
use crate::fem::{Body, FemError, body_force, elements, lame_constants};
use crate::mesh::Mesh;
use crate::numeric::Vec2;
use crate::numeric::quadrature::triangle_product;
use crate::verify::Measured;

/// A3: u_x = u_y = g = sin πx sin πy on the unit square under the body force that causes it.
///
/// ```text
/// b = −(λ + μ) grad div u − μ Δu        both components  π² [ (λ + 3 μ) g − (λ + μ) cos πx cos πy ]
/// ```
/// The mesh is a smoothly distorted grid, so that Jacobians vary and T6 edges are curved. Expected orders for smooth
/// solutions: k + 1 in L2 and k in the H1 seminorm for degree k (Ciarlet, The Finite Element Method for Elliptic Problems,
/// 1978, Theorems 3.2.2 and 3.2.5). The order is taken between the two finest meshes. A rate alone would pass a wrong
/// constant, so the finest solution must also be better, in energy, than the nodal interpolant of the exact one: it is
/// the best of all fields on that mesh (Céa's lemma, ibid. Theorem 2.4.1), up to the quadrature.
pub fn a3_manufactured() -> Result<Vec<Measured>, FemError> {
    let mut figures = Vec::new();
    for (name, order, coarse, degree) in [
        ("T3", Order::Linear, 32, 1.0),
        ("T6", Order::Quadratic, 16, 2.0),
    ] {
        let (coarse, fine) = (solve(coarse, order)?, solve(2 * coarse, order)?);
        let (from, to) = (errors(&coarse.0, &coarse.1), errors(&fine.0, &fine.1));
        let interpolant: Vec<Vec2> = fine.0.points.iter().map(|p| exact(*p).0).collect();
        let best = errors(&fine.0, &interpolant);
        let (l2, h1) = ((from.l2 / to.l2).log2(), (from.h1 / to.h1).log2());
        figures.push(at_least(
            format!("{name}: order in L2"),
            l2,
            degree + 1.0,
            0.1,
        ));
        figures.push(at_least(format!("{name}: order in H1"), h1, degree, 0.1));
        let name = format!("{name}: energy error over that of the interpolant (-)");
        figures.push(at_most(name, to.energy / best.energy, 1.0, 1e-3));
    }
    Ok(figures)
}

/// The mesh of n x n cells and its solution.
fn solve(n: usize, order: Order) -> Result<(Mesh, Vec<Vec2>), FemError> {
    let patch = Patch::new(n, n, order, |s, t| {
        let shift = 0.05 * (2.0 * PI * s).sin() * (2.0 * PI * t).sin();
        Vec2::new(s + shift, t - shift)
    })?;
    let rim: Vec<u32> = [&patch.bottom, &patch.right, &patch.top, &patch.left]
        .into_iter()
        .flatten()
        .copied()
        .collect();
    let (lambda, mu) = lame_constants(STEEL);
    let loads = body_force(&patch.mesh, |p| {
        let g = (PI * p.x).sin() * (PI * p.y).sin();
        let c = (PI * p.x).cos() * (PI * p.y).cos();
        let b = PI * PI * ((lambda + 3.0 * mu) * g - (lambda + mu) * c);
        Vec2::new(b, b)
    });
    let displacement = Body::new(&patch.mesh, STEEL, &rim, &[])?.solve(&loads)?;
    Ok((patch.mesh, displacement))
}

/// The exact displacement and its derivatives after x and y.
fn exact(p: Vec2) -> (Vec2, Vec2, Vec2) {
    let ((sx, cx), (sy, cy)) = ((PI * p.x).sin_cos(), (PI * p.y).sin_cos());
    let both = |v: f64| Vec2::new(v, v);
    (both(sx * sy), both(PI * cx * sy), both(PI * sx * cy))
}

/// Norms of the distance from the exact solution.
struct Errors {
    l2: f64,
    h1: f64,
    energy: f64,
}

fn errors(mesh: &Mesh, displacement: &[Vec2]) -> Errors {
    let (lambda, mu) = lame_constants(STEEL);
    let rule = triangle_product(6);
    let (mut l2, mut h1, mut energy) = (0.0, 0.0, 0.0);
    for element in elements(mesh) {
        for point in &rule {
            let at = element.at(point.xi, point.eta);
            let (u, dx, dy) = exact(at.position);
            let (mut u, mut dx, mut dy) = (-u, -dx, -dy);
            for (i, &node) in element.nodes().iter().enumerate() {
                u += at.value[i] * displacement[node as usize];
                dx += at.gradient[i].x * displacement[node as usize];
                dy += at.gradient[i].y * displacement[node as usize];
            }
            let weight = point.weight * at.jacobian;
            l2 += weight * u.norm_squared();
            h1 += weight * (dx.norm_squared() + dy.norm_squared());
            let (trace, shear) = (dx.x + dy.y, dx.y + dy.x);
            energy += weight
                * (lambda * trace * trace
                    + 2.0 * mu * (dx.x * dx.x + dy.y * dy.y)
                    + mu * shear * shear);
        }
    }
    Errors {
        l2: l2.sqrt(),
        h1: h1.sqrt(),
        energy: energy.sqrt(),
    }
}

/// A value of which only falling short of the target counts as error.
fn at_least(quantity: String, value: f64, target: f64, tolerance: f64) -> Measured {
    one_sided(quantity, value, target, target - value, tolerance)
}

/// A value of which only exceeding the target counts as error.
fn at_most(quantity: String, value: f64, target: f64, tolerance: f64) -> Measured {
    one_sided(quantity, value, target, value - target, tolerance)
}

fn one_sided(quantity: String, value: f64, target: f64, excess: f64, tolerance: f64) -> Measured {
    // Not `max`, which would drop a NaN.
    let error = if excess < 0.0 { 0.0 } else { excess };
    Measured {
        id: "A3",
        quantity,
        value,
        target,
        error,
        tolerance,
    }
}
