//! The forward model of one test: a gear pair under its conditions, by one of the contact models.

mod derivatives;
mod preparation;

use std::sync::Arc;

use crate::analytic::iso6336;
use crate::contact::contact_point::ContactPoint;
use crate::contact::cycle::{Cycle, Stations};
use crate::contact::fem::{CycleCompliance, FemContact};
use crate::contact::hertz::HertzContact;
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::effects::Hook;
use crate::gear::PairError;
pub use crate::simulate::gear_set::GearSet;
use crate::simulate::gear_set::MOST_UNKNOWNS;
use crate::simulate::history::{
    HistoryTangents, Progress, StepReport, WearLaw, WearState, contacts_at, line_load, state_of,
    wear_with_tangents,
};
use crate::simulate::members::{MemberError, Members};
use crate::simulate::numerics::Numerics;
use crate::wear::acting::Acting;
use crate::wear::archard::WearError;
use crate::wear::integrator::StepError;
pub use derivatives::{DifferentiatedContacts, Variation};
use preparation::{Altered, Prepared, Shelf};
pub use preparation::{Mounting, Preparation};

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
    /// The flanks would need more elements than fit into memory.
    #[error(
        "{unknowns} unknowns on the flanks of one member, at most {MOST_UNKNOWNS} are possible: under the smallest torque the \
         elements' edges would be {edge_um:.2} µm long; a larger torque or a smaller numerics.elements_per_half_width needs fewer"
    )]
    TooFine {
        /// Unknowns on the fine flanks of the larger member.
        unknowns: usize,
        /// Length of an edge, µm.
        edge_um: f64,
    },
    /// A wear step failed.
    #[error("{0}")]
    Step(#[from] StepError<WearError>),
    /// A physical effect gave no usable number before wear began.
    #[error("{0}")]
    Effect(String),
}

impl From<WearError> for ForwardError {
    fn from(error: WearError) -> Self {
        match error {
            WearError::Contact(error) => Self::Contact(error),
            WearError::Effect(reason) => Self::Effect(reason),
        }
    }
}

