//! The forward model of one test: a gear pair under its conditions, by one of the contact models.

mod again;
mod altered;
mod derivatives;
mod error;
mod fresh;
mod preparation;
mod running;

use std::borrow::Cow;
use std::sync::Arc;

use nalgebra::DMatrix;

use crate::analytic::iso6336;
use crate::contact::contact_point::ContactPoint;
use crate::contact::cycle::{Cycle, Stations};
use crate::contact::fem::{CycleCompliance, FemContact};
use crate::contact::hertz::HertzContact;
use crate::contact::model::{ContactModel, PositionContact};
use crate::contact::sequence::Sequence;
use crate::contact::slices::Slices;
use crate::effects::Hook;
use crate::simulate::blanks::Blanks;
pub use crate::simulate::gear_set::GearSet;
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::wear_state::line_load;
use crate::wear::acting::Acting;
use altered::Altered;
pub use derivatives::{DifferentiatedContacts, Variation};
pub use error::ForwardError;
pub use fresh::Fresh;
use preparation::Shelf;
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

/// A gear pair under one test's conditions, ready to run.
pub struct Forward<'a> {
    set: &'a GearSet,
    conditions: Conditions,
    numerics: Numerics,
    kind: ContactKind,
    fresh: Fresh<'a>,
    cycle: Arc<Cycle>,
    compliance: Option<Arc<CycleCompliance>>,
    /// Where tooth pairs touch, analytically only.
    points: Vec<Vec<ContactPoint>>,
    condensed_at: Option<Vec<f64>>,
    condensed_for: Option<[f64; 2]>,
    worn: Option<Box<Members>>,
    /// Members with more fine teeth or condensed on more of their flanks than those given, once wear has brought these into reach.
    extended: Option<Arc<Members>>,
    /// What runs of the same gears at the same mounting have prepared so far; a run that comes to need the same takes it.
    prepared: Shelf,
    /// Whether this is one of several such runs; a single one has no use for what it leaves behind.
    shares: bool,
    factorisations: usize,
    acting: Option<&'a Acting>,
    altered: Option<Altered>,
    /// The face, where it has more than one slice.
    slices: Option<Slices>,
    /// What ties its slices, by position.
    ties: Option<Arc<Vec<DMatrix<f64>>>>,
    /// Which tooth meets which, where teeth differ.
    sequence: Option<Sequence>,
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
        let members = members.map_or(Fresh::None, Fresh::Lent);
        Self::on(set, members, conditions, numerics, acting)
    }

    /// As [`Forward::with_effects`], on members that may be the run's own.
    ///
    /// # Errors
    /// As [`Forward::with_effects`].
    pub fn on(
        set: &'a GearSet,
        members: Fresh<'a>,
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
        fresh: Fresh<'a>,
        mut conditions: Conditions,
        numerics: Numerics,
        acting: Option<&'a Acting>,
        (as_before, farther): (Option<&Cycle>, f64),
    ) -> Result<Self, ForwardError> {
        let mut pair = set.mount(conditions.misalignment)?;
        if let Some(acting) = acting.filter(|acting| acting.acts(Hook::Operation)) {
            let moved = acting.added_centre_distance(&pair) + farther;
            conditions.misalignment += moved;
            pair = (set.mount_moved(conditions.misalignment))
                .map_err(|reason| ForwardError::Moved { moved, reason })?;
        }
        let torque = conditions.torque / set.face_width;
        let modulus = set.modulus();
        let spacing = match (as_before, fresh.blanks()) {
            (Some(before), _) => before.spec.spacing,
            (None, Some(blanks)) => blanks.spacing(),
            (None, None) => numerics.flank_spacing(&pair, modulus, torque),
        };
        let spec = match (as_before, fresh.blanks()) {
            (Some(before), _) => before.spec,
            (None, Some(_)) => numerics.cycle(&pair, modulus, torque, spacing),
            (None, None) => numerics.analytic_cycle(&pair, modulus, torque, spacing),
        };
        let stations = match as_before {
            Some(before) => before.stations.like(&pair),
            None => Stations::new(&pair, spacing),
        };
        let kind = match fresh {
            Fresh::None => ContactKind::Hertz,
            _ => ContactKind::Fem,
        };
        let mut out = Self {
            set,
            conditions,
            numerics,
            kind,
            factorisations: if kind == ContactKind::Fem { 2 } else { 0 },
            fresh,
            cycle: Arc::new(Cycle::new(&pair, &stations, spec)),
            compliance: None,
            points: Vec::new(),
            condensed_at: None,
            condensed_for: None,
            worn: None,
            extended: None,
            prepared: Shelf::default(),
            shares: false,
            acting,
            altered: None,
            slices: None,
            ties: None,
            sequence: None,
        };
        out.cover()?;
        out.project()?;
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

    /// The slices of the face; none: one section stands for all of it.
    pub fn slices(&self) -> Option<&Slices> {
        self.slices.as_ref()
    }

    /// Whether the study itself states that teeth differ, effects aside.
    pub fn states_teeth(&self) -> bool {
        !self.set.teeth.are_alike()
    }

    /// Which tooth meets which; none: all teeth of each member are alike.
    pub fn sequence(&self) -> Option<&Sequence> {
        self.sequence.as_ref()
    }

    /// Shares of the slices of the face, or of the passages of teeth that differ, in the mean of all contacts; none: there is but one.
    pub fn weights(&self) -> Option<Vec<f64>> {
        match (&self.sequence, &self.slices) {
            (Some(sequence), _) => Some(sequence.contact_weights()),
            (None, slices) => slices.as_ref().map(|slices| slices.weight.clone()),
        }
    }

    /// The mean over the face, or over all teeth, of the depths `u` of all slices or passages (mm at the stations of pinion and gear).
    pub fn mean_depths<'u>(&self, u: &'u [f64]) -> Cow<'u, [f64]> {
        match (&self.sequence, &self.slices) {
            (Some(sequence), _) => Cow::Owned(sequence.mean_of(u)),
            (None, Some(slices)) => Cow::Owned(slices.mean_of(u)),
            (None, None) => Cow::Borrowed(u),
        }
    }

    /// Material that effects leave missing before the start at the stations of pinion and gear, mm; none where no effect acts so.
    pub(super) fn profile_by_effects(&self) -> Option<&[Vec<f64>; 2]> {
        self.altered.as_ref()?.alteration.profile.as_ref()
    }

    /// Effects that act, if any.
    pub fn acting(&self) -> Option<&'a Acting> {
        self.acting
    }

    /// The conditions, with what effects do to the misalignment.
    pub fn conditions(&self) -> Conditions {
        self.conditions
    }

    /// The new members, by finite elements and unless they have been let go of.
    fn members(&self) -> Option<&Members> {
        self.extended.as_deref().or(self.fresh.condensed())
    }

    /// The meshes of the new members, by finite elements only.
    pub fn blanks(&self) -> Option<&Arc<Blanks>> {
        match &self.extended {
            Some(members) => Some(&members.blanks),
            None => self.fresh.blanks(),
        }
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
    ///
    /// # Errors
    /// [`ForwardError::Unprepared`] after a preparation that failed.
    pub fn with_model<R>(
        &self,
        work: impl FnOnce(&dyn ContactModel) -> R,
    ) -> Result<R, ForwardError> {
        Ok(match (self.compliance(), self.kind) {
            (None, ContactKind::Fem) => return Err(ForwardError::Unprepared),
            (Some(compliance), ContactKind::Fem) => {
                let model = FemContact::new(&self.cycle, compliance, self.torque())
                    .across(self.slices.as_ref())
                    .tied(self.ties.as_ref().map(|ties| ties.as_slice()))
                    .in_turn(self.sequence.as_ref());
                match &self.altered {
                    Some(a) => work(&model.with(&a.alteration, a.opened.as_deref())),
                    None => work(&model),
                }
            }
            (_, ContactKind::Hertz) => {
                let [pinion, gear] = &self.set.gears;
                let (helix, base) = (pinion.helix_angle, self.cycle.pair.base_helix);
                let teeth = iso6336::ToothPair {
                    teeth: [pinion, gear]
                        .map(|g| iso6336::virtual_teeth(f64::from(g.spec.teeth), helix, base)),
                    profile_shift: [pinion, gear].map(|g| g.spec.profile_shift / helix.cos()),
                    ..iso6336::ToothPair::spur(pinion.spec.teeth, gear.spec.teeth)
                };
                // of helical gears along the transverse path of contact
                let stiffness = teeth.theoretical()
                    * iso6336::material_factor(self.set.materials.map(|m| m.youngs_modulus))
                    * helix.cos();
                // a contact of inclined teeth has the radius ρ_t/cos β_b, one of upright teeth as wide the modulus E* cos β_b
                let modulus = self.set.modulus() * self.cycle.pair.cos_base_helix();
                let torque = self.torque();
                let model =
                    HertzContact::new(&self.cycle, &self.points, torque, modulus, stiffness)
                        .across(self.slices.as_ref())
                        .in_turn(self.sequence.as_ref());
                match &self.altered {
                    Some(a) => work(&model.with(&a.alteration)),
                    None => work(&model),
                }
            }
        })
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
}
