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
use crate::contact::deposit::tributary;
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::effects::{Effect, Hook};
use crate::gear::Member;
use crate::numeric::sparse::SparseRows;
use crate::wear::acting::{Acting, Age, PairLoad, side};
use crate::wear::factors::{Worn, factors};
use crate::wear::integrator::WearSystem;
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
    model: &'a M,
    /// Wear coefficient of pinion and gear, mm²/N.
    coefficient: [f64; 2],
    acting: Option<&'a Acting>,
    passage: Option<Passage>,
    warm: Vec<Vec<usize>>,
    last: Option<(Vec<f64>, Vec<PositionContact>)>,
    /// What the stations of pinion and gear see in the last solution; empty where no effect asks.
    moments: [Vec<Moment>; 2],
    /// Contact problems solved so far.
    pub solves: usize,
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
            last: None,
            moments: Default::default(),
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
        if self.last.as_ref().is_none_or(|(at, _)| at != u) {
            let depth = split(self.model, u);
            // analytic contacts are too cheap to be handed out one by one
            let solved: Vec<PositionContact> = self
                .warm
                .par_iter()
                .with_min_len(4)
                .enumerate()
                .map(|(q, start)| self.model.solve(q, depth, start))
                .collect::<Result<_, _>>()?;
            self.solves += solved.len();
            for (warm, contact) in self.warm.iter_mut().zip(&solved) {
                warm.clone_from(&contact.active);
            }
            if let Some(passage) = &self.passage {
                self.moments = [0, 1].map(|s| passage.moments(self.model.cycle(), &solved, s));
            }
            self.last = Some((u.to_vec(), solved));
        }
        Ok(&self.last.as_ref().expect("just filled").1)
    }

    /// Worn area per pinion cycle at `n` cycles for the depths `u`, from the line loads.
    ///
    /// # Errors
    /// [`WearError`]
    pub fn area_rate(&mut self, n: f64, u: &[f64]) -> Result<AreaRate, WearError> {
        self.contacts(u)?;
        let (_, contacts) = self.last.as_ref().expect("contacts were just solved");
        let view = self.view(n, u);
        let cycle = self.model.cycle();
        let mut work = [0.0; 2];
        for (position, contact) in cycle.positions.iter().zip(contacts) {
            let factors = self.wear_factors(&view, position, contact);
            for pair in &position.pairs {
                for (side, work) in work.iter_mut().enumerate() {
                    let load: f64 = (pair.length.iter().enumerate())
                        .map(|(k, length)| {
                            let at = pair.offset + k;
                            let plain = length * contact.pressure[at];
                            factors.as_ref().map_or(plain, |f| plain * f[side][at])
                        })
                        .sum();
                    *work += load * pair.slid;
                }
            }
        }
        let mut rate = AreaRate {
            law: [
                self.coefficient[0] * work[0],
                self.coefficient[1] * work[1] / cycle.pair.speed_ratio,
            ],
            displaced: [0.0; 2],
        };
        for added in self.added(&view, contacts) {
            let width = tributary(&cycle.stations.arc[added.side], added.station);
            rate.law[added.side] += (added.removed + added.displaced) * width;
            rate.displaced[added.side] += added.displaced * width;
        }
        Ok(rate)
    }

    fn factors(&self) -> [f64; 2] {
        [
            self.coefficient[0],
            self.coefficient[1] / self.model.cycle().pair.speed_ratio,
        ]
    }

    fn view<'b>(&self, n: f64, u: &'b [f64]) -> Worn<'b> {
        let depth = split(self.model, u);
        let worn_volume = self
            .acting
            .map_or(0.0, |acting| acting.worn_volume(self.model.cycle(), depth));
        Worn {
            depth,
            age: Age {
                cycles: n,
                worn_volume,
            },
        }
    }

    /// Factor on k at every unknown of position `q` on pinion and gear; `None`: 1 everywhere.
    fn wear_factors(
        &self,
        view: &Worn,
        position: &Position,
        contact: &PositionContact,
    ) -> Option<[Vec<f64>; 2]> {
        self.each_factor(view, position, contact, |f, _, _| f)
    }

    /// The same of f + p df/dp: what a small change of pressure changes f p by.
    fn pressure_slopes(
        &self,
        view: &Worn,
        position: &Position,
        contact: &PositionContact,
    ) -> Option<[Vec<f64>; 2]> {
        const STEP: f64 = 1e-4;
        self.each_factor(view, position, contact, |f, acting, local| {
            let mut more = *local;
            more.pressure *= 1.0 + STEP;
            more.peak_pressure *= 1.0 + STEP;
            f + (acting.effects.wear_factor(&more) - f) / STEP
        })
    }

    fn each_factor(
        &self,
        view: &Worn,
        position: &Position,
        contact: &PositionContact,
        of: impl Fn(f64, &Acting, &crate::effects::Local) -> f64,
    ) -> Option<[Vec<f64>; 2]> {
        let acting = self.acting.filter(|a| a.acts(Hook::WearFactor))?;
        let of = |f: f64, local: &crate::effects::Local| of(f, acting, local);
        let cycle = self.model.cycle();
        Some(factors(acting, cycle, view, position, contact, of))
    }

    /// What effects add at every station, mm per pinion cycle.
    fn added(&self, view: &Worn, contacts: &[PositionContact]) -> Vec<Added> {
        self.each_added(view, contacts, |depths, _, _| depths)
    }

    /// How that changes with the largest pressure there, mm per MPa.
    fn added_slopes(&self, view: &Worn, contacts: &[PositionContact]) -> Vec<Added> {
        const STEP: f64 = 1e-4;
        self.each_added(view, contacts, |depths, acting, local| {
            if local.pressure <= 0.0 {
                return [0.0; 2];
            }
            let mut more = *local;
            more.pressure *= 1.0 + STEP;
            more.peak_pressure *= 1.0 + STEP;
            let moved = acting.effects.added_depths(&more);
            [0, 1].map(|i| (moved[i] - depths[i]) / (STEP * local.pressure))
        })
    }

    fn each_added(
        &self,
        view: &Worn,
        contacts: &[PositionContact],
        of: impl Fn([f64; 2], &Acting, &crate::effects::Local) -> [f64; 2],
    ) -> Vec<Added> {
        let (Some(acting), Some(passage)) = (self.acting, &self.passage) else {
            return Vec::new();
        };
        let cycle = self.model.cycle();
        let locals: Vec<_> = (0..passage.order.len())
            .map(|m| {
                let pair = passage.pair(cycle, m);
                let load = PairLoad::of(pair, &contacts[passage.order[m].0]);
                acting.at_pair(cycle, pair, load, view.age)
            })
            .collect();
        let mut out = Vec::new();
        for member in Member::BOTH {
            let side = side(member);
            let per_cycle = 1e-3 / [1.0, cycle.pair.speed_ratio][side];
            for (station, moment) in self.moments[side].iter().enumerate() {
                let mut local = locals[moment.pair];
                local.peak_pressure = moment.pressure;
                let arc = cycle.stations.arc[side][station];
                let depth = view.depth[side][station];
                acting.at_point(&mut local, cycle, member, arc, depth, moment.pressure);
                let depths = acting.effects.added_depths(&local);
                let [removed, displaced] = of(depths, acting, &local);
                out.push(Added {
                    side,
                    station,
                    removed: per_cycle * removed,
                    displaced: per_cycle * displaced,
                });
            }
        }
        out
    }

    /// What the slopes of added depths put into the Jacobian, by position: unknown, joint station, mm per cycle and MPa.
    fn reads(&self, view: &Worn, contacts: &[PositionContact]) -> Vec<Vec<(usize, usize, f64)>> {
        let cycle = self.model.cycle();
        let mut reads = vec![Vec::new(); cycle.positions.len()];
        let Some(passage) = &self.passage else {
            return reads;
        };
        let shift = [0, cycle.stations.arc[0].len()];
        let unknowns = [0, 1].map(|side| passage.reads(cycle, contacts, side, &self.moments[side]));
        for added in self.added_slopes(view, contacts) {
            let at = shift[added.side] + added.station;
            let slope = added.removed + added.displaced;
            for &(q, k, weight) in &unknowns[added.side][added.station] {
                if weight != 0.0 {
                    reads[q as usize].push((k as usize, at, weight * slope));
                }
            }
        }
        reads
    }
}

