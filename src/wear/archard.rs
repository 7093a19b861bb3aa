//! Archard wear of both members over the mesh cycle.
//!
//! ```text
//! dh/dn (mm per pinion cycle) = ∫ k p |v| dy over the passage,  for the gear times z₁/z₂ passages per pinion cycle
//! ```
//! Archard, J. Appl. Phys. 24 (1953); the passage integral is that of Andersson & Eriksson's single-point observation
//! (Nordtrib 1990), here with the pressure solved at every position instead of a Hertz profile. Physical effects multiply
//! the law's k by f(local state) inside the integral and add depth a once per contact:
//!
//! ```text
//! dh/dn = ∫ k f p |v| dy + a
//! ```
//! Depths are kept in the transverse section; normal to the flanks of helical gears they are cos β_b times that, which is what k p |v| wears.

mod in_turn;
mod jacobian;
mod local;

use rayon::prelude::*;

use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::contact::slices::Slices;
use crate::effects::{Effect, Hook};
use crate::gear::Member;
use crate::wear::acting::{Acting, side};
use crate::wear::integrator::{Jacobian, WearSystem};
use crate::wear::law::{Factors, Law, Solved};
use crate::wear::passage::{Moment, Passage};

/// How far the average of the largest pressure that effects see reaches, mm: half of its weight lies within 12 µm, about the length of a micropit in all, and
/// its second moment is that of an even average over 30 µm.
const PEAK_REACH: f64 = 0.0212;

/// Why wear has no rate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WearError {
    /// Contact could not be solved.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// A physical effect gave no usable number.
    #[error("{0}")]
    Effect(String),
}

/// The two flanks' depths as one vector: pinion stations, then gear stations, mm; where the face has several slices, slice after slice.
pub struct ArchardSystem<'a, M: ContactModel + ?Sized> {
    pub(super) model: &'a M,
    /// Wear coefficient of pinion and gear, mm²/N.
    pub(super) coefficient: [f64; 2],
    pub(super) acting: Option<&'a Acting>,
    passage: Option<Passage>,
    /// By slice and position; where teeth differ by position and what meets there.
    pub(super) warm: Vec<Vec<usize>>,
    /// The last two solutions, the last one first: both stages of a step.
    last: [Option<Joint>; 2],
    /// The factors of every position that the Jacobian was last made with.
    factors: Option<KnownFactors>,
    /// Contact problems solved so far.
    pub solves: usize,
}

/// Contacts solved for some depths, by slice.
pub(super) struct Joint {
    /// Depths of all slices, mm.
    pub(super) u: Vec<f64>,
    /// By slice; where teeth differ by the passages of teeth.
    pub(super) slices: Vec<Solved>,
    /// Where teeth differ, all contacts by position.
    pub(super) met: Vec<Vec<PositionContact>>,
}

/// Factors on the wear coefficient at some cycles and depths, by slice and position.
struct KnownFactors {
    n: f64,
    u: Vec<f64>,
    factors: Vec<Vec<Factors>>,
}

/// A Jacobian, if the system is stiff, and the factors that it was made with by slice and position.
pub(super) type WithFactors = (Option<Jacobian>, Vec<Vec<Factors>>);

/// Worn area per pinion cycle and flank, pinion and gear, mm².
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct AreaRate {
    /// By the law: ∮ k f F'|v_s| dt, and what effects add.
    pub law: [f64; 2],
    /// Of that, what effects only displace: depth without loss of mass.
    pub displaced: [f64; 2],
}

impl<'a, M: ContactModel + ?Sized> ArchardSystem<'a, M> {
    /// Wear under `model` with the coefficients of pinion and gear, mm²/N.
    pub fn new(model: &'a M, coefficient: [f64; 2]) -> Self {
        let mut out = Self {
            model,
            coefficient,
            acting: None,
            passage: None,
            warm: Vec::new(),
            last: [None, None],
            factors: None,
            solves: 0,
        };
        let positions = model.cycle().positions.len();
        let contacts = match model.sequence() {
            Some(sequence) => (0..positions).map(|q| sequence.situations(q)).sum(),
            None => out.slices() * positions,
        };
        out.warm = vec![Vec::new(); contacts];
        out
    }

    /// The same with physical effects.
    pub fn with(mut self, acting: Option<&'a Acting>) -> Self {
        self.acting = acting;
        self.passage = acting
            .filter(|acting| acting.acts(Hook::AddedDepth))
            .map(|_| Passage::averaged(self.model.cycle(), PEAK_REACH));
        self
    }

    /// Number of slices of the face, or of passages of teeth that differ.
    pub fn slices(&self) -> usize {
        match self.model.sequence() {
            Some(sequence) => sequence.count(),
            None => self.model.sliced().map_or(1, |m| m.slices().count()),
        }
    }

