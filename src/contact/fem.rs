//! Contact of the elastic members: the condensed flank compliance of both, seen by the contact grid of each position.

mod tangent;

use std::ops::Range;

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::contact::alteration::{Alteration, set_back};
use crate::contact::cycle::{Cycle, PairContact, Position};
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::contact::mortar::{Trace, couple};
use crate::contact::strips::Strips;
use crate::contact::tangent::LinearContact;
use crate::contact::unilateral::{Drive, Problem, sensitivity, solve};
use crate::fem::Compliance;
use crate::numeric::sparse::SparseRows;
use crate::numeric::{Vec2, cross, rotate};

/// The flank of one tooth among the interface unknowns of its member.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothFlank {
    /// Tooth number in the member frame.
    pub tooth: i32,
    /// Index of its first held node among the interface nodes.
    pub first: usize,
    /// Arc coordinates of its nodes, mm.
    pub arc: Vec<f64>,
    /// Nodes that the compliance holds: the part that can touch.
    pub held: Range<usize>,
    /// 2 for quadratic edges, 1 for linear.
    pub order: usize,
}

/// Flanks that give way by more than this under load, in modules, have left their path of contact: the turn is then no longer
/// small against the tooth, and gaps taken at the unloaded position no longer hold. What the turn makes up for in wear does
/// not count: turned by as much as they have gone back, worn flanks meet as they did.
const MOST_GIVING: f64 = 0.25;

/// How far down from a tip its worn corner reaches, modules: no more than the least depth there is sure to have gone.
const CORNER: f64 = 0.1;

/// Condensed compliance of one member's candidate flanks.
#[derive(Debug, Clone)]
pub struct ElasticFlanks {
    /// Displacements of the interface nodes per unit nodal loads, member frame.
    pub compliance: Compliance,
    /// The flanks, by interface node.
    pub flanks: Vec<ToothFlank>,
}

impl ElasticFlanks {
    fn flank(&self, tooth: i32) -> Option<&ToothFlank> {
        self.flanks.iter().find(|f| f.tooth == tooth)
    }

    /// Whether the compliance holds all that can touch of the member `side` (0 pinion, 1 gear).
    pub fn cover(&self, strips: &Strips, side: usize) -> bool {
        strips.parts(side).all(|(tooth, [low, high])| {
            self.flank(tooth).is_some_and(|flank| {
                let Range { start, end } = flank.held;
                (start == 0 || flank.arc[start] <= low)
                    && (end == flank.arc.len() || flank.arc[end - 1] >= high)
            })
        })
    }
}

/// Mortar coupling of one tooth pair to the finite elements of both members.
#[derive(Debug, Clone)]
pub struct FlankCoupling {
    /// Rows: hats; columns: nodes of the tooth's flank; pinion then gear, mm.
    pub traces: [SparseRows; 2],
}

/// Finite-element contact over one mesh cycle at one torque.
#[derive(Debug, Clone)]
pub struct FemContact<'a> {
    cycle: &'a Cycle,
    compliance: &'a CycleCompliance,
    /// Pinion torque per face width, N·mm/mm.
    torque: f64,
    /// Weighted gaps of a profile that effects give the flanks.
    opened: Option<&'a [Vec<f64>]>,
    alteration: Option<&'a Alteration>,
}

/// What the elastic members look like from the contact grids of every position: independent of load and wear.
#[derive(Debug, Clone)]
pub struct CycleCompliance {
    positions: Vec<PositionCompliance>,
    friction: f64,
}

#[derive(Debug, Clone)]
struct PositionCompliance {
    weighted: DMatrix<f64>,
    /// Lever of the torque, friction included, mm·mm.
    lever: Vec<f64>,
    couplings: Vec<FlankCoupling>,
}

