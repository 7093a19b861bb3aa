//! Wear of teeth that differ: the contacts that each passage of a tooth is made of, and how its wear follows the depths.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::local::Local;
use super::{ArchardSystem, Joint, WearError, WithFactors};
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::contact::sequence::Sequence;
use crate::numeric::patchy::{PatchyMatrix, Rows};
use crate::wear::integrator::Jacobian;
use crate::wear::law::Factors;

impl<M: ContactModel + ?Sized> ArchardSystem<'_, M> {
    /// All contacts at the depths `u` of the passages, and the passages made of them.
    pub(super) fn solve_in_turn(
        &mut self,
        sequence: &Sequence,
        u: &[f64],
    ) -> Result<Joint, ContactError> {
        let positions = self.model.cycle().positions.len();
        let depths = sequence.depths(u);
        let mut first = vec![0];
        for q in 0..positions {
            first.push(first[q] + sequence.situations(q));
        }
        let of_position = |q: usize| {
            let starts = &self.warm[first[q]..first[q + 1]];
            let each = starts.iter().enumerate().map(|(s, start)| {
                let flanks = sequence.flanks(q, s, &depths);
                self.model.solve_flanks(q, &flanks, start)
            });
            each.collect::<Result<Vec<_>, _>>()
        };
        let all = (0..positions).into_par_iter().map(of_position);
        let met: Vec<Vec<PositionContact>> = all.collect::<Result<_, _>>()?;
        self.solves += self.warm.len();
        for (warm, contact) in self.warm.iter_mut().zip(met.iter().flatten()) {
            warm.clone_from(&contact.active);
        }
        let passage = |p: usize| -> Vec<_> {
            (0..positions)
                .map(|q| self.passing(sequence, p, q, &met[q]))
                .collect()
        };
        let passages = (0..sequence.count()).map(passage).collect();
        Ok(Joint {
            met,
            ..self.joint(u, passages)
        })
    }

    /// The contact of passage `p` at the position `q`: each pair's pressures are those of the contact in which it is the passage's own.
    /// They belong to different moments and do not balance the torque together.
    fn passing(
        &self,
        sequence: &Sequence,
        p: usize,
        q: usize,
        met: &[PositionContact],
    ) -> PositionContact {
        let position = &self.model.cycle().positions[q];
        let mut out = PositionContact {
            pressure: vec![0.0; position.gap.len()],
            approach: 0.0,
            active: Vec::new(),
            iterations: 0,
            penetration: 0.0,
            torque_error: 0.0,
        };
        let count = position.pairs.len() as f64;
        for (index, pair) in position.pairs.iter().enumerate() {
            let own = pair.offset..pair.offset + pair.xi.len();
            let contact = &met[sequence.read(q, p, index)];
            out.pressure[own.clone()].copy_from_slice(&contact.pressure[own.clone()]);
            out.active
                .extend(contact.active.iter().filter(|k| own.contains(k)));
            out.approach += contact.approach / count;
            out.iterations = out.iterations.max(contact.iterations);
            out.penetration = out.penetration.max(contact.penetration);
            out.torque_error = out.torque_error.max(contact.torque_error);
        }
        out
    }

    /// The Jacobian of the classes of teeth, as if the neighbours of a tooth wore as it does: what they wear otherwise changes its load
    /// over times as long as those in which the load sharing changes, over which steps are short enough.
    pub(super) fn jacobian_in_turn(
        &self,
        sequence: &Sequence,
        n: f64,
        u: &[f64],
    ) -> Result<WithFactors, WearError> {
        let (law, joint) = (self.law_at(u), self.known(u));
        let cycle = law.cycle;
        let of_position = |(q, met): (usize, &Vec<PositionContact>)| {
            let each = met.iter().map(|contact| self.model.sensitivity(q, contact));
            each.collect::<Result<Option<Vec<DMatrix<f64>>>, _>>()
        };
        let sensitivities = (joint.met.par_iter().enumerate())
            .map(of_position)
            .collect::<Result<Option<Vec<_>>, _>>()?;
        let of_passage = |p: usize| {
            let solved = &joint.slices[p];
            let view = law.view(n, &solved.u);
            let reads = law.added_reads(&view, solved, &law.reads(solved));
            let mut block = PatchyMatrix::new(cycle.stations.count());
            let mut all_factors: Vec<Factors> = Vec::with_capacity(cycle.positions.len());
            for (q, (contact, reads)) in solved.contacts.iter().zip(reads).enumerate() {
                let position = &cycle.positions[q];
                let (mut local, factors) = Local::new(&law, &view, position, contact, reads);
                all_factors.push(factors);
                let Some(sensitivities) = &sensitivities else {
                    continue;
                };
                for (index, pair) in position.pairs.iter().enumerate() {
                    let situation = sequence.read(q, p, index);
                    let own = pair.offset..pair.offset + pair.xi.len();
                    local.take(own, &joint.met[q][situation].active);
                    local.add(&sensitivities[q][situation], &mut block);
                }
            }
            (block, all_factors)
        };
        let passages = (0..sequence.count()).into_par_iter().map(of_passage);
        let (blocks, factors): (Vec<PatchyMatrix>, Vec<Vec<Factors>>) =
            passages.collect::<Vec<_>>().into_iter().unzip();
        let jacobian = sensitivities.map(|_| shared(sequence, &blocks, &cycle.stations.arc));
        Ok((jacobian, factors))
    }
}

/// What the passages' own matrices come to for the classes of teeth.
fn shared(sequence: &Sequence, blocks: &[PatchyMatrix], stations: &[Vec<f64>; 2]) -> Jacobian {
    let sharing = sequence.sharing();
    let mut of_classes = PatchyMatrix::new(sharing.size());
    let split = stations[0].len();
    let mut column = vec![0.0; sharing.size()];
    for (p, block) in blocks.iter().enumerate() {
        // which classes wear by this passage, and how much of it
        let fed: [Vec<(usize, f64)>; 2] = [0, 1].map(|m| {
            let classes = sharing.feeds[m].iter().enumerate();
            let by = classes.flat_map(|(class, feeds)| {
                let own = feeds.iter().filter(|(passage, _)| *passage == p);
                own.map(move |(_, weight)| (class, *weight))
            });
            by.collect()
        });
        for j in 0..block.size() {
            let side = usize::from(j >= split);
            let mut rows = Vec::new();
            for (i, value) in block.column(j) {
                let of = usize::from(i >= split);
                for &(class, weight) in &fed[of] {
                    let row = sharing.class_part(of, class).start + i - of * split;
                    column[row] = weight * value;
                    rows.push(row..row + 1);
                }
            }
            let rows = Rows::new(rows);
            for &(class, share) in &sharing.mixes[side][p] {
                let at = sharing.class_part(side, class).start + j - side * split;
                of_classes.add(at, &rows, share, &column);
            }
        }
    }
    Jacobian::Shared {
        of_classes,
        sharing: std::sync::Arc::clone(sharing),
    }
}