    /// The mean over the face, or over all teeth of the member `side`, of what `of` gives for each slice or passage.
    pub fn mean(&self, side: usize, of: impl Fn(usize) -> f64) -> f64 {
        match (self.model.sequence(), self.model.sliced()) {
            (Some(sequence), _) => {
                let weights = sequence.weights(side).iter().enumerate();
                let counted = weights.filter(|(_, weight)| **weight != 0.0);
                counted.map(|(i, weight)| weight * of(i)).sum()
            }
            (None, Some(model)) => model.slices().mean((0..self.slices()).map(of)),
            (None, None) => of(0),
        }
    }

    /// Goes on from the contact sets `warm` (those of [`ArchardSystem::warm`]; others are ignored).
    pub fn start_from(&mut self, warm: &[Vec<usize>]) {
        if warm.len() == self.warm.len() {
            self.warm = warm.to_vec();
        }
    }

    /// The contact sets of the last solution.
    pub fn warm(&self) -> &[Vec<usize>] {
        &self.warm
    }

    /// The contact of every position for the depths `u`, of the first slice.
    ///
    /// # Errors
    /// [`ContactError`] of the first position that fails.
    pub fn contacts(&mut self, u: &[f64]) -> Result<&[PositionContact], ContactError> {
        Ok(&self.solved(u)?.slices[0].contacts)
    }

    /// The contact of every position for the depths `u`, by slice.
    ///
    /// # Errors
    /// [`ContactError`] of the first position that fails.
    pub fn all_contacts(&mut self, u: &[f64]) -> Result<Vec<Vec<PositionContact>>, ContactError> {
        let slices = &self.solved(u)?.slices;
        Ok(slices.iter().map(|slice| slice.contacts.clone()).collect())
    }

    /// The same, with what stations see of it where effects ask.
    pub(super) fn solved(&mut self, u: &[f64]) -> Result<&Joint, ContactError> {
        let is_known = |solved: &Option<Joint>| solved.as_ref().is_some_and(|s| s.u == u);
        let place = match self.last.iter().position(is_known) {
            Some(place) => place,
            None => {
                let solved = self.solve(u)?;
                self.last.swap(0, 1);
                self.last[0] = Some(solved);
                0
            }
        };
        Ok(self.last[place].as_ref().expect("found or just filled"))
    }

    /// Takes `contacts`, by slice, for those of the depths `u`; where teeth differ they are not all there is to know.
    pub fn take(&mut self, u: &[f64], contacts: Vec<Vec<PositionContact>>) {
        if self.model.sequence().is_none() {
            self.last[0] = Some(self.joint(u, contacts));
        }
    }

    pub(super) fn joint(&self, u: &[f64], contacts: Vec<Vec<PositionContact>>) -> Joint {
        let size = u.len() / contacts.len();
        let of_slice = |(u, contacts): (&[f64], Vec<PositionContact>)| Solved {
            u: u.to_vec(),
            moments: self.moments(&contacts),
            contacts,
        };
        Joint {
            u: u.to_vec(),
            slices: u.chunks(size).zip(contacts).map(of_slice).collect(),
            met: Vec::new(),
        }
    }

    fn moments(&self, contacts: &[PositionContact]) -> [Vec<Moment>; 2] {
        (self.passage.as_ref()).map_or_else(Default::default, |passage| {
            [0, 1].map(|side| passage.moments(self.model.cycle(), contacts, side))
        })
    }

    fn solve(&mut self, u: &[f64]) -> Result<Joint, ContactError> {
        if let Some(sequence) = self.model.sequence() {
            return self.solve_in_turn(sequence, u);
        }
        let law = self.law();
        let positions = law.cycle.positions.len();
        let contacts: Vec<Vec<PositionContact>> = match self.model.sliced() {
            None => {
                let depth = law.split(u);
                // analytic contacts are too cheap to be handed out one by one
                let all = (self.warm.par_iter().with_min_len(4).enumerate())
                    .map(|(q, start)| self.model.solve(q, depth, start));
                vec![all.collect::<Result<_, _>>()?]
            }
            Some(model) => {
                let depths: Vec<[&[f64]; 2]> = law.each(u);
                let of_turn = |turn: usize| {
                    let at = model.slices().all_at(turn, positions);
                    let flanks = law.flanks(&at, &depths);
                    let start: Vec<Vec<usize>> = (at.iter().enumerate())
                        .map(|(i, q)| self.warm[i * positions + q].clone())
                        .collect();
                    model.solve_all(turn, &flanks, &start)
                };
                let solved = (0..positions).into_par_iter().map(of_turn);
                by_slice(model.slices(), solved.collect::<Result<Vec<_>, _>>()?)
            }
        };
        self.solves += self.warm.len();
        for (warm, contact) in self.warm.iter_mut().zip(contacts.iter().flatten()) {
            warm.clone_from(&contact.active);
        }
        Ok(self.joint(u, contacts))
    }

