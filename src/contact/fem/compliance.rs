//! The members' condensed compliance as the contact grids of all positions see it.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::flanks::ElasticFlanks;
use crate::contact::alteration::Alteration;
use crate::contact::cycle::{Cycle, PairContact, Position};
use crate::contact::model::ContactError;
use crate::contact::mortar::{Trace, couple};
use crate::numeric::sparse::SparseRows;
use crate::numeric::{Vec2, cross, rotate};

/// Mortar coupling of one tooth pair to the finite elements of both members.
#[derive(Debug, Clone)]
pub struct FlankCoupling {
    /// Rows: hats; columns: nodes of the tooth's flank; pinion then gear, mm.
    pub traces: [SparseRows; 2],
}

/// What the elastic members look like from the contact grids of every position: independent of load and wear.
#[derive(Debug, Clone)]
pub struct CycleCompliance {
    pub(super) positions: Vec<PositionCompliance>,
    pub(super) friction: f64,
}

#[derive(Debug, Clone)]
pub(super) struct PositionCompliance {
    pub(super) weighted: DMatrix<f64>,
    /// Lever of the torque, friction included, mm·mm.
    pub(super) lever: Vec<f64>,
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
