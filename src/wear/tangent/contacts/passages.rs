//! Passages of teeth that differ: each takes the derivatives of its own pairs from what meets at a position.

use std::ops::Range;

use super::OfPosition;
use crate::contact::cycle::PairContact;
use crate::contact::model::{ContactModel, PositionContact};
use crate::contact::sequence::{Sequence, ToothDepths};
use crate::contact::slices::Flanks;
use crate::contact::tangent::{AlterationChange, Change, ContactTangent, LinearContact};
use crate::wear::archard::{Joint, WearError};
use crate::wear::tangent::{Differentiated, Direction};

/// Depths of all teeth, and how they and their places change along each direction.
pub(super) struct InTurn<'s> {
    sequence: &'s Sequence,
    depths: ToothDepths,
    moved: Vec<Moved>,
}

/// Derivatives of the depths of all teeth, and of how far these stand back by member and tooth.
type Moved = (ToothDepths, [Vec<f64>; 2]);

impl<'s> InTurn<'s> {
    pub(super) fn new(
        sequence: &'s Sequence,
        joint: &Joint,
        directions: &[Direction<'_>],
        du: &[Vec<f64>],
    ) -> Self {
        let moved = |(direction, du): (&Direction<'_>, &Vec<f64>)| {
            let altered = direction.altered.as_ref();
            let back = altered.and_then(|a| a.alteration.tooth_back.clone());
            (sequence.depths(du), back.unwrap_or_default())
        };
        Self {
            sequence,
            depths: sequence.depths(&joint.u),
            moved: directions.iter().zip(du).map(moved).collect(),
        }
    }
}

impl<M: ContactModel + ?Sized> Differentiated<'_, '_, M> {
    /// One position of all passages of teeth that differ.
    pub(super) fn of_passages(
        &self,
        in_turn: &InTurn<'_>,
        q: usize,
        joint: &Joint,
        along: &[&[f64]],
    ) -> Result<OfPosition, WearError> {
        let (law, sequence) = (self.system.law(), in_turn.sequence);
        let met = self.met(in_turn, q, joint)?;
        let size = law.cycle.stations.count();
        let of_passage = |p: usize| {
            let passage = OnePassage { met: &met, p };
            let responses = along.iter().map(|v| {
                let depth = law.split(&v[p * size..(p + 1) * size]);
                passage.responses(&Flanks::alike(met.pairs.len(), depth))
            });
            let responses: Vec<Vec<Vec<f64>>> = responses.collect();
            let moved = self.directions.iter().map(|direction| {
                let altered = direction.altered.as_ref();
                passage.response_tangents(&responses, altered)
            });
            (
                (0..self.directions.len())
                    .map(|d| passage.tangent(d))
                    .collect(),
                responses.iter().map(|y| passage.on_active_set(y)).collect(),
                moved.collect(),
            )
        };
        Ok((0..sequence.count()).map(of_passage).collect())
    }

    /// All that meets at position `q`, linearised.
    fn met<'s>(
        &'s self,
        in_turn: &InTurn<'s>,
        q: usize,
        joint: &'s Joint,
    ) -> Result<Met<'s>, WearError> {
        let (model, sequence) = (self.system.model, in_turn.sequence);
        let mut linears = Vec::new();
        let mut tangents = Vec::new();
        for (s, contact) in joint.met[q].iter().enumerate() {
            let flanks = sequence.flanks(q, s, &in_turn.depths);
            let linear = model.linearised(q, contact, &flanks)?;
            let of_direction = |(direction, (depths, back)): (&Direction<'_>, &Moved)| {
                linear.tangent(&Change {
                    flanks: &sequence.flanks_with(q, s, depths, back),
                    altered: direction.altered.as_ref(),
                })
            };
            let each = self.directions.iter().zip(&in_turn.moved);
            tangents.push(each.map(of_direction).collect::<Vec<ContactTangent>>());
            linears.push(linear);
        }
        let position = &model.cycle().positions[q];
        Ok(Met {
            sequence,
            q,
            pairs: &position.pairs,
            size: position.gap.len(),
            contacts: &joint.met[q],
            linears,
            tangents,
        })
    }
}

/// What meets at one position, linearised.
struct Met<'m> {
    sequence: &'m Sequence,
    q: usize,
    pairs: &'m [PairContact],
    /// Unknowns of the position.
    size: usize,
    contacts: &'m [PositionContact],
    linears: Vec<Box<dyn LinearContact + 'm>>,
    /// By direction.
    tangents: Vec<Vec<ContactTangent>>,
}

/// A passage of a tooth at one position. Each of its pairs is read from what meets when this very pair is in contact.
struct OnePassage<'m> {
    met: &'m Met<'m>,
    /// Its number.
    p: usize,
}

impl OnePassage<'_> {
    /// Where the pair `index` is read from.
    fn read(&self, index: usize) -> usize {
        self.met.sequence.read(self.met.q, self.p, index)
    }

    /// The unknowns of the pair `index`.
    fn own(&self, index: usize) -> Range<usize> {
        let pair = &self.met.pairs[index];
        pair.offset..pair.offset + pair.xi.len()
    }

    /// The derivatives of its contact along the direction `d`.
    fn tangent(&self, d: usize) -> ContactTangent {
        let pairs = self.met.pairs.len();
        let mut out = ContactTangent {
            pressure: vec![0.0; self.met.size],
            approach: 0.0,
        };
        for index in 0..pairs {
            let met = &self.met.tangents[self.read(index)][d];
            out.pressure[self.own(index)].copy_from_slice(&met.pressure[self.own(index)]);
            out.approach += met.approach / pairs as f64;
        }
        out
    }

    /// The responses of the pairs to depths, each on the active set that it is read from.
    fn responses(&self, depths: &Flanks<'_>) -> Vec<Vec<f64>> {
        (0..self.met.pairs.len())
            .map(|index| self.met.linears[self.read(index)].response(depths))
            .collect()
    }

    /// The derivatives of such responses, by vector, on the passage's active set; None where there are none.
    fn response_tangents(
        &self,
        responses: &[Vec<Vec<f64>>],
        altered: Option<&AlterationChange>,
    ) -> Option<Vec<Vec<f64>>> {
        let of_vector = |responses: &Vec<Vec<f64>>| {
            let mut all = Vec::new();
            for (index, response) in responses.iter().enumerate() {
                let linear = &self.met.linears[self.read(index)];
                let change = linear.response_tangent(response, altered?)?;
                all.extend(self.kept(index, &change));
            }
            Some(all)
        };
        responses.iter().map(of_vector).collect()
    }

    /// The values of the pairs on the passage's active set, as its Jacobian has them.
    fn on_active_set(&self, by_pair: &[Vec<f64>]) -> Vec<f64> {
        let each = by_pair.iter().enumerate();
        each.flat_map(|(index, y)| self.kept(index, y)).collect()
    }

    /// Of values on the active set that the pair `index` is read from those of its own unknowns.
    fn kept(&self, index: usize, values: &[f64]) -> Vec<f64> {
        let active = &self.met.contacts[self.read(index)].active;
        let own = self.own(index);
        let all = active.iter().zip(values);
        all.filter(|(k, _)| own.contains(k))
            .map(|(_, value)| *value)
            .collect()
    }
}