    /// Worn area per pinion cycle at `n` cycles for the depths `u`, from the line loads; the mean over the face.
    ///
    /// # Errors
    /// [`WearError`]
    pub fn area_rate(&mut self, n: f64, u: &[f64]) -> Result<AreaRate, WearError> {
        self.solved(u)?;
        let (law, known) = (self.law_at(u), self.known(u));
        let rates: Vec<AreaRate> = (known.slices.iter()).map(|s| law.area_rate(n, s)).collect();
        let mean = |of: fn(&AreaRate) -> [f64; 2]| {
            [0, 1].map(|side| self.mean(side, |slice| of(&rates[slice])[side]))
        };
        Ok(AreaRate {
            law: mean(|rate| rate.law),
            displaced: mean(|rate| rate.displaced),
        })
    }

    /// What a solution for `u` gave, once there has been one.
    pub(super) fn known(&self, u: &[f64]) -> &Joint {
        let known = self.last.iter().flatten().find(|solved| solved.u == u);
        known.expect("the contacts for these depths were just solved")
    }

    pub(super) fn law(&self) -> Law<'_> {
        Law {
            cycle: self.model.cycle(),
            coefficient: self.coefficient,
            acting: self.acting,
            passage: self.passage.as_ref(),
            worn_volume: None,
        }
    }

    /// The law in each slice where the depths are `u`: what has worn off is that of the whole face, and of all teeth.
    pub(super) fn law_at(&self, u: &[f64]) -> Law<'_> {
        let law = self.law();
        Law {
            worn_volume: self.worn_volume(law.acting, u),
            ..law
        }
    }

    /// Volume worn off both members, mm³, where it is not that of one section.
    pub(super) fn worn_volume(&self, acting: Option<&Acting>, u: &[f64]) -> Option<f64> {
        let acting = acting.filter(|_| self.slices() > 1)?;
        let law = self.law();
        let depths: Vec<[&[f64]; 2]> = law.each(u);
        let of = |member: Member| {
            let side = side(member);
            self.mean(side, |slice| {
                acting.worn_off(law.cycle, member, depths[slice][side])
            })
        };
        Some(Member::BOTH.into_iter().map(of).sum())
    }
}

/// Contacts by turn and slice as contacts by slice and section position.
fn by_slice<T>(slices: &Slices, by_turn: Vec<Vec<T>>) -> Vec<Vec<T>> {
    let mut out: Vec<Vec<T>> = (0..slices.count()).map(|_| Vec::new()).collect();
    for turn in by_turn {
        for (slice, contact) in out.iter_mut().zip(turn) {
            slice.push(contact);
        }
    }
    for (i, slice) in out.iter_mut().enumerate() {
        slices.by_section(i, slice);
    }
    out
}

impl<M: ContactModel + ?Sized> WearSystem for ArchardSystem<'_, M> {
    type Error = WearError;

    fn rate(&mut self, n: f64, u: &[f64]) -> Result<Vec<f64>, WearError> {
        self.solved(u)?;
        let known = (self.factors.as_ref()).filter(|known| known.n == n && known.u == u);
        let law = self.law_at(u);
        let of_slice = |(i, solved): (usize, &Solved)| {
            law.rate(n, solved, known.map(|known| known.factors[i].as_slice()))
        };
        let slices = &self.known(u).slices;
        let rate = match slices.as_slice() {
            [one] => of_slice((0, one)),
            all => {
                let rates: Vec<Vec<f64>> = all.par_iter().enumerate().map(of_slice).collect();
                let mut rates = rates.concat();
                if let Some(sequence) = self.model.sequence() {
                    sequence.sharing().share(&mut rates);
                }
                rates
            }
        };
        match self.acting.and_then(|acting| acting.effects.fault()) {
            Some(fault) => Err(WearError::Effect(fault)),
            None => Ok(rate),
        }
    }

    fn jacobian(&mut self, n: f64, u: &[f64]) -> Result<Option<Jacobian>, WearError> {
        self.solved(u)?;
        let (jacobian, factors) = match (self.model.sequence(), self.model.sliced()) {
            (Some(sequence), _) => self.jacobian_in_turn(sequence, n, u)?,
            (None, Some(model)) => match self.jacobian_of_slices(model, n, u)? {
                Some((jacobian, factors)) => (Some(jacobian), factors),
                None => return Ok(None),
            },
            (None, None) => match self.jacobian_of_section(n, u)? {
                Some((jacobian, factors)) => (Some(jacobian), vec![factors]),
                None => return Ok(None),
            },
        };
        self.factors = Some(KnownFactors {
            n,
            u: u.to_vec(),
            factors,
        });
        Ok(jacobian)
    }
}
