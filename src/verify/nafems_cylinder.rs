//! NAFEMS advanced contact benchmark 1, cylinder on block, without friction (benchmark B3).
//!
//! Cylinder R 50 mm, E 210 000 MPa; block 200 × 200 mm, E 70 000 MPa; ν 0.3, plane strain, 35 kN per mm of width, base
//! clamped. Hertz gives p₀ 3585.37 MPa and the half length 6.21 mm (Konter, Advanced Finite Element Contact Benchmarks,
//! NAFEMS 2006). Here the whole width is meshed and the cylinder is cut at its centre, where a rigid plate carries the
//! force.
//!
//! The settlement of the block's top on the axis is compared with a second mesh of the block (a rectangle of stretched
//! rows and columns) under Hertz's pressure as a given load. The value −1.308 mm kept by Code_Aster SSNP154 is not a target:
//! that case is run with large displacements (`GROT_GDEP`), and strains reach some 5 % here; small strain gives 2.1 % less.

use std::f64::consts::PI;

use crate::analytic::hertz_line;
use crate::contact::mortar::Facing;
use crate::contact::unilateral::Drive;
use crate::fem::structured::{Order, Patch};
use crate::fem::{Body, edge_traction};
use crate::material::{Elastic, contact_modulus};
use crate::numeric::Vec2;
use crate::verify::half_bodies::{HalfBody, HalfBodySpec, Outline, fine_surface};
use crate::verify::hertz_cylinders::compare;
use crate::verify::two_bodies::{ElasticSide, Surface, TwoBodies, both};
use crate::verify::{CaseError, Measured, discipline};

/// Line load, N/mm; cylinder radius, mm.
const LOAD: f64 = 35_000.0;
const RADIUS: f64 = 50.0;
/// Block and cylinder.
const MATERIALS: [Elastic; 2] = [
    Elastic {
        youngs_modulus: 70_000.0,
        poisson_ratio: 0.3,
    },
    Elastic {
        youngs_modulus: 210_000.0,
        poisson_ratio: 0.3,
    },
];

/// B3 with `per_half_length` edges on the half length; 12 is the least that the tolerances are meant for.
///
/// # Errors
/// [`CaseError`] if a mesh is refused or the contact has no solution.
pub fn frictionless(per_half_length: usize) -> Result<Vec<Measured>, CaseError> {
    let b = hertz_line::half_width(LOAD, RADIUS, contact_modulus(MATERIALS[0], MATERIALS[1]));
    let p0 = 2.0 * LOAD / (PI * b);
    let (pair, axis_top) = cylinder_on_block(b, per_half_length)?;
    let solution = pair.solve(Drive::Load(LOAD))?;
    let fit = compare(&pair.xi, &solution, b, p0);
    // the block is turned by 180°: up in its frame is down
    let sunk = -pair.displacement(0, &solution)?[axis_top as usize].y;
    let at = format!("{per_half_length} edges per half length");
    let mut out = vec![
        Measured::relative(
            "B3",
            format!("{at}: p(0), MPa"),
            fit.centre * p0,
            3585.37,
            0.02,
        ),
        Measured::absolute(
            "B3",
            format!("{at}: half length, mm"),
            fit.half_width * b,
            6.21,
            b / per_half_length as f64,
        ),
        Measured::relative(
            "B3",
            format!("{at}: u_y of the block's top on the axis, mm"),
            sunk,
            block_under_hertz_pressure(b, p0)?,
            0.002,
        ),
        Measured::bound(
            "B3",
            format!("{at}: balance of the load"),
            (pair.resultant(&solution.pressure) / LOAD - 1.0).abs(),
            1e-10,
        ),
    ];
    out.extend(discipline("B3", &at, &solution));
    Ok(out)
}

/// The cylinder on the block, with so many edges on the half length `b` (mm), and the node of the block's top on the axis.
fn cylinder_on_block(b: f64, per_half_length: usize) -> Result<(TwoBodies, u32), CaseError> {
    let fine = 1.25 * b;
    let upper = 2 * (1.25 * per_half_length as f64).ceil() as usize;
    let lower = 2 * (0.6 * upper as f64).ceil() as usize;
    let body = |radius, outline, elements| {
        let surface = fine_surface(fine, elements);
        HalfBody::new(&HalfBodySpec {
            surface: &surface,
            radius,
            outline,
            first_row: 2.0 * fine / elements as f64,
            growth: 1.15,
            order: Order::Quadratic,
        })
    };
    let block = body(None, Outline::Block(100.0, 200.0), lower)?;
    let cylinder = body(Some(RADIUS), Outline::Disc(2.0 * RADIUS), upper)?;
    let base: Vec<u32> = block
        .outer
        .iter()
        .copied()
        .filter(|&n| block.mesh.points[n as usize].y > 200.0 - 1e-6)
        .collect();
    let axis_top = block.surface[block.surface.len() / 2];
    let side = |body: &HalfBody, material, fixed: &[u32], turn| {
        ElasticSide::new(
            &body.mesh,
            material,
            &both(fixed),
            Surface {
                nodes: &body.surface,
                arc: &body.arc,
                order: body.order,
            },
            turn,
        )
    };
    let sides = [
        Some(side(&block, MATERIALS[0], &base, PI)?),
        Some(side(&cylinder, MATERIALS[1], &cylinder.outer, 0.0)?),
    ];
    let mut xi: Vec<f64> = cylinder
        .arc
        .iter()
        .filter(|s| s.abs() < 1.0001 * fine)
        .map(|s| RADIUS * (s / RADIUS).sin())
        .collect();
    xi.dedup();
    let pair = TwoBodies::new(sides, xi, Vec2::y(), |x| Facing {
        arc: [-x, RADIUS * (x / RADIUS).asin()],
        gap: RADIUS - (RADIUS * RADIUS - x * x).sqrt(),
    });
    Ok((pair, axis_top))
}

/// u_y of the top on the axis of a block meshed by rows and columns under Hertz's pressure, mm.
fn block_under_hertz_pressure(b: f64, p0: f64) -> Result<f64, CaseError> {
    let n = 80;
    let stretch = |z: f64| (5.0 * z).sinh() / 5f64.sinh();
    let patch = Patch::new(n, n, Order::Quadratic, |s, t| {
        Vec2::new(100.0 * stretch(2.0 * s - 1.0), -200.0 * stretch(1.0 - t))
    })?;
    let mut loads = edge_traction(&patch.mesh, &patch.top, |x, _| {
        Vec2::new(0.0, -p0 * (1.0 - (x.x / b).powi(2)).max(0.0).sqrt())
    });
    // the kink at the edge of the contact costs the quadrature a few parts in 10⁴ of the load
    let total: f64 = loads.iter().map(|l| -l.1.y).sum();
    loads.iter_mut().for_each(|l| l.1 *= LOAD / total);
    let body = Body::new(&patch.mesh, MATERIALS[0], &patch.bottom, &[])?;
    Ok(body.solve(&loads)?[patch.top[n] as usize].y)
}
