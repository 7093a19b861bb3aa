//! NAFEMS advanced contact benchmark 1, cylinder on block, without friction (benchmark B3).
//!
//! Cylinder R 50 mm, E 210 000 MPa; block 200 × 200 mm, E 70 000 MPa; ν 0.3, plane strain, 35 kN per mm of width, base
//! fixed. Hertz gives p₀ 3585.37 MPa and the half length 6.21 mm (Konter, Advanced Finite Element Contact Benchmarks,
//! NAFEMS 2006); u_y of the block's top on the axis −1.308 mm is the regression value of Code_Aster SSNP154 with quadratic
//! elements. Here the whole width is meshed and the cylinder is cut at its centre, where a rigid plate carries the force.

use std::f64::consts::PI;

use crate::analytic::half_plane_elements::hertz_half_width;
use crate::contact::mortar::Facing;
use crate::contact::unilateral::Drive;
use crate::fem::structured::Order;
use crate::material::{Elastic, contact_modulus};
use crate::numeric::Vec2;
use crate::verify::half_bodies::{HalfBody, HalfBodySpec, Outline, fine_surface};
use crate::verify::hertz_cylinders::{both, compare};
use crate::verify::two_bodies::{ElasticSide, Surface, TwoBodies};
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
    let b = hertz_half_width(LOAD, RADIUS, contact_modulus(MATERIALS[0], MATERIALS[1]));
    let p0 = 2.0 * LOAD / (PI * b);
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
    let chain = |body: &HalfBody| (body.surface.clone(), body.arc.clone(), body.order);
    let side = |body: &HalfBody, material, fixed: &[u32], turn| {
        let (nodes, arc, order) = chain(body);
        ElasticSide::new(
            &body.mesh,
            material,
            &both(fixed),
            Surface {
                nodes: &nodes,
                arc: &arc,
                order,
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
            -1.308,
            0.01,
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
