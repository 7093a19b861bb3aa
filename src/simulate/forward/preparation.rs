//! How a run prepares its contact: mesh cycle, compliance on it, what effects change about both, and members condensed anew.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::DMatrix;

use super::{ContactKind, Forward, ForwardError, Fresh};
use crate::contact::alteration::Alteration;
use crate::contact::contact_point::ContactPoint;
use crate::contact::cycle::{Cycle, CycleSpec};
use crate::contact::fem::CycleCompliance;
use crate::contact::model::ContactError;
use crate::contact::sequence::{Kinds, Sequence};
use crate::contact::slices::Slices;
use crate::contact::strips::Strips;
use crate::effects::{Effect, Hook};
use crate::gear::{Coupling, Member, Teeth, ToothClasses};
use crate::simulate::blanks::Blanks;
use crate::simulate::history::Progress;
use crate::simulate::members::{MemberError, Members};
use crate::wear::acting::Acting;

/// How a [`Forward`] has prepared its contact: what a resumed run must restore before it goes on.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Preparation {
    /// Half width of the strip contact is looked for in, mm.
    pub window: f64,
    /// Tooth pairs farther apart than this are left out, mm.
    pub reach: f64,
    /// Worn depths at which the members were last condensed, mm at all stations, the mean over the face; none: unworn.
    pub condensed_at: Option<Vec<f64>>,
    /// Window and reach for which they were condensed then; none: those that the new members were made for.
    pub condensed_for: Option<[f64; 2]>,
}

impl Preparation {
    pub(super) fn is_stale(&self, u: &[f64], condense_after: f64) -> bool {
        match &self.condensed_at {
            Some(before) => u
                .iter()
                .zip(before)
                .any(|(now, then)| now - then > condense_after),
            None => u.iter().any(|now| *now > condense_after),
        }
    }
}

/// Preparations on unworn members, by the bits of window and reach.
///
/// A run goes through the same preparations whether they lie here or are made anew: results do not depend on it.
pub(super) type Shelf = Arc<Mutex<HashMap<[u64; 2], Prepared>>>;

/// A mesh cycle with what belongs to it.
#[derive(Clone)]
pub(super) struct Prepared {
    pub(super) cycle: Arc<Cycle>,
    pub(super) compliance: Option<Arc<CycleCompliance>>,
    pub(super) extended: Option<Arc<Members>>,
    pub(super) condensed_for: Option<[f64; 2]>,
}

/// Corners farther apart than this are never looked at, in modules: more than half of what a tooth is thick.
const MOST_REACH: f64 = 0.8;

/// Slices of a face that only an effect makes uneven: a wedge that opens most of the face wears its loaded end within 1.3 % of what 23 slices
/// give, at 3.6 times the time of one.
const SLICES_OF_EFFECTS: usize = 7;
/// The same where it bends: under a crown of 17 µm, of which light loads close a part, 7 slices leave 2 µrad in the transmission error.
const SLICES_OF_BENT_EFFECTS: usize = 11;

/// What runs at one mounting share.
#[derive(Clone)]
pub struct Mounting {
    /// Radial misalignment with what effects add to it, mm.
    pub(super) misalignment: f64,
    /// What a run begins with.
    pub(super) start: Prepared,
    /// What runs come to need.
    pub(super) further: Shelf,
}

/// The contact as effects change it.
pub(super) struct Altered {
    pub(super) alteration: Alteration,
    /// Weighted gaps of the profile, by position.
    pub(super) opened: Option<Vec<Vec<f64>>>,
    /// The projected compliance with load factors and flexibility.
    pub(super) compliance: Option<CycleCompliance>,
}

