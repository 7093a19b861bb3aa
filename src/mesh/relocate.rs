//! Nodes follow the worn flank.
//!
//! Flank nodes are turned back by the worn depth as [`crate::gear::WornFlank`] has it; the tip land slides with the tip
//! corner; all other boundary nodes stay. Inside, the displacement u is the harmonic extension, which at the flank is nearly
//! a rigid shift, so that depths of several element sides keep the elements' shape as long as the depth varies slowly:
//!
//! ```text
//! find u: ∫ ∇u : ∇v = 0 for all v that vanish on the boundary,  u given there        (linear triangles, corners only)
//! ```
//! Mid-side nodes move by the mean of their ends unless they lie on the flank. A step of the depth between two neighbouring
//! nodes of more than an element side turns elements inside out: that is reported, and the body has to be meshed again.
//! [`steepness`] tells beforehand.

use super::boundary::boundary_edges;
use super::{Cells, Mesh, MeshError, check_jacobians};
use crate::gear::Gear;
use crate::numeric::{Vec2, cross};

/// Relative residual at which the extension counts as solved; it only shapes the inside.
const TOLERANCE: f64 = 1e-5;

/// The mesh of the worn gear.
///
/// `nominal` is the mesh of the new gear, or of a worn one; `depths[f][i]` is the depth lost at node `i` of flank `f` since
/// then, mm, positive inwards. The profile below the first node (the root end) stays.
///
/// # Errors
/// Wrong numbers of depths; [`MeshError::Inverted`] if an element lost its positive Jacobian.
pub fn relocate(nominal: &Mesh, gear: &Gear, depths: &[Vec<f64>]) -> Result<Mesh, MeshError> {
    let mut moved: Vec<Option<Vec2>> = vec![None; nominal.points.len()];
    let edges = boundary_edges(nominal);
    for e in &edges {
        for k in [Some(e.start), e.mid, Some(e.end)].into_iter().flatten() {
            moved[k as usize] = Some(Vec2::zeros());
        }
    }
    if depths.len() != nominal.flanks.len() {
        return Err(MeshError::WrongLength {
            flank: depths.len(),
            given: 0,
            nodes: 0,
        });
    }
    let mut before = vec![u32::MAX; nominal.points.len()];
    for (i, e) in edges.iter().enumerate() {
        before[e.end as usize] = i as u32;
    }
    for (flank, (chain, depth)) in nominal.flanks.iter().zip(depths).enumerate() {
        if depth.len() != chain.nodes.len() {
            return Err(MeshError::WrongLength {
                flank,
                given: depth.len(),
                nodes: chain.nodes.len(),
            });
        }
        for (node, h) in chain.nodes.iter().zip(depth) {
            let p = nominal.points[*node as usize];
            // a turn by nothing would still round
            let to = if *h == 0.0 {
                p
            } else {
                gear.turned_back(p, *h)
            };
            moved[*node as usize] = Some(to - p);
        }
        // below a worn lowest node the boundary has a ledge, of a straight edge
        let lowest = chain.nodes.first().copied();
        let ledge = edges.iter().find(|e| Some(e.start) == lowest);
        if let Some((mid, start)) = ledge.and_then(|e| Some((e.mid?, e.start))) {
            moved[mid as usize] = moved[start as usize].map(|u| 0.5 * u);
        }
        if let (Some(tip), Some(h)) = (chain.nodes.last(), depth.last()) {
            slide_tip(nominal, gear, (*tip, *h), &edges, &before, &mut moved);
        }
    }
    let fixed: Vec<bool> = moved.iter().map(Option::is_some).collect();
    let mut u: Vec<Vec2> = moved.into_iter().map(Option::unwrap_or_default).collect();
    extend(nominal, &fixed, &mut u);
    if let Cells::T6(cells) = &nominal.cells {
        for t in cells {
            for (i, (a, b)) in [(0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
                let mid = t[3 + i] as usize;
                if !fixed[mid] {
                    u[mid] = 0.5 * (u[t[a] as usize] + u[t[b] as usize]);
                }
            }
        }
    }
    let points = nominal.points.iter().zip(&u).map(|(p, u)| p + u).collect();
    let mesh = Mesh {
        points,
        ..nominal.clone()
    };
    check_jacobians(&mesh)?;
    Ok(mesh)
}

/// Largest slope of `depths` (as for [`relocate`]) between neighbouring nodes of `mesh`, in depth per length of the edge
/// between them: what shears the elements there.
pub fn steepness(mesh: &Mesh, depths: &[Vec<f64>]) -> f64 {
    let mut most = 0.0f64;
    for (chain, depth) in mesh.flanks.iter().zip(depths) {
        for (nodes, h) in chain.nodes.windows(2).zip(depth.windows(2)) {
            let [a, b] = [nodes[0], nodes[1]].map(|k| mesh.points[k as usize]);
            most = most.max((h[1] - h[0]).abs() / (a - b).norm());
        }
    }
    most
}

/// The nodes of a worn mesh with its flanks back where they were before they wore by `depths` (as for [`relocate`]); all
/// other nodes stay.
pub fn unworn(worn: &Mesh, gear: &Gear, depths: &[Vec<f64>]) -> Vec<Vec2> {
    let mut points = worn.points.clone();
    for (chain, depth) in worn.flanks.iter().zip(depths) {
        for (node, h) in chain.nodes.iter().zip(depth) {
            let p = &mut points[*node as usize];
            *p = gear.turned_back(*p, -*h);
        }
    }
    points
}

/// Lets the nodes behind the corner `tip` follow its depth: a rounding turns with it, the tip land slides.
fn slide_tip(
    mesh: &Mesh,
    gear: &Gear,
    (tip, depth): (u32, f64),
    edges: &[super::BoundaryEdge],
    before: &[u32],
    moved: &mut [Option<Vec2>],
) {
    let at = |k: u32| mesh.points[k as usize];
    let on_circle = |k: u32| (at(k).norm() - gear.tip_radius).abs() < 1e-6 * gear.tip_radius;
    let mut behind = Vec::new();
    let (mut node, mut length) = (tip, 0.0);
    let mut land = on_circle(tip).then_some(0.0);
    // The boundary is walked against its direction; it ends where it leaves the tip circle.
    while behind.len() < mesh.points.len() {
        let Some(e) = edges.get(before[node as usize] as usize) else {
            break;
        };
        if on_circle(node) && !on_circle(e.start) {
            break;
        }
        let step = (at(e.start) - at(e.end)).norm();
        if let Some(mid) = e.mid {
            behind.push((mid, length + 0.5 * step));
        }
        length += step;
        behind.push((e.start, length));
        node = e.start;
        if on_circle(node) {
            land.get_or_insert(length);
        }
    }
    let land = land.unwrap_or(0.0);
    for (k, s) in behind {
        let share = ((length - s) / (length - land)).min(1.0);
        let p = at(k);
        let to = if depth == 0.0 {
            p
        } else {
            gear.turned_back(p, share * depth)
        };
        moved[k as usize] = Some(to - p);
    }
}

/// Harmonic extension of `u` from the fixed corners to the free ones by conjugate gradients with diagonal scaling.
fn extend(mesh: &Mesh, fixed: &[bool], u: &mut [Vec2]) {
    let laplacian = Laplacian::new(mesh, fixed);
    let free: Vec<usize> = (0..u.len())
        .filter(|k| laplacian.diagonal[*k] > 0.0)
        .collect();
    let mut r = vec![Vec2::zeros(); u.len()];
    laplacian.apply(u, &mut r);
    free.iter().for_each(|&k| r[k] = -r[k]);
    let scaled = |r: &[Vec2], k: usize| r[k] / laplacian.diagonal[k];
    let dot = |a: &dyn Fn(usize) -> f64| free.iter().map(|k| a(*k)).sum::<f64>();
    let mut d = vec![Vec2::zeros(); u.len()];
    free.iter().for_each(|&k| d[k] = scaled(&r, k));
    let mut rho = dot(&|k| r[k].dot(&d[k]));
    let goal = rho * TOLERANCE * TOLERANCE;
    let mut q = vec![Vec2::zeros(); u.len()];
    for _ in 0..4 * free.len() {
        if rho <= goal {
            break;
        }
        laplacian.apply(&d, &mut q);
        let alpha = rho / dot(&|k| d[k].dot(&q[k]));
        for &k in &free {
            u[k] += alpha * d[k];
            r[k] -= alpha * q[k];
        }
        let next = dot(&|k| r[k].dot(&scaled(&r, k)));
        for &k in &free {
            d[k] = scaled(&r, k) + (next / rho) * d[k];
        }
        rho = next;
    }
}

/// Rows of the Laplace matrix of the corner triangles at the free nodes; `diagonal` is 0 at all others.
struct Laplacian {
    diagonal: Vec<f64>,
    entries: Vec<(u32, u32, f64)>,
}

impl Laplacian {
    fn new(mesh: &Mesh, fixed: &[bool]) -> Laplacian {
        let mut diagonal = vec![0.0; mesh.points.len()];
        let mut entries = Vec::new();
        for t in mesh.corners() {
            let p = t.map(|k| mesh.points[k as usize]);
            for i in 0..3 {
                // The edge opposite corner i carries half the cotangent of the angle there.
                let (a, b) = ((i + 1) % 3, (i + 2) % 3);
                let (v, w) = (p[a] - p[i], p[b] - p[i]);
                let weight = 0.5 * v.dot(&w) / cross(v, w);
                for (k, l) in [(t[a], t[b]), (t[b], t[a])] {
                    if !fixed[k as usize] {
                        diagonal[k as usize] += weight;
                        entries.push((k, l, weight));
                    }
                }
            }
        }
        entries.sort_unstable_by_key(|e| (e.0, e.1));
        entries.dedup_by(|b, a| {
            let same = (a.0, a.1) == (b.0, b.1);
            if same {
                a.2 += b.2;
            }
            same
        });
        Laplacian { diagonal, entries }
    }

    fn apply(&self, u: &[Vec2], out: &mut [Vec2]) {
        for (k, d) in self.diagonal.iter().enumerate() {
            out[k] = *d * u[k];
        }
        for (k, l, w) in &self.entries {
            out[*k as usize] -= *w * u[*l as usize];
        }
    }
}
