//! Both gears as elastic bodies: meshed, factored and condensed onto the flanks that can touch. Done once per geometry;
//! every load, misalignment, wear state and trial parameter reuses it.

use rayon::join;

use crate::contact::cycle::Stations;
use crate::contact::fem::{ElasticFlanks, ToothFlank};
use crate::fem::{Body, FemError};
use crate::gear::{Gear, Pair};
use crate::material::Elastic;
use crate::mesh::{
    Cells, Mesh, MeshError, MeshSpec, Order, Quality, mesh_gear, mesh_worn_gear, relocate, unworn,
};
use crate::numeric::Vec2;
use crate::numeric::interpolate;

/// One elastic gear.
pub struct Member {
    /// Its mesh, member frame.
    pub mesh: Mesh,
    /// Elastic constants.
    pub material: Elastic,
    /// Its factored stiffness, bore held.
    pub body: Body,
    /// Its compliance at the candidate flanks.
    pub flanks: ElasticFlanks,
}

/// Why a member could not be built.
#[derive(Debug, thiserror::Error)]
pub enum MemberError {
    /// No acceptable mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The stiffness could not be factored.
    #[error(transparent)]
    Fem(#[from] FemError),
}

/// Pinion and gear as elastic bodies.
pub struct Members {
    /// Pinion, then gear.
    pub members: [Member; 2],
    spacing: f64,
    of_user: bool,
    /// Depths at the stations for which a member was meshed anew; none: its mesh is the unworn one, moved or not.
    anew: [Option<Vec<f64>>; 2],
}

/// The mesh of a worn member.
pub struct WornMesh {
    /// Nodes at their worn places.
    pub mesh: Mesh,
    /// Depths at the stations for which it was meshed anew; none: the unworn mesh, moved.
    anew: Option<Vec<f64>>,
}

/// A worn mesh with the places its nodes had before any wear.
pub struct DrawnMesh {
    /// Nodes at their worn places.
    pub mesh: Mesh,
    /// Unworn places. A member that was meshed anew has none inside: there they are the worn ones.
    pub unworn: Vec<Vec2>,
}

/// Smallest angle down to which a moved mesh is used, degrees; below it the worn gear is meshed anew.
const LEAST_ANGLE: f64 = 10.0;

impl Members {
    /// Meshes and condenses both gears, in parallel.
    ///
    /// `teeth` are the pinion's teeth that can touch (the gear's have the opposite numbers), `spacing` the length of
    /// their flanks' edges (mm), `order` 2 for quadratic triangles or 1 for linear; `own` meshes stand in for ours.
    ///
    /// # Errors
    /// [`MemberError`].
    pub fn build(
        gears: &[Gear; 2],
        materials: [Elastic; 2],
        teeth: &[i32],
        spacing: f64,
        order: usize,
        own: [Option<Mesh>; 2],
    ) -> Result<Self, MemberError> {
        let of_user = own.iter().any(Option::is_some);
        let [pinion, gear] = meshes(gears, teeth, spacing, order, own)?;
        let (pinion, gear) = join(
            || Member::from_mesh(pinion, materials[0]),
            || Member::from_mesh(gear, materials[1]),
        );
        Ok(Self {
            members: [pinion?, gear?],
            spacing,
            of_user,
            anew: [None, None],
        })
    }

    /// The pinion's finely meshed teeth.
    pub fn teeth(&self) -> Vec<i32> {
        self.members[0]
            .flanks
            .flanks
            .iter()
            .map(|f| f.tooth)
            .collect()
    }

    /// Whether a mesh is the user's own.
    pub fn of_user(&self) -> bool {
        self.of_user
    }

    /// Length of a flank edge, mm.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The members with the material of `depth` (mm at the `stations`, pinion then gear) removed, not factored: nodes moved
    /// along the inward normal, the interior following. A gear whose mesh cannot follow is meshed anew in its worn shape,
    /// unless a mesh is the user's own.
    ///
    /// # Errors
    /// [`MemberError`] if a triangle of a user's mesh turns over, or the worn shape cannot be meshed.
    pub fn worn_meshes(
        &self,
        pair: &Pair,
        stations: &Stations,
        depth: [&[f64]; 2],
    ) -> Result<[WornMesh; 2], MemberError> {
        let worn = |side: usize| -> Result<WornMesh, MemberError> {
            let member = &self.members[side];
            let gear = [&pair.pinion, &pair.gear][side];
            let moved = moved(&member.mesh, gear, &stations.arc[side], depth[side]);
            let usable = |mesh: &Mesh| Quality::of(mesh).min_angle_deg >= LEAST_ANGLE;
            match moved {
                Ok(mesh) if self.of_user || usable(&mesh) => Ok(WornMesh { mesh, anew: None }),
                Err(error) if self.of_user => Err(error.into()),
                Ok(_) | Err(MeshError::Inverted { .. }) => {
                    let teeth = member.flanks.flanks.iter().map(|f| f.tooth).collect();
                    let spec = spec(gear, teeth, self.spacing, member.order());
                    let lost = |_: i32, s: f64| interpolate(&stations.arc[side], depth[side], s);
                    Ok(WornMesh {
                        mesh: mesh_worn_gear(gear, &spec, &lost)?,
                        anew: Some(depth[side].to_vec()),
                    })
                }
                Err(error) => Err(error.into()),
            }
        };
        let (pinion, gear) = join(|| worn(0), || worn(1));
        Ok([pinion?, gear?])
    }

