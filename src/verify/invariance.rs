//! Contact does not depend on how a problem is put (benchmark B7).
//!
//! A cylinder of elements off the middle of a block of elements, both non-matching and of different materials, is solved
//! as it is and again rotated, mirrored, with renumbered nodes, with lengths or stiffness and load scaled, and with the
//! bodies swapped (the other body then carries the grid). Then: bodies apart, just touching, and overlapping at the start.

use std::f64::consts::PI;

use crate::analytic::hertz_line;
use crate::contact::mortar::Facing;
use crate::contact::unilateral::{Drive, UnilateralError};
use crate::fem::structured::Order;
use crate::material::{Elastic, contact_modulus};
use crate::mesh::{Cells, Mesh};
use crate::numeric::{Vec2, rotate};
use crate::verify::half_bodies::{HalfBody, HalfBodySpec, Outline, fine_surface};
use crate::verify::sliding::value_at;
use crate::verify::two_bodies::{ElasticSide, Surface, TwoBodies, both};
use crate::verify::{CaseError, Measured};

/// How the problem is put.
#[derive(Debug, Clone, Copy, PartialEq)]
struct View {
    /// Rotation of everything, rad.
    rotation: f64,
    /// x → −x.
    mirror: bool,
    /// Node numbers are shuffled.
    renumber: bool,
    /// Factor of all lengths.
    length: f64,
    /// Factor of both moduli.
    stiffness: f64,
    /// The cylinder is body 0 and the grid lies on the block.
    swap: bool,
    /// Gap added everywhere, mm (before scaling).
    shift: f64,
}

const PLAIN: View = View {
    rotation: 0.0,
    mirror: false,
    renumber: false,
    length: 1.0,
    stiffness: 1.0,
    swap: false,
    shift: 0.0,
};

const LOAD: f64 = 10.0;
const RADIUS: f64 = 8.0;
/// Block, cylinder.
const MATERIALS: [Elastic; 2] = [
    Elastic {
        youngs_modulus: 120.0,
        poisson_ratio: 0.2,
    },
    Elastic {
        youngs_modulus: 200.0,
        poisson_ratio: 0.3,
    },
];

