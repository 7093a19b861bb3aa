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

use crate::contact::model::ContactModel;
use crate::contact::tangent::{AlterationChange, Change, ContactTangent};
use crate::wear::acting::Acting;
use crate::wear::archard::{ArchardSystem, WearError};
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

impl<M: ContactModel + ?Sized> Differentiated<'_, '_, M> {
    fn contacts(
        &self,
        solved: &Solved,
        du: &[Vec<f64>],
        along: &[&[f64]],
    ) -> Result<ContactTangents, WearError> {
        let (model, law) = (self.system.model, self.system.law());
        let depth = law.split(&solved.u);
        let of_position = |q: usize| {
            let linear = model.linearised(q, &solved.contacts[q], depth)?;
            let tangents: Vec<ContactTangent> = (self.directions.iter().zip(du))
                .map(|(direction, du)| {
                    linear.tangent(&Change {
                        depth: law.split(du),
                        altered: direction.altered.as_ref(),
                    })
                })
                .collect();
            let responses: Vec<Vec<f64>> = along
                .iter()
                .map(|v| linear.response(law.split(v)))
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
            Ok::<_, WearError>((tangents, responses, moved))
        };
        let positions: Vec<_> = (0..solved.contacts.len())
            .into_par_iter()
            .with_min_len(4)
            .map(of_position)
            .collect::<Result<_, _>>()?;
        let mut out = ContactTangents {
            contacts: vec![Vec::with_capacity(positions.len()); du.len()],
            responses: vec![Vec::with_capacity(positions.len()); along.len()],
            response_tangents: (self.directions.iter())
                .map(|_| Some(vec![Vec::new(); along.len()]))
                .collect(),
        };
        for (tangents, responses, moved) in positions {
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
        Ok(out)
    }

    /// Derivatives of the contacts of all positions, by direction and position, where the depths `u` change by `du`.
    ///
    /// # Errors
    /// [`WearError`]
    pub fn contact_tangents(
        &mut self,
        u: &[f64],
        du: &[Vec<f64>],
    ) -> Result<Vec<Vec<ContactTangent>>, WearError> {
        self.system.solved(u)?;
        Ok(self.contacts(self.system.known(u), du, &[])?.contacts)
    }

    /// Derivatives of the area per pinion cycle that effects only displace, by direction, mm² per unit.
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
        let (law, solved) = (self.system.law(), self.system.known(u));
        let tangents = self.contacts(solved, du, &[])?;
        let reads = law.reads(solved);
        let before = law.displaced_rate(n, solved);
        let slope = |(i, direction): (usize, &Direction<'_>)| {
            let (law, along) = moved(
                &law,
                solved,
                &reads,
                direction,
                &du[i],
                &tangents.contacts[i],
            );
            let after = law.displaced_rate(n, &along);
            [0, 1].map(|side| (after[side] - before[side]) / direction.step)
        };
        Ok(self.directions.iter().enumerate().map(slope).collect())
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
        let (law, solved) = (self.system.law(), self.system.known(u));
        let tangents = self.contacts(solved, du, along)?;
        let reads = law.reads(solved);
        let (rate, products) = law.rate_and_products(n, solved, &reads, &tangents.responses);
        let slope = |(i, direction): (usize, &Direction<'_>)| {
            let h = direction.step;
            let (law, along) = moved(
                &law,
                solved,
                &reads,
                direction,
                &du[i],
                &tangents.contacts[i],
            );
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
        let (rates, products): (Vec<Vec<f64>>, Vec<Vec<Vec<f64>>>) =
            self.directions.par_iter().enumerate().map(slope).unzip();
        Ok(Tangents { rates, products })
    }
}
