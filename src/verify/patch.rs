//! Contact patch test: two stacked blocks with non-matching meshes must carry a uniform pressure (benchmark B1).
//!
//! ```text
//! ν = 0, pushed by δ     p = E δ/2,   u_y(interface) = −δ/2          heights 1 and 1, width 1
//! ν > 0, load p          ε_x = ν(1+ν) p/E,   ε_y = −(1−ν²) p/E       held ends follow the lateral expansion
//! ```
//! The test of El-Abbasi & Bathe, Comput. Struct. 79 (2001), with the numbers of the Code_Aster case SSNP121. Mortar
//! integration on the common refinement is exact for it, hence the tolerance of 1e-8.

use crate::contact::mortar::Facing;
use crate::contact::unilateral::Drive;
use crate::fem::structured::{Order, Patch};
use crate::fem::{Axis, edge_traction};
use crate::material::Elastic;
use crate::numeric::{Vec2, rotate};
use crate::verify::two_bodies::{ElasticSide, Surface, TwoBodies, both};
use crate::verify::{CaseError, Measured, discipline};

/// How the upper block is pushed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Push {
    /// By a given approach of its held top.
    Approach,
    /// By a given load on its held top, which follows the lateral expansion.
    Load,
    /// By a pressure on its free top.
    Pressure,
}

/// One patch test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchTest {
    /// Interface edges of lower and upper block.
    pub edges: [usize; 2],
    /// Seed of the shifts of interface nodes; 0 for none.
    pub seed: u64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// How it is loaded.
    pub push: Push,
    /// Rotation of the whole, rad.
    pub tilt: f64,
    /// Linear or quadratic triangles.
    pub order: Order,
    /// The grid of the pressure lies on the lower block's corner nodes, else on the upper's.
    pub grid_below: bool,
}

const YOUNG: f64 = 2e6;
const TARGET: f64 = 1e5;

/// B1 in all its variants.
///
/// # Errors
/// [`CaseError`] if a mesh is refused or a contact has no solution.
pub fn all() -> Result<Vec<Measured>, CaseError> {
    let mut out = Vec::new();
    for order in [Order::Quadratic, Order::Linear] {
        for (edges, seed) in [([3, 4], 0), ([7, 5], 11), ([7, 5], 12)] {
            for (poisson, push) in [
                (0.0, Push::Approach),
                (0.3, Push::Load),
                (0.3, Push::Pressure),
            ] {
                for grid_below in [false, true] {
                    let tilts: &[f64] = if push == Push::Pressure {
                        &[0.0]
                    } else {
                        &[0.0, std::f64::consts::PI / 6.0]
                    };
                    for &tilt in tilts {
                        out.extend(run(&PatchTest {
                            edges,
                            seed,
                            poisson,
                            push,
                            tilt,
                            order,
                            grid_below,
                        })?);
                    }
                }
            }
        }
    }
    Ok(out)
}

/// One patch test.
///
/// # Errors
/// [`CaseError`] if a mesh is refused or the contact has no solution.
pub fn run(test: &PatchTest) -> Result<Vec<Measured>, CaseError> {
    let (lower, lower_x) = block(test, false)?;
    let (upper, upper_x) = block(test, true)?;
    let xi = if test.grid_below { lower_x } else { upper_x };
    let normal = rotate(Vec2::y(), test.tilt);
    let pair = TwoBodies::new([Some(lower), Some(upper)], xi, normal, |x| Facing {
        arc: [x, x],
        gap: 0.0,
    });
    let solution = pair.solve(match test.push {
        Push::Approach => Drive::Approach(0.1),
        _ => Drive::Load(TARGET),
    })?;
    let uneven = solution
        .pressure
        .iter()
        .map(|p| (p / TARGET - 1.0).abs())
        .fold(0.0, f64::max);
    let mut field = 0.0f64;
    for (side, origin) in [(0, 0.0), (1, 2.0)] {
        let body = pair.sides[side].as_ref().expect("both blocks are elastic");
        for (p, u) in body
            .mesh()
            .points
            .iter()
            .zip(pair.displacement(side, &solution)?)
        {
            let (x, y) = (rotate(*p, -test.tilt), rotate(u, -test.tilt));
            // held ends do not move along the normal, loaded ones do as in the exact solution
            let held = test.push != Push::Pressure;
            let level = if held {
                exact(test, Vec2::new(0.0, origin)).y
            } else {
                0.0
            };
            let shift = Vec2::new(0.0, level);
            field = field.max(
                (y - (exact(test, x) - shift)).amax() / exact(test, Vec2::new(0.0, 1.0)).y.abs(),
            );
        }
    }
    let at = format!(
        "{}/{} {:?} nu {} {:?} seed {} tilt {:.0} deg grid {}",
        test.edges[0],
        test.edges[1],
        test.order,
        test.poisson,
        test.push,
        test.seed,
        test.tilt.to_degrees(),
        if test.grid_below { "below" } else { "above" }
    );
    let mut out = vec![
        Measured::bound(
            "B1",
            format!("{at}: largest relative deviation of p"),
            uneven,
            1e-8,
        ),
        Measured::bound(
            "B1",
            format!("{at}: largest deviation of u from the linear field over u_y(interface)"),
            field,
            1e-8,
        ),
    ];
    out.extend(discipline("B1", &at, &solution));
    Ok(out)
}

