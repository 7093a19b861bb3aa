//! A smooth discrepancy: how much of a misfit anything smooth could explain, and on what that depends.
//!
//! ```text
//! m(test, member, quantity; s, n) = g Σ_p Σ_c a_pc cos(p π s) T_c(n)      one set of a per test, member, quantity and place across the face
//! ```
//! s: position in shares of the measured range; T: Chebyshev's polynomials of the share of the test; g: 1, or the model's own value,
//! of which most missing effects are a smooth share. The discrepancy shown is that of the least Bayesian information criterion. What
//! anything smooth could explain is more than such few terms do: the largest fall of χ², beyond what as many terms gain on noise,
//! that is sure to two standard deviations.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::learn::candidates::likelihood::Likelihood;
use crate::measure::surfaces;
use crate::numeric::chebyshev;

/// Terms along the position and over the cycles that are tried.
const TERMS: [(usize, usize); 7] = [(1, 1), (1, 3), (3, 1), (4, 2), (7, 3), (12, 3), (18, 4)];
/// Prior precision of the whitened coefficients, so that terms the data do not hold stay finite.
const RIDGE: f64 = 1e-6;

/// Standard deviations from which a fall of χ² is far more than noise.
const SIGNIFICANT: f64 = 5.0;

/// What a smooth discrepancy found.
#[derive(Debug, Clone)]
pub(in crate::learn) struct SmoothDiscrepancy {
    /// Fall of χ² beyond what its terms gain on noise.
    pub(in crate::learn) drop: f64,
    /// Whether that is what evidence gains at least, in which the tests' own k agreeing counts, and not what the terms bring.
    pub(in crate::learn) by_evidence: bool,
    /// Number of terms that this takes.
    pub(in crate::learn) terms: usize,
    /// Its values, model minus what is missing: to be added to the model, per row.
    pub(in crate::learn) values: Vec<f64>,
}

/// One place of the map of a smooth discrepancy.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPoint {
    /// Id of the test.
    pub test: String,
    /// `pinion`, `gear` or `pair`.
    pub member: &'static str,
    /// What is measured.
    pub quantity: &'static str,
    /// Pinion revolutions.
    pub cycles: f64,
    /// mm of radius or base pitches of rotation; None for a whole member.
    pub position: Option<f64>,
    /// Smooth part of measured minus base model, in sigmas of the row.
    pub value: f64,
    /// The row's sigma, in the unit of what is measured.
    pub sigma: f64,
    /// That unit.
    pub unit: &'static str,
}

/// Whether a fall of χ² with this standard deviation on noise alone is far more than noise.
pub(in crate::learn) fn is_significant(drop: f64, spread: f64) -> bool {
    drop > SIGNIFICANT * spread
}

impl SmoothDiscrepancy {
    /// Of what a model leaves.
    pub(in crate::learn) fn of(likelihood: &Likelihood<'_>, model: &[f64]) -> Self {
        let residual = likelihood.residual(model);
        let white = DVector::from_vec(likelihood.covariance.whiten(&residual));
        let groups = groups(likelihood);
        let ones = vec![1.0; likelihood.len()];
        let kinds: Vec<(&[f64], (usize, usize))> = ([ones.as_slice(), model].into_iter())
            .flat_map(|g| TERMS.map(|terms| (g, terms)))
            .collect();
        let tried: Vec<SmoothDiscrepancy> = kinds
            .par_iter()
            .map(|&(g, terms)| {
                let mut values = vec![0.0; likelihood.len()];
                let (mut fallen, mut count) = (0.0, 0);
                for group in &groups {
                    let columns = group.columns(g, terms);
                    let seen = likelihood.covariance.whiten_all(&columns);
                    let mut gram = seen.tr_mul(&seen);
                    for i in 0..gram.nrows() {
                        gram[(i, i)] += RIDGE * (1.0 + gram[(i, i)]);
                    }
                    let right = seen.tr_mul(&white);
                    let Some(factor) = gram.cholesky() else {
                        continue;
                    };
                    let found = factor.solve(&right);
                    fallen += found.dot(&right);
                    count += columns.ncols();
                    let of_group = &columns * found;
                    values
                        .iter_mut()
                        .zip(of_group.iter())
                        .for_each(|(v, m)| *v += m);
                }
                SmoothDiscrepancy {
                    drop: fallen - count as f64,
                    by_evidence: false,
                    terms: count,
                    values,
                }
            })
            .collect();
        let rows = (likelihood.len() as f64).ln();
        let criterion = |f: &SmoothDiscrepancy| f.drop + (1.0 - rows) * f.terms as f64;
        let sure = |f: &SmoothDiscrepancy| f.drop - 2.0 * f.spread();
        let shown = best(&tried, criterion).values.clone();
        let SmoothDiscrepancy { drop, terms, .. } = *best(&tried, sure);
        Self {
            drop,
            by_evidence: false,
            terms,
            values: shown,
        }
    }

