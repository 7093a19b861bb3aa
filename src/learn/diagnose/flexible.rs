//! A flexible discrepancy: how much of a misfit anything smooth could explain, and on what that depends.
//!
//! ```text
//! m(test, member, quantity; s, n) = g Σ_p Σ_c a_pc cos(p π s) T_c(n)      one set of a per test, member and quantity
//! ```
//! s: position in shares of the measured range; T: Chebyshev's polynomials of the share of the test; g: 1, or the model's own value,
//! of which most missing effects are a smooth share. The discrepancy shown is that of the least Bayesian information criterion. What
//! anything smooth could explain is more than such few terms do: the largest fall of χ², beyond what as many terms gain on noise,
//! that is sure to two standard deviations.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::ground::{Ground, whiten};
use crate::learn::region::Map;

/// Terms along the position and over the cycles that are tried.
const TERMS: [(usize, usize); 7] = [(1, 1), (1, 3), (3, 1), (4, 2), (7, 3), (12, 3), (18, 4)];
/// Prior precision of the whitened coefficients, so that terms the data do not hold stay finite.
const RIDGE: f64 = 1e-6;
/// Bins of a continuous driver.
const BINS: usize = 10;
/// Share by which traces must explain more than test, member and cycles do to count as a driver of their own.
const CLEARLY: f64 = 0.1;

/// What a flexible discrepancy found.
#[derive(Debug, Clone)]
pub(super) struct Flexible {
    /// Fall of χ² beyond what its terms gain on noise.
    pub(super) drop: f64,
    /// Number of terms that this takes.
    pub(super) terms: usize,
    /// Its values, model minus what is missing: to be added to the model, per row.
    pub(super) values: Vec<f64>,
}

/// How much of a discrepancy one driver explains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Driver {
    /// position, member, cycles, depth, torque, speed, misalignment or trace.
    pub name: String,
    /// Share of the discrepancy's variance (in units of the noise) that depends on it alone.
    pub variance_share: f64,
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
}

