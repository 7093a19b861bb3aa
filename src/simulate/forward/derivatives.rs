//! A wear history with its derivatives.
//!
//! Exact on the steps that the run takes, by tangents ([`crate::wear::tangent`]): of the wear coefficient of each member and of every
//! parameter of an effect or a formula that changes wear, load, flexibility, profile or pitch. Members that are condensed anew are taken to
//! be as stiff for the derivatives as they are for the run. What moves the axes changes the whole mesh cycle, its grids included, and has
//! no tangent: such a parameter is differentiated by central differences of two runs on the same steps, at mountings
//! a little apart ([`Forward::again_moved`]).

use super::{ContactKind, Forward, ForwardError};
use crate::contact::contact_point::ContactPoint;
use crate::contact::model::PositionContact;
use crate::contact::tangent::{AlterationChange, ContactTangent};
use crate::simulate::history::Progress;
use crate::simulate::wear_state::line_load;
use crate::wear::acting::Acting;
use crate::wear::archard::ArchardSystem;
use crate::wear::tangent::{Differentiated, Direction};

/// A parameter that a run is differentiated by.
pub struct Variation {
    /// Derivatives of ln k of pinion and gear.
    pub coefficient: [f64; 2],
    /// The effects with the parameter moved by `step`; None: it is not theirs.
    pub effects: Option<Acting>,
    /// A change of the parameter so small that the laws are straight over it, in its unit.
    pub step: f64,
}

/// The contact of every position by slice, and its derivatives by slice, parameter and position.
pub type DifferentiatedContacts = (Vec<Vec<PositionContact>>, Vec<Vec<Vec<ContactTangent>>>);

impl Forward<'_> {
    /// Wears fresh flanks along given steps (ascending cycles at their ends), whatever their error; `observe` sees the start and every
    /// step's end.
    ///
    /// # Errors
    /// As [`Forward::wear_to`].
    pub fn wear_along(
        &mut self,
        progress: &mut Option<Progress>,
        steps: &[f64],
        observe: &mut dyn FnMut(&Progress),
    ) -> Result<(), ForwardError> {
        let tolerance = self.numerics.step_tolerance;
        self.numerics.step_tolerance = f64::INFINITY;
        let mut wear = || -> Result<(), ForwardError> {
            self.wear_to(progress, 0.0, &mut |_, _| true)?;
            for &end in steps {
                if let Some(progress) = progress.as_mut() {
                    // as long as it takes to the end
                    progress.stand.step = f64::INFINITY;
                    observe(progress);
                }
                self.wear_to(progress, end, &mut |_, _| true)?;
            }
            progress.as_ref().into_iter().for_each(&mut *observe);
            Ok(())
        };
        let outcome = wear();
        self.numerics.step_tolerance = tolerance;
        outcome
    }

    /// What the parameters change as this run is prepared.
    pub fn directions<'v>(&self, variations: &'v [Variation]) -> Vec<Direction<'v>> {
        variations.iter().map(|v| self.direction(v)).collect()
    }

    fn direction<'v>(&self, variation: &'v Variation) -> Direction<'v> {
        Direction {
            coefficient: variation.coefficient,
            shifted: variation.effects.as_ref(),
            step: variation.step,
            altered: (variation.effects.as_ref())
                .and_then(|effects| self.alteration_change(effects, variation.step)),
        }
    }

    fn alteration_change(&self, shifted: &Acting, step: f64) -> Option<AlterationChange> {
        let before = self.alteration(self.acting?);
        let after = self.alteration(shifted);
        let slope = before.slope_to(&after, step);
        if slope.is_zero() {
            return None;
        }
        let elastic = self.kind == ContactKind::Fem;
        let profile = slope.profile.is_some().then_some(after.profile.as_ref());
        let points = profile.filter(|_| !elastic).map(|profile| {
            let after = ContactPoint::all(&self.cycle, profile);
            let rows = self.points.iter().zip(&after);
            rows.map(|(before, after)| {
                let pairs = before.iter().zip(after);
                pairs.map(|(a, b)| a.slope_to(b, step)).collect()
            })
            .collect()
        });
        Some(AlterationChange {
            opened: if elastic {
                slope.gaps(&self.cycle)
            } else {
                None
            },
            points,
            alteration: slope,
        })
    }

    /// As [`Forward::contacts_at`], with the derivatives where the depths change by `du` per unit of each parameter.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub fn contacts_with_tangents(
        &mut self,
        u: &[f64],
        du: &[Vec<f64>],
        variations: &[Variation],
    ) -> Result<DifferentiatedContacts, ForwardError> {
        // looks as widely as it takes first: another grid has other directions
        let contacts = self.all_contacts_at(u)?;
        let directions = self.directions(variations);
        let tangents = self.with_model(|model| {
            let mut system = ArchardSystem::new(model, self.conditions.coefficient);
            system.take(u, contacts.clone());
            let mut differentiated = Differentiated {
                system: &mut system,
                directions: &directions,
            };
            differentiated.contact_tangents(u, du)
        })??;
        Ok((contacts, tangents))
    }

    /// Derivative of [`Forward::moment`] along a direction.
    pub fn moment_tangent(
        &self,
        q: usize,
        index: usize,
        contact: &PositionContact,
        tangent: &ContactTangent,
        direction: &Direction<'_>,
    ) -> f64 {
        let change = PositionContact {
            pressure: tangent.pressure.clone(),
            ..contact.clone()
        };
        let own = self.moment(q, index, &change);
        if self.compliance().is_none() {
            let pair = &self.cycle.positions[q].pairs[index];
            return line_load(pair, &change) * self.cycle.pair.pinion.base_radius;
        }
        // the lever is divided by the load factor
        let slope =
            (direction.altered.as_ref()).map_or(0.0, |a| a.alteration.factor_slope(q, index));
        let factor = (self.altered.as_ref()).map_or(1.0, |a| a.alteration.factor(q, index));
        let friction =
            (direction.altered.as_ref()).map_or(0.0, |a| a.alteration.friction(q, index));
        let rubbed = match self.compliance() {
            Some(compliance) if friction != 0.0 => {
                let pair = &self.cycle.positions[q].pairs[index];
                friction / factor * compliance.moment_per_friction(q, pair, &contact.pressure)
            }
            _ => 0.0,
        };
        own + rubbed - slope / factor * self.moment(q, index, contact)
    }
}
