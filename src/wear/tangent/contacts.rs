//! The contacts of all positions, differentiated: of one section, of slices that share a rotation, of passages of teeth that differ.

mod passages;

use rayon::prelude::*;

use self::passages::InTurn;
use super::Differentiated;
use crate::contact::model::{ContactModel, PositionContact, SlicedContact};
use crate::contact::slices::{Flanks, Slices};
use crate::contact::tangent::{Change, ContactTangent};
use crate::wear::archard::{Joint, WearError};
use crate::wear::law::Solved;

/// The contacts of all positions, differentiated.
pub(super) struct ContactTangents {
    /// By direction and position.
    pub(super) contacts: Vec<Vec<ContactTangent>>,
    /// S G v by vector and position.
    pub(super) responses: Vec<Vec<Vec<f64>>>,
    /// Their derivatives by direction, vector and position; None where there are none.
    pub(super) response_tangents: Vec<Option<Vec<Vec<Vec<f64>>>>>,
}

impl ContactTangents {
    /// Puts those of slice `i`, found turn by turn, into the order of its section positions.
    fn put_by_section(&mut self, slices: &Slices, i: usize) {
        for tangents in &mut self.contacts {
            slices.by_section(i, tangents);
        }
        for responses in &mut self.responses {
            slices.by_section(i, responses);
        }
        for responses in self.response_tangents.iter_mut().flatten().flatten() {
            slices.by_section(i, responses);
        }
    }
}

/// Contact tangents and responses of one position, by slice: tangents by direction, responses by vector, and their derivatives by direction
/// and vector.
type OfPosition = Vec<(
    Vec<ContactTangent>,
    Vec<Vec<f64>>,
    Vec<Option<Vec<Vec<f64>>>>,
)>;

impl<M: ContactModel + ?Sized> Differentiated<'_, '_, M> {
    /// By slice, where the depths of `joint` change by `du`, with responses to the depths `along`.
    pub(super) fn contacts(
        &self,
        joint: &Joint,
        du: &[Vec<f64>],
        along: &[&[f64]],
    ) -> Result<Vec<ContactTangents>, WearError> {
        let in_turn = (self.system.model.sequence())
            .map(|sequence| InTurn::new(sequence, joint, self.directions, du));
        let positions: Vec<OfPosition> = (0..self.system.law().cycle.positions.len())
            .into_par_iter()
            .with_min_len(4)
            .map(|q| match (&in_turn, self.system.model.sliced()) {
                (Some(in_turn), _) => self.of_passages(in_turn, q, joint, along),
                (None, Some(model)) => self.of_slices(model, q, joint, du, along),
                (None, None) => self.of_section(q, &joint.slices[0], du, along),
            })
            .collect::<Result<_, _>>()?;
        let count = positions.len();
        let empty = || ContactTangents {
            contacts: vec![Vec::with_capacity(count); du.len()],
            responses: vec![Vec::with_capacity(count); along.len()],
            response_tangents: (self.directions.iter())
                .map(|_| Some(vec![Vec::new(); along.len()]))
                .collect(),
        };
        let mut out: Vec<ContactTangents> = joint.slices.iter().map(|_| empty()).collect();
        for position in positions {
            for (out, (tangents, responses, moved)) in out.iter_mut().zip(position) {
                for (all, tangent) in out.contacts.iter_mut().zip(tangents) {
                    all.push(tangent);
                }
                for (all, response) in out.responses.iter_mut().zip(responses) {
                    all.push(response);
                }
                for (all, moved) in out.response_tangents.iter_mut().zip(moved) {
                    match (&mut *all, moved) {
                        (Some(all), Some(moved)) => {
                            all.iter_mut().zip(moved).for_each(|(all, y)| all.push(y));
                        }
                        _ => *all = None,
                    }
                }
            }
        }
        if let (None, Some(model)) = (&in_turn, self.system.model.sliced()) {
            for (i, of_slice) in out.iter_mut().enumerate() {
                of_slice.put_by_section(model.slices(), i);
            }
        }
        Ok(out)
    }

    /// One position of the one section that there is.
    fn of_section(
        &self,
        q: usize,
        solved: &Solved,
        du: &[Vec<f64>],
        along: &[&[f64]],
    ) -> Result<OfPosition, WearError> {
        let (model, law) = (self.system.model, self.system.law());
        let pairs = law.cycle.positions[q].pairs.len();
        let flanks = Flanks::alike(pairs, law.split(&solved.u));
        let linear = model.linearised(q, &solved.contacts[q], &flanks)?;
        let tangents: Vec<ContactTangent> = (self.directions.iter().zip(du))
            .map(|(direction, du)| {
                linear.tangent(&Change {
                    flanks: &Flanks::alike(pairs, law.split(du)),
                    altered: direction.altered.as_ref(),
                })
            })
            .collect();
        let responses: Vec<Vec<f64>> = along
            .iter()
            .map(|v| linear.response(&Flanks::alike(pairs, law.split(v))))
            .collect();
        let moved: Vec<Option<Vec<Vec<f64>>>> = (self.directions.iter())
            .map(|direction| {
                let altered = direction.altered.as_ref()?;
                let moved = responses
                    .iter()
                    .map(|y| linear.response_tangent(y, altered));
                moved.collect()
            })
            .collect();
        Ok(vec![(tangents, responses, moved)])
    }

    /// One turn of all slices.
    fn of_slices(
        &self,
        model: &dyn SlicedContact,
        turn: usize,
        joint: &Joint,
        du: &[Vec<f64>],
        along: &[&[f64]],
    ) -> Result<OfPosition, WearError> {
        let law = self.system.law();
        let at = model.slices().all_at(turn, law.cycle.positions.len());
        let own = joint.slices.iter().zip(&at);
        let contacts: Vec<&PositionContact> = own.map(|(s, q)| &s.contacts[*q]).collect();
        let depths = law.each(&joint.u);
        let linear = model.linearised_all(turn, &contacts, &law.flanks(&at, &depths))?;
        let mut out: OfPosition = (joint.slices.iter())
            .map(|_| (Vec::new(), Vec::new(), Vec::new()))
            .collect();
        for (direction, du) in self.directions.iter().zip(du) {
            let depths = law.each(du);
            let tangents = linear.tangents(&Change {
                flanks: &law.flanks(&at, &depths),
                altered: direction.altered.as_ref(),
            });
            for (out, tangent) in out.iter_mut().zip(tangents) {
                out.0.push(tangent);
            }
        }
        let responses: Vec<Vec<Vec<f64>>> = along
            .iter()
            .map(|v| linear.responses(&law.flanks(&at, &law.each(v))))
            .collect();
        for direction in self.directions {
            let moved: Option<Vec<Vec<Vec<f64>>>> =
                direction.altered.as_ref().and_then(|altered| {
                    let moved = responses.iter();
                    moved
                        .map(|y| linear.response_tangents(y, altered))
                        .collect()
                });
            for (slice, out) in out.iter_mut().enumerate() {
                let own = moved
                    .as_ref()
                    .map(|by_vector| by_vector.iter().map(|y| y[slice].clone()).collect());
                out.2.push(own);
            }
        }
        for response in responses {
            for (out, own) in out.iter_mut().zip(response) {
                out.1.push(own);
            }
        }
        Ok(out)
    }
}
