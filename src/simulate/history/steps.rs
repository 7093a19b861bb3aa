//! The steps of a wear history, each with the areas that it wears off.

use super::{Balancing, HistoryTangents, Progress, WearLaw};
use crate::contact::cycle::Cycle;
use crate::contact::model::ContactModel;
use crate::simulate::balance::Balance;
use crate::simulate::wear_state::{split, worn_area};
use crate::wear::archard::{ArchardSystem, AreaRate, WearError};
use crate::wear::integrator::{Stand, Step, StepControl, StepError, WearSystem, advance};
use crate::wear::tangent::{Differentiated, Direction};

/// A step on trial, with all that is kept of it if it counts.
pub(super) struct Trial {
    /// The integrator's state at its end.
    pub(super) stand: Stand,
    /// What derivatives along it follow from.
    pub(super) taken: Step,
    /// Its length, cycles.
    pub(super) length: f64,
    /// Rate of worn area by the law at its end.
    pub(super) rate: AreaRate,
    /// Worn areas up to its end.
    pub(super) balance: Balance,
    /// Largest depth on pinion and gear at its end, mm.
    pub(super) max_depth: [f64; 2],
    /// Contact problems solved in this part of the history.
    pub(super) solves: usize,
    /// Contact sets at its end.
    pub(super) warm: Vec<Vec<usize>>,
}

/// What a history is integrated with: contacts and rates of the model, and the law.
pub(super) struct History<'a, M: ContactModel + ?Sized> {
    pub(super) system: ArchardSystem<'a, M>,
    law: WearLaw<'a>,
    cycle: &'a Cycle,
}

impl<'a, M: ContactModel + ?Sized> History<'a, M> {
    pub(super) fn new(model: &'a M, law: WearLaw<'a>) -> Self {
        Self {
            system: ArchardSystem::new(model, law.coefficient).with(law.acting),
            law,
            cycle: model.cycle(),
        }
    }

    /// The step control; fills `progress` with fresh flanks where there is none yet.
    pub(super) fn begin(
        &mut self,
        progress: &mut Option<Progress>,
    ) -> Result<StepControl, StepError<WearError>> {
        let module = self.cycle.pair.pinion.rack.module;
        if progress.is_some() {
            return Ok(self.law.control(module, &[]));
        }
        let fail = |source| StepError::System { n: 0.0, source };
        let fresh = vec![0.0; self.system.slices() * self.cycle.stations.count()];
        let rate = self.system.rate(0.0, &fresh).map_err(fail)?;
        let control = self.law.control(module, &rate);
        let rate = self.area_rate(0.0, &fresh).map_err(fail)?;
        *progress = Some(Progress::fresh(fresh, control, rate));
        Ok(control)
    }

    /// Sets the derivatives along each of the directions to those of fresh flanks, which `progress` holds.
    pub(super) fn begin_tangents(
        &mut self,
        directions: &[Direction<'_>],
        progress: &Progress,
        tangents: &mut HistoryTangents,
    ) -> Result<(), StepError<WearError>> {
        let (n, u) = (progress.stand.n, &progress.stand.u);
        let mut fresh = HistoryTangents::fresh(directions.len(), u.len());
        if self.displaces() && !directions.is_empty() {
            let mut differentiated = Differentiated {
                system: &mut self.system,
                directions,
            };
            fresh.displaced_rate = differentiated
                .displaced_tangents(n, u, &fresh.depth)
                .map_err(|source| StepError::System { n, source })?;
        }
        // whole or not at all: who begins again must not find half of it
        *tangents = fresh;
        Ok(())
    }

    /// A step on from `progress`, not beyond `end`, with the areas that it wears off.
    pub(super) fn step(
        &mut self,
        progress: &Progress,
        end: f64,
        control: StepControl,
    ) -> Result<Trial, StepError<WearError>> {
        // with the balance, a step counts only once the contact at its end is known too
        let mut stand = progress.stand.clone();
        let taken = advance(&mut self.system, &mut stand, end, control)?;
        let rate = (self.area_rate(stand.n, &stand.u))
            .map_err(|source| StepError::System { n: stand.n, source })?;
        let flanks = split(self.cycle, &stand.u);
        let length = stand.n - progress.stand.n;
        let mut balance = progress.balance;
        for (side, arc) in self.cycle.stations.arc.iter().enumerate() {
            balance.law[side] += 0.5 * length * (progress.rate.law[side] + rate.law[side]);
            balance.geometry[side] =
                (self.system).mean(side, |slice| worn_area(arc, flanks[slice][side]));
        }
        let max_depth = [0, 1].map(|side| {
            let depths = flanks.iter().flat_map(|flanks| flanks[side]);
            depths.fold(0.0, |m: f64, h| m.max(*h))
        });
        Ok(Trial {
            taken,
            length,
            rate,
            balance,
            max_depth,
            solves: self.system.solves,
            warm: self.system.warm().to_vec(),
            stand,
        })
    }

    /// Takes the derivatives over `trial`.
    pub(super) fn follow(
        &mut self,
        trial: &Trial,
        directions: &[Direction<'_>],
        tangents: &mut HistoryTangents,
    ) -> Result<(), StepError<WearError>> {
        let displaces = self.displaces();
        let mut differentiated = Differentiated {
            system: &mut self.system,
            directions,
        };
        let (n, u) = (trial.stand.n, &trial.stand.u);
        tangents
            .follow(&mut differentiated, &trial.taken, (n, u), displaces)
            .map_err(|source| StepError::System { n, source })
    }

    /// Rate of worn area by the law at `n` cycles and the depths `u`, mm² per cycle; 0 where areas are not balanced.
    fn area_rate(&mut self, n: f64, u: &[f64]) -> Result<AreaRate, WearError> {
        if self.law.balance != Balancing::Off {
            self.system.area_rate(n, u)
        } else {
            Ok(AreaRate::default())
        }
    }

    /// Whether an effect displaces material.
    fn displaces(&self) -> bool {
        self.law.acting.is_some_and(|a| a.effects.displaces())
    }
}
