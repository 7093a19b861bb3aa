//! Displacement, stress and flank loads of both members at one mesh position, for drawing and for root stresses.

use crate::contact::cycle::Cycle;
use crate::contact::fem::{CycleCompliance, member_tooth, member_turns};
use crate::contact::model::PositionContact;
use crate::fem::{FemError, Stress};
use crate::mesh::{BoundaryEdge, boundary_edges};
use crate::numeric::{Vec2, rotate};
use crate::simulate::forward::{Forward, ForwardError};
use crate::simulate::members::Member;

/// Fields of one member at one mesh position, by node, in the member's frame.
#[derive(Debug, Clone)]
pub struct MemberFields {
    /// Rotation of the member frame into the fixed frame, rad (the gear's centre sits on the x axis).
    pub turn: f64,
    /// Displacement, mm.
    pub displacement: Vec<Vec2>,
    /// Nodal stresses, MPa.
    pub stress: Vec<Stress>,
    /// Contact force on the node per face width, N/mm.
    pub force: Vec<Vec2>,
    /// Contact pressure on flank nodes, MPa, never negative: consistent force over the node's share of the outline, so that its
    /// integral over the outline's edges is the load.
    pub pressure: Vec<f64>,
}

impl Forward<'_> {
    /// Fields of pinion and gear at mesh position `q` under `contact`, pressures on the flanks as last condensed.
    ///
    /// `None` for the analytic contact model.
    ///
    /// # Errors
    /// [`ForwardError`] if a solve misses its residual.
    pub fn fields(
        &self,
        q: usize,
        contact: &PositionContact,
    ) -> Result<Option<[MemberFields; 2]>, ForwardError> {
        let (Some(members), Some(outlines)) = (self.condensed(), self.outlines()) else {
            return Ok(None);
        };
        let points = [0, 1].map(|side: usize| &members.members[side].mesh.points[..]);
        let outlines = &outlines;
        self.fields_on(q, contact, Surfaces { points, outlines })
    }

    /// The edges of both members' outlines; `None` for the analytic contact model.
    pub fn outlines(&self) -> Option<[Vec<BoundaryEdge>; 2]> {
        let members = self.condensed()?;
        Some([0, 1].map(|side: usize| boundary_edges(&members.members[side].mesh)))
    }

    /// As [`Forward::fields`], pressures on (worn) `surfaces`.
    ///
    /// # Errors
    /// [`ForwardError`] if a solve misses its residual.
    pub fn fields_on(
        &self,
        q: usize,
        contact: &PositionContact,
        surfaces: Surfaces<'_>,
    ) -> Result<Option<[MemberFields; 2]>, ForwardError> {
        let (Some(members), Some(compliance)) = (self.condensed(), self.compliance()) else {
            return Ok(None);
        };
        let position = &self.cycle().positions[q];
        let turns = member_turns(self.cycle(), position.theta);
        let fields = |side: usize| -> Result<MemberFields, FemError> {
            let member = &members.members[side];
            let mut loads = Loads::new(surfaces.points[side], &surfaces.outlines[side]);
            loads.add(
                self.cycle(),
                compliance,
                q,
                contact,
                side,
                turns[side],
                member,
            );
            loads.solve(member, turns[side])
        };
        let (pinion, gear) = rayon::join(|| fields(0), || fields(1));
        let [mut pinion, mut gear] = [
            pinion.map_err(crate::simulate::members::MemberError::from)?,
            gear.map_err(crate::simulate::members::MemberError::from)?,
        ];
        // along the path of contact, of flanks that give way along their normal
        let inclined = self.cycle().pair.cos_base_helix();
        for fields in [&mut pinion, &mut gear] {
            fields.displacement.iter_mut().for_each(|u| *u /= inclined);
        }
        // the pinion's bore turns by the approach
        for (u, x) in pinion
            .displacement
            .iter_mut()
            .zip(&members.members[0].mesh.points)
        {
            *u += contact.approach * Vec2::new(-x.y, x.x);
        }
        Ok(Some([pinion, gear]))
    }
}