impl CycleCompliance {
    /// Projects the members' compliance onto the grid of each position, in parallel.
    ///
    /// `friction` is the Coulomb coefficient of full slip against the sliding direction; 0 for none.
    ///
    /// # Errors
    /// [`ContactError::NoFlank`] if a tooth that can touch has no fine flank in a member's mesh.
    pub fn new(
        cycle: &Cycle,
        members: [&ElasticFlanks; 2],
        friction: f64,
    ) -> Result<Self, ContactError> {
        let positions = cycle
            .positions
            .par_iter()
            .map(|position| PositionCompliance::new(cycle, position, members, friction))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            positions,
            friction,
        })
    }

    /// The same with what effects change about load and flexibility.
    ///
    /// ```text
    /// lever_k → lever_k/f of its pair          W → W + q l lᵀ on each pair (l_k = ∫ N_k)
    /// ```
    pub fn altered(&self, cycle: &Cycle, alteration: &Alteration) -> Self {
        let mut out = self.clone();
        for (q, (elastic, position)) in out.positions.iter_mut().zip(&cycle.positions).enumerate() {
            for (index, pair) in position.pairs.iter().enumerate() {
                let own = pair.offset..pair.offset + pair.xi.len();
                let factor = alteration.factor(q, index);
                for lever in &mut elastic.lever[own.clone()] {
                    *lever /= factor;
                }
                if alteration.flexibility != 0.0 {
                    for (k, row) in own.clone().enumerate() {
                        for (l, column) in own.clone().enumerate() {
                            elastic.weighted[(row, column)] +=
                                alteration.flexibility * (pair.length[k] * pair.length[l]);
                        }
                    }
                }
            }
        }
        out
    }

    /// Traction on the gear per unit pressure, friction included, fixed frame (the pinion's is the opposite).
    pub fn traction(&self, pair: &PairContact) -> Vec2 {
        pair.frame.normal + friction_direction(pair, self.friction)
    }

    /// Lever of the torque for each unknown of position `q`, friction included, mm·mm.
    pub fn levers(&self, q: usize) -> &[f64] {
        &self.positions[q].lever
    }

    /// Coupling of each tooth pair of position `q` to the elements.
    pub fn couplings(&self, q: usize) -> &[FlankCoupling] {
        &self.positions[q].couplings
    }
}

impl PositionCompliance {
    fn new(
        cycle: &Cycle,
        position: &Position,
        members: [&ElasticFlanks; 2],
        friction: f64,
    ) -> Result<Self, ContactError> {
        let turns = member_turns(cycle, position.theta);
        let n = position.gap.len();
        let mut couplings = Vec::new();
        for pair in &position.pairs {
            let mut traces = Vec::new();
            for (side, member) in members.iter().enumerate() {
                let tooth = member_tooth(pair, side);
                let flank = member
                    .flank(tooth)
                    .ok_or(ContactError::NoFlank { side, tooth })?;
                traces.push(Trace {
                    side,
                    arc: &flank.arc,
                    order: flank.order,
                });
            }
            let coupling = couple(&pair.xi, |x| pair.frame.facing(&cycle.pair, x), &traces);
            couplings.push(FlankCoupling {
                traces: coupling.traces.try_into().expect("two traces were given"),
            });
        }
        let mut weighted = DMatrix::zeros(n, n);
        for side in 0..2 {
            let flanks: Vec<SideView> = position
                .pairs
                .iter()
                .zip(&couplings)
                .map(|(pair, coupling)| {
                    SideView::new(
                        pair,
                        &coupling.traces[side],
                        members[side],
                        side,
                        turns[side],
                        friction,
                    )
                })
                .collect::<Result<_, _>>()?;
            add_weighted(&mut weighted, &flanks, members[side]);
        }
        if friction == 0.0 {
            // both halves are the same sums in another order; make them the same bits
            weighted.fill_lower_triangle_with_upper_triangle();
        }
        let mut lever = position.arm.clone();
        for pair in &position.pairs {
            let force = friction_direction(pair, friction);
            let (origin, tangent) = (pair.frame.origin, pair.frame.tangent);
            for k in 0..pair.xi.len() {
                lever[pair.offset + k] +=
                    cross(origin * pair.length[k] + tangent * pair.moment[k], force);
            }
        }
        Ok(Self {
            weighted,
            lever,
            couplings,
        })
    }
}

