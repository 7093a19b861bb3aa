//! The members' condensed compliance as the contact grids of all positions see it.
//!
//! Under Coulomb friction with full slip the traction on the gear is p (n − µ sgn(v) t), so compliance and lever are straight in µ:
//!
//! ```text
//! W = W₀ + µ W_t          lever = arm + µ lever_t
//! ```
//! Of helical gears the body deforms in the section normal to the contact line: under the pressure p it gives way by C p along the normal,
//! and that is C p/cos β_b along the path of contact, on which gaps are measured. C is taken as that of the transverse section; that is exact
//! for what the contact itself gives way by, and near it for the tooth (guide/face.md). The force on the inclined flank is 1/cos β_b of
//! what it carries in the transverse section, and friction takes its share of that.

use std::sync::{Arc, OnceLock};

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
    /// Whether no pair has friction: then the compliance is symmetric.
    pub(super) symmetric: bool,
    /// The coefficient of all pairs, per force in the transverse section.
    friction: f64,
    /// What effects add to it, by position and pair.
    added_friction: Option<Vec<Vec<f64>>>,
    /// Made when an effect first asks for it.
    per_friction: Arc<OnceLock<Vec<PerFriction>>>,
}

/// Change of a position's compliance and levers per unit coefficient of friction; columns and levers of a pair follow its own.
#[derive(Debug, Clone)]
pub(super) struct PerFriction {
    pub(super) weighted: DMatrix<f64>,
    pub(super) lever: Vec<f64>,
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
        let friction = friction / cycle.pair.cos_base_helix();
        let positions = cycle
            .positions
            .par_iter()
            .map(|position| PositionCompliance::new(cycle, position, members, friction))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            positions,
            symmetric: friction == 0.0,
            friction,
            added_friction: None,
            per_friction: Arc::default(),
        })
    }

    /// The same with what effects change about load, flexibility and friction; `members` are those that it was made of.
    ///
    /// ```text
    /// lever_k → lever_k/f of its pair          W → W + q l lᵀ on each pair (l_k = ∫ N_k)
    /// ```
    pub fn altered(
        &self,
        cycle: &Cycle,
        alteration: &Alteration,
        members: [&ElasticFlanks; 2],
    ) -> Self {
        let mut out = self.clone();
        if alteration.friction.is_some() {
            out.rub(cycle, alteration, members);
        }
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

    /// Adds the friction of effects.
    fn rub(&mut self, cycle: &Cycle, alteration: &Alteration, members: [&ElasticFlanks; 2]) {
        let basis = Arc::clone(&self.per_friction);
        let per_friction = basis.get_or_init(|| {
            let positions = cycle.positions.par_iter().zip(&self.positions);
            positions
                .map(|(position, own)| PerFriction::new(cycle, position, members, &own.couplings))
                .collect()
        });
        for (q, (elastic, per)) in self.positions.iter_mut().zip(per_friction).enumerate() {
            for (index, pair) in cycle.positions[q].pairs.iter().enumerate() {
                let friction = alteration.friction(q, index);
                for k in pair.offset..pair.offset + pair.xi.len() {
                    let column = per.weighted.column(k);
                    elastic.weighted.column_mut(k).axpy(friction, &column, 1.0);
                    elastic.lever[k] += friction * per.lever[k];
                }
            }
        }
        self.symmetric &= alteration
            .friction
            .iter()
            .flatten()
            .flatten()
            .all(|f| *f == 0.0);
        self.added_friction.clone_from(&alteration.friction);
    }

    /// Change with the coefficient of friction, where an effect adds friction.
    pub(super) fn per_friction(&self, q: usize) -> Option<&PerFriction> {
        self.per_friction.get().map(|positions| &positions[q])
    }

    /// Traction on the gear per unit pressure at pair number `index` of position `q`, friction included, fixed frame (the pinion's is the
    /// opposite).
    pub fn traction(&self, cycle: &Cycle, q: usize, index: usize) -> Vec2 {
        let pair = &cycle.positions[q].pairs[index];
        let added = (self.added_friction.as_ref()).map_or(0.0, |added| added[q][index]);
        pair.frame.normal + (self.friction + added) * friction_direction(pair)
    }

    /// Torque per face width of `pair` of position `q` per unit of the friction that an effect adds, N·mm/mm, at the position's pressures;
    /// 0 where none does.
    pub fn moment_per_friction(&self, q: usize, pair: &PairContact, pressure: &[f64]) -> f64 {
        let own = pair.offset..pair.offset + pair.xi.len();
        self.per_friction(q).map_or(0.0, |per| {
            let products = pressure[own.clone()].iter().zip(&per.lever[own.clone()]);
            products.map(|(p, l)| p * l).sum()
        })
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
        let traction = |pair: &PairContact| pair.frame.normal + friction * friction_direction(pair);
        project(
            &mut weighted,
            cycle,
            position,
            members,
            &couplings,
            traction,
        )?;
        if friction == 0.0 {
            // both halves are the same sums in another order; make them the same bits
            weighted.fill_lower_triangle_with_upper_triangle();
        }
        let mut lever = position.arm.clone();
        for (lever, per) in lever.iter_mut().zip(levers_of_friction(position)) {
            *lever += friction * per;
        }
        Ok(Self {
            weighted,
            lever,
            couplings,
        })
    }
}

