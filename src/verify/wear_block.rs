//! Wear of an elastic cylinder on two blocks of finite elements (benchmark F6 on elements).
//!
//! Both bodies are flat half discs of 100 a₀ with non-matching meshes, the cylinder's curvature is in the gap; so the
//! bodies are half planes to (a/100 a₀)², and the table for the half plane is the target.

use std::f64::consts::PI;

use crate::analytic::cylinder_wear::HISTORY;
use crate::analytic::hertz_line;
use crate::contact::mortar::Facing;
use crate::fem::structured::Order;
use crate::numeric::Vec2;
use crate::verify::half_bodies::{HalfBody, HalfBodySpec, Outline, fine_surface};
use crate::verify::hertz_cylinders::MATERIAL;
use crate::verify::sliding::SlidingContact;
use crate::verify::two_bodies::{ElasticSide, Surface, TwoBodies, both};
use crate::verify::wear_half_plane::{DATA, table_rows};
use crate::verify::{CaseError, Measured};

/// F6 with `per_half_width` edges on a₀ of the coarser block, up to the σ `last`.
///
/// # Errors
/// [`CaseError`] if a mesh is refused, a contact has no solution or step control fails.
pub fn cylinder(
    per_half_width: usize,
    last: f64,
    tolerance: f64,
) -> Result<Vec<Measured>, CaseError> {
    let (load, radius, modulus, k) = DATA;
    let a0 = hertz_line::half_width(load, radius, modulus);
    let rows: Vec<_> = HISTORY.iter().filter(|row| row.sliding <= last).collect();
    let widest = rows.iter().map(|row| row.half_width).fold(1.0, f64::max) + 0.15;
    let upper = 2 * (widest * per_half_width as f64).ceil() as usize;
    let fine = 0.5 * a0 * upper as f64 / per_half_width as f64;
    let lower = 2 * (0.6 * upper as f64).ceil() as usize;
    let (lower, _) = block(fine, lower, PI, 100.0 * a0)?;
    let (upper, corners) = block(fine, upper, 0.0, 100.0 * a0)?;
    let xi: Vec<f64> = corners
        .into_iter()
        .filter(|x| x.abs() < 1.0001 * fine)
        .collect();
    let centre = xi.len() / 2;
    let gap = |x: f64| x * x / (2.0 * radius);
    let pair = TwoBodies::new([Some(lower), Some(upper)], xi, Vec2::y(), |x| Facing {
        arc: [-x, x],
        gap: gap(x),
    });
    let mut system = SlidingContact::new(pair.xi, gap, |_, _| pair.w, load, k);
    table_rows(
        "F6",
        "blocks of elements",
        &mut system,
        &rows,
        centre,
        [load, radius, modulus, a0],
        tolerance,
    )
}

fn block(
    fine: f64,
    elements: usize,
    turn: f64,
    size: f64,
) -> Result<(ElasticSide, Vec<f64>), CaseError> {
    let surface = fine_surface(fine, elements);
    let body = HalfBody::new(&HalfBodySpec {
        surface: &surface,
        radius: None,
        outline: Outline::Disc(size),
        first_row: 2.0 * fine / elements as f64,
        growth: 1.15,
        order: Order::Quadratic,
    })?;
    let chain = Surface {
        nodes: &body.surface,
        arc: &body.arc,
        order: body.order,
    };
    Ok((
        ElasticSide::new(&body.mesh, MATERIAL, &both(&body.outer), chain, turn)?,
        surface,
    ))
}