/// Tooth of member `side` (0 pinion, 1 gear) in tooth pair j: j and −j.
pub fn member_tooth(pair: &PairContact, side: usize) -> i32 {
    if side == 0 { pair.tooth } else { -pair.tooth }
}

/// Rotation of both member frames at pinion rotation `theta`, rad.
pub fn member_turns(cycle: &Cycle, theta: f64) -> [f64; 2] {
    let path = theta * cycle.pair.base_pitch;
    [cycle.pair.pinion_angle(path), cycle.pair.gear_angle(path)]
}

/// Traction on the gear per unit pressure that friction adds to n: against the sliding of the gear on the pinion.
///
/// In recess (slip > 0) the pinion's surface slides towards its root and drags the gear with it, along −t.
fn friction_direction(pair: &PairContact, friction: f64) -> Vec2 {
    pair.frame.tangent * (-friction * pair.slip.signum() * f64::from(u8::from(pair.slip != 0.0)))
}

/// One tooth pair as one member sees it.
struct SideView<'a> {
    offset: usize,
    rows: &'a SparseRows,
    /// Interface node of the first column used, and how many columns.
    first_node: usize,
    first_column: usize,
    count: usize,
    /// Contact normal and traction per unit pressure in the member frame.
    normal: Vec2,
    traction: Vec2,
}

impl<'a> SideView<'a> {
    fn new(
        pair: &PairContact,
        rows: &'a SparseRows,
        member: &ElasticFlanks,
        side: usize,
        turn: f64,
        friction: f64,
    ) -> Result<Self, ContactError> {
        let columns = (0..rows.len()).flat_map(|k| rows.row(k).0.iter().copied());
        let (low, high) = columns.fold((u32::MAX, 0), |(low, high), c| (low.min(c), high.max(c)));
        let tooth = member_tooth(pair, side);
        let flank = (member.flank(tooth))
            .filter(|f| f.held.start <= low as usize && (high as usize) < f.held.end)
            .ok_or(ContactError::NoFlank { side, tooth })?;
        Ok(Self {
            offset: pair.offset,
            rows,
            first_node: flank.first + low as usize - flank.held.start,
            first_column: low as usize,
            count: (high - low) as usize + 1,
            normal: rotate(pair.frame.normal, -turn),
            traction: rotate(
                pair.frame.normal + friction_direction(pair, friction),
                -turn,
            ),
        })
    }
}

/// W += D (nᵀ C f) Dᵀ of one member.
fn add_weighted(weighted: &mut DMatrix<f64>, views: &[SideView], member: &ElasticFlanks) {
    for source in views {
        for target in views {
            let block = DMatrix::from_fn(target.count, source.count, |i, j| {
                let (row, column) = (2 * (target.first_node + i), 2 * (source.first_node + j));
                let c = member.compliance.column(column);
                let d = member.compliance.column(column + 1);
                let force = source.traction;
                target.normal.x * (c[row] * force.x + d[row] * force.y)
                    + target.normal.y * (c[row + 1] * force.x + d[row + 1] * force.y)
            });
            // T = block · D_sourceᵀ, then W += D_target · T
            let mut spread = DMatrix::zeros(target.count, source.rows.len());
            for l in 0..source.rows.len() {
                let (columns, values) = source.rows.row(l);
                for (&c, &v) in columns.iter().zip(values) {
                    spread.column_mut(l).axpy(
                        v,
                        &block.column(c as usize - source.first_column),
                        1.0,
                    );
                }
            }
            for l in 0..source.rows.len() {
                for k in 0..target.rows.len() {
                    let (columns, values) = target.rows.row(k);
                    let sum: f64 = columns
                        .iter()
                        .zip(values)
                        .map(|(&c, v)| v * spread[(c as usize - target.first_column, l)])
                        .sum();
                    weighted[(target.offset + k, source.offset + l)] += sum;
                }
            }
        }
    }
}

