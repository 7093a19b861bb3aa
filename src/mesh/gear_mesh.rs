//! The mesh of one gear: full circle of teeth, the candidates' loaded flanks fine, the rest coarse.
//!
//! ```text
//! sizes wanted at fine flanks and fillets -> field -> edges along the tooth profiles and the bore -> outline
//! outline's own edge lengths -> field -> triangles -> T6 with mid-side nodes on the exact curves
//! ```
//! Flank nodes lie on the nominal involute: tip relief and wear are gaps, not shape.

use super::gear_outline::{FineFlank, gear_outline};
use super::order::Order;
use super::triangulate::{TriangulateOptions, triangulate};
use super::{FlankChain, Mesh, MeshError, SizeField, check_jacobians, raise_order};
use crate::gear::{Gear, WornFlank};

/// What the mesh of a gear is to be like. Sizes are edge lengths (the side of a quadratic element), mm.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSpec {
    /// Teeth whose loaded flank is fine: 0 on the +x axis, counter-clockwise positive; any order.
    pub fine_teeth: Vec<i32>,
    /// Edge length along the fine part of the loaded flanks; the edges are made equal by arc length and no longer than this.
    pub flank_spacing: f64,
    /// Curvature radius at which the fine part begins (it ends at the tip); below the form circle: the form circle.
    pub active_from_rho: f64,
    /// Edge length in the fillets of the fine teeth.
    pub root_spacing: f64,
    /// Edge length on all other teeth.
    pub coarse_spacing: f64,
    /// Edge length at the bore at most; the bore has at least 24 edges.
    pub bore_spacing: f64,
    /// Growth of the edge length per distance.
    pub growth: f64,
    /// Element order.
    pub order: Order,
    /// Smallest angle accepted, degrees.
    pub min_angle_deg: f64,
}

impl MeshSpec {
    /// Usual sizes for a gear: 0.06 modules in fine fillets, 0.4 modules on coarse teeth, 1.5 modules at the bore, growth 0.3.
    pub fn new(
        gear: &Gear,
        fine_teeth: Vec<i32>,
        flank_spacing: f64,
        active_from_rho: f64,
    ) -> MeshSpec {
        let m = gear.rack.module;
        MeshSpec {
            fine_teeth,
            flank_spacing,
            active_from_rho,
            root_spacing: 0.06 * m,
            coarse_spacing: 0.4 * m,
            bore_spacing: 1.5 * m,
            growth: 0.3,
            order: Order::T6,
            min_angle_deg: 20.0,
        }
    }

    fn check(&self, gear: &Gear) -> Result<(), MeshError> {
        let m = gear.rack.module;
        for (name, value, low, high) in [
            ("flank_spacing", self.flank_spacing, 1e-4 * m, 0.5 * m),
            ("root_spacing", self.root_spacing, 1e-3 * m, 0.5 * m),
            ("coarse_spacing", self.coarse_spacing, 0.01 * m, m),
            ("bore_spacing", self.bore_spacing, 0.01 * m, 10.0 * m),
            ("growth", self.growth, 0.05, 0.5),
            ("min_angle_deg", self.min_angle_deg, 0.0, 30.0),
        ] {
            if !(low..=high).contains(&value) {
                return Err(MeshError::Spec {
                    name,
                    value,
                    allowed: format!("{low} to {high}"),
                });
            }
        }
        let highest = gear.rho_end - self.flank_spacing;
        if !self.active_from_rho.is_finite() || self.active_from_rho > highest {
            let allowed = format!("up to {highest:.4} mm, one edge below the tip");
            return Err(MeshError::Spec {
                name: "active_from_rho",
                value: self.active_from_rho,
                allowed,
            });
        }
        let z = gear.spec.teeth as i32;
        let mut seen: Vec<i32> = self.fine_teeth.iter().map(|t| t.rem_euclid(z)).collect();
        seen.sort_unstable();
        if let Some(pair) = seen.windows(2).find(|w| w[0] == w[1]) {
            let allowed = format!("each of the {z} teeth once");
            return Err(MeshError::Spec {
                name: "fine_teeth",
                value: f64::from(pair[0]),
                allowed,
            });
        }
        Ok(())
    }
}

/// Meshes a gear.
///
/// # Errors
/// Sizes out of range, or a mesh that stays below `min_angle_deg` or has a Jacobian that is not positive.
pub fn mesh_gear(gear: &Gear, spec: &MeshSpec) -> Result<Mesh, MeshError> {
    mesh_worn_gear(gear, spec, &WornFlank::unworn(gear))
}

/// Slope, in depth per arc, between whose likes nothing may stand proud in a mesh: its corners are then wider than 70°.
const SPIKE_SLOPE: f64 = 0.7;

/// Thinnest that a worn tooth may be, modules.
const LEAST_THICKNESS: f64 = 0.05;

/// Meshes a gear whose fine flanks are `worn`, all alike.
///
/// The chains keep the arc coordinates of the unworn flank; where wear has left ledges they have more nodes. What stands proud
/// between steep slopes is left out ([`WornFlank::without_spikes`]).
///
/// # Errors
/// As [`mesh_gear`]; [`MeshError::WornThrough`] if a tooth is worn to a point.
pub fn mesh_worn_gear(gear: &Gear, spec: &MeshSpec, worn: &WornFlank) -> Result<Mesh, MeshError> {
    spec.check(gear)?;
    let worn = worn.clone().without_spikes(SPIKE_SLOPE);
    let thinnest = worn.thinnest();
    if !worn.is_unworn() && thinnest.left < LEAST_THICKNESS * gear.rack.module {
        return Err(MeshError::WornThrough {
            at: thinnest,
            of: None,
        });
    }
    let (outline, fine_flanks) = gear_outline(gear, spec, &worn);
    let field = SizeField::of_outline(&outline, spec.growth, f64::INFINITY);
    let options = TriangulateOptions {
        min_angle_deg: spec.min_angle_deg,
        ..TriangulateOptions::default()
    };
    let triangles = triangulate(&outline, &|x| field.size(x), &options)?;
    let (points, cells, mids) = raise_order(&triangles, &outline, spec.order);
    let outer = outline.loops[0].points.len() as u32;
    let hole = outer..outer + outline.loops[1].points.len() as u32;
    let mut bore: Vec<u32> = hole.clone().collect();
    if spec.order == Order::T6 {
        bore.extend(&mids[hole.start as usize..hole.end as usize]);
    }
    let mut flanks: Vec<FlankChain> = fine_flanks
        .iter()
        .map(|f| flank_chain(f, &mids, outer))
        .collect();
    flanks.sort_by_key(|f| f.tooth);
    let mesh = Mesh {
        points,
        cells,
        flanks,
        bore,
    };
    check_jacobians(&mesh)?;
    Ok(mesh)
}

/// The chain of a flank from the root side up: corners, and the outline's mid-side nodes if there are any.
fn flank_chain(flank: &FineFlank, mids: &[u32], outer: u32) -> FlankChain {
    let (mut nodes, mut arc) = (Vec::new(), Vec::new());
    for i in (0..flank.arcs.len()).rev() {
        nodes.push((flank.start + i) as u32 % outer);
        arc.push(flank.arcs[i]);
        if i > 0 && !mids.is_empty() {
            nodes.push(mids[flank.start + i - 1]);
            arc.push(0.5 * (flank.arcs[i - 1] + flank.arcs[i]));
        }
    }
    FlankChain {
        tooth: flank.tooth,
        nodes,
        arc,
    }
}