impl Flexible {
    /// Of what a model leaves.
    pub(super) fn of(ground: &Ground<'_>, model: &[f64]) -> Self {
        let residual = ground.residual(model);
        let white = DVector::from_vec(ground.covariance.whiten(&residual));
        let groups = groups(ground);
        let ones = vec![1.0; ground.len()];
        let kinds: Vec<(&[f64], (usize, usize))> = ([ones.as_slice(), model].into_iter())
            .flat_map(|g| TERMS.map(|terms| (g, terms)))
            .collect();
        let tried: Vec<Flexible> = kinds
            .par_iter()
            .map(|&(g, terms)| {
                let mut values = vec![0.0; ground.len()];
                let (mut fallen, mut count) = (0.0, 0);
                for group in &groups {
                    let columns = group.columns(g, terms);
                    let seen = whiten(&ground.covariance, &columns);
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
                Flexible {
                    drop: fallen - count as f64,
                    terms: count,
                    values,
                }
            })
            .collect();
        let rows = (ground.len() as f64).ln();
        let criterion = |f: &Flexible| f.drop + (1.0 - rows) * f.terms as f64;
        let sure = |f: &Flexible| f.drop - 2.0 * f.spread();
        let shown = best(&tried, criterion).values.clone();
        let Flexible { drop, terms, .. } = *best(&tried, sure);
        Self {
            drop,
            terms,
            values: shown,
        }
    }

    /// Whether it is far more than noise: five standard deviations.
    pub(super) fn is_real(&self) -> bool {
        self.drop > 5.0 * self.spread()
    }

    /// Standard deviation of `drop` on noise alone.
    pub(super) fn spread(&self) -> f64 {
        (2.0 * self.terms as f64).sqrt()
    }

    /// The discrepancy at every row of the ground.
    pub(super) fn map(&self, ground: &Ground<'_>) -> Vec<MapPoint> {
        let of = |(i, value): (usize, &f64)| {
            let o = ground.observation(i);
            MapPoint {
                test: ground.measured.data.tests[o.test].clone(),
                member: o.member.name(),
                quantity: o.quantity.name(),
                cycles: o.cycles,
                position: o.position,
                value: value / o.sigma,
            }
        };
        self.values.iter().enumerate().map(of).collect()
    }

    /// Shares of the variance by driver, the largest first.
    ///
    /// ```text
    /// share = [Σ_bins (Σ m f/σ²)²/Σ f²/σ²]/Σ m²/σ²      f: the model's value, a factor on it; or 1, a constant added to it
    /// ```
    /// The larger of both; `m` is first freed of what a factor per test explains, since k is free.
    pub(super) fn drivers(&self, ground: &Ground<'_>, model: &[f64]) -> Vec<Driver> {
        let map = Map::new(ground.measured.study(), &ground.measured.data);
        let m: Vec<f64> = self.values.clone();
        let weight: Vec<f64> = (0..ground.len())
            .map(|i| ground.observation(i).sigma.powi(-2))
            .collect();
        let total: f64 = m.iter().zip(&weight).map(|(m, w)| m * m * w).sum();
        if total <= 0.0 {
            return Vec::new();
        }
        let tests = &ground.measured.study().tests;
        let conditions = |i: usize| &tests[ground.observation(i).test].conditions;
        let by = |of: &dyn Fn(usize) -> Option<f64>| -> Vec<Option<f64>> {
            (0..ground.len()).map(of).collect()
        };
        let place = |i: usize| {
            let o = ground.observation(i);
            map.path(o).or(o.position)
        };
        let all: [(&str, Vec<Option<f64>>); 7] = [
            ("position", by(&place)),
            (
                "member",
                by(&|i| Some(ground.observation(i).member as u8 as f64)),
            ),
            ("cycles", by(&|i| Some(ground.observation(i).cycles.ln()))),
            ("depth", by(&|i| Some(model[i]))),
            ("torque", by(&|i| Some(conditions(i).torque_nmm))),
            ("speed", by(&|i| Some(conditions(i).speed_rpm))),
            ("misalignment", by(&|i| Some(conditions(i).misalignment_mm))),
        ];
        let explained = |bins: &[usize]| {
            let share = |f: &dyn Fn(usize) -> f64| explained(&m, &weight, bins, f) / total;
            share(&|i| model[i]).max(share(&|_| 1.0)).min(1.0)
        };
        let mut drivers: Vec<Driver> = all
            .into_iter()
            .map(|(name, of)| Driver {
                name: name.to_owned(),
                variance_share: explained(&binned(&of)),
            })
            .collect();
        let cells: Vec<[u64; 3]> = (0..ground.len())
            .map(|i| ground.observation(i))
            .map(|o| [o.test as u64, o.member as u64, o.cycles.to_bits()])
            .collect();
        let traces: Vec<Option<usize>> = (0..ground.len())
            .map(|i| ground.observation(i).trace)
            .collect();
        drivers.push(Driver {
            name: "trace".to_owned(),
            variance_share: of_trace(&traces, &cells, &explained),
        });
        drivers.sort_by(|a, b| b.variance_share.total_cmp(&a.variance_share));
        drivers
    }
}

fn best(tried: &[Flexible], value: impl Fn(&Flexible) -> f64) -> &Flexible {
    (tried.iter().max_by(|a, b| value(a).total_cmp(&value(b))))
        .expect("some numbers of terms are tried")
}

/// Σ over bins of (Σ m f/σ²)²/Σ f²/σ².
fn explained(m: &[f64], weight: &[f64], bins: &[usize], f: &dyn Fn(usize) -> f64) -> f64 {
    let mut sums: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for (i, bin) in bins.iter().enumerate() {
        let sum = sums.entry(*bin).or_default();
        sum[0] += m[i] * f(i) * weight[i];
        sum[1] += f(i) * f(i) * weight[i];
    }
    let seen = sums.values().filter(|s| s[1] > 0.0);
    seen.map(|s| s[0] * s[0] / s[1]).sum()
}

/// Share that the traces explain: all of it where they explain clearly more than test, member and cycles, alone or together, do
/// with no more bins; else only what they explain beyond those. One trace for each test, member and time so explains nothing.
fn of_trace(
    traces: &[Option<usize>],
    cells: &[[u64; 3]],
    explained: &dyn Fn(&[usize]) -> f64,
) -> f64 {
    let bins: Vec<usize> = traces.iter().map(|t| t.map_or(0, |t| 1 + t)).collect();
    let count = |bins: &[usize]| {
        let distinct: std::collections::BTreeSet<usize> = bins.iter().copied().collect();
        distinct.len()
    };
    let (own, most) = (explained(&bins), count(&bins));
    if most < 2 {
        return 0.0;
    }
    // Every set of test, member and cycles by the bits of its number; what is not in the set is made alike.
    let others = (1..8).filter_map(|set| {
        let mut numbers: BTreeMap<[u64; 3], usize> = BTreeMap::new();
        let bins: Vec<usize> = cells
            .iter()
            .map(|cell| {
                let key = [0, 1, 2].map(|i| if set >> i & 1 == 1 { cell[i] } else { 0 });
                let next = numbers.len();
                *numbers.entry(key).or_insert(next)
            })
            .collect();
        (numbers.len() <= most).then(|| explained(&bins))
    });
    let beyond = own - others.fold(0.0, f64::max);
    if beyond > CLEARLY {
        own
    } else {
        beyond.max(0.0)
    }
}

/// Numbers of bins of about equal size; few different values are bins of their own.
fn binned(values: &[Option<f64>]) -> Vec<usize> {
    let mut sorted: Vec<f64> = values.iter().flatten().copied().collect();
    sorted.sort_by(f64::total_cmp);
    let mut distinct = sorted.clone();
    distinct.dedup();
    let edges = if distinct.len() <= BINS {
        distinct
    } else {
        (0..BINS).map(|i| sorted[i * sorted.len() / BINS]).collect()
    };
    values
        .iter()
        .map(|v| v.map_or(0, |v| 1 + edges.iter().filter(|edge| **edge <= v).count()))
        .collect()
}

/// Rows of one test, member and quantity.
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
                    let chebyshev = (c as f64 * (2.0 * n - 1.0).acos()).cos();
                    columns[(row, p * over + c)] = g[row] * (p as f64 * PI * s).cos() * chebyshev;
                }
            }
        }
        columns
    }
}

