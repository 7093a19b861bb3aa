//! What follows from the contacts of a worn state: pressures that points see, the approach over a base pitch, and their derivatives.

use crate::contact::cycle::Cycle;
use crate::contact::model::PositionContact;
use crate::contact::slices::Slices;
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
        let reads: Vec<Reads> = match tangents.is_empty() {
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
        let base_pitch = BasePitch::new(cycle);
        let approach = |q: usize| contacts[q].approach;
        let parameters = tangents.first().map_or(0, Vec::len);
        let tangent = |parameter: usize| {
            let by_slice: Vec<&[ContactTangent]> = (tangents.iter())
                .map(|of_slice| of_slice[parameter].as_slice())
                .collect();
            let largest = (by_slice.iter().zip(&reads))
                .map(|(tangents, reads)| largest_tangents(tangents, reads))
                .collect();
            let mean = mean_tangents(&contacts, &by_slice, &weights, slices);
            MeshingTangent::new(&base_pitch, mean, largest)
        };
        Ok(Self {
            tangents: (0..parameters).map(tangent).collect(),
            mean: base_pitch.mean(approach),
            turns: (base_pitch.rotations.clone(), base_pitch.closed(approach)),
            contacts,
            passage,
            moments,
            by_slice,
        })
    }
}

impl MeshingTangent {
    fn new(
        base_pitch: &BasePitch,
        contacts: Vec<ContactTangent>,
        largest: Vec<[Vec<f64>; 2]>,
    ) -> Self {
        let approach = |q: usize| contacts[q].approach;
        Self {
            largest,
            approach: base_pitch.closed(approach),
            mean: base_pitch.mean(approach),
            contacts,
        }
    }
}

/// Where the largest pressures of one slice are read on both flanks: position, unknown of the position, and weight.
type Reads = [Vec<Vec<(u32, u32, f64)>>; 2];

/// The derivatives of the largest pressures of one slice on both flanks, MPa.
fn largest_tangents(tangents: &[ContactTangent], reads: &Reads) -> [Vec<f64>; 2] {
    let read =
        |&(q, k, weight): &(u32, u32, f64)| weight * tangents[q as usize].pressure[k as usize];
    [0, 1].map(|side| {
        let each = reads[side].iter();
        each.map(|reads| reads.iter().map(read).sum()).collect()
    })
}

/// The derivatives of the mean `contacts` over the face; helical slices are at other positions of the mesh cycle at the same rotation.
fn mean_tangents(
    contacts: &[PositionContact],
    by_slice: &[&[ContactTangent]],
    weights: &[f64],
    slices: Option<&Slices>,
) -> Vec<ContactTangent> {
    let pressure = |q: usize, k: usize| -> f64 {
        let all = weights.iter().zip(by_slice);
        all.map(|(w, own)| w * own[q].pressure[k]).sum()
    };
    let approach = |q: usize| -> f64 {
        let all = weights.iter().zip(by_slice).enumerate();
        all.map(|(i, (w, own))| {
            let at = slices.map_or(q, |s| s.at(i, q, own.len()));
            w * own[at].approach
        })
        .sum()
    };
    (contacts.iter().enumerate())
        .map(|(q, contact)| ContactTangent {
            pressure: (0..contact.pressure.len())
                .map(|k| pressure(q, k))
                .collect(),
            approach: approach(q),
        })
        .collect()
}

/// The positions of a mesh cycle in the order of their rotation.
struct BasePitch {
    order: Vec<usize>,
    /// Base pitches, closed around: from the last position of the pitch before to the first of the next one.
    rotations: Vec<f64>,
}

impl BasePitch {
    fn new(cycle: &Cycle) -> Self {
        let phase = |q: usize| cycle.positions[q].phase();
        let mut order: Vec<usize> = (0..cycle.positions.len()).collect();
        order.sort_by(|a, b| phase(*a).total_cmp(&phase(*b)));
        let mut pitch = Self {
            order,
            rotations: Vec::new(),
        };
        let mut rotations = pitch.closed(phase);
        let closing = rotations.len() - 1;
        rotations[0] -= 1.0;
        rotations[closing] += 1.0;
        pitch.rotations = rotations;
        pitch
    }

    /// A quantity of the positions at [`BasePitch::rotations`].
    fn closed(&self, of: impl Fn(usize) -> f64) -> Vec<f64> {
        let order = &self.order;
        let (first, last) = (order[0], order[order.len() - 1]);
        let all = std::iter::once(last).chain(order.iter().copied());
        all.chain(std::iter::once(first)).map(of).collect()
    }

    /// Its mean over the positions.
    fn mean(&self, of: impl Fn(usize) -> f64) -> f64 {
        self.order.iter().map(|&q| of(q)).sum::<f64>() / self.order.len() as f64
    }
}