/// Where pressures act: node positions of both members, mm, and the edges of their outlines.
#[derive(Debug, Clone, Copy)]
pub struct Surfaces<'s> {
    /// Node positions, mm, worn or not.
    pub points: [&'s [Vec2]; 2],
    /// As of [`Forward::outlines`].
    pub outlines: &'s [Vec<BoundaryEdge>; 2],
}

struct Loads<'a> {
    points: &'a [Vec2],
    outline: &'a [BoundaryEdge],
    force: Vec<Vec2>,
    pressure: Vec<f64>,
}

impl<'a> Loads<'a> {
    fn new(points: &'a [Vec2], outline: &'a [BoundaryEdge]) -> Self {
        Self {
            points,
            outline,
            force: vec![Vec2::zeros(); points.len()],
            pressure: vec![0.0; points.len()],
        }
    }

    #[expect(
        clippy::too_many_arguments,
        reason = "one caller, and each is a different kind of thing"
    )]
    fn add(
        &mut self,
        cycle: &Cycle,
        compliance: &CycleCompliance,
        q: usize,
        contact: &PositionContact,
        side: usize,
        turn: f64,
        member: &Member,
    ) {
        let position = &cycle.positions[q];
        let couplings = position.pairs.iter().zip(compliance.couplings(q));
        for (index, (pair, coupling)) in couplings.enumerate() {
            let tooth = member_tooth(pair, side);
            let Some(chain) = member.mesh.flanks.iter().find(|f| f.tooth == tooth) else {
                continue;
            };
            let mut amount = vec![0.0; chain.nodes.len()];
            for k in 0..pair.xi.len() {
                coupling.traces[side].scatter(k, contact.pressure[pair.offset + k], &mut amount);
            }
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let traction = rotate(compliance.traction(cycle, q, index), -turn) * sign;
            for (&node, amount) in chain.nodes.iter().zip(&amount) {
                self.force[node as usize] += traction * *amount;
            }
            if member.order() == 2 {
                without_suction(&mut amount);
            }
            let share = self.shares(&chain.nodes, member.order());
            for ((&node, amount), share) in chain.nodes.iter().zip(&amount).zip(&share) {
                self.pressure[node as usize] = amount / share;
            }
        }
    }

    /// ∫ φ_i ds of each of a flank's `nodes` over the whole outline, mm: the first and the last node also have a share of the
    /// fillet's and of the tip land's edge beside them.
    fn shares(&self, nodes: &[u32], order: usize) -> Vec<f64> {
        let at = |node: &u32| self.points[*node as usize];
        let mut share = chain_shares(&nodes.iter().map(at).collect::<Vec<_>>(), order);
        let last = nodes.len() - 1;
        for edge in self.outline {
            let beside = [(edge.start, edge.end, 0), (edge.end, edge.start, order)];
            for (own, other, place) in beside {
                let of_flank = |node| nodes.contains(&node);
                let Some(end) = [0, last].into_iter().find(|i| nodes[*i] == own) else {
                    continue;
                };
                if !of_flank(other) {
                    let edge = [Some(edge.start), edge.mid, Some(edge.end)];
                    let edge: Vec<Vec2> = edge.iter().flatten().map(at).collect();
                    share[end] += chain_shares(&edge, order)[place];
                }
            }
        }
        share
    }

    fn solve(self, member: &Member, turn: f64) -> Result<MemberFields, FemError> {
        let loads: Vec<(u32, Vec2)> = self
            .force
            .iter()
            .enumerate()
            .filter(|(_, f)| f.norm_squared() > 0.0)
            .map(|(i, f)| (i as u32, *f))
            .collect();
        let displacement = member.body.solve(&loads)?;
        let stress = crate::fem::nodal_stress(&member.mesh, member.material, &displacement)?;
        Ok(MemberFields {
            turn,
            displacement,
            stress,
            force: self.force,
            pressure: self.pressure,
        })
    }
}

