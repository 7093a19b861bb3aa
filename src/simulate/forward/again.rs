//! Further runs on what one has prepared: with other coefficients, effects or steps.

use std::sync::Arc;

use super::preparation::{Mounting, Prepared};
use super::{Conditions, Forward, ForwardError, Fresh};
use crate::effects::Hook;
use crate::simulate::numerics::Numerics;
use crate::wear::acting::Acting;

impl<'a> Forward<'a> {
    /// A fresh run under the same conditions, on what this one has prepared, with another tolerance of its wear steps. The members are to be
    /// unworn.
    ///
    /// # Errors
    /// [`ForwardError::Effect`] if an effect gives no number.
    pub fn stepping(&self, tolerance: f64) -> Result<Self, ForwardError> {
        let mut out = Self {
            set: self.set,
            conditions: self.conditions,
            numerics: Numerics {
                step_tolerance: tolerance,
                ..self.numerics
            },
            kind: self.kind,
            fresh: self.fresh.clone(),
            cycle: Arc::clone(&self.cycle),
            compliance: self.compliance.clone(),
            points: Vec::new(),
            condensed_at: None,
            condensed_for: self.condensed_for,
            worn: None,
            extended: self.extended.clone(),
            prepared: Arc::clone(&self.prepared),
            shares: self.shares,
            factorisations: 0,
            acting: self.acting,
            altered: None,
            slices: None,
            ties: None,
            sequence: None,
        };
        out.alter()?;
        Ok(out)
    }

    /// A fresh run of the same gears at the same torque and mounting with another wear coefficient and other effects, on the
    /// projected compliance that this one has made.
    ///
    /// # Errors
    /// As [`Forward::with_effects`].
    pub fn again<'b>(
        &'b self,
        coefficient: [f64; 2],
        acting: Option<&'b Acting>,
    ) -> Result<Forward<'b>, ForwardError> {
        if acting.is_some_and(|acting| acting.acts(Hook::Operation)) || self.worn.is_some() {
            // another mounting is another mesh cycle
            return self.again_moved(coefficient, acting, 0.0);
        }
        self.again_at(&self.mounting(), coefficient, acting)
    }

    /// As [`Forward::again`] where effects move the axes, with these this much (mm) farther apart.
    ///
    /// # Errors
    /// As [`Forward::with_effects`].
    pub fn again_moved<'b>(
        &'b self,
        coefficient: [f64; 2],
        acting: Option<&'b Acting>,
        farther: f64,
    ) -> Result<Forward<'b>, ForwardError> {
        let conditions = Conditions {
            coefficient,
            ..self.conditions
        };
        let as_before = (Some(self.cycle.as_ref()), farther);
        let (members, numerics) = (self.lent(), self.numerics);
        let mut out = Forward::mounted(self.set, members, conditions, numerics, acting, as_before)?;
        out.shares = true;
        Ok(out)
    }

    /// How much farther apart (mm) effects put the axes of this run, whose own effects do not move them.
    pub fn axes_moved_by(&self, acting: &Acting) -> f64 {
        acting.added_centre_distance(&self.cycle.pair)
    }

    /// As [`Forward::again`], at a mounting to which effects have moved the axes before.
    ///
    /// # Errors
    /// As [`Forward::with_effects`].
    pub fn again_at<'b>(
        &'b self,
        mounting: &Mounting,
        coefficient: [f64; 2],
        acting: Option<&'b Acting>,
    ) -> Result<Forward<'b>, ForwardError> {
        let mounting = mounting.clone();
        let mut out = Forward {
            set: self.set,
            conditions: Conditions {
                coefficient,
                misalignment: mounting.misalignment,
                ..self.conditions
            },
            numerics: self.numerics,
            kind: self.kind,
            fresh: self.lent(),
            cycle: mounting.start.cycle,
            compliance: mounting.start.compliance,
            points: Vec::new(),
            condensed_at: None,
            condensed_for: mounting.start.condensed_for,
            worn: None,
            extended: mounting.start.extended,
            prepared: mounting.further,
            shares: true,
            factorisations: 0,
            acting,
            altered: None,
            slices: None,
            ties: None,
            sequence: None,
        };
        out.alter()?;
        Ok(out)
    }

    /// What this run has prepared so far, for further ones at the same mounting; the members are to be unworn.
    pub fn mounting(&self) -> Mounting {
        Mounting {
            misalignment: self.conditions.misalignment,
            start: Prepared {
                cycle: Arc::clone(&self.cycle),
                compliance: self.compliance.clone(),
                extended: self.extended.clone(),
                condensed_for: self.condensed_for,
            },
            further: Arc::clone(&self.prepared),
        }
    }

    /// The new members, for another run.
    pub(super) fn lent(&self) -> Fresh<'_> {
        match (&self.fresh, self.members()) {
            (Fresh::Blanks(blanks), None) => Fresh::Blanks(Arc::clone(blanks)),
            (_, members) => members.map_or(Fresh::None, Fresh::Lent),
        }
    }
}