impl PerFriction {
    /// At a position whose flanks `couplings` tie to the elements.
    fn new(
        cycle: &Cycle,
        position: &Position,
        members: [&ElasticFlanks; 2],
        couplings: &[FlankCoupling],
    ) -> Self {
        let n = position.gap.len();
        let mut weighted = DMatrix::zeros(n, n);
        project(
            &mut weighted,
            cycle,
            position,
            members,
            couplings,
            friction_direction,
        )
        .expect("the flanks were found when the compliance was made");
        Self {
            weighted,
            lever: levers_of_friction(position),
        }
    }
}

/// Closing of the weighted gaps, taken as opening, by unit pressures with the `traction` on the gear of each pair, added to `weighted`.
fn project(
    weighted: &mut DMatrix<f64>,
    cycle: &Cycle,
    position: &Position,
    members: [&ElasticFlanks; 2],
    couplings: &[FlankCoupling],
    traction: impl Fn(&PairContact) -> Vec2,
) -> Result<(), ContactError> {
    let turns = member_turns(cycle, position.theta);
    for side in 0..2 {
        let views: Vec<SideView> = (position.pairs.iter().zip(couplings))
            .map(|(pair, coupling)| {
                let rows = &coupling.traces[side];
                let traction = traction(pair);
                SideView::new(pair, rows, members[side], side, turns[side], traction)
            })
            .collect::<Result<_, _>>()?;
        add_weighted(weighted, &views, members[side]);
    }
    let inclined = cycle.pair.cos_base_helix();
    if inclined != 1.0 {
        *weighted /= inclined;
    }
    Ok(())
}

/// Lever of the torque that friction adds to each unknown per unit coefficient, mm·mm.
fn levers_of_friction(position: &Position) -> Vec<f64> {
    let mut levers = Vec::with_capacity(position.gap.len());
    for pair in &position.pairs {
        let force = friction_direction(pair);
        let (origin, tangent) = (pair.frame.origin, pair.frame.tangent);
        let weighted = pair.length.iter().zip(&pair.moment);
        levers.extend(weighted.map(|(l, m)| cross(origin * *l + tangent * *m, force)));
    }
    levers
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

/// Traction on the gear per unit pressure and coefficient that friction adds to n: against the sliding of the gear on the pinion.
///
/// In recess (slip > 0) the pinion's surface slides towards its root and drags the gear with it, along −t.
fn friction_direction(pair: &PairContact) -> Vec2 {
    pair.frame.tangent * (-pair.slip.signum() * f64::from(u8::from(pair.slip != 0.0)))
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
        traction: Vec2,
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
            traction: rotate(traction, -turn),
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
