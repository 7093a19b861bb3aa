//! Derivatives of a wear history with respect to parameters, carried along its steps.
//!
//! The discrete step is differentiated, not the differential equation: what comes out are the derivatives of the very numbers that the
//! steps gave, its sequence held. With S = du/dθ and F the rate,
//!
//! ```text
//! (I − γ τ J) dk₁ = dF₁ + γ τ dJ k₁            dF = (∂F/∂u) S + ∂F/∂θ        at the stage's own depths
//! (I − γ τ J) dk₂ = dF₂ − 2 dk₁ + γ τ dJ k₂    S' = S + (3/2) τ dk₁ + (1/2) τ dk₂
//! ```
//! The contact follows exactly, by back-substitutions on its active set ([`crate::contact::tangent`]). The law is not differentiated by hand:
//! it is asked once more a short way along the tangent of pressures, depths and parameter, without a contact to solve.

use rayon::prelude::*;

use crate::contact::model::{ContactModel, PositionContact, SlicedContact};
use crate::contact::sequence::{Sequence, ToothDepths};
use crate::contact::slices::{Flanks, Slices};
use crate::contact::tangent::{AlterationChange, Change, ContactTangent};
use crate::wear::acting::Acting;
use crate::wear::archard::{ArchardSystem, Joint, WearError};
use crate::wear::integrator::{Differentiable, Tangents};
use crate::wear::law::{Law, Reads, Solved};

/// A parameter that a wear history is differentiated by.
pub struct Direction<'a> {
    /// Derivatives of ln k of pinion and gear.
    pub coefficient: [f64; 2],
    /// The effects with the parameter moved by `step`; None: it is not theirs.
    pub shifted: Option<&'a Acting>,
    /// How far the law is asked along the tangent, in units of the parameter.
    pub step: f64,
    /// What the parameter alters about the contact, if anything.
    pub altered: Option<AlterationChange>,
}

/// A wear system with the parameters that it is differentiated by.
pub struct Differentiated<'s, 'a, M: ContactModel + ?Sized> {
    /// The system.
    pub system: &'s mut ArchardSystem<'a, M>,
    /// The parameters.
    pub directions: &'s [Direction<'s>],
}

/// The contacts of all positions, differentiated.
struct ContactTangents {
    /// By direction and position.
    contacts: Vec<Vec<ContactTangent>>,
    /// S G v by vector and position.
    responses: Vec<Vec<Vec<f64>>>,
    /// Their derivatives by direction, vector and position; None where there are none.
    response_tangents: Vec<Option<Vec<Vec<Vec<f64>>>>>,
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

/// Depths of all teeth, and how they and their places change along each direction.
struct InTurn<'s> {
    sequence: &'s Sequence,
    depths: ToothDepths,
    moved: Vec<Moved>,
}

/// Derivatives of the depths of all teeth, and of how far these stand back by member and tooth.
type Moved = (ToothDepths, [Vec<f64>; 2]);

