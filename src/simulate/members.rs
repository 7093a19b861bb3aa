//! Both gears as elastic bodies: meshed, factored and condensed onto the flanks that can touch. Done once per geometry;
//! every load, misalignment, wear state and trial parameter reuses it.

use std::ops::Range;
use std::sync::Arc;

use crate::contact::fem::{ElasticFlanks, ToothFlank, WaveError};
use crate::contact::strips::Strips;
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

impl From<WaveError> for MemberError {
    fn from(error: WaveError) -> Self {
        match error {
            WaveError::Mesh(error) => Self::Mesh(error),
            WaveError::Fem(error) => Self::Fem(error),
        }
    }
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
    /// Meshes and condenses both gears where `strips` can touch, in parallel; other arguments as for [`Blanks::new`].
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
        strips: Strips,
    ) -> Result<Self, MemberError> {
        let blanks = Blanks::new(gears, materials, teeth, spacing, order, own, strips)?;
        let blanks = Arc::new(blanks);
        blanks.condensed(&blanks.strips)
    }

    /// Length of a flank edge, mm.
    pub fn spacing(&self) -> f64 {
        self.blanks.spacing()
    }

    /// Whether the compliance of both holds all that can touch.
    pub fn cover(&self, strips: &Strips) -> bool {
        (0..2).all(|side| self.members[side].flanks.cover(strips, side))
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

    /// Factors and condenses a given mesh on its whole fine flanks.
    ///
    /// # Errors
    /// [`FemError`] if the stiffness cannot be factored.
    pub fn from_mesh(mesh: Mesh, material: Elastic) -> Result<Self, MemberError> {
        Self::on_parts(mesh, material, |_| Some([f64::NEG_INFINITY, f64::INFINITY]))
    }

    /// Factors a given mesh and condenses it on a `part` of each fine tooth's flank: first and last arc coordinate, mm.
    ///
    /// # Errors
    /// [`FemError`] if the stiffness cannot be factored.
    pub fn on_parts(
        mesh: Mesh,
        material: Elastic,
        part: impl Fn(i32) -> Option<[f64; 2]>,
    ) -> Result<Self, MemberError> {
        let order = order_of(&mesh);
        let held: Vec<Range<usize>> = (mesh.flanks.iter())
            .map(|chain| part(chain.tooth).map_or(0..0, |ends| edges_over(&chain.arc, order, ends)))
            .collect();
        let interface: Vec<u32> = (mesh.flanks.iter().zip(&held))
            .flat_map(|(f, held)| f.nodes[held.clone()].iter().copied())
            .collect();
        let body = Body::new(&mesh, material, &mesh.bore, &interface)?;
        let mut first = 0;
        let flanks = mesh
            .flanks
            .iter()
            .zip(held)
            .map(|(chain, held)| {
                let count = held.len();
                let flank = ToothFlank {
                    tooth: chain.tooth,
                    first,
                    arc: chain.arc.clone(),
                    held,
                    order,
                };
                first += count;
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

/// Nodes of the edges between two arc coordinates (mm), with one more edge on either side; none where they do not reach the flank.
fn edges_over(arc: &[f64], order: usize, [low, high]: [f64; 2]) -> Range<usize> {
    let edges = (arc.len() - 1) / order;
    if high < arc[0] || low > arc[arc.len() - 1] {
        return 0..0;
    }
    let corner = |edge: usize| arc[edge * order];
    let before = (0..edges).rev().find(|e| corner(*e) <= low).unwrap_or(0);
    let after = (1..=edges).find(|e| corner(*e) >= high).unwrap_or(edges);
    before.saturating_sub(1) * order..(after + 1).min(edges) * order + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::cycle::CycleSpec;
    use crate::gear::{BasicRack, Pair, ToothSpec};
    use crate::mesh::{MeshSpec, mesh_gear};

    const STEEL: Elastic = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };

    fn gear() -> Gear {
        let rack = BasicRack {
            module: 2.0,
            pressure_angle: 20f64.to_radians(),
            addendum: 1.0,
            dedendum: 1.25,
            fillet_radius: 0.38,
        };
        Gear::new(rack, ToothSpec::plain(20, 20.0)).unwrap()
    }

    fn mesh() -> Mesh {
        let gear = gear();
        mesh_gear(&gear, &MeshSpec::new(&gear, vec![0, 1], 0.2, gear.rho_form)).unwrap()
    }

    /// What a node gives way by under loads on others does not depend on which further nodes the compliance holds.
    #[test]
    fn a_part_gives_way_as_it_does_within_the_whole_flank() {
        let whole = Member::from_mesh(mesh(), STEEL).unwrap();
        let arcs = |tooth: i32| {
            let arc = &whole.mesh.flanks[usize::try_from(tooth).unwrap()].arc;
            let at = |share: f64| arc[0] + share * (arc[arc.len() - 1] - arc[0]);
            // one part within the flank, one that ends at the tip
            Some(if tooth == 0 {
                [at(0.31), at(0.62)]
            } else {
                [at(0.77), at(1.5)]
            })
        };
        let part = Member::on_parts(mesh(), STEEL, arcs).unwrap();
        let [some, all] = [&part, &whole].map(|m| &m.flanks.compliance);
        assert!(some.size() < all.size() / 2);
        let place: Vec<usize> = (some.nodes().iter())
            .map(|node| all.nodes().iter().position(|n| n == node).unwrap())
            .collect();
        let unknown = |i: usize| 2 * place[i / 2] + i % 2;
        let largest = (0..all.size()).fold(0.0, |m: f64, i| m.max(all.get(i, i)));
        for i in 0..some.size() {
            for j in 0..some.size() {
                let [a, b] = [some.get(i, j), all.get(unknown(i), unknown(j))];
                assert!((a - b).abs() < 1e-11 * largest, "{a} and {b}");
            }
        }
        // and each holds its part, with no more than an edge and what is left of one on either side
        for flank in &part.flanks.flanks {
            let [low, high] = arcs(flank.tooth).unwrap();
            let (start, end) = (flank.arc[flank.held.start], flank.arc[flank.held.end - 1]);
            let tip = flank.arc[flank.arc.len() - 1];
            assert!(start <= low && start > low - 0.41, "{start}");
            assert!(end >= high.min(tip) && end < high.min(tip) + 0.41, "{end}");
        }
    }

    #[test]
    fn nodes_of_the_edges_over_a_part() {
        let arc = [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]; // four quadratic edges
        assert_eq!(edges_over(&arc, 2, [1.2, 1.8]), 0..7);
        assert_eq!(edges_over(&arc, 2, [2.2, 2.8]), 2..9);
        assert_eq!(edges_over(&arc, 2, [-1.0, 0.5]), 0..5);
        assert_eq!(edges_over(&arc, 2, [-1.0, 9.0]), 0..9);
        assert_eq!(edges_over(&arc, 2, [4.1, 9.0]), 0..0);
        assert_eq!(edges_over(&arc, 1, [2.1, 2.2]), 3..7);
    }

    /// Parts made for a cycle cover it; without one of its teeth they do not, though the tooth is in the mesh.
    #[test]
    fn a_tooth_without_a_part_is_not_covered() {
        let gear = gear();
        let distance = 2.0 * gear.reference_radius;
        let pair = Pair::new(gear.clone(), gear.clone(), distance, 0.0).unwrap();
        let spec = CycleSpec {
            positions: 10,
            spacing: 0.2,
            even: 0.4,
            window: 0.4,
            reach: 0.02,
        };
        let strips = Strips::new(&pair, spec);
        let teeth: Vec<i32> = strips.parts(0).map(|(tooth, _)| tooth).collect();
        let mesh = || {
            mesh_gear(
                &gear,
                &MeshSpec::new(&gear, teeth.clone(), 0.3, gear.rho_form),
            )
        };
        let with = |part: &dyn Fn(i32) -> Option<[f64; 2]>| {
            let member = Member::on_parts(mesh().unwrap(), STEEL, part).unwrap();
            member.flanks.cover(&strips, 0)
        };
        assert!(with(&|tooth| strips.of(0, tooth)));
        for left_out in &teeth {
            assert!(!with(&|tooth| strips
                .of(0, tooth)
                .filter(|_| tooth != *left_out)));
        }
        let shorter = |[low, high]: [f64; 2]| [low + 0.8, high - 0.8];
        assert!(!with(&|tooth| strips.of(0, tooth).map(shorter)));
    }
}
