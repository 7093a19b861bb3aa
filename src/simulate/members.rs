//! Both gears as elastic bodies: meshed, factored and condensed onto the flanks that can touch. Done once per geometry;
//! every load, misalignment, wear state and trial parameter reuses it.

use rayon::join;

use crate::contact::cycle::Stations;
use crate::contact::fem::{ElasticFlanks, ToothFlank};
use crate::fem::{Body, FemError};
use crate::gear::{Gear, Pair};
use crate::material::Elastic;
use crate::mesh::{Cells, Mesh, MeshError, MeshSpec, Order, mesh_gear, relocate};
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
}

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

    /// The members with the material of `depth` (mm at the `stations`, pinion then gear) removed: nodes moved along the
    /// inward normal, the interior following; not factored.
    ///
    /// # Errors
    /// [`MemberError`] if a triangle turns over.
    pub fn worn_meshes(
        &self,
        pair: &Pair,
        stations: &Stations,
        depth: [&[f64]; 2],
    ) -> Result<[Mesh; 2], MemberError> {
        let worn = |side: usize| -> Result<Mesh, MemberError> {
            let mesh = &self.members[side].mesh;
            let depths: Vec<Vec<f64>> = mesh
                .flanks
                .iter()
                .map(|chain| {
                    chain
                        .arc
                        .iter()
                        .map(|&s| interpolate(&stations.arc[side], depth[side], s))
                        .collect()
                })
                .collect();
            Ok(relocate(mesh, [&pair.pinion, &pair.gear][side], &depths)?)
        };
        let (pinion, gear) = join(|| worn(0), || worn(1));
        Ok([pinion?, gear?])
    }

    /// The members factored and condensed again on the given meshes.
    ///
    /// # Errors
    /// [`MemberError`].
    pub fn condensed_on(&self, meshes: [Mesh; 2]) -> Result<Self, MemberError> {
        let [pinion, gear] = meshes;
        let (pinion, gear) = join(
            || Member::from_mesh(pinion, self.members[0].material),
            || Member::from_mesh(gear, self.members[1].material),
        );
        Ok(Self {
            members: [pinion?, gear?],
            spacing: self.spacing,
            of_user: self.of_user,
        })
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
        let mut spec = MeshSpec::new(&gears[side], fine, spacing, gears[side].rho_form);
        spec.order = if order == 1 { Order::T3 } else { Order::T6 };
        mesh_gear(&gears[side], &spec)
    };
    let [own_pinion, own_gear] = own;
    let (pinion, gear) = join(|| one(0, own_pinion), || one(1, own_gear));
    Ok([pinion?, gear?])
}