impl<'s> InTurn<'s> {
    fn new(
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

/// Contact tangents and responses of one position, by slice: tangents by direction, responses by vector, and their derivatives by direction
/// and vector.
type OfPosition = Vec<(
    Vec<ContactTangent>,
    Vec<Vec<f64>>,
    Vec<Option<Vec<Vec<f64>>>>,
)>;

impl<M: ContactModel + ?Sized> Differentiated<'_, '_, M> {
    /// By slice.
    fn contacts(
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

    /// One position of all passages of teeth that differ.
    fn of_passages(
        &self,
        in_turn: &InTurn<'_>,
        q: usize,
        joint: &Joint,
        along: &[&[f64]],
    ) -> Result<OfPosition, WearError> {
        let (model, law, sequence) = (self.system.model, self.system.law(), in_turn.sequence);
        let pairs = &law.cycle.positions[q].pairs;
        let size = law.cycle.stations.count();
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
        let of_passage = |p: usize| {
            let read = |index: usize| sequence.read(q, p, index);
            let own = |index: usize| {
                let pair = &pairs[index];
                pair.offset..pair.offset + pair.xi.len()
            };
            let tangent = |d: usize| {
                let mut out = ContactTangent {
                    pressure: vec![0.0; law.cycle.positions[q].gap.len()],
                    approach: 0.0,
                };
                for index in 0..pairs.len() {
                    let met = &tangents[read(index)][d];
                    out.pressure[own(index)].copy_from_slice(&met.pressure[own(index)]);
                    out.approach += met.approach / pairs.len() as f64;
                }
                out
            };
            // on the passage's active set, as its Jacobian has them
            let kept = |index: usize, values: &[f64]| -> Vec<f64> {
                let active = &joint.met[q][read(index)].active;
                let all = active.iter().zip(values);
                all.filter(|(k, _)| own(index).contains(k))
                    .map(|(_, value)| *value)
                    .collect()
            };
            let mut responses = vec![Vec::new(); along.len()];
            let mut moved: Vec<Option<Vec<Vec<f64>>>> =
                vec![Some(vec![Vec::new(); along.len()]); self.directions.len()];
            for index in 0..pairs.len() {
                let linear = &linears[read(index)];
                for (v, response) in along.iter().zip(&mut responses) {
                    let depth = law.split(&v[p * size..(p + 1) * size]);
                    response.push(linear.response(&Flanks::alike(pairs.len(), depth)));
                }
            }
            for (moved, direction) in moved.iter_mut().zip(self.directions) {
                for (v, responses) in responses.iter().enumerate() {
                    for (index, response) in responses.iter().enumerate() {
                        let change = direction.altered.as_ref().and_then(|altered| {
                            linears[read(index)].response_tangent(response, altered)
                        });
                        match (change, &mut *moved) {
                            (Some(change), Some(all)) => all[v].extend(kept(index, &change)),
                            _ => *moved = None,
                        }
                    }
                }
            }
            let responses = (responses.iter()).map(|responses| {
                let each = responses.iter().enumerate();
                each.flat_map(|(index, y)| kept(index, y)).collect()
            });
            let tangents = (0..self.directions.len()).map(tangent).collect();
            (tangents, responses.collect(), moved)
        };
        Ok((0..sequence.count()).map(of_passage).collect())
    }

    /// Worn volumes a step along each direction, where they are those of the whole face.
    fn moved_volumes(&self, law: &Law<'_>, joint: &Joint, du: &[Vec<f64>]) -> Vec<Option<f64>> {
        let along = |(direction, du): (&Direction<'_>, &Vec<f64>)| {
            let moved: Vec<f64> = (joint.u.iter().zip(du))
                .map(|(u, du)| u + direction.step * du)
                .collect();
            self.system
                .worn_volume(direction.shifted.or(law.acting), &moved)
        };
        self.directions.iter().zip(du).map(along).collect()
    }

    /// Derivatives of the contacts of all positions, by slice, direction and position, where the depths `u` change by `du`.
    ///
    /// # Errors
    /// [`WearError`]
    pub fn contact_tangents(
        &mut self,
        u: &[f64],
        du: &[Vec<f64>],
    ) -> Result<Vec<Vec<Vec<ContactTangent>>>, WearError> {
        self.system.solved(u)?;
        let tangents = self.contacts(self.system.known(u), du, &[])?;
        Ok(tangents.into_iter().map(|slice| slice.contacts).collect())
    }

    /// Derivatives of the area per pinion cycle that effects only displace, by direction, mm² per unit; the mean over the face.
    ///
    /// # Errors
    /// [`WearError`]
    pub fn displaced_tangents(
        &mut self,
        n: f64,
        u: &[f64],
        du: &[Vec<f64>],
    ) -> Result<Vec<[f64; 2]>, WearError> {
        self.system.solved(u)?;
        let (law, joint) = (self.system.law_at(u), self.system.known(u));
        let tangents = self.contacts(joint, du, &[])?;
        let volumes = self.moved_volumes(&law, joint, du);
        let size = law.cycle.stations.count();
        let of_slice = |s: usize| -> Vec<[f64; 2]> {
            let (solved, tangents) = (&joint.slices[s], &tangents[s]);
            let reads = law.reads(solved);
            let before = law.displaced_rate(n, solved);
            let slope = |(i, direction): (usize, &Direction<'_>)| {
                let du = &du[i][s * size..(s + 1) * size];
                let (law, along) =
                    moved(&law, solved, &reads, direction, du, &tangents.contacts[i]);
                let law = Law {
                    worn_volume: volumes[i],
                    ..law
                };
                let after = law.displaced_rate(n, &along);
                [0, 1].map(|side| (after[side] - before[side]) / direction.step)
            };
            self.directions.iter().enumerate().map(slope).collect()
        };
        let all: Vec<Vec<[f64; 2]>> = (0..joint.slices.len()).map(of_slice).collect();
        let mean = |i: usize| [0, 1].map(|side| self.system.mean(side, |s| all[s][i][side]));
        Ok((0..self.directions.len()).map(mean).collect())
    }
}

/// The law and what it is asked about, a step along a direction.
fn moved<'a>(
    law: &Law<'a>,
    solved: &Solved,
    reads: &Reads,
    direction: &Direction<'a>,
    du: &[f64],
    tangents: &[ContactTangent],
) -> (Law<'a>, Solved) {
    let h = direction.step;
    let mut along = solved.clone();
    for (u, du) in along.u.iter_mut().zip(du) {
        *u += h * du;
    }
    for (contact, tangent) in along.contacts.iter_mut().zip(tangents) {
        for (p, dp) in contact.pressure.iter_mut().zip(&tangent.pressure) {
            // a point about to leave does so no farther than to nothing
            *p = (*p + h * dp).max(0.0);
        }
    }
    // read at the same instants: the largest pressure is stationary there
    for (moments, reads) in along.moments.iter_mut().zip(reads) {
        for (moment, reads) in moments.iter_mut().zip(reads) {
            let read = |&(q, k, weight): &(u32, u32, f64)| {
                weight * tangents[q as usize].pressure[k as usize]
            };
            moment.pressure += h * reads.iter().map(read).sum::<f64>();
        }
    }
    let law = Law {
        coefficient: [0, 1]
            .map(|side| law.coefficient[side] * (1.0 + h * direction.coefficient[side])),
        acting: direction.shifted.or(law.acting),
        ..*law
    };
    (law, along)
}

impl<M: ContactModel + ?Sized> Differentiable for Differentiated<'_, '_, M> {
    type Error = WearError;

    fn tangents(
        &mut self,
        n: f64,
        u: &[f64],
        du: &[Vec<f64>],
        along: &[&[f64]],
    ) -> Result<Tangents, WearError> {
        self.system.solved(u)?;
        let (law, joint) = (self.system.law_at(u), self.system.known(u));
        let tangents = self.contacts(joint, du, along)?;
        let volumes = self.moved_volumes(&law, joint, du);
        let size = law.cycle.stations.count();
        let of_slice = |s: usize| {
            let du: Vec<&[f64]> = (du.iter())
                .map(|du| &du[s * size..(s + 1) * size])
                .collect();
            self.of_slice(n, &law, &joint.slices[s], &tangents[s], (&du, &volumes))
        };
        let slices: Vec<Vec<OfDirection>> = (0..joint.slices.len())
            .into_par_iter()
            .map(of_slice)
            .collect();
        let mut out = Tangents {
            rates: vec![Vec::with_capacity(u.len()); self.directions.len()],
            products: vec![vec![Vec::with_capacity(u.len()); along.len()]; self.directions.len()],
        };
        for slice in slices {
            for (i, (rate, products)) in slice.into_iter().enumerate() {
                out.rates[i].extend(rate);
                for (all, product) in out.products[i].iter_mut().zip(products) {
                    all.extend(product);
                }
            }
        }
        if let Some(sequence) = self.system.model.sequence() {
            let all = out
                .rates
                .iter_mut()
                .chain(out.products.iter_mut().flatten());
            all.for_each(|values| sequence.sharing().share(values));
        }
        Ok(out)
    }
}

/// Derivatives of a slice's rate, and of its products, along one direction.
type OfDirection = (Vec<f64>, Vec<Vec<f64>>);

impl<M: ContactModel + ?Sized> Differentiated<'_, '_, M> {
    fn of_slice(
        &self,
        n: f64,
        law: &Law<'_>,
        solved: &Solved,
        tangents: &ContactTangents,
        (du, volumes): (&[&[f64]], &[Option<f64>]),
    ) -> Vec<OfDirection> {
        let reads = law.reads(solved);
        let (rate, products) = law.rate_and_products(n, solved, &reads, &tangents.responses);
        let slope = |(i, direction): (usize, &Direction<'_>)| {
            let h = direction.step;
            let (law, along) = moved(law, solved, &reads, direction, du[i], &tangents.contacts[i]);
            let law = Law {
                worn_volume: volumes[i],
                ..law
            };
            let difference = |after: &[f64], before: &[f64]| -> Vec<f64> {
                after.iter().zip(before).map(|(a, b)| (a - b) / h).collect()
            };
            let moved_responses = tangents.response_tangents[i].as_ref().map(|slopes| {
                let mut moved = tangents.responses.clone();
                for (moved, slopes) in moved.iter_mut().flatten().zip(slopes.iter().flatten()) {
                    moved
                        .iter_mut()
                        .zip(slopes)
                        .for_each(|(y, dy)| *y += h * dy);
                }
                moved
            });
            let responses = moved_responses.as_ref().unwrap_or(&tangents.responses);
            let (after, products_after) = law.rate_and_products(n, &along, &reads, responses);
            let of_products = products_after.iter().zip(&products);
            (
                difference(&after, &rate),
                of_products.map(|(a, b)| difference(a, b)).collect(),
            )
        };
        self.directions.par_iter().enumerate().map(slope).collect()
    }
}