/// B7 with `per_half_width` edges on the half width.
///
/// # Errors
/// [`CaseError`] if a mesh is refused or a contact has no solution.
pub fn all(per_half_width: usize) -> Result<Vec<Measured>, CaseError> {
    let solve = |view: View, drive: Drive| -> Result<(Vec<f64>, Vec<f64>, f64), CaseError> {
        let pair = build(view, per_half_width)?;
        let s = pair.solve(drive)?;
        Ok((pair.xi, s.pressure, s.approach))
    };
    let (xi, plain, approach) = solve(PLAIN, Drive::Load(LOAD))?;
    let peak = plain.iter().fold(0.0f64, |m, p| m.max(*p));
    let largest = |p: &[f64], scale: f64| {
        plain
            .iter()
            .zip(p)
            .map(|(a, b)| (b * scale - a).abs())
            .fold(0.0, f64::max)
            / peak
    };
    let mut out = Vec::new();
    let mut same = |name: &str, p: &[f64], scale: f64, tolerance: f64| {
        out.push(Measured::bound(
            "B7",
            format!("{name}: largest change of p over its peak"),
            largest(p, scale),
            tolerance,
        ));
    };
    for degrees in [30.0f64, 137.0] {
        let view = View {
            rotation: degrees.to_radians(),
            ..PLAIN
        };
        same(
            &format!("rotated by {degrees} deg"),
            &solve(view, Drive::Load(LOAD))?.1,
            1.0,
            1e-8,
        );
    }
    let mut mirrored = solve(
        View {
            mirror: true,
            ..PLAIN
        },
        Drive::Load(LOAD),
    )?
    .1;
    mirrored.reverse();
    same("mirrored", &mirrored, 1.0, 1e-8);
    same(
        "renumbered",
        &solve(
            View {
                renumber: true,
                ..PLAIN
            },
            Drive::Load(LOAD),
        )?
        .1,
        1.0,
        1e-8,
    );
    same(
        "lengths x 1000",
        &solve(
            View {
                length: 1000.0,
                ..PLAIN
            },
            Drive::Load(1000.0 * LOAD),
        )?
        .1,
        1.0,
        1e-8,
    );
    same(
        "E and load x 1000",
        &solve(
            View {
                stiffness: 1000.0,
                ..PLAIN
            },
            Drive::Load(1000.0 * LOAD),
        )?
        .1,
        1e-3,
        1e-8,
    );
    let (other, swapped, swapped_approach) = solve(
        View {
            swap: true,
            ..PLAIN
        },
        Drive::Load(LOAD),
    )?;
    // the other body's grid, whose origin is the block's middle, and the tangent runs the other way
    let mapped: Vec<f64> = xi
        .iter()
        .map(|x| value_at(&other, &swapped, -x - offset(per_half_width)))
        .collect();
    let rms = |p: &[f64]| p.iter().map(|p| p * p).sum::<f64>().sqrt();
    let change: Vec<f64> = plain.iter().zip(&mapped).map(|(a, b)| a - b).collect();
    let largest_swapped = swapped.iter().fold(0.0f64, |m, p| m.max(*p));
    out.push(Measured::relative(
        "B7",
        "bodies swapped: largest p, MPa",
        largest_swapped,
        peak,
        0.01,
    ));
    out.push(Measured::relative(
        "B7",
        "bodies swapped: approach, mm",
        swapped_approach,
        approach,
        0.01,
    ));
    if per_half_width >= 40 {
        // coarser grids differ by their interpolation of the kink at the contact's edge
        out.push(Measured::bound(
            "B7",
            "bodies swapped: change of p, root mean square over that of p",
            rms(&change) / rms(&plain),
            0.01,
        ));
    }

    let apart = View {
        shift: 0.1,
        ..PLAIN
    };
    let refused = matches!(
        solve(apart, Drive::Approach(0.05)),
        Err(CaseError::Contact(UnilateralError::Separated { .. }))
    );
    out.push(Measured::bound(
        "B7",
        "0.1 mm apart, pushed by 0.05 mm: 1 unless refused as separated",
        f64::from(u8::from(!refused)),
        0.0,
    ));
    let (_, far, closed) = solve(apart, Drive::Load(LOAD))?;
    out.push(Measured::bound(
        "B7",
        "0.1 mm apart under load: largest change of p over its peak",
        largest(&far, 1.0),
        1e-8,
    ));
    out.push(Measured::relative(
        "B7",
        "0.1 mm apart under load: approach, mm",
        closed,
        approach + 0.1,
        1e-10,
    ));
    let (_, touching, _) = solve(PLAIN, Drive::Load(1e-12 * LOAD))?;
    let carried = touching.iter().filter(|p| **p > 0.0).count();
    out.push(Measured::bound(
        "B7",
        "just touching, 1e-12 of the load: points in contact",
        carried as f64,
        2.0,
    ));
    let (_, overlap, _) = solve(
        View {
            shift: -0.1,
            ..PLAIN
        },
        Drive::Approach(approach - 0.1),
    )?;
    out.push(Measured::bound(
        "B7",
        "initial overlap 0.1 mm: largest change of p over its peak",
        largest(&overlap, 1.0),
        1e-8,
    ));
    Ok(out)
}

fn half_width() -> f64 {
    hertz_line::half_width(LOAD, RADIUS, contact_modulus(MATERIALS[0], MATERIALS[1]))
}

/// The cylinder touches the block off its middle by a fraction of an edge, mm.
fn offset(per_half_width: usize) -> f64 {
    0.3 * half_width() / per_half_width as f64
}

