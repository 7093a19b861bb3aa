//! Rigid flat punch on a block of finite elements, fresh (benchmark B6) and wearing (F7).
//!
//! ```text
//! p(x) = F'/(π √(a² − x²))
//! ```
//! Johnson, Contact Mechanics (1985), Eq. (2.64). The block is a half disc of 60 a, held at its outer edge.

use std::f64::consts::PI;

use crate::analytic::half_plane::flat_punch_pressure;
use crate::contact::mortar::Facing;
use crate::contact::unilateral::Drive;
use crate::fem::structured::Order;
use crate::material::Elastic;
use crate::numeric::Vec2;
use crate::verify::half_bodies::{HalfBody, HalfBodySpec, Outline};
use crate::verify::sliding::{SlidingContact, value_at};
use crate::verify::two_bodies::{ElasticSide, Surface, TwoBodies, both};
use crate::verify::wear_punch::{DATA, graded_grid, table_rows};
use crate::verify::{CaseError, Measured, discipline};

/// ν of the block; its E follows from the contact modulus of [`DATA`].
const POISSON: f64 = 0.3;

/// A punch of half width a on a block; pressure on the corner nodes of the `elements` (even) edges under it.
fn punch(elements: usize) -> Result<TwoBodies, CaseError> {
    let (a, modulus, ..) = DATA;
    let surface = graded_grid(a, elements);
    let body = HalfBody::new(&HalfBodySpec {
        surface: &surface,
        radius: None,
        outline: Outline::Disc(60.0 * a),
        first_row: a * PI / elements as f64,
        growth: 1.12,
        order: Order::Quadratic,
    })?;
    let material = Elastic {
        youngs_modulus: modulus * (1.0 - POISSON * POISSON),
        poisson_ratio: POISSON,
    };
    let chain = Surface {
        nodes: &body.surface,
        arc: &body.arc,
        order: body.order,
    };
    let side = ElasticSide::new(&body.mesh, material, &both(&body.outer), chain, PI)?;
    Ok(TwoBodies::new(
        [Some(side), None],
        surface,
        Vec2::y(),
        |x| Facing {
            arc: [-x, 0.0],
            gap: 0.0,
        },
    ))
}

/// B6: pressure under the fresh punch, within 0.8 a.
///
/// # Errors
/// [`CaseError`] if the mesh is refused or the contact has no solution.
pub fn fresh(elements: usize) -> Result<Vec<Measured>, CaseError> {
    let (a, _, _, load) = DATA;
    let pair = punch(elements)?;
    let solution = pair.solve(Drive::Load(load))?;
    let exact = |x: f64| flat_punch_pressure(x, load, a);
    let at = format!("{elements} edges under the punch");
    let mut out: Vec<Measured> = [0.0, 0.5, 0.8]
        .into_iter()
        .map(|x| {
            let value = value_at(&pair.xi, &solution.pressure, x * a);
            Measured::relative(
                "B6",
                format!("{at}: p({x}a), MPa"),
                value,
                exact(x * a),
                0.02,
            )
        })
        .collect();
    let worst = (0..=160)
        .map(|i| a * (f64::from(i) / 100.0 - 0.8))
        .map(|x| (value_at(&pair.xi, &solution.pressure, x) / exact(x) - 1.0).abs())
        .fold(0.0, f64::max);
    out.push(Measured::bound(
        "B6",
        format!("{at}: largest relative error within 0.8a"),
        worst,
        0.02,
    ));
    out.extend(discipline("B6", &at, &solution));
    Ok(out)
}

/// F7 on the block of finite elements.
///
/// # Errors
/// [`CaseError`] if the mesh is refused, the contact has no solution or step control fails.
pub fn worn(elements: usize, tolerance: f64) -> Result<Vec<Measured>, CaseError> {
    let (_, _, k, load) = DATA;
    let pair = punch(elements)?;
    let mut system = SlidingContact::new(pair.xi, |_| 0.0, |_, _| pair.w, load, k);
    table_rows("F7", "block of elements", &mut system, DATA, tolerance)
}
