//! Contact of the elastic members: the condensed flank compliance of both, seen by the contact grid of each position.

mod compliance;
mod face;
mod flank_ends;
mod flank_waves;
mod flanks;
mod tangent;
mod ties;

use nalgebra::DMatrix;

use crate::contact::alteration::{Alteration, set_back};
use crate::contact::cycle::{Cycle, Position};
use crate::contact::model::{ContactError, ContactModel, PositionContact, SlicedContact};
use crate::contact::sequence::Sequence;
use crate::contact::slices::{Flanks, Slices};
use crate::contact::tangent::LinearContact;
use crate::contact::unilateral::{Drive, Problem, sensitivity, solve};
pub use compliance::{CycleCompliance, FlankCoupling, member_tooth, member_turns};
pub use flank_waves::WaveError;
pub use flanks::{ElasticFlanks, ToothFlank};
pub use ties::ToothWaves;

/// Flanks that give way by more than this under load, in modules, have left their path of contact: the turn is then no longer
/// small against the tooth, and gaps taken at the unloaded position no longer hold. What the turn makes up for in wear does
/// not count: turned by as much as they have gone back, worn flanks meet as they did.
const MOST_GIVING: f64 = 0.25;

/// How far down from a tip its worn corner reaches, modules: no more than the least depth there is sure to have gone.
const CORNER: f64 = 0.1;

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
    /// More than one slice of the face.
    slices: Option<&'a Slices>,
    /// What ties the slices, by turn.
    ties: Option<&'a [DMatrix<f64>]>,
    /// Teeth that differ.
    sequence: Option<&'a Sequence>,
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
            slices: None,
            ties: None,
            sequence: None,
        }
    }

    /// The same with the face in slices; none: one section.
    pub fn across(mut self, slices: Option<&'a Slices>) -> Self {
        self.slices = slices;
        self
    }

    /// The same with the slices tied ([`ToothWaves::ties`]).
    pub fn tied(mut self, ties: Option<&'a [DMatrix<f64>]>) -> Self {
        self.ties = ties;
        self
    }

    /// The same with teeth that differ; none: all are alike.
    pub fn in_turn(mut self, sequence: Option<&'a Sequence>) -> Self {
        self.sequence = sequence;
        self
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
            symmetric: self.compliance.symmetric,
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
        self.within_limits(
            position,
            gap,
            &solution.pressure,
            solution.approach,
            corners,
        )?;
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

    /// Whether a solution is one that the model was prepared for.
    fn within_limits(
        &self,
        position: &Position,
        gap: &[f64],
        pressure: &[f64],
        approach: f64,
        corners: [f64; 2],
    ) -> Result<(), ContactError> {
        // a rigid turn closes a corner by r_b times it, less what the corner itself has lost
        let closing = approach * self.cycle.pair.pinion.base_radius;
        for (apart, lost) in position.left_out.iter().zip(corners) {
            if closing > apart + lost {
                return Err(ContactError::OutOfReach {
                    theta: position.theta,
                    separation: *apart,
                });
            }
        }
        let limit = MOST_GIVING * self.cycle.pair.pinion.rack.module;
        let giving = closing - mean_gap(position, gap, pressure);
        // an open slice of the face does not give way at all
        let loaded = self.slices.is_none() || pressure.iter().any(|p| *p > 0.0);
        if loaded && giving > limit {
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
                if at_end && pressure[pair.offset + k] > 0.0 {
                    return Err(ContactError::WindowTooNarrow {
                        theta: position.theta,
                        window,
                    });
                }
            }
        }
        Ok(())
    }

    /// Weighted gaps of the flanks as effects make them, as worn and as their teeth stand.
    fn gap(&self, q: usize, flanks: &Flanks<'_>) -> Vec<f64> {
        let position = &self.cycle.positions[q];
        let mut gap = position.gap.clone();
        position.open_each(flanks.of(0), &mut gap);
        if let Some(opened) = self.opened {
            for (gap, opened) in gap.iter_mut().zip(&opened[q]) {
                *gap += opened;
            }
        }
        for (pair, back) in position.pairs.iter().zip(&flanks.back) {
            if *back != 0.0 {
                set_back(&mut gap, pair, *back);
            }
        }
        gap
    }

    /// Least depth that the whole tip corners of pinion and gear have lost, mm, with how far their teeth stand back.
    fn lost(&self, flanks: &Flanks<'_>) -> [f64; 2] {
        let mut least = [f64::INFINITY; 2];
        let mut before: Option<([&[f64]; 2], [f64; 2])> = None;
        for (depth, back) in flanks.of(0).iter().zip(&flanks.back) {
            let same = |known: &[&[f64]; 2]| (0..2).all(|i| std::ptr::eq(known[i], depth[i]));
            let lost = match before {
                Some((known, lost)) if same(&known) => lost,
                _ => self.lost_corners(*depth),
            };
            before = Some((*depth, lost));
            least = [0, 1].map(|side| least[side].min(lost[side] + back));
        }
        least
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

    fn solve_flanks(
        &self,
        q: usize,
        flanks: &Flanks<'_>,
        start: &[usize],
    ) -> Result<PositionContact, ContactError> {
        self.solve_gap(q, &self.gap(q, flanks), start, self.lost(flanks))
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
        _: &Flanks<'_>,
    ) -> Result<Box<dyn LinearContact + 'm>, ContactError> {
        Ok(Box::new(tangent::FemLinear::new(self, q, contact)?))
    }

    fn sequence(&self) -> Option<&Sequence> {
        self.sequence
    }

    fn sliced(&self) -> Option<&dyn SlicedContact> {
        self.slices.map(|_| self as &dyn SlicedContact)
    }
}
