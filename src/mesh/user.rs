//! A user's own mesh of a gear: what it must state and how it is checked.
//!
//! ```text
//! points (mm, gear centre at the origin, tooth 0 on the +x axis), triangles with 3 or 6 nodes, the bore's nodes,
//! and for each candidate tooth the nodes of its loaded (counter-clockwise) flank
//! ```
//! Tooth numbers follow from where a flank lies. Arc coordinates follow from the radius; nodes stay where the user put them.

use super::boundary::boundary_edges;
use super::{Cells, FlankChain, Mesh, check_jacobians};
use crate::gear::Gear;
use crate::numeric::{Vec2, cross, rotate};

/// Largest distance of a flank node from the nominal involute, mm.
pub const FLANK_TOLERANCE: f64 = 1e-4;
/// Largest distance of a bore node from the bore circle, mm.
pub const BORE_TOLERANCE: f64 = 1e-3;

/// A mesh as read, before it is checked.
pub(super) struct RawMesh {
    pub(super) points: Vec<Vec2>,
    pub(super) cells: Cells,
    pub(super) bore: Vec<u32>,
    /// Flank number as the file states it, and its nodes (mid-side nodes may be left out).
    pub(super) flanks: Vec<(i64, Vec<u32>)>,
}

impl RawMesh {
    /// The mesh for `gear`, or what is wrong with it.
    pub(super) fn check(mut self, gear: &Gear) -> Result<Mesh, String> {
        if self.cells.is_empty() {
            return Err("no triangles; allowed are triangles with 3 nodes or with 6".into());
        }
        if let Some(k) = self.points.iter().position(|p| !(p.x + p.y).is_finite()) {
            return Err(format!("node {k} has a coordinate that is not finite"));
        }
        turn_counter_clockwise(&mut self.cells, &self.points);
        self.drop_unused();
        if self.bore.is_empty() {
            return Err("no bore nodes; the nodes on the bore circle must be marked `bore`".into());
        }
        let r = gear.bore_radius();
        for k in &self.bore {
            let p = self.points[*k as usize];
            if (p.norm() - r).abs() > BORE_TOLERANCE {
                let (x, y, at) = (p.x, p.y, p.norm());
                return Err(format!(
                    "bore node at ({x:.4}, {y:.4}) has radius {at:.5} mm, allowed {r} ± {BORE_TOLERANCE} mm"
                ));
            }
        }
        let flanks = self.flanks;
        if flanks.is_empty() {
            return Err("no flank nodes; at least one loaded flank must be marked `flank`".into());
        }
        let mut mesh = Mesh {
            points: self.points,
            cells: self.cells,
            flanks: Vec::new(),
            bore: self.bore,
        };
        let mut mids = Vec::new();
        for edge in boundary_edges(&mesh) {
            let on_bore = |k| mesh.bore.binary_search(&k).is_ok();
            if let Some(mid) = edge
                .mid
                .filter(|mid| on_bore(edge.start) && on_bore(edge.end) && !on_bore(*mid))
            {
                mids.push(mid);
            }
        }
        mesh.bore.extend(mids);
        for (number, nodes) in &flanks {
            let chain = chain(&mesh, gear, *number, nodes)?;
            mesh.flanks.push(chain);
        }
        mesh.flanks.sort_by_key(|f| f.tooth);
        if let Some(w) = mesh.flanks.windows(2).find(|w| w[0].tooth == w[1].tooth) {
            return Err(format!("two flanks lie on tooth {}", w[0].tooth));
        }
        check_jacobians(&mesh).map_err(|e| e.to_string())?;
        Ok(mesh)
    }

    /// Leaves out nodes of no triangle (centres of arcs and the like).
    fn drop_unused(&mut self) {
        let mut number = vec![u32::MAX; self.points.len()];
        let mut mark = |nodes: &[u32]| nodes.iter().for_each(|k| number[*k as usize] = 0);
        match &self.cells {
            Cells::T3(t) => t.iter().for_each(|t| mark(t)),
            Cells::T6(t) => t.iter().for_each(|t| mark(t)),
        }
        let mut points = Vec::new();
        for (k, n) in number.iter_mut().enumerate().filter(|(_, n)| **n == 0) {
            *n = points.len() as u32;
            points.push(self.points[k]);
        }
        self.points = points;
        let renumber = |k: &mut u32| *k = number[*k as usize];
        match &mut self.cells {
            Cells::T3(t) => t.iter_mut().flatten().for_each(renumber),
            Cells::T6(t) => t.iter_mut().flatten().for_each(renumber),
        }
        for list in self
            .flanks
            .iter_mut()
            .map(|f| &mut f.1)
            .chain([&mut self.bore])
        {
            list.iter_mut().for_each(renumber);
            list.retain(|k| *k != u32::MAX);
            list.sort_unstable();
            list.dedup();
        }
    }
}

