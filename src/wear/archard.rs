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

use faer::Mat;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::contact::cycle::{PairContact, Position};
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::effects::{Effect, Hook};
use crate::numeric::sparse::SparseRows;
use crate::wear::acting::Acting;
use crate::wear::integrator::WearSystem;
use crate::wear::law::{AddedReads, Factors, Law, Solved};
use crate::wear::passage::{Moment, Passage};

/// Length over which the largest pressure that effects are told is averaged, mm: about that of a micropit, and a third of a contact.
const PEAK_LENGTH: f64 = 0.03;

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

/// The two flanks' depths as one vector: pinion stations, then gear stations, mm.
pub struct ArchardSystem<'a, M: ContactModel + ?Sized> {
    pub(super) model: &'a M,
    /// Wear coefficient of pinion and gear, mm²/N.
    pub(super) coefficient: [f64; 2],
    pub(super) acting: Option<&'a Acting>,
    passage: Option<Passage>,
    warm: Vec<Vec<usize>>,
    /// The last two solutions, the last one first: both stages of a step.
    last: [Option<Solved>; 2],
    /// The factors of every position that the Jacobian was last made with.
    factors: Option<KnownFactors>,
    /// Contact problems solved so far.
    pub solves: usize,
}

/// Factors on the wear coefficient at some cycles and depths, by position.
struct KnownFactors {
    n: f64,
    u: Vec<f64>,
    factors: Vec<Factors>,
}

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
        Self {
            model,
            coefficient,
            acting: None,
            passage: None,
            warm: vec![Vec::new(); model.cycle().positions.len()],
            last: [None, None],
            factors: None,
            solves: 0,
        }
    }

    /// The same with physical effects.
    pub fn with(mut self, acting: Option<&'a Acting>) -> Self {
        self.acting = acting;
        self.passage = acting
            .filter(|acting| acting.acts(Hook::AddedDepth))
            .map(|_| Passage::averaged(self.model.cycle(), PEAK_LENGTH));
        self
    }

    /// Goes on from the contact sets `warm` (one list of unknowns per position; others are ignored).
    pub fn start_from(&mut self, warm: &[Vec<usize>]) {
        if warm.len() == self.warm.len() {
            self.warm = warm.to_vec();
        }
    }

    /// The contact sets of the last solution.
    pub fn warm(&self) -> &[Vec<usize>] {
        &self.warm
    }

    /// The contact of every position for the depths `u`.
    ///
    /// # Errors
    /// [`ContactError`] of the first position that fails.
    pub fn contacts(&mut self, u: &[f64]) -> Result<&[PositionContact], ContactError> {
        Ok(&self.solved(u)?.contacts)
    }

    /// The same, with what stations see of it where effects ask.
    pub(super) fn solved(&mut self, u: &[f64]) -> Result<&Solved, ContactError> {
        let is_known = |solved: &Option<Solved>| solved.as_ref().is_some_and(|s| s.u == u);
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

    /// Takes `contacts` for those of the depths `u`.
    pub fn take(&mut self, u: &[f64], contacts: Vec<PositionContact>) {
        let moments = self.moments(&contacts);
        self.last[0] = Some(Solved {
            u: u.to_vec(),
            contacts,
            moments,
        });
    }

    fn moments(&self, contacts: &[PositionContact]) -> [Vec<Moment>; 2] {
        (self.passage.as_ref()).map_or_else(Default::default, |passage| {
            [0, 1].map(|side| passage.moments(self.model.cycle(), contacts, side))
        })
    }

    fn solve(&mut self, u: &[f64]) -> Result<Solved, ContactError> {
        let depth = self.law().split(u);
        // analytic contacts are too cheap to be handed out one by one
        let contacts: Vec<PositionContact> = self
            .warm
            .par_iter()
            .with_min_len(4)
            .enumerate()
            .map(|(q, start)| self.model.solve(q, depth, start))
            .collect::<Result<_, _>>()?;
        self.solves += contacts.len();
        for (warm, contact) in self.warm.iter_mut().zip(&contacts) {
            warm.clone_from(&contact.active);
        }
        let moments = self.moments(&contacts);
        Ok(Solved {
            u: u.to_vec(),
            contacts,
            moments,
        })
    }

    /// Worn area per pinion cycle at `n` cycles for the depths `u`, from the line loads.
    ///
    /// # Errors
    /// [`WearError`]
    pub fn area_rate(&mut self, n: f64, u: &[f64]) -> Result<AreaRate, WearError> {
        self.solved(u)?;
        Ok(self.law().area_rate(n, self.known(u)))
    }

    /// What a solution for `u` gave, once there has been one.
    pub(super) fn known(&self, u: &[f64]) -> &Solved {
        let known = self.last.iter().flatten().find(|solved| solved.u == u);
        known.expect("the contacts for these depths were just solved")
    }

    pub(super) fn law(&self) -> Law<'_> {
        Law {
            cycle: self.model.cycle(),
            coefficient: self.coefficient,
            acting: self.acting,
            passage: self.passage.as_ref(),
        }
    }
}