fn groups(ground: &Ground<'_>) -> Vec<Group> {
    let mut rows = BTreeMap::new();
    for i in 0..ground.len() {
        let o = ground.observation(i);
        let of: &mut Vec<usize> = rows.entry((o.test, o.member, o.quantity)).or_default();
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
                .map(|&i| ground.observation(i).position.unwrap_or(0.0))
                .collect();
            let when: Vec<f64> = rows.iter().map(|&i| ground.observation(i).cycles).collect();
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

    /// Two tests, two members, four times, three places each, with one trace for each of them all.
    fn cells() -> Vec<[u64; 3]> {
        (0..48).map(|i| [i / 24, i / 12 % 2, i / 3 % 4]).collect()
    }

    fn share(m: &[f64], traces: &[Option<usize>]) -> f64 {
        let weight = vec![1.0; m.len()];
        let total: f64 = m.iter().map(|m| m * m).sum();
        of_trace(traces, &cells(), &|bins| {
            explained(m, &weight, bins, &|_| 1.0) / total
        })
    }

    #[test]
    fn a_trace_for_each_test_member_and_time_explains_nothing_of_its_own() {
        let traces: Vec<Option<usize>> = (0..48).map(|i| Some(i / 3)).collect();
        let m: Vec<f64> = (0..48).map(|i| ((i / 3 * 7) % 16) as f64).collect();
        // every trace has another constant, but so has every cell
        assert!(share(&m, &traces) < 1e-12);
        // the same with a trace for each test and member
        let traces: Vec<Option<usize>> = (0..48).map(|i| Some(i / 12)).collect();
        let m: Vec<f64> = (0..48).map(|i| (1 + i / 12) as f64).collect();
        assert!(share(&m, &traces) < 1e-12);
    }

    #[test]
    fn traces_that_cut_across_tests_and_times_are_a_driver() {
        // two instruments that take turns, the other way round in the second test: no test, member or time explains them
        let label = |c: &[u64; 3]| (c[0] + c[2]) % 2;
        let traces: Vec<Option<usize>> = cells().iter().map(|c| Some(label(c) as usize)).collect();
        let m: Vec<f64> = cells()
            .iter()
            .map(|c| 2.0 * label(c) as f64 - 1.0)
            .collect();
        assert!((share(&m, &traces) - 1.0).abs() < 1e-12);
        assert_eq!(share(&m, &vec![None; 48]), 0.0);
    }
}
