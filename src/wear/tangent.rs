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

mod contacts;

use rayon::prelude::*;

use self::contacts::ContactTangents;
use crate::contact::model::ContactModel;
use crate::contact::tangent::{AlterationChange, ContactTangent};
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

impl<M: ContactModel + ?Sized> Differentiated<'_, '_, M> {
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