impl Forward<'_> {
    /// How the contact is prepared at the moment.
    pub fn preparation(&self) -> Preparation {
        Preparation {
            window: self.cycle.spec.window,
            reach: self.cycle.spec.reach,
            condensed_at: self.condensed_at.clone(),
            condensed_for: self.condensed_for,
        }
    }

    /// Prepares the contact as `preparation` says, as an interrupted run had it.
    ///
    /// # Errors
    /// [`ForwardError`] if a worn member cannot be meshed or factored; the contact is then that of the unworn members.
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
            (self.extended, self.condensed_for) = (known.extended, known.condensed_for);
            return self.alter();
        }
        self.prepare_anew(preparation, spec)?;
        if shelved {
            let prepared = Prepared {
                cycle: Arc::clone(&self.cycle),
                compliance: self.compliance.clone(),
                extended: self.extended.clone(),
                condensed_for: self.condensed_for,
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
        let narrow = preparation.condensed_for != self.condensed_for;
        if preparation.condensed_at.is_some() || narrow {
            self.let_go();
        }
        let more = self.with_more_teeth()?;
        if more.is_some() || narrow || preparation.condensed_at != self.condensed_at {
            (self.worn, self.condensed_at, self.condensed_for) = (None, None, None);
            if let Some(blanks) = more {
                self.take(blanks)?;
            }
            match preparation.condensed_at.as_deref() {
                Some(u) => match self.condensed_worn(u, preparation.condensed_for) {
                    Ok(worn) => {
                        self.factorisations += 2;
                        self.condensed_at = Some(u.to_vec());
                        self.condensed_for = preparation.condensed_for;
                        self.worn = Some(worn);
                    }
                    Err(error) => {
                        // what was reached is still read, on the members as they were new
                        self.take_back()?;
                        self.project()?;
                        return Err(error);
                    }
                },
                None => {
                    self.take_back()?;
                    self.cover()?;
                    self.condensed_for = preparation.condensed_for;
                }
            }
        }
        self.project()
    }

    /// Lets go of new members that nobody else uses: all but their meshes.
    fn let_go(&mut self) {
        if self.shares {
            return;
        }
        if let Some(extended) = self.extended.take() {
            self.fresh = Fresh::Blanks(Arc::clone(&extended.blanks));
        }
        if let Fresh::Own(members) = &self.fresh {
            self.fresh = Fresh::Blanks(Arc::clone(&members.blanks));
        }
    }

    /// Makes again the new members that were let go of.
    fn take_back(&mut self) -> Result<(), ForwardError> {
        if let Fresh::Blanks(blanks) = &self.fresh
            && self.extended.is_none()
        {
            let built = blanks.condensed(&self.strips_when_new(blanks))?;
            self.fresh = Fresh::Own(Arc::new(built));
            self.factorisations += 2;
        }
        Ok(())
    }

    /// Where the new members on `blanks` are condensed: for what they were made for, and with room for the present cycle.
    fn strips_when_new(&self, blanks: &Blanks) -> Strips {
        Strips::with_room(&self.cycle.pair, self.cycle.spec).and(&blanks.strips)
    }

    /// Sees to it that the new members are condensed on all that the cycle can touch, if there are any.
    pub(super) fn cover(&mut self) -> Result<(), ForwardError> {
        let Some(members) = self.members() else {
            return Ok(());
        };
        if members.blanks.of_user() {
            // a tooth that a user's own mesh lacks is refused by the coupling
            return Ok(());
        }
        let more = self.with_more_teeth()?;
        if more.is_none() && self.covers(members, self.cycle.spec) {
            return Ok(());
        }
        let blanks = more.unwrap_or_else(|| Arc::clone(&members.blanks));
        self.extend(blanks)
    }

    fn covers(&self, members: &Members, spec: CycleSpec) -> bool {
        members.blanks.of_user() || members.cover(&Strips::new(&self.cycle.pair, spec))
    }

    /// Members on `blanks` instead of those given.
    fn extend(&mut self, blanks: Arc<Blanks>) -> Result<(), ForwardError> {
        let built = blanks.condensed(&self.strips_when_new(&blanks))?;
        self.factorisations += 2;
        self.extended = Some(Arc::new(built));
        Ok(())
    }

    /// Takes over blanks with more teeth.
    fn take(&mut self, blanks: Arc<Blanks>) -> Result<(), ForwardError> {
        if matches!(self.fresh, Fresh::Blanks(_)) {
            (self.extended, self.fresh) = (None, Fresh::Blanks(blanks));
            return Ok(());
        }
        self.extended = None;
        self.extend(blanks)
    }

    /// Members condensed worn by `u` (mm at the stations of pinion and gear) for a window and reach.
    fn condensed_worn(
        &self,
        u: &[f64],
        condensed_for: Option<[f64; 2]>,
    ) -> Result<Box<Members>, ForwardError> {
        let blanks = self.blanks().expect("only elastic members are condensed");
        let (pinion, gear) = u.split_at(self.cycle.stations.arc[0].len());
        let meshes = blanks
            .worn_meshes(&self.cycle.pair, &self.cycle.stations, [pinion, gear])
            .map_err(MemberError::from)?;
        let strips = match condensed_for {
            Some([window, reach]) => Strips::with_room(
                &self.cycle.pair,
                CycleSpec {
                    window,
                    reach,
                    ..self.cycle.spec
                },
            ),
            None => self.strips_when_new(blanks),
        };
        Ok(Box::new(blanks.condensed_on(meshes, &strips)?))
    }

    /// Prepares for contacts that were not looked for when `error` arose.
    ///
    /// # Errors
    /// The error itself if it has another cause; [`ForwardError`] of the preparation.
    pub(super) fn widen(&mut self, error: ContactError) -> Result<(), ForwardError> {
        let preparation = self.preparation();
        let most = MOST_REACH * self.cycle.pair.pinion.rack.module;
        match error {
            // wear flattens contacts: look for them in a wider strip
            ContactError::WindowTooNarrow { .. } => self.look_farther(Preparation {
                window: 1.4 * preparation.window,
                ..preparation
            }),
            // wear lets teeth turn far enough for corners that were not looked at
            ContactError::OutOfReach { .. } if preparation.reach < most => {
                self.look_farther(Preparation {
                    reach: 1.5 * preparation.reach,
                    ..preparation
                })
            }
            error => Err(error.into()),
        }
    }

    /// Prepares for more, on members condensed anew if these do not hold it.
    fn look_farther(&mut self, mut preparation: Preparation) -> Result<(), ForwardError> {
        let spec = CycleSpec {
            window: preparation.window,
            reach: preparation.reach,
            ..self.cycle.spec
        };
        if (self.condensed()).is_some_and(|members| !self.covers(members, spec)) {
            preparation.condensed_for = Some([spec.window, spec.reach]);
        }
        self.prepare(&preparation)
    }

    /// Blanks with more teeth meshed finely, if the cycle reaches teeth that are not.
    fn with_more_teeth(&self) -> Result<Option<Arc<Blanks>>, ForwardError> {
        let Some(blanks) = self.blanks() else {
            return Ok(None);
        };
        let mut teeth = Cycle::teeth(&self.cycle.pair, self.cycle.spec);
        let fine = blanks.teeth();
        if blanks.of_user() || teeth.iter().all(|t| fine.contains(t)) {
            return Ok(None);
        }
        teeth.extend(fine);
        teeth.sort_unstable();
        teeth.dedup();
        let (spacing, order) = (blanks.spacing(), self.numerics.order);
        let more = Blanks::new(
            &self.set.gears,
            self.set.materials,
            &teeth,
            spacing,
            order,
            [None, None],
            self.strips_when_new(blanks),
        );
        Ok(Some(Arc::new(more.map_err(MemberError::from)?)))
    }

    /// Wear since the last condensation after which the members are condensed again, mm.
    pub(super) fn condense_after(&self) -> f64 {
        self.numerics.condense_after * self.cycle.pair.pinion.rack.module
    }

    /// Condenses the members anew if they have worn too far since they were last.
    pub(super) fn condense_if_stale(
        &mut self,
        progress: Option<&Progress>,
    ) -> Result<(), ForwardError> {
        let preparation = self.preparation();
        match progress {
            Some(progress)
                if self.kind == ContactKind::Fem
                    && preparation
                        .is_stale(&self.mean_depths(&progress.stand.u), self.condense_after()) =>
            {
                self.prepare(&Preparation {
                    condensed_at: Some(self.mean_depths(&progress.stand.u).into_owned()),
                    condensed_for: Some([preparation.window, preparation.reach]),
                    ..preparation
                })
            }
            _ => Ok(()),
        }
    }

    /// Projects the compliance of the members onto the cycle, and what effects change about it.
    pub(super) fn project(&mut self) -> Result<(), ForwardError> {
        if let Some(members) = self.condensed() {
            let flanks = members.flanks();
            let friction = self.numerics.friction;
            let compliance = CycleCompliance::new(&self.cycle, flanks, friction)?;
            self.compliance = Some(Arc::new(compliance));
        }
        self.alter()
    }

    /// What effects change about the contact of this run's kind.
    pub(super) fn alteration(&self, acting: &Acting) -> Alteration {
        let alteration = acting.alteration(&self.cycle, self.slices.as_ref());
        match self.kind {
            ContactKind::Fem => alteration,
            ContactKind::Hertz => alteration.with_friction_in_levers(&self.cycle),
        }
    }

    /// The slices of the face with what the gears lack in them; none where one section stands for all of it, as analytically for spur gears. What effects
    /// make missing across the face is not in them yet.
    fn slices_of_the_face(&self) -> Option<Slices> {
        let (face, width) = (&self.set.face, self.set.face_width);
        // teeth that differ are one section each: there the lead acts as in the analytic model
        let wanted = (self.acting).is_some_and(|acting| {
            acting.acts_across_the_face(&self.cycle.pair) && !acting.acts(Hook::ToothOffset)
        });
        let bends = || (self.acting).is_some_and(|a| a.bends_across_the_face(&self.cycle.pair));
        let count = match face.slices {
            // one stated section stays one: effects across the face are then a factor on its load, as analytically
            0 if wanted && bends() => SLICES_OF_BENT_EFFECTS,
            0 if wanted => SLICES_OF_EFFECTS,
            stated => stated,
        };
        let pair = &self.cycle.pair;
        if count < 2 || (self.kind == ContactKind::Hertz && pair.base_helix == 0.0) {
            return None;
        }
        let positions = self.cycle.positions.len();
        let mut slices = Slices::even(count, width).turned(pair.turned_per_mm(), positions);
        for (offset, y) in slices.offset.iter_mut().zip(&slices.place) {
            *offset = face.missing(*y, width);
        }
        Some(slices)
    }

    /// What the teeth tie the slices of the face by, if they are to.
    fn ties_of_slices(&self) -> Result<Option<Arc<Vec<DMatrix<f64>>>>, ForwardError> {
        let tied = self.set.face.coupling == Coupling::Teeth;
        let (Some(slices), Some(blanks)) = (self.slices.as_ref().filter(|_| tied), self.blanks())
        else {
            return Ok(None);
        };
        let pair = &self.cycle.pair;
        let gears = [&pair.pinion, &pair.gear];
        let face = &self.set.face;
        let waves = blanks.waves(gears, self.set.face_width, slices.count(), face.ends)?;
        Ok(Some(Arc::new(waves.ties(&self.cycle, slices))))
    }

    /// Which tooth meets which, if the study or the effects say that teeth differ.
    fn teeth_in_turn(&self) -> Option<Sequence> {
        let (pair, teeth) = (&self.cycle.pair, &self.set.teeth);
        let counts = Member::BOTH.map(|m| pair.member(m).spec.teeth as usize);
        let acting = (self.acting).filter(|acting| acting.acts(Hook::ToothOffset));
        let by_effects = acting.map(|acting| acting.tooth_kinds(pair));
        if by_effects.is_none() && teeth.are_alike() {
            return None;
        }
        let altered = self.altered.as_ref();
        let moved = altered.and_then(|a| a.alteration.tooth_back.as_ref());
        let stated = |m: usize, i: usize| teeth.back[m].get(i).copied().unwrap_or(0.0);
        let kind = |m: usize, i: usize| {
            let own = by_effects.iter().flat_map(|kinds| kinds[m][i].iter());
            std::iter::once(1e3 * stated(m, i))
                .chain(own.copied())
                .collect()
        };
        let back = |m: usize, i: usize| stated(m, i) + moved.map_or(0.0, |moved| moved[m][i]);
        let back = [0, 1].map(|m| (0..counts[m]).map(|i| back(m, i)).collect::<Vec<f64>>());
        // an effect that moves no tooth leaves all alike
        if back.iter().flatten().all(|back| *back == 0.0) {
            return None;
        }
        let stand_apart = |m: usize| teeth.back[m].windows(2).any(|two| two[0] != two[1]);
        let usual = |m: usize| teeth.classes[m].unwrap_or(Teeth::USUAL_CLASSES);
        let classes = |m: usize| match acting {
            // what an effect's own pattern takes is enough where nothing else tells teeth apart
            Some(acting) if !stand_apart(m) => acting.effects.tooth_classes(),
            _ => ToothClasses::Alike(usize::MAX),
        };
        let at_most_usual = |m: usize| match classes(m) {
            ToothClasses::Alike(most) => ToothClasses::Alike(most.min(usual(m))),
            ToothClasses::Wave(count) => ToothClasses::Wave(count.min(usual(m))),
        };
        let sequence = Sequence::new(&Kinds {
            of: [0, 1].map(|m| (0..counts[m]).map(|i| kind(m, i)).collect()),
            classes: [0, 1].map(at_most_usual),
            hunting: teeth.hunting,
        })?;
        Some(sequence.over(&self.cycle, back))
    }

    /// Lets the effects change the contact.
    pub(super) fn alter(&mut self) -> Result<(), ForwardError> {
        self.altered = None;
        self.slices = self.slices_of_the_face();
        self.ties = self.ties_of_slices()?;
        self.sequence = None;
        if let Some(acting) = self.acting {
            let alteration = self.alteration(acting);
            if let Some(fault) = acting.effects.fault() {
                return Err(ForwardError::Effect(fault));
            }
            if let (Some(slices), Some(lead)) = (&mut self.slices, &alteration.lead) {
                for (offset, lead) in slices.offset.iter_mut().zip(lead) {
                    *offset += lead;
                }
            }
            self.altered = (!alteration.is_none()).then(|| Altered {
                opened: (self.compliance.as_ref()).and_then(|_| alteration.gaps(&self.cycle)),
                compliance: (self.compliance.as_ref().zip(self.condensed()))
                    .map(|(c, members)| c.altered(&self.cycle, &alteration, members.flanks())),
                alteration,
            });
        }
        self.sequence = self.teeth_in_turn();
        if self.kind == ContactKind::Hertz {
            let altered = self.altered.as_ref();
            let profile = altered.and_then(|a| a.alteration.profile.as_ref());
            self.points = ContactPoint::all(&self.cycle, profile);
        }
        Ok(())
    }
}
