//! The forward model of one test: a gear pair under its conditions, by one of the contact models.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use crate::analytic::iso6336;
use crate::contact::alteration::Alteration;
use crate::contact::cycle::{Cycle, CycleSpec, Stations};
use crate::contact::fem::{CycleCompliance, FemContact};
use crate::contact::hertz::HertzContact;
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::effects::{Effect, Hook};
use crate::gear::PairError;
pub use crate::simulate::gear_set::GearSet;
use crate::simulate::gear_set::MOST_UNKNOWNS;
use crate::simulate::history::{
    Progress, StepReport, WearLaw, WearState, contacts_at, line_load, state_of, wear_until,
};
use crate::simulate::members::{MemberError, Members};
use crate::simulate::numerics::Numerics;
use crate::wear::acting::Acting;
use crate::wear::archard::WearError;
use crate::wear::integrator::StepError;

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

/// Preparations on unworn members, by the bits of window and reach.
///
/// A run goes through the same preparations whether they lie here or are made anew: results do not depend on it.
type Shelf = Arc<Mutex<HashMap<[u64; 2], Prepared>>>;

/// A mesh cycle with what belongs to it.
#[derive(Clone)]
struct Prepared {
    cycle: Arc<Cycle>,
    compliance: Option<Arc<CycleCompliance>>,
    extended: Option<Arc<Members>>,
}

