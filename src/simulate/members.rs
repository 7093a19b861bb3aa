//! Both gears as elastic bodies: meshed, factored and condensed onto the flanks that can touch. Done once per geometry;
//! every load, misalignment, wear state and trial parameter reuses it.

use rayon::join;

use crate::contact::fem::{ElasticFlanks, ToothFlank};
use crate::fem::{Body, FemError};
use crate::gear::{Gear, Pair};
use crate::material::Elastic;
use crate::mesh::{Cells, Mesh, MeshError, MeshSpec, Order, mesh_gear};

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
}

impl Members {
    /// Meshes and condenses both gears of `pair`, in parallel.
    ///
    /// `teeth` are the pinion's teeth that can touch (the gear's have the opposite numbers), `spacing` the length of
    /// their flanks' edges (mm), `order` 2 for quadratic triangles or 1 for linear.
    ///
    /// # Errors
    /// [`MemberError`].
    pub fn build(
        pair: &Pair,
        materials: [Elastic; 2],
        teeth: &[i32],
        spacing: f64,
        order: usize,
    ) -> Result<Self, MemberError> {
        let mirrored: Vec<i32> = teeth.iter().rev().map(|t| -t).collect();
        let (pinion, gear) = join(
            || Member::build(&pair.pinion, materials[0], teeth, spacing, order),
            || Member::build(&pair.gear, materials[1], &mirrored, spacing, order),
        );
        Ok(Self {
            members: [pinion?, gear?],
            spacing,
        })
    }

    /// Length of a flank edge, mm.
    pub fn spacing(&self) -> f64 {
        self.spacing
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

    fn build(
        gear: &Gear,
        material: Elastic,
        teeth: &[i32],
        spacing: f64,
        order: usize,
    ) -> Result<Self, MemberError> {
        let mut spec = MeshSpec::new(gear, teeth.to_vec(), spacing, gear.rho_form);
        spec.order = if order == 1 { Order::T3 } else { Order::T6 };
        Self::from_mesh(mesh_gear(gear, &spec)?, material)
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
