//! Both gears meshed but not factored: what elastic members are made from, new and worn.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::join;

use crate::contact::cycle::Stations;
use crate::contact::fem::ToothWaves;
use crate::contact::strips::Strips;
use crate::gear::{self, FaceEnds, Gear, Pair, WornFlank};
use crate::material::Elastic;
use crate::mesh::{
    Cells, Mesh, MeshError, MeshSpec, Order, Quality, mesh_gear, mesh_worn_gear, relocate,
    steepness, unworn,
};
use crate::numeric::{Vec2, interpolate};
use crate::simulate::members::{Member, MemberError, Members};

/// Meshes of pinion and gear before wear. Worn members are made from these and the depth alone, whatever was made before.
pub struct Blanks {
    /// Pinion, then gear, member frames.
    pub meshes: [Mesh; 2],
    /// Elastic constants of both.
    pub materials: [Elastic; 2],
    /// What they are to touch with when new.
    pub strips: Strips,
    spacing: f64,
    of_user: bool,
    /// By the bits of the face width and the number of slices.
    waves: Mutex<HashMap<(u64, usize, FaceEnds), Arc<ToothWaves>>>,
}

/// The mesh of a worn member.
pub struct WornMesh {
    /// Nodes at their worn places.
    pub mesh: Mesh,
    /// Depths at the stations for which it was meshed anew; none: the unworn mesh, moved.
    pub(super) anew: Option<Vec<f64>>,
}

/// A worn mesh with the places its nodes had before any wear.
pub struct DrawnMesh {
    /// Nodes at their worn places.
    pub mesh: Mesh,
    /// Unworn places. A member that was meshed anew has none inside: there they are the worn ones.
    pub unworn: Vec<Vec2>,
}

/// Steepest depth, per length of edge, that a moved mesh is to follow; beyond it the worn gear is meshed anew. A sheared element
/// loses about half the angle that the flank turns by: 18° from the 30° and more that nearly all have.
const STEEPEST: f64 = 0.7;

/// Smallest angle down to which a moved mesh is used all the same, degrees.
const LEAST_ANGLE: f64 = 12.0;

impl Blanks {
    /// Meshes both gears, fine on the loaded flanks of the pinion's `teeth` and of the gear's teeth of opposite number, with
    /// flank edges `spacing` (mm) and `order` 2 for quadratic triangles or 1 for linear; `own` meshes stand in for ours. The `strips`
    /// are those that the members condensed on them are to touch with.
    ///
    /// # Errors
    /// [`MeshError`] if no acceptable mesh is found.
    pub fn new(
        gears: &[Gear; 2],
        materials: [Elastic; 2],
        teeth: &[i32],
        spacing: f64,
        order: usize,
        own: [Option<Mesh>; 2],
        strips: Strips,
    ) -> Result<Self, MeshError> {
        let of_user = own.iter().any(Option::is_some);
        let one = |side: usize, own: Option<Mesh>| -> Result<Mesh, MeshError> {
            if let Some(mesh) = own {
                return Ok(mesh);
            }
            let sign = if side == 0 { 1 } else { -1 };
            let fine = teeth.iter().map(|t| sign * t).collect();
            mesh_gear(&gears[side], &spec(&gears[side], fine, spacing, order))
        };
        let [own_pinion, own_gear] = own;
        let (pinion, gear) = join(|| one(0, own_pinion), || one(1, own_gear));
        Ok(Self {
            meshes: [pinion?, gear?],
            materials,
            strips,
            spacing,
            of_user,
            waves: Mutex::default(),
        })
    }

    /// The pinion's finely meshed teeth.
    pub fn teeth(&self) -> Vec<i32> {
        self.meshes[0].flanks.iter().map(|f| f.tooth).collect()
    }

    /// Whether a mesh is the user's own.
    pub fn of_user(&self) -> bool {
        self.of_user
    }

