//! What one mesh position contributes to the Jacobian of the wear rate.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::contact::cycle::{PairContact, Position};
use crate::contact::model::PositionContact;
use crate::numeric::patchy::{PatchyMatrix, Rows};
use crate::numeric::sparse::SparseRows;
use crate::wear::factors::Worn;
use crate::wear::law::{AddedReads, Factors, Law};

/// One position's part of the Jacobian, −Dᵀ S G: D deposits, S is the sensitivity of the pressures, G opens the gaps.
pub(super) struct Local<'a> {
    position: &'a Position,
    active: &'a [usize],
    /// Unknowns whose pressures are taken from this contact.
    own: Range<usize>,
    /// First unknown of each flank.
    shift: [usize; 2],
    /// Depth rate per pressure of pinion and gear: k per pinion cycle.
    scale: [f64; 2],
    /// Change of f p with p at the unknowns.
    slopes: Factors,
    /// What effects add.
    reads: AddedReads,
}

impl<'a> Local<'a> {
    /// Of a solved contact, with the factors on the coefficient that the law has there.
    pub(super) fn new(
        law: &Law<'_>,
        view: &Worn<'_>,
        position: &'a Position,
        contact: &'a PositionContact,
        reads: AddedReads,
    ) -> (Self, Factors) {
        let [factors, slopes] = law.factors_and_slopes(view, position, contact);
        let local = Self {
            position,
            active: &contact.active,
            own: 0..contact.pressure.len(),
            shift: [0, law.cycle.stations.arc[0].len()],
            scale: law.scale(),
            slopes,
            reads,
        };
        (local, factors)
    }

    /// The same where the pressures of the unknowns `own` are those of another contact, with the active set `active`.
    pub(super) fn take(&mut self, own: Range<usize>, active: &'a [usize]) {
        (self.own, self.active) = (own, active);
    }

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

    /// Where the pressure at each unknown of the active set wears, by its rate of depth.
    fn deposits(&self) -> Deposits {
        let mut deposits = Deposits::default();
        for &k in self.active {
            if !self.own.contains(&k) {
                deposits.push(std::iter::empty());
                continue;
            }
            let slope = |side: usize| self.slopes.as_ref().map_or(1.0, |s| s[side][k]);
            let read = self.reads.iter().filter(|read| read.0 == k);
            let worn = self
                .row(k, |pair| &pair.wear)
                .map(|(at, v, side)| (at, self.scale[side] * slope(side) * v));
            deposits.push(worn.chain(read.map(|&(_, at, value)| (at, value))));
        }
        deposits
    }

    /// Rates per approach, where `pressure` is that on the active set per approach.
    pub(super) fn drives(&self, pressure: &DVector<f64>, rate: &mut [f64]) {
        let deposits = self.deposits();
        for (i, p) in pressure.iter().enumerate() {
            for (first, values) in deposits.of(i) {
                let rates = rate[first..].iter_mut().zip(values);
                rates.for_each(|(rate, value)| *rate += value * p);
            }
        }
    }

    /// Approach per depth, where `gap` times `share` is that per weighted gap on the active set.
    pub(super) fn follows(&self, gap: &DVector<f64>, share: f64, depth: &mut [f64]) {
        for (&k, f) in self.active.iter().zip(gap.iter()) {
            for (station, opening, _) in self.row(k, |pair| &pair.opening) {
                depth[station] += share * f * opening;
            }
        }
    }

    /// Adds the part of this position, whose pressures on the active set have this `sensitivity` to its weighted gaps.
    pub(super) fn add(&self, sensitivity: &DMatrix<f64>, jacobian: &mut PatchyMatrix) {
        let deposits = self.deposits();
        let touched = Rows::new(deposits.stations());
        let mut column = vec![0.0; jacobian.size()];
        for (j, &l) in self.active.iter().enumerate() {
            for range in touched.ranges() {
                column[range.clone()].fill(0.0);
            }
            for i in 0..self.active.len() {
                let sensitivity = sensitivity[(i, j)];
                for (first, values) in deposits.of(i) {
                    let entries = column[first..].iter_mut().zip(values);
                    entries.for_each(|(entry, value)| *entry -= value * sensitivity);
                }
            }
            for (station, opening, _) in self.row(l, |pair| &pair.opening) {
                jacobian.add(station, &touched, opening, &column);
            }
        }
    }
}

/// Rates of depth per pressure at the unknowns of an active set, by runs of neighbouring stations: loops over a run are loops over slices.
#[derive(Default)]
struct Deposits {
    values: Vec<f64>,
    /// First station of each run, and its place in `values`.
    runs: Vec<(usize, Range<usize>)>,
    /// Where each unknown's runs end.
    ends: Vec<usize>,
}

impl Deposits {
    /// Takes the next unknown's entries (joint station, value).
    fn push(&mut self, entries: impl Iterator<Item = (usize, f64)>) {
        let own = self.runs.len();
        for (station, value) in entries {
            let at = self.values.len();
            match self.runs[own..].last_mut() {
                Some((first, run)) if *first + run.len() == station => run.end += 1,
                _ => self.runs.push((station, at..at + 1)),
            }
            self.values.push(value);
        }
        self.ends.push(self.runs.len());
    }

    /// First station and values of every run of the unknown number `i` of the set.
    fn of(&self, i: usize) -> impl Iterator<Item = (usize, &[f64])> + '_ {
        let begin = if i == 0 { 0 } else { self.ends[i - 1] };
        let runs = self.runs[begin..self.ends[i]].iter();
        runs.map(|(first, run)| (*first, &self.values[run.clone()]))
    }

    /// The stations of all.
    fn stations(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let runs = self.runs.iter();
        runs.map(|(first, run)| *first..*first + run.len())
    }
}
