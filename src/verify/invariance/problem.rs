//! A cylinder on a block, put in any of the ways that must not matter.

use std::f64::consts::PI;

use crate::analytic::hertz_line;
use crate::contact::mortar::Facing;
use crate::fem::structured::Order;
use crate::material::{Elastic, contact_modulus};
use crate::mesh::{Cells, Mesh};
use crate::numeric::{Vec2, rotate};
use crate::verify::CaseError;
use crate::verify::half_bodies::{HalfBody, HalfBodySpec, Outline, fine_surface};
use crate::verify::two_bodies::{ElasticSide, Surface, TwoBodies, both};

/// How the problem is put.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct View {
    /// Rotation of everything, rad.
    pub(super) rotation: f64,
    /// x → −x.
    pub(super) mirror: bool,
    /// Node numbers are shuffled.
    pub(super) renumber: bool,
    /// Factor of all lengths.
    pub(super) length: f64,
    /// Factor of both moduli.
    pub(super) stiffness: f64,
    /// The cylinder is body 0 and the grid lies on the block.
    pub(super) swap: bool,
    /// Gap added everywhere, mm (before scaling).
    pub(super) shift: f64,
}

pub(super) const PLAIN: View = View {
    rotation: 0.0,
    mirror: false,
    renumber: false,
    length: 1.0,
    stiffness: 1.0,
    swap: false,
    shift: 0.0,
};

pub(super) const LOAD: f64 = 10.0;
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

fn half_width() -> f64 {
    hertz_line::half_width(LOAD, RADIUS, contact_modulus(MATERIALS[0], MATERIALS[1]))
}

/// The cylinder touches the block off its middle by a fraction of an edge, mm.
pub(super) fn offset(per_half_width: usize) -> f64 {
    0.3 * half_width() / per_half_width as f64
}

/// Block and cylinder as the view has them.
pub(super) fn build(view: View, per_half_width: usize) -> Result<TwoBodies, CaseError> {
    let fine = 1.4 * half_width();
    let offset = offset(per_half_width);
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
    let xi = if view.swap {
        grid(&block, view, fine - offset)
    } else {
        grid(&cylinder, view, fine - offset)
    };
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
    Ok(TwoBodies::new(
        sides.map(Some),
        xi,
        rotate(Vec2::y(), view.rotation),
        |x| facing(x, view, offset),
    ))
}

/// The points along the tangent where the body that carries the grid has nodes, within `reach` mm of its middle.
fn grid(body: &HalfBody, view: View, reach: f64) -> Vec<f64> {
    // tangent coordinate in the plain view is x on the cylinder; the mirror turns it round
    let mut xi: Vec<f64> = body
        .arc
        .iter()
        .step_by(2)
        .filter(|s| s.abs() < 1.0001 * reach)
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
    xi
}

/// Where both surfaces face the point `x` of the tangent, mm, and how far they are apart.
fn facing(x: f64, view: View, offset: f64) -> Facing {
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
    let outer: Vec<u32> = body.outer.iter().map(|&n| number(n)).collect();
    let mut nodes: Vec<u32> = body.surface.iter().map(|&n| number(n)).collect();
    let mut arc: Vec<f64> = body.arc.iter().map(|s| s * view.length).collect();
    if view.mirror {
        nodes.reverse();
        arc.reverse();
        arc.iter_mut().for_each(|s| *s = -*s);
    }
    ElasticSide::new(
        &moved(&body.mesh, number, view),
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

/// The mesh as the view has it; `number`: the new number of a node.
fn moved(mesh: &Mesh, number: impl Fn(u32) -> u32, view: View) -> Mesh {
    let mut points = vec![Vec2::zeros(); mesh.points.len()];
    for (n, p) in mesh.points.iter().enumerate() {
        let p = if view.mirror {
            Vec2::new(-p.x, p.y)
        } else {
            *p
        };
        // the frame is turned by `turn`; the rest of the view's rotation is in the points themselves
        points[number(n as u32) as usize] = rotate(p, view.rotation) * view.length;
    }
    let Cells::T6(cells) = &mesh.cells else {
        unreachable!("the bodies are quadratic")
    };
    let cells = cells
        .iter()
        .map(|c| {
            let [a, b, c, d, e, f] = c.map(&number);
            if view.mirror {
                [a, c, b, f, e, d]
            } else {
                [a, b, c, d, e, f]
            }
        })
        .collect();
    Mesh {
        points,
        cells: Cells::T6(cells),
        flanks: Vec::new(),
        bore: Vec::new(),
    }
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