/// The contact as effects change it.
struct Altered {
    alteration: Alteration,
    /// Weighted gaps of the profile, by position.
    opened: Option<Vec<Vec<f64>>>,
    /// The projected compliance with load factors and flexibility.
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
        Self::mounted(set, members, conditions, numerics, acting, None)
    }

    /// As [`Forward::with_effects`], looking for contact within the window and reach of `as_before`.
    fn mounted(
        set: &'a GearSet,
        members: Option<&'a Members>,
        mut conditions: Conditions,
        numerics: Numerics,
        acting: Option<&'a Acting>,
        as_before: Option<CycleSpec>,
    ) -> Result<Self, ForwardError> {
        let mut pair = set.mount(conditions.misalignment)?;
        if let Some(acting) = acting.filter(|acting| acting.acts(Hook::Operation)) {
            conditions.misalignment += acting.added_centre_distance(&pair);
            pair = set.mount(conditions.misalignment)?;
        }
        let torque = conditions.torque / set.face_width;
        let spacing = match members {
            Some(members) => members.spacing(),
            None => numerics.flank_spacing(&pair, set.modulus(), torque),
        };
        let spec = numerics.cycle(&pair, set.modulus(), torque, spacing);
        let spec = as_before.map_or(spec, |CycleSpec { window, reach, .. }| CycleSpec {
            window,
            reach,
            ..spec
        });
        let stations = Stations::new(&pair, spacing);
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

    /// Projects the compliance of the members onto the cycle, and what effects change about it.
    fn project(&mut self) -> Result<(), ForwardError> {
        if let Some(members) = self.condensed() {
            let flanks = members.flanks();
            let friction = self.numerics.friction;
            let compliance = CycleCompliance::new(&self.cycle, flanks, friction)?;
            self.compliance = Some(Arc::new(compliance));
        }
        self.alter()
    }

    /// Lets the effects change the contact.
    fn alter(&mut self) -> Result<(), ForwardError> {
        self.altered = None;
        let Some(acting) = self.acting else {
            return Ok(());
        };
        let alteration = acting.alteration(&self.cycle);
        if let Some(fault) = acting.effects.fault() {
            return Err(ForwardError::Effect(fault));
        }
        self.altered = (!alteration.is_none()).then(|| Altered {
            opened: alteration.gaps(&self.cycle),
            compliance: (self.compliance.as_ref()).map(|c| c.altered(&self.cycle, &alteration)),
            alteration,
        });
        Ok(())
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
        let conditions = Conditions {
            coefficient,
            ..self.conditions
        };
        if acting.is_some_and(|acting| acting.acts(Hook::Operation)) || self.worn.is_some() {
            // another mounting is another mesh cycle
            let (members, spec) = (self.members(), Some(self.cycle.spec));
            let mut out =
                Forward::mounted(self.set, members, conditions, self.numerics, acting, spec)?;
            out.shares = true;
            return Ok(out);
        }
        let mut out = Forward {
            set: self.set,
            conditions,
            numerics: self.numerics,
            kind: self.kind,
            members: self.members,
            cycle: Arc::clone(&self.cycle),
            compliance: self.compliance.clone(),
            condensed_at: None,
            worn: None,
            extended: self.extended.clone(),
            prepared: Arc::clone(&self.prepared),
            shares: true,
            factorisations: 0,
            acting,
            altered: None,
        };
        out.alter()?;
        Ok(out)
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
                let model = HertzContact::new(&self.cycle, self.torque(), modulus, stiffness);
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
            let outcome = self.with_model(|model| {
                wear_until(model, law, progress, stop, &mut |progress| {
                    go_on = observe(&preparation, progress);
                    stale = elastic && preparation.is_stale(&progress.stand.u, condense_after);
                    go_on && !stale
                })
            });
            match outcome {
                Ok(_) if !go_on => return Ok(false),
                Ok(_) if stale => {}
                Ok(_) => return Ok(true),
                Err(StepError::System {
                    source: WearError::Contact(ContactError::WindowTooNarrow { .. }),
                    ..
                }) => {
                    // wear flattens contacts: look for them in a wider strip
                    self.prepare(&Preparation {
                        window: 1.4 * preparation.window,
                        ..preparation
                    })?;
                    if let Some(progress) = progress {
                        progress.forget_sets();
                    }
                }
                Err(StepError::System {
                    source: WearError::Contact(ContactError::OutOfReach { .. }),
                    ..
                }) if preparation.reach < MOST_REACH * self.cycle.pair.pinion.rack.module => {
                    // wear lets teeth turn far enough for corners that were not looked at
                    self.prepare(&Preparation {
                        reach: 1.5 * preparation.reach,
                        ..preparation
                    })?;
                    if let Some(progress) = progress {
                        progress.forget_sets();
                    }
                }
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Condenses the members anew if they have worn too far since they were last.
    fn condense_if_stale(&mut self, progress: Option<&Progress>) -> Result<(), ForwardError> {
        let preparation = self.preparation();
        match progress {
            Some(progress)
                if self.members.is_some()
                    && preparation.is_stale(&progress.stand.u, self.numerics.condense_after) =>
            {
                self.prepare(&Preparation {
                    condensed_at: Some(progress.stand.u.clone()),
                    ..preparation
                })
            }
            _ => Ok(()),
        }
    }

    /// Depths and contact of every position where `progress` stands.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub fn state(&self, progress: &Progress) -> Result<WearState, ForwardError> {
        Ok(self.with_model(|model| state_of(model, progress))?)
    }

    /// The contact of every position at the depths `u` (mm at the stations of pinion and gear).
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub fn contacts_at(&self, u: &[f64]) -> Result<Vec<PositionContact>, ForwardError> {
        Ok(self.with_model(|model| contacts_at(model, u))?)
    }

    /// How the contact is prepared at the moment.
    pub fn preparation(&self) -> Preparation {
        Preparation {
            window: self.cycle.spec.window,
            reach: self.cycle.spec.reach,
            condensed_at: self.condensed_at.clone(),
        }
    }

    /// Prepares the contact as `preparation` says, as an interrupted run had it.
    ///
    /// # Errors
    /// [`ForwardError`] if a worn member cannot be factored; the run is then without a contact model and must be given up.
    pub fn prepare(&mut self, preparation: &Preparation) -> Result<(), ForwardError> {
        if *preparation == self.preparation() {
            return Ok(());
        }
        let spec = CycleSpec {
            window: preparation.window,
            reach: preparation.reach,
            ..self.cycle.spec
        };
        let shelved = self.shares && self.worn.is_none() && preparation.condensed_at.is_none();
        let key = [preparation.window, preparation.reach].map(f64::to_bits);
        let shelf = Arc::clone(&self.prepared);
        let shelf = || shelf.lock().unwrap_or_else(PoisonError::into_inner);
        let known = shelved.then(|| shelf().get(&key).cloned()).flatten();
        if let Some(known) = known {
            (self.cycle, self.compliance) = (known.cycle, known.compliance);
            self.extended = known.extended;
            return self.alter();
        }
        self.prepare_anew(preparation, spec)?;
        if shelved {
            let prepared = Prepared {
                cycle: Arc::clone(&self.cycle),
                compliance: self.compliance.clone(),
                extended: self.extended.clone(),
            };
            shelf().insert(key, prepared);
        }
        Ok(())
    }

    fn prepare_anew(
        &mut self,
        preparation: &Preparation,
        spec: CycleSpec,
    ) -> Result<(), ForwardError> {
        if spec != self.cycle.spec {
            self.cycle = Arc::new(Cycle::new(&self.cycle.pair, &self.cycle.stations, spec));
        }
        // what the new preparation replaces is let go first: it is as large as what takes its place
        (self.compliance, self.altered) = (None, None);
        let more_teeth = self.extend_members()?;
        if self.members().is_none() {
            return self.project();
        }
        if more_teeth || preparation.condensed_at != self.condensed_at {
            (self.worn, self.condensed_at) = (None, None);
            let Some(fresh) = self.members() else {
                return self.project();
            };
            let worn = match &preparation.condensed_at {
                Some(u) => {
                    let (pinion, gear) = u.split_at(self.cycle.stations.arc[0].len());
                    let meshes = fresh.worn_meshes(
                        &self.cycle.pair,
                        &self.cycle.stations,
                        [pinion, gear],
                    )?;
                    Some(Box::new(fresh.condensed_on(meshes)?))
                }
                None => None,
            };
            self.factorisations += 2 * usize::from(worn.is_some());
            self.condensed_at.clone_from(&preparation.condensed_at);
            self.worn = worn;
        }
        self.project()
    }

    /// Meshes more teeth finely if the cycle reaches teeth that are not; true if it did.
    fn extend_members(&mut self) -> Result<bool, ForwardError> {
        let Some(members) = self.members() else {
            return Ok(false);
        };
        let mut teeth = Cycle::teeth(&self.cycle.pair, self.cycle.spec);
        let fine = members.teeth();
        if members.of_user() || teeth.iter().all(|t| fine.contains(t)) {
            // a tooth that a user's own mesh lacks is refused by the coupling
            return Ok(false);
        }
        teeth.extend(fine);
        teeth.sort_unstable();
        teeth.dedup();
        let (spacing, order) = (members.spacing(), self.numerics.order);
        (self.worn, self.condensed_at, self.extended) = (None, None, None);
        let built = Members::build(
            &self.set.gears,
            self.set.materials,
            &teeth,
            spacing,
            order,
            [None, None],
        )?;
        self.factorisations += 2;
        self.extended = Some(Arc::new(built));
        Ok(true)
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

/// How a [`Forward`] has prepared its contact: what a resumed run must restore before it goes on.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Preparation {
    /// Half width of the strip contact is looked for in, mm.
    pub window: f64,
    /// Tooth pairs farther apart than this are left out, mm.
    pub reach: f64,
    /// Worn depths at which the members were last condensed, mm at all stations; none: unworn.
    pub condensed_at: Option<Vec<f64>>,
}

/// Corners farther apart than this are never looked at, in modules: flanks that close farther are refused.
const MOST_REACH: f64 = 0.25;

impl Preparation {
    fn is_stale(&self, u: &[f64], condense_after: f64) -> bool {
        match &self.condensed_at {
            Some(before) => u
                .iter()
                .zip(before)
                .any(|(now, then)| now - then > condense_after),
            None => u.iter().any(|now| *now > condense_after),
        }
    }
}