    /// The same where a smooth discrepancy gains `evidence` (log) over none: evidence pays for its freedom, so the fall of χ² that gains it is
    /// at least twice that. Discrepancies common to all tests, a function of the cycles say, gain more than terms of every test's own.
    pub(in crate::learn) fn gaining(self, evidence: f64) -> Self {
        let least = 2.0 * evidence;
        Self {
            drop: self.drop.max(least),
            by_evidence: least > self.drop,
            ..self
        }
    }

    /// Whether it is far more than noise.
    pub(in crate::learn) fn is_real(&self) -> bool {
        is_significant(self.drop, self.spread())
    }

    /// Standard deviation of `drop` on noise alone.
    pub(in crate::learn) fn spread(&self) -> f64 {
        (2.0 * self.terms as f64).sqrt()
    }

    /// The discrepancy at every row of the likelihood.
    pub(in crate::learn) fn map(&self, likelihood: &Likelihood<'_>) -> Vec<MapPoint> {
        let of = |(i, value): (usize, &f64)| {
            let o = likelihood.observation(i);
            MapPoint {
                test: likelihood.measured.data.tests[o.test].clone(),
                member: o.member.name(),
                quantity: o.quantity.name(),
                cycles: o.cycles,
                position: o.position,
                value: value / o.sigma,
                sigma: o.sigma,
                unit: o.quantity.unit(),
            }
        };
        self.values.iter().enumerate().map(of).collect()
    }
}

fn best(
    tried: &[SmoothDiscrepancy],
    value: impl Fn(&SmoothDiscrepancy) -> f64,
) -> &SmoothDiscrepancy {
    (tried.iter().max_by(|a, b| value(a).total_cmp(&value(b))))
        .expect("some numbers of terms are tried")
}

/// Rows of one test, member, quantity and place across the face.
struct Group {
    rows: Vec<usize>,
    /// Position and time of each, 0 to 1.
    places: Vec<(f64, f64)>,
    distinct: (usize, usize),
}

impl Group {
    /// The basis functions times `g` at the rows, 0 elsewhere.
    fn columns(&self, g: &[f64], terms: (usize, usize)) -> DMatrix<f64> {
        let (along, over) = (terms.0.min(self.distinct.0), terms.1.min(self.distinct.1));
        let mut columns = DMatrix::zeros(g.len(), along * over);
        for (&row, &(s, n)) in self.rows.iter().zip(&self.places) {
            for p in 0..along {
                for c in 0..over {
                    let over_cycles = chebyshev(c, 2.0 * n - 1.0);
                    columns[(row, p * over + c)] = g[row] * (p as f64 * PI * s).cos() * over_cycles;
                }
            }
        }
        columns
    }
}

fn groups(likelihood: &Likelihood<'_>) -> Vec<Group> {
    let mut rows = BTreeMap::new();
    let observations = likelihood.observations();
    for (i, surface) in surfaces(&observations).into_iter().enumerate() {
        let of: &mut Vec<usize> = rows.entry(surface).or_default();
        of.push(i);
    }
    let range = |values: &[f64]| {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let width = if high > low { high - low } else { 1.0 };
        let mut distinct: Vec<f64> = values.to_vec();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        (low, width, distinct.len())
    };
    rows.into_values()
        .map(|rows| {
            let at: Vec<f64> = rows
                .iter()
                .map(|&i| likelihood.observation(i).position.unwrap_or(0.0))
                .collect();
            let when: Vec<f64> = rows
                .iter()
                .map(|&i| likelihood.observation(i).cycles)
                .collect();
            let (a, b) = (range(&at), range(&when));
            let share =
                |v: f64, (low, width, _): (f64, f64, usize)| ((v - low) / width).clamp(0.0, 1.0);
            let places = at
                .iter()
                .zip(&when)
                .map(|(&s, &n)| (share(s, a), share(n, b)));
            Group {
                places: places.collect(),
                distinct: (a.2, b.2),
                rows,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evidence_bounds_the_fall_from_below() {
        let found = |drop| SmoothDiscrepancy {
            drop,
            by_evidence: false,
            terms: 8,
            values: Vec::new(),
        };
        assert_eq!(found(100.0).gaining(80.0).drop, 160.0);
        assert_eq!(found(100.0).gaining(30.0).drop, 100.0);
        assert!(found(100.0).gaining(80.0).by_evidence && !found(100.0).gaining(30.0).by_evidence);
        // what was hardly more than noise becomes real by it: the standard deviation is 4
        assert!(!found(19.0).is_real() && found(19.0).gaining(11.0).is_real());
    }
}
