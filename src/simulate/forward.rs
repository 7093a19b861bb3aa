//! The forward model of one test: a gear pair under its conditions, by one of the contact models.

use crate::analytic::iso6336;
use crate::contact::cycle::{Cycle, Stations};
use crate::contact::fem::{CycleCompliance, FemContact};
use crate::contact::hertz::HertzContact;
use crate::contact::model::{ContactError, ContactModel};
use crate::gear::{Gear, Pair, PairError};
use crate::material::{Elastic, contact_modulus};
use crate::simulate::history::{Progress, StepReport, WearLaw, WearState, state_of, wear_until};
use crate::simulate::members::{MemberError, Members};
use crate::simulate::numerics::Numerics;
use crate::wear::integrator::StepError;

/// The gears as they are, before they are mounted.
#[derive(Debug, Clone)]
pub struct GearSet {
    /// Pinion and gear.
    pub gears: [Gear; 2],
    /// Elastic constants of both.
    pub materials: [Elastic; 2],
    /// Nominal centre distance, mm.
    pub centre_distance: f64,
    /// Face width, mm.
    pub face_width: f64,
}

/// Conditions of a run or test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditions {
    /// Pinion torque, N·mm.
    pub torque: f64,
    /// Pinion speed, rpm.
    pub speed: f64,
    /// Radial misalignment, added to the centre distance, mm.
    pub misalignment: f64,
    /// Pinion revolutions.
    pub cycles: f64,
    /// Wear coefficient of pinion and gear, mm²/N.
    pub coefficient: [f64; 2],
}

/// Which contact model a run uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactKind {
    /// Finite elements.
    Fem,
    /// Elastic load sharing and Hertz line contact.
    Hertz,
}

/// Why a forward run ended early.
#[derive(Debug, thiserror::Error)]
pub enum ForwardError {
    /// The gears do not run at this centre distance.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// A member could not be built.
    #[error(transparent)]
    Member(#[from] MemberError),
    /// Contact could not be solved.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// A wear step failed.
    #[error("{0}")]
    Step(#[from] StepError<ContactError>),
}

impl GearSet {
    /// The pair mounted with a radial misalignment (mm).
    ///
    /// # Errors
    /// [`PairError`] if the gears cannot run so.
    pub fn mount(&self, misalignment: f64) -> Result<Pair, PairError> {
        Pair::new(
            self.gears[0].clone(),
            self.gears[1].clone(),
            self.centre_distance,
            misalignment,
        )
    }

    /// Contact modulus E*, MPa.
    pub fn modulus(&self) -> f64 {
        contact_modulus(self.materials[0], self.materials[1])
    }

    /// Elastic members fine enough for every pinion torque (N·mm) and radial misalignment (mm) given.
    ///
    /// # Errors
    /// [`ForwardError`] if a pair cannot run or a member cannot be built.
    pub fn members(
        &self,
        numerics: &Numerics,
        torques: &[f64],
        misalignments: &[f64],
    ) -> Result<Members, ForwardError> {
        let least = torques.iter().fold(f64::INFINITY, |m, t| m.min(*t)) / self.face_width;
        let greatest = torques.iter().fold(0.0, |m: f64, t| m.max(*t)) / self.face_width;
        let mut teeth: Vec<i32> = Vec::new();
        let mut spacing = f64::INFINITY;
        for &misalignment in misalignments {
            let pair = self.mount(misalignment)?;
            spacing = spacing.min(numerics.flank_spacing(&pair, self.modulus(), least));
            teeth.extend(Cycle::teeth(
                &pair,
                numerics.cycle(&pair, self.modulus(), greatest, spacing),
            ));
        }
        teeth.sort_unstable();
        teeth.dedup();
        let pair = self.mount(misalignments.first().copied().unwrap_or(0.0))?;
        Ok(Members::build(
            &pair,
            self.materials,
            &teeth,
            spacing,
            numerics.order,
        )?)
    }
}

/// A gear pair under one test's conditions, ready to run.
pub struct Forward<'a> {
    set: &'a GearSet,
    conditions: Conditions,
    numerics: Numerics,
    kind: ContactKind,
    members: Option<&'a Members>,
    cycle: Cycle,
    compliance: Option<CycleCompliance>,
}

impl<'a> Forward<'a> {
    /// Prepares a run: by finite elements if `members` are given, else analytically.
    ///
    /// # Errors
    /// [`ForwardError`] if the gears cannot run so or the mesh lacks a tooth that can touch.
    pub fn new(
        set: &'a GearSet,
        members: Option<&'a Members>,
        conditions: Conditions,
        numerics: Numerics,
    ) -> Result<Self, ForwardError> {
        let pair = set.mount(conditions.misalignment)?;
        let torque = conditions.torque / set.face_width;
        let spacing = match members {
            Some(members) => members.spacing(),
            None => numerics.flank_spacing(&pair, set.modulus(), torque),
        };
        let spec = numerics.cycle(&pair, set.modulus(), torque, spacing);
        let stations = Stations::new(&pair, spacing);
        let cycle = Cycle::new(&pair, &stations, spec);
        let compliance = match members {
            Some(members) => Some(CycleCompliance::new(
                &cycle,
                members.flanks(),
                numerics.friction,
            )?),
            None => None,
        };
        let kind = if members.is_some() {
            ContactKind::Fem
        } else {
            ContactKind::Hertz
        };
        Ok(Self {
            set,
            conditions,
            numerics,
            kind,
            members,
            cycle,
            compliance,
        })
    }

