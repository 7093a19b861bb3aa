//! Both gears as elastic bodies: meshed, factored and condensed onto the flanks that can touch. Done once per geometry;
//! every load, misalignment, wear state and trial parameter reuses it.

use std::sync::Arc;

use crate::contact::fem::{ElasticFlanks, ToothFlank};
use crate::fem::{Body, FemError};
use crate::gear::Gear;
use crate::material::Elastic;
use crate::mesh::{Mesh, MeshError};
use crate::simulate::blanks::{Blanks, order_of};

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
    /// What they were made from.
    pub blanks: Arc<Blanks>,
    /// Depths at the stations for which a member was meshed anew; none: its mesh is the unworn one, moved or not.
    pub(super) anew: [Option<Vec<f64>>; 2],
}

impl Members {
    /// Meshes and condenses both gears, in parallel; arguments as for [`Blanks::new`].
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
        let blanks = Blanks::new(gears, materials, teeth, spacing, order, own)?;
        Arc::new(blanks).condensed()
    }

    /// Length of a flank edge, mm.
    pub fn spacing(&self) -> f64 {
        self.blanks.spacing()
    }

    /// The condensed flanks of both.
    pub fn flanks(&self) -> [&ElasticFlanks; 2] {
        [&self.members[0].flanks, &self.members[1].flanks]
    }
}

impl Member {
    /// 2 for quadratic triangles, 1 for linear.
    pub fn order(&self) -> usize {
        order_of(&self.mesh)
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
        let order = order_of(&mesh);
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