    /// The members factored and condensed again on the given meshes.
    ///
    /// # Errors
    /// [`MemberError`].
    pub fn condensed_on(&self, meshes: [WornMesh; 2]) -> Result<Self, MemberError> {
        let [pinion, gear] = meshes;
        let anew = [pinion.anew, gear.anew];
        let (pinion, gear) = join(
            || Member::from_mesh(pinion.mesh, self.members[0].material),
            || Member::from_mesh(gear.mesh, self.members[1].material),
        );
        Ok(Self {
            members: [pinion?, gear?],
            spacing: self.spacing,
            of_user: self.of_user,
            anew,
        })
    }

    /// The meshes with the material of `depth` (mm at the `stations`) removed, each with the triangles that `condensed`
    /// has: these members, or what [`Members::condensed_on`] made of them.
    ///
    /// # Errors
    /// [`MemberError`] if a triangle turns over.
    pub fn drawn_meshes(
        &self,
        condensed: &Members,
        pair: &Pair,
        stations: &Stations,
        depth: [&[f64]; 2],
    ) -> Result<[DrawnMesh; 2], MemberError> {
        let drawn = |side: usize| -> Result<DrawnMesh, MemberError> {
            let gear = [&pair.pinion, &pair.gear][side];
            let arc = &stations.arc[side];
            let Some(at) = &condensed.anew[side] else {
                let fresh = &self.members[side].mesh;
                return Ok(DrawnMesh {
                    mesh: moved(fresh, gear, arc, depth[side])?,
                    unworn: fresh.points.clone(),
                });
            };
            let since: Vec<f64> = depth[side].iter().zip(at).map(|(h, a)| h - a).collect();
            let mesh = moved(&condensed.members[side].mesh, gear, arc, &since)?;
            let unworn = unworn(&mesh, gear, &node_depths(&mesh, arc, depth[side]));
            Ok(DrawnMesh { mesh, unworn })
        };
        let (pinion, gear) = join(|| drawn(0), || drawn(1));
        Ok([pinion?, gear?])
    }

    /// Which members were meshed anew in their worn shape.
    pub fn meshed_anew(&self) -> [bool; 2] {
        [self.anew[0].is_some(), self.anew[1].is_some()]
    }

    /// The condensed flanks of both.
    pub fn flanks(&self) -> [&ElasticFlanks; 2] {
        [&self.members[0].flanks, &self.members[1].flanks]
    }
}

impl Member {
    /// 2 for quadratic triangles, 1 for linear.
    pub fn order(&self) -> usize {
        match self.mesh.cells {
            Cells::T3(_) => 1,
            Cells::T6(_) => 2,
        }
    }

    /// Factors and condenses a given mesh.
    ///
    /// # Errors
    /// [`FemError`] if the stiffness cannot be factored.
    pub fn from_mesh(mesh: Mesh, material: Elastic) -> Result<Self, MemberError> {
        let interface: Vec<u32> = mesh
            .flanks
            .iter()
            .flat_map(|f| f.nodes.iter().copied())
            .collect();
        let body = Body::new(&mesh, material, &mesh.bore, &interface)?;
        let order = match mesh.cells {
            Cells::T3(_) => 1,
            Cells::T6(_) => 2,
        };
        let mut first = 0;
        let flanks = mesh
            .flanks
            .iter()
            .map(|chain| {
                let flank = ToothFlank {
                    tooth: chain.tooth,
                    first,
                    arc: chain.arc.clone(),
                    order,
                };
                first += chain.nodes.len();
                flank
            })
            .collect();
        let flanks = ElasticFlanks {
            compliance: body.compliance(),
            flanks,
        };
        Ok(Self {
            mesh,
            material,
            body,
            flanks,
        })
    }
}

/// `mesh` with its flank nodes moved inwards by `depth` (mm at the stations `arc`).
fn moved(mesh: &Mesh, gear: &Gear, arc: &[f64], depth: &[f64]) -> Result<Mesh, MeshError> {
    relocate(mesh, gear, &node_depths(mesh, arc, depth))
}

/// Depths (mm at the stations `arc`) at the nodes of each flank of `mesh`.
fn node_depths(mesh: &Mesh, arc: &[f64], depth: &[f64]) -> Vec<Vec<f64>> {
    let at = |s: &f64| interpolate(arc, depth, *s);
    mesh.flanks
        .iter()
        .map(|chain| chain.arc.iter().map(at).collect())
        .collect()
}

/// What the mesh of a gear is to be like.
fn spec(gear: &Gear, fine: Vec<i32>, spacing: f64, order: usize) -> MeshSpec {
    MeshSpec {
        order: if order == 1 { Order::T3 } else { Order::T6 },
        ..MeshSpec::new(gear, fine, spacing, gear.rho_form)
    }
}

/// Meshes of both gears, fine on the loaded flanks of the pinion's `teeth` and of the gear's teeth of opposite number;
/// `own` meshes stand in for ours.
///
/// # Errors
/// [`MeshError`] if no acceptable mesh is found.
pub fn meshes(
    gears: &[Gear; 2],
    teeth: &[i32],
    spacing: f64,
    order: usize,
    own: [Option<Mesh>; 2],
) -> Result<[Mesh; 2], MemberError> {
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
    Ok([pinion?, gear?])
}
