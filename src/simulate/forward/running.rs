//! Wear from fresh flanks on: steps, and the contacts of what they reach.

use super::{ContactKind, Forward, ForwardError, Preparation, Variation};
use crate::contact::model::PositionContact;
use crate::simulate::history::{
    Balancing, HistoryTangents, Progress, StepReport, WearLaw, wear_with_tangents,
};
use crate::simulate::wear_state::{WearState, contacts_at, mean_contacts, state_of};
use crate::wear::archard::WearError;
use crate::wear::integrator::StepError;

impl Forward<'_> {
    /// Wears the flanks from `progress` (or fresh) to each of the ascending `stops` (cycles) and hands every state reached
    /// to `store`. Returns false if `observe` stopped the run.
    ///
    /// # Errors
    /// [`ForwardError`] with where it happened; `progress` then holds the last accepted step.
    pub fn wear(
        &mut self,
        progress: &mut Option<Progress>,
        stops: &[f64],
        observe: &mut dyn FnMut(StepReport) -> bool,
        store: &mut dyn FnMut(WearState),
    ) -> Result<bool, ForwardError> {
        for &stop in stops {
            if !self.wear_to(progress, stop, &mut |_, progress| {
                observe(progress.report())
            })? {
                return Ok(false);
            }
            if let Some(progress) = progress {
                store(self.state(progress)?);
            }
        }
        Ok(true)
    }

    /// Wears the flanks from `progress` (or fresh) to `stop` cycles; `observe` sees what a resumed run needs after every
    /// step and may stop the run. Returns false if it did.
    ///
    /// # Errors
    /// [`ForwardError`] with where it happened; `progress` then holds the last accepted step.
    pub fn wear_to(
        &mut self,
        progress: &mut Option<Progress>,
        stop: f64,
        observe: &mut dyn FnMut(&Preparation, &Progress) -> bool,
    ) -> Result<bool, ForwardError> {
        let mut none = HistoryTangents::default();
        self.wear_with_tangents(progress, stop, (&[], &mut none), &mut |p, progress, _| {
            observe(p, progress)
        })
    }

    /// As [`Forward::wear_to`], with the derivatives by each parameter of `variations` (empty: those of fresh flanks), which
    /// `observe` sees too.
    ///
    /// # Errors
    /// As [`Forward::wear_to`].
    pub fn wear_with_tangents(
        &mut self,
        progress: &mut Option<Progress>,
        stop: f64,
        (variations, tangents): (&[Variation], &mut HistoryTangents),
        observe: &mut dyn FnMut(&Preparation, &Progress, &HistoryTangents) -> bool,
    ) -> Result<bool, ForwardError> {
        let law = WearLaw {
            coefficient: self.conditions.coefficient,
            acting: self.acting,
            tolerance: self.numerics.step_tolerance,
            floor: self.numerics.step_floor,
            // of several runs only the depths are asked for, and the mass that is not lost with them
            balance: match self.kind {
                _ if self.shares && !self.acting.is_some_and(|a| a.effects.displaces()) => {
                    Balancing::Off
                }
                ContactKind::Fem => Balancing::History,
                ContactKind::Hertz => Balancing::Steps,
            },
        };
        loop {
            // here and not after the step that calls for it: a run resumed from that step does the same
            self.condense_if_stale(progress.as_ref())?;
            let preparation = self.preparation();
            let elastic = self.kind == ContactKind::Fem;
            let condense_after = self.condense_after();
            let mut go_on = true;
            let mut stale = false;
            let directions = self.directions(variations);
            let outcome = self.with_model(|model| {
                let with = (directions.as_slice(), &mut *tangents);
                wear_with_tangents(
                    model,
                    law,
                    progress,
                    stop,
                    with,
                    &mut |progress, tangents| {
                        go_on = observe(&preparation, progress, tangents);
                        let mean = self.mean_depths(&progress.stand.u);
                        stale = elastic && preparation.is_stale(&mean, condense_after);
                        go_on && !stale
                    },
                )
            })?;
            match outcome {
                Ok(_) if !go_on => return Ok(false),
                Ok(_) if stale => {}
                Ok(_) => return Ok(true),
                Err(StepError::System {
                    source: WearError::Contact(error),
                    n,
                }) => {
                    let failed = |source| StepError::System { n, source };
                    self.widen(error).map_err(|error| match error {
                        ForwardError::Contact(error) => failed(WearError::Contact(error)).into(),
                        other => other,
                    })?;
                    if let Some(progress) = progress {
                        progress.forget_sets();
                    }
                }
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Depths and contact of every position where `progress` stands.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub fn state(&self, progress: &Progress) -> Result<WearState, ForwardError> {
        Ok(self.with_model(|model| state_of(model, &progress.stand, progress.displaced()))??)
    }

    /// The contact of every position at the depths `u` (mm at the stations of pinion and gear), looked for as widely as it takes; of several
    /// slices the mean over the face.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub fn contacts_at(&mut self, u: &[f64]) -> Result<Vec<PositionContact>, ForwardError> {
        let by_slice = self.all_contacts_at(u)?;
        Ok(mean_contacts(
            self.weights().as_deref(),
            self.slices(),
            by_slice,
        ))
    }

    /// The same by slice.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub fn all_contacts_at(
        &mut self,
        u: &[f64],
    ) -> Result<Vec<Vec<PositionContact>>, ForwardError> {
        loop {
            match self.with_model(|model| contacts_at(model, u))? {
                Ok(contacts) => return Ok(contacts),
                Err(error) => self.widen(error)?,
            }
        }
    }
}