/// A gear pair under one test's conditions, ready to run.
pub struct Forward<'a> {
    set: &'a GearSet,
    conditions: Conditions,
    numerics: Numerics,
    kind: ContactKind,
    members: Option<&'a Members>,
    cycle: Arc<Cycle>,
    compliance: Option<Arc<CycleCompliance>>,
    /// Where tooth pairs touch, analytically only.
    points: Vec<Vec<ContactPoint>>,
    condensed_at: Option<Vec<f64>>,
    worn: Option<Box<Members>>,
    /// Members with more fine teeth than those given, once wear has brought these into reach.
    extended: Option<Arc<Members>>,
    /// What runs of the same gears at the same mounting have prepared so far; a run that comes to need the same takes it.
    prepared: Shelf,
    /// Whether this is one of several such runs; a single one has no use for what it leaves behind.
    shares: bool,
    factorisations: usize,
    acting: Option<&'a Acting>,
    altered: Option<Altered>,
}

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
            members: self.members,
            cycle: Arc::clone(&self.cycle),
            compliance: self.compliance.clone(),
            points: Vec::new(),
            condensed_at: None,
            worn: None,
            extended: self.extended.clone(),
            prepared: Arc::clone(&self.prepared),
            shares: self.shares,
            factorisations: 0,
            acting: self.acting,
            altered: None,
        };
        out.alter()?;
        Ok(out)
    }

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
        Self::with_effects(set, members, conditions, numerics, None)
    }

    /// As [`Forward::new`], with physical effects.
    ///
    /// # Errors
    /// As [`Forward::new`]; [`ForwardError::Effect`] if an effect gives no number.
    pub fn with_effects(
        set: &'a GearSet,
        members: Option<&'a Members>,
        conditions: Conditions,
        numerics: Numerics,
        acting: Option<&'a Acting>,
    ) -> Result<Self, ForwardError> {
        Self::mounted(set, members, conditions, numerics, acting, (None, 0.0))
    }

    /// As [`Forward::with_effects`], on as fine grids as those of a cycle before and looking for contact within its window and reach, and
    /// with the axes this much (mm) farther apart than effects move them.
    fn mounted(
        set: &'a GearSet,
        members: Option<&'a Members>,
        mut conditions: Conditions,
        numerics: Numerics,
        acting: Option<&'a Acting>,
        (as_before, farther): (Option<&Cycle>, f64),
    ) -> Result<Self, ForwardError> {
        let mut pair = set.mount(conditions.misalignment)?;
        if let Some(acting) = acting.filter(|acting| acting.acts(Hook::Operation)) {
            conditions.misalignment += acting.added_centre_distance(&pair) + farther;
            pair = set.mount_moved(conditions.misalignment)?;
        }
        let torque = conditions.torque / set.face_width;
        let modulus = set.modulus();
        let spacing = match (as_before, members) {
            (Some(before), _) => before.spec.spacing,
            (None, Some(members)) => members.spacing(),
            (None, None) => numerics.flank_spacing(&pair, modulus, torque),
        };
        let spec = match (as_before, members) {
            (Some(before), _) => before.spec,
            (None, Some(_)) => numerics.cycle(&pair, modulus, torque, spacing),
            (None, None) => numerics.analytic_cycle(&pair, modulus, torque, spacing),
        };
        let stations = match as_before {
            Some(before) => before.stations.like(&pair),
            None => Stations::new(&pair, spacing),
        };
        let kind = if members.is_some() {
            ContactKind::Fem
        } else {
            ContactKind::Hertz
        };
        let mut out = Self {
            set,
            conditions,
            numerics,
            kind,
            members,
            cycle: Arc::new(Cycle::new(&pair, &stations, spec)),
            compliance: None,
            points: Vec::new(),
            condensed_at: None,
            worn: None,
            extended: None,
            prepared: Shelf::default(),
            shares: false,
            factorisations: if members.is_some() { 2 } else { 0 },
            acting,
            altered: None,
        };
        if acting.is_some_and(|acting| acting.acts(Hook::Operation)) {
            out.extend_members()?;
        }
        out.project()?;
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
        let (members, numerics) = (self.members(), self.numerics);
        let mut out = Forward::mounted(self.set, members, conditions, numerics, acting, as_before)?;
        out.shares = true;
        Ok(out)
    }

    /// As [`Forward::again`], at a mounting where effects with the same parameters have been before.
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
            members: self.members(),
            cycle: mounting.start.cycle,
            compliance: mounting.start.compliance,
            points: Vec::new(),
            condensed_at: None,
            worn: None,
            extended: mounting.start.extended,
            prepared: mounting.further,
            shares: true,
            factorisations: 0,
            acting,
            altered: None,
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
            },
            further: Arc::clone(&self.prepared),
        }
    }

    /// The mesh cycle.
    pub fn cycle(&self) -> &Cycle {
        &self.cycle
    }

    /// Projected compliance, by finite elements only.
    pub fn compliance(&self) -> Option<&CycleCompliance> {
        let altered = self.altered.as_ref();
        (altered.and_then(|a| a.compliance.as_ref())).or(self.compliance.as_deref())
    }

    /// Effects that act, if any.
    pub fn acting(&self) -> Option<&'a Acting> {
        self.acting
    }

    /// The conditions, with what effects do to the misalignment.
    pub fn conditions(&self) -> Conditions {
        self.conditions
    }

    /// The elastic members, by finite elements only.
    pub fn members(&self) -> Option<&Members> {
        self.extended.as_deref().or(self.members)
    }

    /// The members as last condensed: unworn, or worn by then.
    pub fn condensed(&self) -> Option<&Members> {
        self.worn.as_deref().or(self.members())
    }

    /// Torque per face width, N·mm/mm.
    pub fn torque(&self) -> f64 {
        self.conditions.torque / self.set.face_width
    }

    /// Calls `work` with the contact model.
    pub fn with_model<R>(&self, work: impl FnOnce(&dyn ContactModel) -> R) -> R {
        match (self.compliance(), self.kind) {
            (None, ContactKind::Fem) => {
                unreachable!("a run whose preparation failed is given up")
            }
            (Some(compliance), ContactKind::Fem) => {
                let model = FemContact::new(&self.cycle, compliance, self.torque());
                match &self.altered {
                    Some(a) => work(&model.with(&a.alteration, a.opened.as_deref())),
                    None => work(&model),
                }
            }
            (_, ContactKind::Hertz) => {
                let [pinion, gear] = &self.set.gears;
                let teeth = iso6336::ToothPair {
                    teeth: [pinion, gear].map(|g| f64::from(g.spec.teeth)),
                    profile_shift: [pinion, gear].map(|g| g.spec.profile_shift),
                    ..iso6336::ToothPair::spur(pinion.spec.teeth, gear.spec.teeth)
                };
                let stiffness = teeth.theoretical()
                    * iso6336::material_factor(self.set.materials.map(|m| m.youngs_modulus));
                let modulus = self.set.modulus();
                let torque = self.torque();
                let model =
                    HertzContact::new(&self.cycle, &self.points, torque, modulus, stiffness);
                match &self.altered {
                    Some(a) => work(&model.with(&a.alteration)),
                    None => work(&model),
                }
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
            // of several runs only the depths are asked for, and the mass that is not lost with them
            balance: !self.shares || self.acting.is_some_and(|a| a.effects.displaces()),
        };
        loop {
            // here and not after the step that calls for it: a run resumed from that step does the same
            self.condense_if_stale(progress.as_ref())?;
            let preparation = self.preparation();
            let elastic = self.members.is_some();
            let condense_after = self.numerics.condense_after;
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
                        stale = elastic && preparation.is_stale(&progress.stand.u, condense_after);
                        go_on && !stale
                    },
                )
            });
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
        Ok(self.with_model(|model| state_of(model, progress))?)
    }

    /// The contact of every position at the depths `u` (mm at the stations of pinion and gear), looked for as widely as it takes.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub fn contacts_at(&mut self, u: &[f64]) -> Result<Vec<PositionContact>, ForwardError> {
        loop {
            match self.with_model(|model| contacts_at(model, u)) {
                Ok(contacts) => return Ok(contacts),
                Err(error) => self.widen(error)?,
            }
        }
    }

    /// Stiffness factorisations so far.
    pub fn factorisations(&self) -> usize {
        self.factorisations
    }

    /// Torque per face width that tooth pair number `index` of position `q` puts on the pinion, N·mm/mm.
    pub fn moment(&self, q: usize, index: usize, contact: &PositionContact) -> f64 {
        let pair = &self.cycle.positions[q].pairs[index];
        match self.compliance() {
            Some(compliance) => {
                let own = pair.offset..pair.offset + pair.xi.len();
                contact.pressure[own.clone()]
                    .iter()
                    .zip(&compliance.levers(q)[own])
                    .map(|(p, l)| p * l)
                    .sum()
            }
            // the analytic model puts each pair's load on the line of action
            None => line_load(pair, contact) * self.cycle.pair.pinion.base_radius,
        }
    }

    /// Torque per face width of the contact forces of position `q` on the pinion, N·mm/mm.
    pub fn torque_of(&self, q: usize, contact: &PositionContact) -> f64 {
        (0..self.cycle.positions[q].pairs.len())
            .map(|index| self.moment(q, index, contact))
            .sum()
    }
}
