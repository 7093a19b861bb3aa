//! Worn flanks at one moment: depths, contact of every mesh position, and what follows from them.

use crate::contact::cycle::{Cycle, PairContact};
use crate::contact::deposit::tributary;
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::contact::sequence::Sequence;
use crate::contact::slices::Slices;
use crate::simulate::turn::over_a_turn;
use crate::wear::archard::ArchardSystem;
use crate::wear::integrator::Stand;

/// The flanks after some cycles, and how they mesh then.
#[derive(Debug, Clone, PartialEq)]
pub struct WearState {
    /// Pinion revolutions.
    pub cycles: f64,
    /// Worn depth at the stations of pinion and gear, mm in the transverse section; of several slices the mean over the face.
    pub depth: [Vec<f64>; 2],
    /// Contact at every mesh position; of several slices with the mean pressures over the face. Of helical gears slices come to a position at
    /// different turns; the approach is that of mid-face's.
    pub contacts: Vec<PositionContact>,
    /// Slice by slice, where the face has more than one.
    pub slices: Vec<SliceState>,
    /// Class by class, where teeth differ; the above are then those of the mean tooth.
    pub teeth: Vec<ToothState>,
    /// Contact at every mesh position by passage, where teeth differ.
    pub passages: Vec<Vec<PositionContact>>,
    /// Rotation of the pinion (base pitches) and approach (rad) over one turn of the member with more teeth, where teeth differ.
    pub turn: Vec<[f64; 2]>,
    /// Part of the worn area that effects only displaced, without loss of mass, per tooth of pinion and gear, mm².
    pub displaced: [f64; 2],
}

/// One slice of worn flanks.
#[derive(Debug, Clone, PartialEq)]
pub struct SliceState {
    /// Its middle from mid-face, mm.
    pub face: f64,
    /// Worn depth at the stations of pinion and gear, mm.
    pub depth: [Vec<f64>; 2],
    /// Contact at every mesh position.
    pub contacts: Vec<PositionContact>,
}

/// Teeth of a member that wear alike.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothState {
    /// 0 pinion, 1 gear.
    pub side: usize,
    /// Which of the member's teeth, in the order in which they come into mesh.
    pub teeth: Vec<usize>,
    /// Worn depth at the member's stations, mm.
    pub depth: Vec<f64>,
}

impl WearState {
    /// The slice `i` by itself.
    pub fn section(&self, i: usize) -> Self {
        let slice = &self.slices[i];
        Self {
            cycles: self.cycles,
            depth: slice.depth.clone(),
            contacts: slice.contacts.clone(),
            slices: Vec::new(),
            teeth: Vec::new(),
            passages: Vec::new(),
            turn: Vec::new(),
            displaced: self.displaced,
        }
    }
}

/// The state where an integration stands: depths by flank and the contact of every position; `displaced`: see [`WearState::displaced`].
///
/// # Errors
/// [`ContactError`] of the first position that fails.
pub fn state_of<M: ContactModel + ?Sized>(
    model: &M,
    stand: &Stand,
    displaced: [f64; 2],
) -> Result<WearState, ContactError> {
    let cycle = model.cycle();
    let by_slice = contacts_at(model, &stand.u)?;
    let flanks = split(cycle, &stand.u);
    let owned = |flanks: &[&[f64]; 2]| flanks.map(<[f64]>::to_vec);
    let slices = model.sliced().map(|model| model.slices());
    let sequence = model.sequence();
    let depth = match (sequence, slices) {
        (Some(sequence), _) => owned(&split(cycle, &sequence.mean_of(&stand.u))[0]),
        (None, Some(slices)) => owned(&split(cycle, &slices.mean_of(&stand.u))[0]),
        (None, None) => owned(&flanks[0]),
    };
    let of_slice = |(i, slices): (usize, &Slices)| SliceState {
        face: slices.place[i],
        depth: owned(&flanks[i]),
        contacts: by_slice[i].clone(),
    };
    let all = slices.into_iter();
    let weights = match (sequence, slices) {
        (Some(sequence), _) => Some(sequence.contact_weights()),
        (None, slices) => slices.map(|slices| slices.weight.clone()),
    };
    Ok(WearState {
        cycles: stand.n,
        depth,
        slices: all
            .flat_map(|slices| (0..slices.count()).map(move |i| (i, slices)))
            .map(of_slice)
            .collect(),
        turn: match sequence {
            Some(sequence) => over_a_turn(model, sequence, &stand.u, &by_slice[0])?,
            None => Vec::new(),
        },
        teeth: sequence.map_or_else(Vec::new, |sequence| tooth_states(sequence, &flanks)),
        passages: sequence.map_or_else(Vec::new, |_| by_slice.clone()),
        contacts: mean_contacts(weights.as_deref(), slices, by_slice),
        displaced,
    })
}