impl<'a> FemContact<'a> {
    /// Contact under a pinion torque per face width (N·mm/mm).
    pub fn new(cycle: &'a Cycle, compliance: &'a CycleCompliance, torque: f64) -> Self {
        Self {
            cycle,
            compliance,
            torque,
            opened: None,
            alteration: None,
        }
    }

    /// The same with what effects change: `opened` are the alteration's own [`Alteration::gaps`]; load and flexibility stand in
    /// the compliance already ([`CycleCompliance::altered`]).
    pub fn with(mut self, alteration: &'a Alteration, opened: Option<&'a [Vec<f64>]>) -> Self {
        self.alteration = Some(alteration);
        self.opened = opened;
        self
    }

    /// Depth that the whole tip corners of pinion and gear have lost, mm.
    fn lost_corners(&self, depth: [&[f64]; 2]) -> [f64; 2] {
        let reach = CORNER * self.cycle.pair.pinion.rack.module;
        [0, 1].map(|side| {
            let arc = &self.cycle.stations.arc[side];
            let first = arc.partition_point(|s| *s < arc[arc.len() - 1] - reach);
            depth[side][first..]
                .iter()
                .fold(f64::INFINITY, |m, h| m.min(*h))
        })
    }

    fn problem<'b>(&'b self, q: usize, gap: &'b [f64]) -> Problem<'b> {
        let elastic = &self.compliance.positions[q];
        Problem {
            w: &elastic.weighted,
            gap,
            arm: &self.cycle.positions[q].arm,
            lever: &elastic.lever,
            drive: Drive::Load(self.torque),
            symmetric: self.compliance.friction == 0.0,
        }
    }

    fn solve_gap(
        &self,
        q: usize,
        gap: &[f64],
        start: &[usize],
        corners: [f64; 2],
    ) -> Result<PositionContact, ContactError> {
        let position = &self.cycle.positions[q];
        let solution =
            solve(&self.problem(q, gap), start).map_err(|source| ContactError::Unilateral {
                theta: position.theta,
                source,
            })?;
        // a rigid turn closes a corner by r_b times it, less what the corner itself has lost
        let closing = solution.approach * self.cycle.pair.pinion.base_radius;
        for (apart, lost) in position.left_out.iter().zip(corners) {
            if closing > apart + lost {
                return Err(ContactError::OutOfReach {
                    theta: position.theta,
                    separation: *apart,
                });
            }
        }
        let limit = MOST_GIVING * self.cycle.pair.pinion.rack.module;
        let giving = closing - mean_gap(position, gap, &solution.pressure);
        if giving > limit {
            return Err(ContactError::TooSoft {
                theta: position.theta,
                closing: giving,
                limit,
            });
        }
        for pair in &position.pairs {
            let window = self.cycle.spec.window;
            for (k, at_end) in [
                (0, pair.xi[0] <= -window + self.cycle.spec.spacing),
                (
                    pair.xi.len() - 1,
                    pair.xi[pair.xi.len() - 1] >= window - self.cycle.spec.spacing,
                ),
            ] {
                if at_end && solution.pressure[pair.offset + k] > 0.0 {
                    return Err(ContactError::WindowTooNarrow {
                        theta: position.theta,
                        window,
                    });
                }
            }
        }
        let levers = &self.compliance.positions[q].lever;
        let products = solution.pressure.iter().zip(levers).map(|(p, l)| p * l);
        Ok(PositionContact {
            torque_error: (products.sum::<f64>() / self.torque - 1.0).abs(),
            pressure: solution.pressure,
            approach: solution.approach,
            active: solution.active,
            iterations: solution.iterations,
            penetration: solution.penetration,
        })
    }

