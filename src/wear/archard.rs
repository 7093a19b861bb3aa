//! Archard wear of both members over the mesh cycle.
//!
//! ```text
//! dh/dn (mm per pinion cycle) = ∫ k p |v| dy over the passage,  for the gear times z₁/z₂ passages per pinion cycle
//! ```
//! Archard, J. Appl. Phys. 24 (1953); the passage integral is that of Andersson & Eriksson's single-point observation
//! (Nordtrib 1990), here with the pressure solved at every position instead of a Hertz profile.

use faer::Mat;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::contact::cycle::{PairContact, Position};
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::numeric::sparse::SparseRows;
use crate::wear::integrator::WearSystem;

/// The two flanks' depths as one vector: pinion stations, then gear stations, mm.
pub struct ArchardSystem<'a, M: ContactModel + ?Sized> {
    model: &'a M,
    /// Wear coefficient of pinion and gear, mm²/N.
    coefficient: [f64; 2],
    warm: Vec<Vec<usize>>,
    last: Option<(Vec<f64>, Vec<PositionContact>)>,
    /// Contact problems solved so far.
    pub solves: usize,
}

impl<'a, M: ContactModel + ?Sized> ArchardSystem<'a, M> {
    /// Wear under `model` with the coefficients of pinion and gear, mm²/N.
    pub fn new(model: &'a M, coefficient: [f64; 2]) -> Self {
        Self {
            model,
            coefficient,
            warm: vec![Vec::new(); model.cycle().positions.len()],
            last: None,
            solves: 0,
        }
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
            let solved: Vec<PositionContact> = self
                .warm
                .par_iter()
                .enumerate()
                .map(|(q, start)| self.model.solve(q, depth, start))
                .collect::<Result<_, _>>()?;
            self.solves += solved.len();
            for (warm, contact) in self.warm.iter_mut().zip(&solved) {
                warm.clone_from(&contact.active);
            }
            self.last = Some((u.to_vec(), solved));
        }
        Ok(&self.last.as_ref().expect("just filled").1)
    }

    fn factors(&self) -> [f64; 2] {
        [
            self.coefficient[0],
            self.coefficient[1] / self.model.cycle().pair.speed_ratio,
        ]
    }
}

/// Pinion and gear part of the joint depth vector.
fn split<'u, M: ContactModel + ?Sized>(model: &M, u: &'u [f64]) -> [&'u [f64]; 2] {
    let (pinion, gear) = u.split_at(model.cycle().stations.arc[0].len());
    [pinion, gear]
}

impl<M: ContactModel + ?Sized> WearSystem for ArchardSystem<'_, M> {
    type Error = ContactError;

    fn rate(&mut self, _: f64, u: &[f64]) -> Result<Vec<f64>, ContactError> {
        let factors = self.factors();
        self.contacts(u)?;
        let (_, contacts) = self.last.as_ref().expect("contacts were just solved");
        let cycle = self.model.cycle();
        let mut rate = vec![0.0; u.len()];
        let (pinion, gear) = rate.split_at_mut(cycle.stations.arc[0].len());
        for (position, contact) in cycle.positions.iter().zip(contacts) {
            for pair in &position.pairs {
                for (side, depth) in [&mut *pinion, &mut *gear].into_iter().enumerate() {
                    for k in 0..pair.xi.len() {
                        let p = contact.pressure[pair.offset + k];
                        if p > 0.0 {
                            pair.wear[side].scatter(k, factors[side] * p, depth);
                        }
                    }
                }
            }
        }
        Ok(rate)
    }

    fn jacobian(&mut self, _: f64, u: &[f64]) -> Result<Option<Mat<f64>>, ContactError> {
        let factors = self.factors();
        self.contacts(u)?;
        let (_, contacts) = self.last.as_ref().expect("contacts were just solved");
        let cycle = self.model.cycle();
        let shift = [0, cycle.stations.arc[0].len()];
        let blocks: Vec<Option<DMatrix<f64>>> = contacts
            .par_iter()
            .enumerate()
            .map(|(q, contact)| self.model.sensitivity(q, contact))
            .collect::<Result<_, _>>()?;
        let mut jacobian = Mat::zeros(u.len(), u.len());
        for ((position, contact), block) in cycle.positions.iter().zip(contacts).zip(blocks) {
            let Some(block) = block else { return Ok(None) };
            let local = Local {
                position,
                active: &contact.active,
                shift,
                factors,
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
    factors: [f64; 2],
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
                self.row(k, |pair| &pair.wear)
                    .map(|(at, v, side)| (at, self.factors[side] * v))
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