fn turn_counter_clockwise(cells: &mut Cells, points: &[Vec2]) {
    let clockwise = |t: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|i| points[t[i] as usize]);
        cross(b - a, c - a) < 0.0
    };
    match cells {
        Cells::T3(t) => t
            .iter_mut()
            .filter(|t| clockwise(&t[..]))
            .for_each(|t| t.swap(1, 2)),
        Cells::T6(t) => t.iter_mut().filter(|t| clockwise(&t[..])).for_each(|t| {
            t.swap(1, 2);
            t.swap(3, 5);
        }),
    }
}

/// Orders the nodes of a flank and checks that they form one line of edges on the loaded involute of one tooth.
fn chain(mesh: &Mesh, gear: &Gear, number: i64, nodes: &[u32]) -> Result<FlankChain, String> {
    let mut on_flank = vec![false; mesh.points.len()];
    nodes.iter().for_each(|k| on_flank[*k as usize] = true);
    let radius = |k: u32| mesh.points[k as usize].norm();
    let mut edges: Vec<_> = boundary_edges(mesh)
        .into_iter()
        .filter(|e| on_flank[e.start as usize] && on_flank[e.end as usize])
        .collect();
    // On the loaded flank the boundary runs from the tip down.
    edges.sort_by(|a, b| radius(a.end).total_cmp(&radius(b.end)));
    let Some(first) = edges.first() else {
        return Err(format!(
            "flank {number} has no boundary edge between two of its nodes"
        ));
    };
    let arc_of = |p: Vec2| gear.arc(gear.rho_at_radius(p.norm()));
    let mut line = vec![first.end];
    let mut arc = vec![arc_of(mesh.points[first.end as usize])];
    for e in &edges {
        if line.last() != Some(&e.end) {
            let r = radius(e.end);
            return Err(format!(
                "flank {number} is not one connected line of the loaded side, root to tip: it breaks at radius {r:.4} mm"
            ));
        }
        let (s0, s1) = (arc[arc.len() - 1], arc_of(mesh.points[e.start as usize]));
        if let Some(mid) = e.mid {
            line.push(mid);
            arc.push(0.5 * (s0 + s1));
        }
        line.push(e.start);
        arc.push(s1);
    }
    let middle = mesh.points[line[line.len() / 2] as usize];
    let turn = middle.y.atan2(middle.x) - gear.half_angle(middle.norm());
    let tooth = (turn / gear.pitch_angle()).round() as i32;
    for (k, s) in line.iter().zip(&arc) {
        let p = mesh.points[*k as usize];
        let exact = rotate(
            gear.involute_point(gear.rho_at_arc(*s)),
            f64::from(tooth) * gear.pitch_angle(),
        );
        let off = (p - exact).norm();
        if off > FLANK_TOLERANCE {
            let (x, y) = (p.x, p.y);
            return Err(format!(
                "node of flank {number} at ({x:.5}, {y:.5}) lies {off:.2e} mm from the involute of tooth {tooth}, allowed {FLANK_TOLERANCE} mm"
            ));
        }
    }
    let (lowest, highest) = (
        gear.arc(gear.rho_form) - FLANK_TOLERANCE,
        gear.arc(gear.rho_tip) + FLANK_TOLERANCE,
    );
    if arc[0] < lowest || arc[arc.len() - 1] > highest {
        let (low, high) = (gear.form_radius, gear.tip_radius);
        return Err(format!(
            "flank {number} leaves the involute, allowed radii {low:.4} to {high:.4} mm"
        ));
    }
    Ok(FlankChain {
        tooth,
        nodes: line,
        arc,
    })
}