/// What effects add at one station, or its change with the largest pressure there.
struct Added {
    side: usize,
    station: usize,
    /// mm per pinion cycle, material lost.
    removed: f64,
    /// mm per pinion cycle, material moved aside.
    displaced: f64,
}

/// Pinion and gear part of the joint depth vector.
fn split<'u, M: ContactModel + ?Sized>(model: &M, u: &'u [f64]) -> [&'u [f64]; 2] {
    let (pinion, gear) = u.split_at(model.cycle().stations.arc[0].len());
    [pinion, gear]
}

impl<M: ContactModel + ?Sized> WearSystem for ArchardSystem<'_, M> {
    type Error = WearError;

    fn rate(&mut self, n: f64, u: &[f64]) -> Result<Vec<f64>, WearError> {
        let scale = self.factors();
        self.contacts(u)?;
        let (_, contacts) = self.last.as_ref().expect("contacts were just solved");
        let view = self.view(n, u);
        let cycle = self.model.cycle();
        let factors: Vec<_> = (cycle.positions.iter().zip(contacts))
            .map(|(position, contact)| self.wear_factors(&view, position, contact))
            .collect();
        let mut rate = vec![0.0; u.len()];
        let (pinion, gear) = rate.split_at_mut(cycle.stations.arc[0].len());
        for ((position, contact), factors) in cycle.positions.iter().zip(contacts).zip(factors) {
            for pair in &position.pairs {
                for (side, depth) in [&mut *pinion, &mut *gear].into_iter().enumerate() {
                    for k in 0..pair.xi.len() {
                        let at = pair.offset + k;
                        let p = contact.pressure[at];
                        if p > 0.0 {
                            let kp = scale[side] * p;
                            let kp = factors.as_ref().map_or(kp, |f| kp * f[side][at]);
                            pair.wear[side].scatter(k, kp, depth);
                        }
                    }
                }
            }
        }
        for added in self.added(&view, contacts) {
            [&mut *pinion, &mut *gear][added.side][added.station] +=
                added.removed + added.displaced;
        }
        match self.acting.and_then(|acting| acting.effects.fault()) {
            Some(fault) => Err(WearError::Effect(fault)),
            None => Ok(rate),
        }
    }

    fn jacobian(&mut self, n: f64, u: &[f64]) -> Result<Option<Mat<f64>>, WearError> {
        let scale = self.factors();
        self.contacts(u)?;
        let (_, contacts) = self.last.as_ref().expect("contacts were just solved");
        let view = self.view(n, u);
        let cycle = self.model.cycle();
        let shift = [0, cycle.stations.arc[0].len()];
        let blocks: Vec<Option<DMatrix<f64>>> = contacts
            .par_iter()
            .enumerate()
            .map(|(q, contact)| self.model.sensitivity(q, contact))
            .collect::<Result<_, _>>()?;
        let Some(blocks) = blocks.into_iter().collect::<Option<Vec<_>>>() else {
            return Ok(None);
        };
        let mut jacobian = Mat::zeros(u.len(), u.len());
        let reads = self.reads(&view, contacts);
        for (q, ((contact, block), reads)) in contacts.iter().zip(blocks).zip(reads).enumerate() {
            let position = &cycle.positions[q];
            let local = Local {
                position,
                active: &contact.active,
                shift,
                scale,
                slopes: self.pressure_slopes(&view, position, contact),
                reads,
            };
            local.add(&block, &mut jacobian);
        }
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
    /// Change of f p with p at the unknowns, pinion and gear; `None`: 1.
    slopes: Option<[Vec<f64>; 2]>,
    /// What effects add: unknown, joint station, mm per cycle and MPa.
    reads: Vec<(usize, usize, f64)>,
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