/// The teeth that wear differently, by the depths of all passages.
fn tooth_states(sequence: &Sequence, flanks: &[[&[f64]; 2]]) -> Vec<ToothState> {
    let state = |side: usize, teeth: Vec<usize>| {
        let mut depth = vec![0.0; flanks[0][side].len()];
        for (passage, weight) in sequence.homes(side, teeth[0]) {
            let own = flanks[passage][side].iter();
            depth
                .iter_mut()
                .zip(own)
                .for_each(|(d, own)| *d += weight * own);
        }
        ToothState { side, teeth, depth }
    };
    let all = (0..2).flat_map(|side| {
        let alike = sequence.worn_alike(side).into_iter();
        alike.map(move |teeth| (side, teeth))
    });
    all.map(|(side, teeth)| state(side, teeth)).collect()
}

/// Depths of pinion and gear, slice by slice.
pub(super) fn split<'u>(cycle: &Cycle, u: &'u [f64]) -> Vec<[&'u [f64]; 2]> {
    u.chunks(cycle.stations.count())
        .map(|slice| slice.split_at(cycle.stations.arc[0].len()).into())
        .collect()
}

/// Contacts with the mean pressures over the face, or over all passages of teeth, of those by slice or passage and the `weights` of these.
/// Pressures are those at a section position, wherever in the turn each slice comes to it; the approach is that at the turn.
pub fn mean_contacts(
    weights: Option<&[f64]>,
    slices: Option<&Slices>,
    mut by_slice: Vec<Vec<PositionContact>>,
) -> Vec<PositionContact> {
    let Some(weights) = weights else {
        return by_slice.swap_remove(0);
    };
    let mean = |q: usize| {
        let all = || by_slice.iter().map(|contacts| &contacts[q]);
        let count = by_slice[0][q].pressure.len();
        let pressure: Vec<f64> = (0..count)
            .map(|k| weighted(weights, all().map(|contact| contact.pressure[k])))
            .collect();
        let largest = |of: fn(&PositionContact) -> f64| all().map(of).fold(0.0, f64::max);
        PositionContact {
            active: (0..count).filter(|&k| pressure[k] > 0.0).collect(),
            pressure,
            approach: weighted(
                weights,
                (by_slice.iter().enumerate()).map(|(i, contacts)| {
                    contacts[slices.map_or(q, |s| s.at(i, q, contacts.len()))].approach
                }),
            ),
            iterations: all().map(|contact| contact.iterations).max().unwrap_or(0),
            penetration: largest(|contact| contact.penetration),
            torque_error: largest(|contact| contact.torque_error),
        }
    };
    (0..by_slice[0].len()).map(mean).collect()
}

fn weighted(weights: &[f64], values: impl Iterator<Item = f64>) -> f64 {
    weights.iter().zip(values).map(|(w, v)| w * v).sum()
}

/// The contact of every position by slice at the depths `u` (mm at the stations of pinion and gear).
///
/// # Errors
/// [`ContactError`] of the first position that fails.
pub fn contacts_at<M: ContactModel + ?Sized>(
    model: &M,
    u: &[f64],
) -> Result<Vec<Vec<PositionContact>>, ContactError> {
    ArchardSystem::new(model, [0.0; 2]).all_contacts(u)
}

/// ∫ h ds over one flank, mm².
pub fn worn_area(stations: &[f64], depth: &[f64]) -> f64 {
    depth
        .iter()
        .enumerate()
        .map(|(i, h)| h * tributary(stations, i))
        .sum()
}

/// Line load of one tooth pair, N/mm.
pub fn line_load(pair: &PairContact, contact: &PositionContact) -> f64 {
    pair.length
        .iter()
        .zip(&contact.pressure[pair.offset..])
        .map(|(l, p)| l * p)
        .sum()
}