    /// Teeth differ: each tooth pair in turn is that of the measured tooth, and its pressures are taken from that solution.
    /// The pressures of one position then belong to different moments and need not balance the torque together; the
    /// approach is their mean.
    fn each_tooth_measured(
        &self,
        q: usize,
        gap: &[f64],
        start: &[usize],
        corners: [f64; 2],
        alteration: &Alteration,
    ) -> Result<PositionContact, ContactError> {
        let pairs = &self.cycle.positions[q].pairs;
        let mut joint = PositionContact {
            pressure: vec![0.0; gap.len()],
            approach: 0.0,
            active: Vec::new(),
            iterations: 0,
            penetration: 0.0,
            torque_error: 0.0,
        };
        for measured in 0..pairs.len() {
            let (unknowns, solved) =
                self.one_tooth_measured(q, gap, start, corners, alteration, measured)?;
            joint.pressure[unknowns.clone()].copy_from_slice(&solved.pressure[unknowns.clone()]);
            let active = solved.active.iter().copied();
            joint.active.extend(active.filter(|k| unknowns.contains(k)));
            joint.approach += solved.approach / pairs.len() as f64;
            joint.iterations = joint.iterations.max(solved.iterations);
            joint.penetration = joint.penetration.max(solved.penetration);
            joint.torque_error = joint.torque_error.max(solved.torque_error);
        }
        Ok(joint)
    }

    /// The contact with pair number `measured` that of the measured tooth, and that pair's unknowns.
    fn one_tooth_measured(
        &self,
        q: usize,
        gap: &[f64],
        start: &[usize],
        corners: [f64; 2],
        alteration: &Alteration,
        measured: usize,
    ) -> Result<(Range<usize>, PositionContact), ContactError> {
        let pairs = &self.cycle.positions[q].pairs;
        let mut gap = gap.to_vec();
        for (index, pair) in pairs.iter().enumerate() {
            set_back(&mut gap, pair, alteration.offset(measured, index));
        }
        let own = &pairs[measured];
        let unknowns = own.offset..own.offset + own.xi.len();
        Ok((unknowns, self.solve_gap(q, &gap, start, corners)?))
    }

    /// Weighted gaps of the flanks as effects make them and as worn (depths in mm).
    fn gap(&self, q: usize, depth: [&[f64]; 2]) -> Vec<f64> {
        let mut gap = self.cycle.positions[q].worn_gap(depth);
        if let Some(opened) = self.opened {
            for (gap, opened) in gap.iter_mut().zip(&opened[q]) {
                *gap += opened;
            }
        }
        gap
    }
}

/// Mean gap, mm, of what carries load, weighted with the load; `gap` is weighted with the hats.
fn mean_gap(position: &Position, gap: &[f64], pressure: &[f64]) -> f64 {
    let (mut work, mut load) = (0.0, 0.0);
    for pair in &position.pairs {
        for (k, length) in pair.length.iter().enumerate() {
            let p = pressure[pair.offset + k];
            work += p * gap[pair.offset + k];
            load += p * length;
        }
    }
    if load > 0.0 { work / load } else { 0.0 }
}

impl ContactModel for FemContact<'_> {
    fn cycle(&self) -> &Cycle {
        self.cycle
    }

    fn solve(
        &self,
        q: usize,
        depth: [&[f64]; 2],
        start: &[usize],
    ) -> Result<PositionContact, ContactError> {
        let gap = self.gap(q, depth);
        let corners = self.lost_corners(depth);
        match self.alteration {
            Some(alteration) if alteration.tooth_offset.is_some() => {
                self.each_tooth_measured(q, &gap, start, corners, alteration)
            }
            _ => self.solve_gap(q, &gap, start, corners),
        }
    }

    fn sensitivity(
        &self,
        q: usize,
        contact: &PositionContact,
    ) -> Result<Option<DMatrix<f64>>, ContactError> {
        let position = &self.cycle.positions[q];
        sensitivity(&self.problem(q, &position.gap), &contact.active)
            .map(Some)
            .map_err(|source| ContactError::Unilateral {
                theta: position.theta,
                source,
            })
    }
    fn linearised<'m>(
        &'m self,
        q: usize,
        contact: &PositionContact,
        depth: [&[f64]; 2],
    ) -> Result<Box<dyn LinearContact + 'm>, ContactError> {
        Ok(Box::new(tangent::FemLinear::new(self, q, contact, depth)?))
    }
}
