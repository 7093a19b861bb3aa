//! What follows from the contacts of a worn state: pressures that points see, the approach over a base pitch, and their derivatives.

use crate::contact::model::PositionContact;
use crate::contact::tangent::ContactTangent;
use crate::learn::prediction::trajectory::Node;
use crate::simulate::forward::{Forward, ForwardError, Variation};
use crate::simulate::wear_state::mean_contacts;
use crate::wear::passage::{Moment, Passage};

/// What follows from the contacts of a worn state.
pub(super) struct Meshing {
    /// The mean over the face.
    pub(super) contacts: Vec<PositionContact>,
    /// Order of a passage, and the largest pressures on both flanks.
    pub(super) passage: Passage,
    pub(super) moments: [Vec<Moment>; 2],
    /// Largest pressures on both flanks by slice.
    pub(super) by_slice: Vec<[Vec<Moment>; 2]>,
    /// Rotation (base pitches, ascending from 0 to 1) and approach (rad), closed around.
    pub(super) turns: (Vec<f64>, Vec<f64>),
    /// Mean approach over the base pitch, rad.
    pub(super) mean: f64,
    /// Derivatives by parameter.
    pub(super) tangents: Vec<MeshingTangent>,
}

/// The derivative of a [`Meshing`] by one parameter, per unit.
pub(super) struct MeshingTangent {
    pub(super) contacts: Vec<ContactTangent>,
    /// Of the largest pressures on both flanks by slice, MPa.
    pub(super) largest: Vec<[Vec<f64>; 2]>,
    /// Of the approach at the rotations of [`Meshing::turns`], rad, and of its mean.
    pub(super) approach: Vec<f64>,
    pub(super) mean: f64,
}

impl Meshing {
    /// Of a run in the state `worn`.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub(super) fn new(
        forward: &mut Forward<'_>,
        worn: &Node,
        variations: &[Variation],
    ) -> Result<Self, ForwardError> {
        let (all, tangents) = if variations.is_empty() {
            (forward.all_contacts_at(&worn.u)?, Vec::new())
        } else {
            forward.contacts_with_tangents(&worn.u, &worn.tangents.depth, variations)?
        };
        let cycle = forward.cycle();
        let passage = Passage::new(cycle);
        let by_slice: Vec<[Vec<Moment>; 2]> = (all.iter())
            .map(|contacts| [0, 1].map(|side| passage.moments(cycle, contacts, side)))
            .collect();
        let reads =
            |i: usize| [0, 1].map(|side| passage.reads(cycle, &all[i], side, &by_slice[i][side]));
        let reads: Vec<_> = match tangents.is_empty() {
            true => Vec::new(),
            false => (0..all.len()).map(reads).collect(),
        };
        let of_several = forward.weights();
        let slices = forward.slices();
        let contacts = mean_contacts(of_several.as_deref(), slices, all);
        let weights = of_several.unwrap_or_else(|| vec![1.0]);
        let moments = match by_slice.as_slice() {
            [one] => one.clone(),
            _ => [0, 1].map(|side| passage.moments(cycle, &contacts, side)),
        };
        let mut order: Vec<usize> = (0..contacts.len()).collect();
        let phase = |q: usize| cycle.positions[q].phase();
        order.sort_by(|a, b| phase(*a).total_cmp(&phase(*b)));
        let (first, last) = (order[0], order[order.len() - 1]);
        // closed around the base pitch
        let around = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let ends = |q: usize| std::iter::once(of(q));
            let inner = order.iter().map(|&q| of(q));
            ends(last).chain(inner).chain(ends(first)).collect()
        };
        let mean = |of: &dyn Fn(usize) -> f64| -> f64 {
            order.iter().map(|&q| of(q)).sum::<f64>() / order.len() as f64
        };
        let mut rotations = around(&phase);
        let closing = rotations.len() - 1;
        rotations[0] -= 1.0;
        rotations[closing] += 1.0;
        let approach = |q: usize| contacts[q].approach;
        let turns = (rotations, around(&approach));
        let tangent = |parameter: usize| {
            let of_slice = |i: usize| &tangents[i][parameter];
            let largest = |i: usize| {
                [0, 1].map(|side| {
                    let read = |&(q, k, weight): &(u32, u32, f64)| {
                        weight * of_slice(i)[q as usize].pressure[k as usize]
                    };
                    let each = reads[i][side].iter();
                    each.map(|reads| reads.iter().map(read).sum()).collect()
                })
            };
            let mean_tangent = |q: usize| {
                let sum = |of: &dyn Fn(&ContactTangent) -> f64| -> f64 {
                    let all = weights.iter().enumerate();
                    all.map(|(i, w)| w * of(&of_slice(i)[q])).sum()
                };
                ContactTangent {
                    pressure: (0..contacts[q].pressure.len())
                        .map(|k| sum(&|tangent| tangent.pressure[k]))
                        .collect(),
                    approach: (weights.iter().enumerate())
                        .map(|(i, w)| {
                            let own = of_slice(i);
                            let at = slices.map_or(q, |s| s.at(i, q, own.len()));
                            w * own[at].approach
                        })
                        .sum(),
                }
            };
            let contacts: Vec<ContactTangent> = (0..contacts.len()).map(mean_tangent).collect();
            let approach = |q: usize| contacts[q].approach;
            MeshingTangent {
                largest: (0..weights.len()).map(largest).collect(),
                approach: around(&approach),
                mean: mean(&approach),
                contacts,
            }
        };
        let parameters = tangents.first().map_or(0, Vec::len);
        Ok(Self {
            tangents: (0..parameters).map(tangent).collect(),
            mean: mean(&approach),
            turns,
            contacts,
            passage,
            moments,
            by_slice,
        })
    }
}
