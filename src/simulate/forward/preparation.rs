//! How a run prepares its contact: mesh cycle, compliance on it, and members condensed anew.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::{ContactKind, Forward, ForwardError, Fresh};
use crate::contact::cycle::{Cycle, CycleSpec};
use crate::contact::fem::CycleCompliance;
use crate::contact::model::ContactError;
use crate::contact::strips::Strips;
use crate::simulate::blanks::Blanks;
use crate::simulate::history::Progress;
use crate::simulate::members::{MemberError, Members};

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
}