/// The uniform solution with u = 0 at the middle of the base, upright; held body 1 moves with its top in addition.
fn exact(test: &PatchTest, x: Vec2) -> Vec2 {
    let nu = test.poisson;
    Vec2::new(nu * (1.0 + nu) * (x.x - 0.5), -(1.0 - nu * nu) * x.y) * (TARGET / YOUNG)
}

/// The lower or upper block and its interface corner nodes.
fn block(test: &PatchTest, upper: bool) -> Result<(ElasticSide, Vec<f64>), CaseError> {
    let n = test.edges[usize::from(upper)];
    let corners = shifted_nodes(
        n,
        test.seed.wrapping_mul(2).wrapping_add(u64::from(upper)),
        test.seed != 0,
    );
    let place = |s: f64, t: f64| {
        // interface nodes are shifted, the far end is even
        let cell = ((s * n as f64).floor() as usize).min(n - 1);
        let x = corners[cell] + (s * n as f64 - cell as f64) * (corners[cell + 1] - corners[cell]);
        let towards = if upper { 1.0 - t } else { t };
        let y = if upper { 1.0 + t } else { t };
        rotate(Vec2::new(towards * x + (1.0 - towards) * s, y), test.tilt)
    };
    let mut patch = Patch::new(n, 3, test.order, place)?;
    patch.top.reverse();
    let (surface, far) = if upper {
        (&patch.bottom, &patch.top)
    } else {
        (&patch.top, &patch.bottom)
    };
    let arc: Vec<f64> = surface
        .iter()
        .map(|&k| rotate(patch.mesh.points[k as usize], -test.tilt).x)
        .collect();
    let order = if test.order == Order::Quadratic { 2 } else { 1 };
    let chain = Surface {
        nodes: surface,
        arc: &arc,
        order,
    };
    let material = Elastic {
        youngs_modulus: YOUNG,
        poisson_ratio: test.poisson,
    };
    if test.push == Push::Pressure {
        // statically determinate; the solution is fixed to `exact` by where it is held
        let last = far[far.len() - 1];
        let middle = Vec2::new(0.0, if upper { 2.0 } else { 0.0 });
        let fixed = [(far[0], Axis::X), (far[0], Axis::Y), (last, Axis::Y)];
        let held = exact(test, middle);
        let prescribed = vec![
            (far[0], Axis::X, held.x),
            (far[0], Axis::Y, held.y),
            (last, Axis::Y, held.y),
        ];
        let mut edge = far.clone();
        if upper {
            edge.reverse();
        }
        let loads = edge_traction(&patch.mesh, &edge, |_, outward| outward * -TARGET);
        let side = ElasticSide::new(&patch.mesh, material, &fixed, chain, 0.0)?
            .with_loads(loads, prescribed)?;
        return Ok((side, corners));
    }
    let prescribed: Vec<(u32, Axis, f64)> = far
        .iter()
        .flat_map(|&k| {
            let x = rotate(patch.mesh.points[k as usize], -test.tilt).x;
            let u = rotate(exact(test, Vec2::new(x, 0.0)), test.tilt);
            [(k, Axis::X, u.x), (k, Axis::Y, u.y)]
        })
        .collect();
    let side = ElasticSide::new(&patch.mesh, material, &both(far), chain, 0.0)?
        .with_loads(Vec::new(), prescribed)?;
    Ok((side, corners))
}

/// n + 1 nodes on 0..1, inner ones shifted by up to 0.3 of the spacing.
fn shifted_nodes(n: usize, seed: u64, shift: bool) -> Vec<f64> {
    let mut state = seed;
    (0..=n)
        .map(|i| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let random = (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
            let inner = shift && i > 0 && i < n;
            (i as f64 + if inner { 0.6 * random } else { 0.0 }) / n as f64
        })
        .collect()
}