fn build(view: View, per_half_width: usize) -> Result<TwoBodies, CaseError> {
    let b = half_width();
    let offset = offset(per_half_width);
    let fine = 1.4 * b;
    let cells = |share: f64| 2 * (share * 1.4 * per_half_width as f64).ceil() as usize;
    let body = |radius, elements: usize| {
        let surface = fine_surface(fine, elements);
        HalfBody::new(&HalfBodySpec {
            surface: &surface,
            radius,
            outline: Outline::Disc(2.0 * RADIUS),
            first_row: 2.0 * fine / elements as f64,
            growth: 1.25,
            order: Order::Quadratic,
        })
    };
    let block = body(None, cells(1.2))?;
    let cylinder = body(Some(RADIUS), cells(1.0))?;
    // tangent coordinate in the plain view is x on the cylinder; the mirror turns it round
    let grid = if view.swap { &block } else { &cylinder };
    let mut xi: Vec<f64> = grid
        .arc
        .iter()
        .step_by(2)
        .filter(|s| s.abs() < 1.0001 * (fine - offset))
        .map(|s| {
            if view.swap {
                *s
            } else {
                RADIUS * (s / RADIUS).sin()
            }
        })
        .map(|x| view.length * if view.mirror { -x } else { x })
        .collect();
    xi.sort_by(f64::total_cmp);
    let cylinder_is = usize::from(!view.swap);
    let side = |body: &HalfBody, index: usize| {
        let is_cylinder = index == cylinder_is;
        let turn = if index == 1 { 0.0 } else { PI };
        let material = MATERIALS[usize::from(is_cylinder)];
        let material = Elastic {
            youngs_modulus: view.stiffness * material.youngs_modulus,
            ..material
        };
        placed(body, material, turn, view)
    };
    let sides = if view.swap {
        [side(&cylinder, 0)?, side(&block, 1)?]
    } else {
        [side(&block, 0)?, side(&cylinder, 1)?]
    };
    let facing = |x: f64| {
        // back to the plain lengths and the cylinder's side of the mirror
        let z = if view.mirror { -x } else { x } / view.length;
        // body 0 is turned by 180°, so its arc runs against the tangent; the block's origin is off by `offset`
        let sign = if view.mirror { -1.0 } else { 1.0 };
        let (on_cylinder, on_block) = if view.swap {
            (z + offset, z)
        } else {
            (z, z + offset)
        };
        let cylinder = RADIUS * (on_cylinder / RADIUS).asin();
        let arc = if view.swap {
            [-cylinder, on_block]
        } else {
            [-on_block, cylinder]
        };
        Facing {
            arc: arc.map(|s| s * sign * view.length),
            gap: view.length
                * (view.shift + RADIUS - (RADIUS * RADIUS - on_cylinder * on_cylinder).sqrt()),
        }
    };
    Ok(TwoBodies::new(
        sides.map(Some),
        xi,
        rotate(Vec2::y(), view.rotation),
        facing,
    ))
}

/// The body as the view has it: points moved, node numbers shuffled, mirrored triangles turned round.
fn placed(
    body: &HalfBody,
    material: Elastic,
    turn: f64,
    view: View,
) -> Result<ElasticSide, CaseError> {
    let count = body.mesh.points.len() as u32;
    // a stride without a common factor with the count is a permutation
    let stride = (count / 3..).find(|s| gcd(*s, count) == 1).unwrap_or(1);
    let number = |n: u32| {
        if view.renumber {
            (u64::from(n) * u64::from(stride) % u64::from(count)) as u32
        } else {
            n
        }
    };
    let mut points = vec![Vec2::zeros(); count as usize];
    for (n, p) in body.mesh.points.iter().enumerate() {
        let p = if view.mirror {
            Vec2::new(-p.x, p.y)
        } else {
            *p
        };
        // the frame is turned by `turn`; the rest of the view's rotation is in the points themselves
        points[number(n as u32) as usize] = rotate(p, view.rotation) * view.length;
    }
    let Cells::T6(cells) = &body.mesh.cells else {
        unreachable!("the bodies are quadratic")
    };
    let cells = cells
        .iter()
        .map(|c| {
            let [a, b, c, d, e, f] = c.map(number);
            if view.mirror {
                [a, c, b, f, e, d]
            } else {
                [a, b, c, d, e, f]
            }
        })
        .collect();
    let mesh = Mesh {
        points,
        cells: Cells::T6(cells),
        flanks: Vec::new(),
        bore: Vec::new(),
    };
    let outer: Vec<u32> = body.outer.iter().map(|&n| number(n)).collect();
    let mut nodes: Vec<u32> = body.surface.iter().map(|&n| number(n)).collect();
    let mut arc: Vec<f64> = body.arc.iter().map(|s| s * view.length).collect();
    if view.mirror {
        nodes.reverse();
        arc.reverse();
        arc.iter_mut().for_each(|s| *s = -*s);
    }
    ElasticSide::new(
        &mesh,
        material,
        &both(&outer),
        Surface {
            nodes: &nodes,
            arc: &arc,
            order: body.order,
        },
        turn,
    )
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
