//! A6 elliptic membrane, A7 cantilever, A8 Cook's membrane, A9 the residual of their solutions.

use std::f64::consts::FRAC_PI_2;

use super::STEEL;
use crate::analytic::cantilever::Cantilever;
use crate::fem::structured::{Order, Patch};
use crate::fem::{
    Axis, Body, FemError, RESIDUAL_LIMIT, Solution, edge_traction, nodal_stress,
    plane_stress_equivalent, strain_energy,
};
use crate::material::Elastic;
use crate::numeric::Vec2;
use crate::verify::Measured;

/// A6: NAFEMS LE1, a quarter of a membrane between two ellipses under 10 MPa outward on its outer edge: σ_yy at (2, 0) m.
///
/// Target 92.7 MPa (NAFEMS, The Standard NAFEMS Benchmarks, 1990, test LE1); the in-plane stresses do not depend on
/// Poisson's ratio, so plane strain has the same target. 2 %.
pub fn a6_elliptic_membrane() -> Result<Vec<Measured>, FemError> {
    let (patch, solution) = elliptic_membrane()?;
    let stress = nodal_stress(&patch.mesh, STEEL, &solution.displacement)?;
    let value = stress[patch.node(0, 0) as usize].yy;
    Ok(vec![Measured::relative(
        "A6",
        "normal stress yy at (2, 0) m, MPa",
        value,
        92.7,
        0.02,
    )])
}

/// A7: cantilever L 48, D 12, E 30 000, nu 0.3, P 1000 in plane stress, exact displacements at the root and exact
/// tractions at the end; tip deflection and energy within 0.1 %.
pub fn a7_cantilever() -> Result<Vec<Measured>, FemError> {
    let (patch, solution) = cantilever()?;
    let material = plane_stress_equivalent(BEAM_MATERIAL);
    let tip = solution.displacement[patch.right[patch.right.len() / 2] as usize].y;
    let energy = strain_energy(&patch.mesh, material, &solution.displacement)?;
    Ok(vec![
        Measured::relative("A7", "tip deflection, mm", tip, BEAM.tip(), 0.001),
        Measured::relative("A7", "elastic energy, N", energy, BEAM.energy(), 0.001),
    ])
}

/// A8: Cook's membrane, E 1, nu 1/3 in plane stress, unit shear load on the right edge: vertical displacement of the
/// middle of that edge.
///
/// Target 23.96 (Simo & Rifai, Int. J. Numer. Methods Eng. 29 (1990) 1595, refined meshes). 0.5 %.
pub fn a8_cook() -> Result<Vec<Measured>, FemError> {
    let (patch, solution) = cook()?;
    let tip = solution.displacement[patch.right[patch.right.len() / 2] as usize].y;
    Ok(vec![Measured::relative(
        "A8",
        "vertical displacement of (48, 52), mm",
        tip,
        23.96,
        0.005,
    )])
}

/// A9: relative residual of the solutions of A6 to A8.
pub fn a9_residual() -> Result<Vec<Measured>, FemError> {
    let solutions = [
        ("A6", elliptic_membrane()?.1),
        ("A7", cantilever()?.1),
        ("A8", cook()?.1),
    ];
    Ok(solutions
        .into_iter()
        .map(|(case, s)| {
            Measured::bound(
                "A9",
                format!("residual of {case} (-)"),
                s.residual,
                RESIDUAL_LIMIT,
            )
        })
        .collect())
}

fn elliptic_membrane() -> Result<(Patch, Solution), FemError> {
    let patch = Patch::new(32, 32, Order::Quadratic, |s, t| {
        let (sin, cos) = (t * FRAC_PI_2).sin_cos();
        1000.0 * Vec2::new((2.0 + 1.25 * s) * cos, (1.0 + 1.75 * s) * sin)
    })?;
    let fixed: Vec<_> = patch
        .bottom
        .iter()
        .map(|&n| (n, Axis::Y))
        .chain(patch.top.iter().map(|&n| (n, Axis::X)))
        .collect();
    let loads = edge_traction(&patch.mesh, &patch.right, |_, normal| 10.0 * normal);
    let solution =
        Body::with_fixed_dofs(&patch.mesh, STEEL, &fixed, &[])?.solve_with(&loads, &[])?;
    Ok((patch, solution))
}

const BEAM_MATERIAL: Elastic = Elastic {
    youngs_modulus: 3e4,
    poisson_ratio: 0.3,
};
const BEAM: Cantilever = Cantilever {
    length: 48.0,
    depth: 12.0,
    load: 1000.0,
    youngs_modulus: BEAM_MATERIAL.youngs_modulus,
    poisson_ratio: BEAM_MATERIAL.poisson_ratio,
};

fn cantilever() -> Result<(Patch, Solution), FemError> {
    let map = |s: f64, t: f64| Vec2::new(BEAM.length * s, BEAM.depth * (t - 0.5));
    let patch = Patch::new(24, 6, Order::Quadratic, map)?;
    let body = Body::new(
        &patch.mesh,
        plane_stress_equivalent(BEAM_MATERIAL),
        &patch.left,
        &[],
    )?;
    let prescribed: Vec<_> = patch
        .left
        .iter()
        .flat_map(|&n| {
            let p = patch.mesh.points[n as usize];
            let (ux, uy) = BEAM.displacement(p.x, p.y);
            [(n, Axis::X, ux), (n, Axis::Y, uy)]
        })
        .collect();
    let loads = edge_traction(&patch.mesh, &patch.right, |p, _| {
        let (normal, shear) = BEAM.stress(p.x, p.y);
        Vec2::new(normal, shear)
    });
    let solution = body.solve_with(&loads, &prescribed)?;
    Ok((patch, solution))
}

fn cook() -> Result<(Patch, Solution), FemError> {
    let map = |s: f64, t: f64| Vec2::new(48.0 * s, (1.0 - t) * 44.0 * s + t * (44.0 + 16.0 * s));
    let patch = Patch::new(32, 32, Order::Quadratic, map)?;
    let material = plane_stress_equivalent(Elastic {
        youngs_modulus: 1.0,
        poisson_ratio: 1.0 / 3.0,
    });
    let body = Body::new(&patch.mesh, material, &patch.left, &[])?;
    let loads = edge_traction(&patch.mesh, &patch.right, |_, _| Vec2::new(0.0, 1.0 / 16.0));
    let solution = body.solve_with(&loads, &[])?;
    Ok((patch, solution))
}