    /// Length of a flank edge, mm.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// How the flanks of `gears`, of which these are the blanks, give way less under loads that vary across a face `width` (mm) in so many `slices`.
    ///
    /// # Errors
    /// [`MemberError`].
    pub fn waves(
        &self,
        gears: [&Gear; 2],
        width: f64,
        slices: usize,
        ends: FaceEnds,
    ) -> Result<Arc<ToothWaves>, MemberError> {
        let known = || self.waves.lock().unwrap_or_else(PoisonError::into_inner);
        let key = (width.to_bits(), slices, ends);
        let found = known().get(&key).cloned();
        if let Some(found) = found {
            return Ok(found);
        }
        // not made under the lock: a thread that waits for parts of it may turn to work that asks for them too
        let made = Arc::new(ToothWaves::new(
            gears,
            self.materials,
            width,
            slices,
            ends == FaceEnds::Free,
        )?);
        Ok(Arc::clone(known().entry(key).or_insert(made)))
    }

    /// The new members, factored and condensed where `strips` can touch (their own or wider ones).
    ///
    /// # Errors
    /// [`MemberError`].
    pub fn condensed(self: &Arc<Self>, strips: &Strips) -> Result<Members, MemberError> {
        let meshes = self
            .meshes
            .clone()
            .map(|mesh| WornMesh { mesh, anew: None });
        self.condensed_on(meshes, strips)
    }

    /// The meshes with the material of `depth` (mm at the `stations`, pinion then gear) removed. Where the depth is so steep
    /// that elements would suffer from following it, and there is no mesh of the user's to be kept, the worn gear is meshed anew.
    ///
    /// # Errors
    /// [`MeshError`] if a triangle of a user's mesh turns over, or the worn shape cannot be meshed.
    pub fn worn_meshes(
        &self,
        pair: &Pair,
        stations: &Stations,
        depth: [&[f64]; 2],
    ) -> Result<[WornMesh; 2], MeshError> {
        let worn = |side: usize| -> Result<WornMesh, MeshError> {
            let (blank, gear) = (&self.meshes[side], [&pair.pinion, &pair.gear][side]);
            let (arc, depth) = (&stations.arc[side], depth[side]);
            let lost = node_depths(blank, arc, depth);
            if self.of_user {
                let mesh = relocate(blank, gear, &lost)?;
                return Ok(WornMesh { mesh, anew: None });
            }
            if steepness(blank, &lost) <= STEEPEST {
                match relocate(blank, gear, &lost) {
                    Ok(mesh) if Quality::of(&mesh).min_angle_deg >= LEAST_ANGLE => {
                        return Ok(WornMesh { mesh, anew: None });
                    }
                    Ok(_) | Err(MeshError::Inverted { .. }) => {}
                    Err(error) => return Err(error),
                }
            }
            let teeth = blank.flanks.iter().map(|f| f.tooth).collect();
            let spec = spec(gear, teeth, self.spacing, order_of(blank));
            let worn = WornFlank::new(gear, arc.clone(), depth.to_vec());
            let mesh = mesh_worn_gear(gear, &spec, &worn);
            Ok(WornMesh {
                mesh: mesh.map_err(|error| error.of(gear::Member::BOTH[side]))?,
                anew: Some(depth.to_vec()),
            })
        };
        let (pinion, gear) = join(|| worn(0), || worn(1));
        Ok([pinion?, gear?])
    }

    /// The members factored on the given meshes and condensed where `strips` can touch; a user's own meshes on all of their flanks.
    ///
    /// # Errors
    /// [`MemberError`].
    pub fn condensed_on(
        self: &Arc<Self>,
        meshes: [WornMesh; 2],
        strips: &Strips,
    ) -> Result<Members, MemberError> {
        let one = |side: usize, mesh: Mesh| {
            if self.of_user {
                Member::from_mesh(mesh, self.materials[side])
            } else {
                Member::on_parts(mesh, self.materials[side], |tooth| strips.of(side, tooth))
            }
        };
        let [pinion, gear] = meshes;
        let anew = [pinion.anew, gear.anew];
        let (pinion, gear) = join(|| one(0, pinion.mesh), || one(1, gear.mesh));
        Ok(Members {
            members: [pinion?, gear?],
            blanks: Arc::clone(self),
            anew,
        })
    }