/// Consistent forces ∫ φ_i p dξ along quadratic edges, without negative ones.
///
/// A corner's shape function is negative in the far half of an edge, so where a contact ends there its force is negative although
/// nothing pulls. What is below 0 is taken from the mid-sides beside it, in proportion to theirs: there 4t(1 − t) ≥ (1 − t)(2t − 1),
/// so together they have more.
fn without_suction(amount: &mut [f64]) {
    for corner in (0..amount.len()).step_by(2) {
        if amount[corner] >= 0.0 {
            continue;
        }
        let lack = std::mem::take(&mut amount[corner]);
        let beside = [corner.checked_sub(1), Some(corner + 1)];
        let count = amount.len();
        let mids = || beside.into_iter().flatten().filter(|i| *i < count);
        let both: f64 = mids().map(|i| amount[i]).sum();
        for mid in mids() {
            amount[mid] *= (1.0 + lack / both).max(0.0);
        }
    }
}

/// ∫ φ_i ds of each node of a flank chain, mm: by Gauss quadrature along its (curved) edges.
pub fn chain_shares(points: &[Vec2], order: usize) -> Vec<f64> {
    let mut share = vec![0.0; points.len()];
    for first in (0..points.len() - 1).step_by(order) {
        if order == 1 {
            let length = (points[first + 1] - points[first]).norm();
            share[first] += 0.5 * length;
            share[first + 1] += 0.5 * length;
            continue;
        }
        let edge = &points[first..first + 3];
        for (t, weight) in [
            (0.5 - 0.15f64.sqrt(), 5.0 / 18.0),
            (0.5, 8.0 / 18.0),
            (0.5 + 0.15f64.sqrt(), 5.0 / 18.0),
        ] {
            let slope =
                edge[0] * (4.0 * t - 3.0) + edge[1] * (4.0 - 8.0 * t) + edge[2] * (4.0 * t - 1.0);
            let shapes = [
                (1.0 - t) * (1.0 - 2.0 * t),
                4.0 * t * (1.0 - t),
                t * (2.0 * t - 1.0),
            ];
            for (i, shape) in shapes.iter().enumerate() {
                share[first + i] += weight * shape * slope.norm();
            }
        }
    }
    share
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::mortar::{Facing, Trace, couple};

    /// Pressures of any width and place against the mid-sides and corners.
    #[test]
    fn pressures_are_never_negative_and_carry_the_load() {
        let nodes: Vec<f64> = (0..=16).map(|i| 0.25 * f64::from(i)).collect();
        let mut suction = 0;
        for width in [0.3, 0.5, 0.9, 1.7] {
            for place in 0..40 {
                let start = 0.9 + 0.03 * f64::from(place);
                let xi: Vec<f64> = (0..=4)
                    .map(|k| start + width * f64::from(k) / 4.0)
                    .collect();
                let facing = |x: f64| Facing {
                    arc: [x; 2],
                    gap: 0.0,
                };
                let trace = Trace {
                    side: 0,
                    arc: &nodes,
                    order: 2,
                };
                let coupling = couple(&xi, facing, &[trace]);
                let mut amount = vec![0.0; nodes.len()];
                let mut load = 0.0;
                for (k, p) in [0.0, 0.8, 1.0, 0.8, 0.0].into_iter().enumerate() {
                    coupling.traces[0].scatter(k, p, &mut amount);
                    load += p * coupling.length[k];
                }
                suction += usize::from(amount.iter().any(|a| *a < -1e-3));
                without_suction(&mut amount);
                assert!(amount.iter().all(|a| *a >= 0.0), "{amount:?}");
                assert!((amount.iter().sum::<f64>() / load - 1.0).abs() < 1e-12);
            }
        }
        assert!(
            suction > 20,
            "consistent forces were negative {suction} times"
        );
    }
}