    /// The mesh cycle.
    pub fn cycle(&self) -> &Cycle {
        &self.cycle
    }

    /// Projected compliance, by finite elements only.
    pub fn compliance(&self) -> Option<&CycleCompliance> {
        self.compliance.as_ref()
    }

    /// The elastic members, by finite elements only.
    pub fn members(&self) -> Option<&'a Members> {
        self.members
    }

    /// Torque per face width, N·mm/mm.
    pub fn torque(&self) -> f64 {
        self.conditions.torque / self.set.face_width
    }

    /// Calls `work` with the contact model.
    pub fn with_model<R>(&self, work: impl FnOnce(&dyn ContactModel) -> R) -> R {
        match (&self.compliance, self.kind) {
            (Some(compliance), ContactKind::Fem) => {
                work(&FemContact::new(&self.cycle, compliance, self.torque()))
            }
            _ => {
                let [pinion, gear] = &self.set.gears;
                let teeth = iso6336::ToothPair {
                    teeth: [pinion, gear].map(|g| f64::from(g.spec.teeth)),
                    profile_shift: [pinion, gear].map(|g| g.spec.profile_shift),
                    ..iso6336::ToothPair::spur(pinion.spec.teeth, gear.spec.teeth)
                };
                let stiffness = teeth.theoretical();
                work(&HertzContact::new(
                    &self.cycle,
                    self.torque(),
                    self.set.modulus(),
                    stiffness,
                ))
            }
        }
    }

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
        let law = WearLaw {
            coefficient: self.conditions.coefficient,
            tolerance: self.numerics.step_tolerance,
        };
        for &stop in stops {
            loop {
                let outcome =
                    self.with_model(|model| wear_until(model, law, progress, stop, observe));
                match outcome {
                    Ok(true) => break,
                    Ok(false) => return Ok(false),
                    Err(StepError::System {
                        source: ContactError::WindowTooNarrow { .. },
                        ..
                    }) => {
                        self.widen()?;
                        if let Some(progress) = progress {
                            progress.forget_sets();
                        }
                    }
                    Err(error) => return Err(error.into()),
                }
            }
            if let Some(progress) = progress {
                store(self.with_model(|model| state_of(model, progress))?);
            }
        }
        Ok(true)
    }

    /// Looks for contact in a wider strip: wear flattens contacts.
    fn widen(&mut self) -> Result<(), ForwardError> {
        let mut spec = self.cycle.spec;
        spec.window *= 1.4;
        self.cycle = Cycle::new(&self.cycle.pair, &self.cycle.stations, spec);
        if let Some(members) = self.members {
            self.compliance = Some(CycleCompliance::new(
                &self.cycle,
                members.flanks(),
                self.numerics.friction,
            )?);
        }
        Ok(())
    }
}