impl<M: ContactModel + ?Sized> WearSystem for ArchardSystem<'_, M> {
    type Error = WearError;

    fn rate(&mut self, n: f64, u: &[f64]) -> Result<Vec<f64>, WearError> {
        self.solved(u)?;
        let known = (self.factors.as_ref()).filter(|known| known.n == n && known.u == u);
        let known = known.map(|known| known.factors.as_slice());
        let rate = self.law().rate(n, self.known(u), known);
        match self.acting.and_then(|acting| acting.effects.fault()) {
            Some(fault) => Err(WearError::Effect(fault)),
            None => Ok(rate),
        }
    }

    fn jacobian(&mut self, n: f64, u: &[f64]) -> Result<Option<Mat<f64>>, WearError> {
        self.solved(u)?;
        let (law, solved) = (self.law(), self.known(u));
        let (cycle, contacts) = (law.cycle, &solved.contacts);
        let blocks: Vec<Option<DMatrix<f64>>> = contacts
            .par_iter()
            .enumerate()
            .map(|(q, contact)| self.model.sensitivity(q, contact))
            .collect::<Result<_, _>>()?;
        let Some(blocks) = blocks.into_iter().collect::<Option<Vec<_>>>() else {
            return Ok(None);
        };
        let view = law.view(n, u);
        let mut jacobian = Mat::zeros(u.len(), u.len());
        let mut all_factors = Vec::with_capacity(contacts.len());
        let reads = law.added_reads(&view, solved, &law.reads(solved));
        for (q, ((contact, block), reads)) in contacts.iter().zip(blocks).zip(reads).enumerate() {
            let position = &cycle.positions[q];
            let [factors, slopes] = law.factors_and_slopes(&view, position, contact);
            all_factors.push(factors);
            let local = Local {
                position,
                active: &contact.active,
                shift: [0, cycle.stations.arc[0].len()],
                scale: law.scale(),
                slopes,
                reads,
            };
            local.add(&block, &mut jacobian);
        }
        self.factors = Some(KnownFactors {
            n,
            u: u.to_vec(),
            factors: all_factors,
        });
        Ok(Some(jacobian))
    }
}

/// One position's part of the Jacobian, −Dᵀ S G: D deposits, S is the sensitivity of the pressures, G opens the gaps.
struct Local<'a> {
    position: &'a Position,
    active: &'a [usize],
    /// First unknown of each flank.
    shift: [usize; 2],
    /// Depth rate per pressure of pinion and gear: k per pinion cycle.
    scale: [f64; 2],
    /// Change of f p with p at the unknowns.
    slopes: Factors,
    /// What effects add.
    reads: AddedReads,
}

impl Local<'_> {
    /// Entries (station, value) of an operator's row for unknown `k`, both flanks.
    fn row<'b>(
        &'b self,
        k: usize,
        operator: impl Fn(&'b PairContact) -> &'b [SparseRows; 2] + 'b,
    ) -> impl Iterator<Item = (usize, f64, usize)> + 'b {
        let pair = &self.position.pairs[self.position.owner(k)];
        operator(pair)
            .iter()
            .enumerate()
            .flat_map(move |(side, rows)| {
                let (columns, values) = rows.row(k - pair.offset);
                columns
                    .iter()
                    .zip(values)
                    .map(move |(&c, &v)| (self.shift[side] + c as usize, v, side))
            })
    }

    fn add(&self, sensitivity: &DMatrix<f64>, jacobian: &mut Mat<f64>) {
        let deposits: Vec<Vec<(usize, f64)>> = self
            .active
            .iter()
            .map(|&k| {
                let slope = |side: usize| self.slopes.as_ref().map_or(1.0, |s| s[side][k]);
                let read = self.reads.iter().filter(|read| read.0 == k);
                self.row(k, |pair| &pair.wear)
                    .map(|(at, v, side)| (at, self.scale[side] * slope(side) * v))
                    .chain(read.map(|&(_, at, value)| (at, value)))
                    .collect()
            })
            .collect();
        let mut touched: Vec<usize> = deposits.iter().flatten().map(|e| e.0).collect();
        touched.sort_unstable();
        touched.dedup();
        let mut column = vec![0.0; jacobian.nrows()];
        for (j, &l) in self.active.iter().enumerate() {
            for &i in &touched {
                column[i] = 0.0;
            }
            for (i, deposit) in deposits.iter().enumerate() {
                for &(at, value) in deposit {
                    column[at] -= value * sensitivity[(i, j)];
                }
            }
            for (station, opening, _) in self.row(l, |pair| &pair.opening) {
                let target = jacobian.col_as_slice_mut(station);
                for &i in &touched {
                    target[i] += opening * column[i];
                }
            }
        }
    }
}