    /// The meshes with the material of `depth` (mm at the `stations`) removed, each with the triangles that `condensed`
    /// has: members made from these blanks.
    ///
    /// Where triangles would turn over on the way, a mesh of ours is shown as it was condensed some steps of wear before.
    ///
    /// # Errors
    /// [`MeshError`] if a triangle of a user's mesh turns over.
    pub fn drawn_meshes(
        &self,
        condensed: &Members,
        pair: &Pair,
        stations: &Stations,
        depth: [&[f64]; 2],
    ) -> Result<[DrawnMesh; 2], MeshError> {
        let drawn = |side: usize| -> Result<DrawnMesh, MeshError> {
            let gear = [&pair.pinion, &pair.gear][side];
            let arc = &stations.arc[side];
            let Some(at) = &condensed.anew[side] else {
                let blank = &self.meshes[side];
                let mesh = match relocate(blank, gear, &node_depths(blank, arc, depth[side])) {
                    Err(MeshError::Inverted { .. }) if !self.of_user => {
                        condensed.members[side].mesh.clone()
                    }
                    moved => moved?,
                };
                let unworn = blank.points.clone();
                return Ok(DrawnMesh { mesh, unworn });
            };
            let made = &condensed.members[side].mesh;
            let since: Vec<f64> = depth[side].iter().zip(at).map(|(h, a)| h - a).collect();
            let (mesh, shown) = match relocate(made, gear, &node_depths(made, arc, &since)) {
                Ok(mesh) => (mesh, depth[side]),
                Err(MeshError::Inverted { .. }) => (made.clone(), &at[..]),
                Err(error) => return Err(error),
            };
            let unworn = unworn(&mesh, gear, &node_depths(&mesh, arc, shown));
            Ok(DrawnMesh { mesh, unworn })
        };
        let (pinion, gear) = join(|| drawn(0), || drawn(1));
        Ok([pinion?, gear?])
    }
}

/// Depths (mm at the stations `arc`) at the nodes of each flank of `mesh`.
fn node_depths(mesh: &Mesh, arc: &[f64], depth: &[f64]) -> Vec<Vec<f64>> {
    let at = |s: &f64| interpolate(arc, depth, *s);
    mesh.flanks
        .iter()
        .map(|chain| chain.arc.iter().map(at).collect())
        .collect()
}

/// 2 for quadratic triangles, 1 for linear.
pub(super) fn order_of(mesh: &Mesh) -> usize {
    match mesh.cells {
        Cells::T3(_) => 1,
        Cells::T6(_) => 2,
    }
}

/// What the mesh of a gear is to be like.
fn spec(gear: &Gear, fine: Vec<i32>, spacing: f64, order: usize) -> MeshSpec {
    MeshSpec {
        order: if order == 1 { Order::T3 } else { Order::T6 },
        ..MeshSpec::new(gear, fine, spacing, gear.rho_form)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gear::{BasicRack, ToothSpec};

    #[test]
    fn whose_tooth_is_worn_through_is_said() {
        let rack = BasicRack {
            module: 2.0,
            pressure_angle: 20f64.to_radians(),
            addendum: 1.0,
            dedendum: 1.25,
            fillet_radius: 0.38,
        };
        let gear = |teeth| Gear::new(rack, ToothSpec::plain(teeth, 20.0)).unwrap();
        let gears = [gear(20), gear(25)];
        let steel = Elastic {
            youngs_modulus: 2.1e5,
            poisson_ratio: 0.3,
        };
        let [pinion, large] = gears.clone();
        let pair = Pair::new(pinion, large, 45.0, 0.0).unwrap();
        let none = [None, None];
        let blanks = Blanks::new(&gears, [steel; 2], &[0], 0.3, 1, none, Strips::default());
        let blanks = blanks.unwrap();
        let stations = Stations::new(&pair, 0.3);
        for (side, name) in ["pinion", "gear"].into_iter().enumerate() {
            let depth = [0, 1].map(|i| {
                let worn = if i == side { 4.0 } else { 0.0 };
                vec![worn; stations.arc[i].len()]
            });
            let depth = [&depth[0][..], &depth[1][..]];
            let error = blanks.worn_meshes(&pair, &stations, depth).err().unwrap();
            let start = format!("a tooth of the {name} is worn to a point: 4.0000 mm deep");
            assert!(error.to_string().starts_with(&start), "{error}");
        }
    }
}
