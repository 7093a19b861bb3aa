//! What a discrepancy depends on: how much of it a function of one driver alone explains.
//!
//! ```text
//! m = g(row) Σ_j a_j φ_j(driver)      g: 1, or the model's own value, of which most missing effects are a share
//! share = (fall of χ² by the a_j − their number − what a factor on the model gains)/attainable fall of χ²
//! ```
//! The fall is that of the whitened residual, in which datums and the model's own error are no discrepancy, and the factor on the
//! model (the wear coefficient is free) is none of a driver's. The functions φ are common to all tests: a driver is what the
//! discrepancy follows wherever it takes the same value. φ of the position may differ between the members, as far as it explains
//! more than the members do.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::basis::{Functions, numbered, polynomials, waves};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::fitting::region::FlankRegions;
use crate::measure::{Observation, Quantity};

/// Most functions of the position, of the cycles, of the depth, and of a condition of the tests.
const ALONG: usize = 24;
const OVER_CYCLES: usize = 8;
const OVER_DEPTH: usize = 4;
const OVER_CONDITIONS: usize = 3;
/// Prior precision of the coefficients, in shares of what the data hold.
const RIDGE: f64 = 1e-6;
/// Share by which traces must explain more than test, member and cycles do to count as a driver of their own.
const CLEARLY: f64 = 0.1;
/// Share by which they must explain more than what grows evenly, and than any other driver, where each is a test, member and time.
const ALONE: f64 = 0.2;

/// Least fall of χ² of which shares are taken.
const LEAST_ATTAINABLE: f64 = 1.0;

/// How much of a discrepancy one driver explains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Driver {
    /// position, member, cycles, depth, torque, speed, misalignment, `bulk_temperature` or trace.
    pub name: String,
    /// Share of the discrepancy (of the χ² that it makes) that follows it alone.
    pub variance_share: f64,
}

impl Driver {
    /// Its name for people.
    pub(in crate::learn) fn in_words(&self) -> String {
        self.name.replace('_', " ")
    }
}

/// Shares of the discrepancy between measurements and `model` by driver, the largest first; `attainable`: the fall of χ² that
/// anything smooth could reach.
pub(in crate::learn) fn drivers(
    likelihood: &Likelihood<'_>,
    model: &[f64],
    attainable: f64,
) -> Vec<Driver> {
    let white = DVector::from_vec(likelihood.covariance.whiten(&likelihood.residual(model)));
    let seen = DriverAnalysis {
        likelihood,
        model,
        kinds: numbered((0..likelihood.len()).map(|i| likelihood.observation(i).quantity)),
        white,
        attainable: attainable.max(LEAST_ATTAINABLE),
    };
    let rows = likelihood.len();
    let all = vec![0; rows];
    let members: Vec<usize> = (0..rows)
        .map(|i| likelihood.observation(i).member as usize)
        .collect();
    let map = FlankRegions::new(likelihood.measured.study(), &likelihood.measured.data);
    let tests = &likelihood.measured.study().tests;
    let by = |of: &dyn Fn(&Observation) -> f64| -> Vec<f64> {
        (0..rows).map(|i| of(likelihood.observation(i))).collect()
    };
    let condition = |of: &dyn Fn(&crate::study::Operation) -> f64| {
        let values = by(&|o| of(&tests[o.test].conditions));
        // what is the same in all tests is no driver, and its share that of a constant
        if values.iter().all(|value| *value == values[0]) {
            return 0.0;
        }
        seen.share(&all, &polynomials(&seen.kinds, &values, OVER_CONDITIONS))
    };
    // of which every test must have one
    let at = |test: usize| tests[test].conditions.bulk_temperature_c;
    let temperature = if (0..rows).all(|i| at(likelihood.observation(i).test).is_some()) {
        condition(&|at| at.bulk_temperature_c.unwrap_or_default())
    } else {
        0.0
    };
    // a place, a depth or a member that no row differs by is the constant
    let differs = |values: &[f64]| values.iter().any(|value| *value != values[0]);
    let member = match members.iter().any(|member| *member != members[0]) {
        true => seen.share(&members, &constant(rows)),
        false => 0.0,
    };
    let place = by(&|o| map.path(o).or(o.position).unwrap_or(0.0));
    let waves = waves(&seen.kinds, &place, ALONG);
    let position = match differs(&place) {
        true => (seen.share(&all, &waves)).max(seen.share(&members, &waves) - member),
        false => 0.0,
    };
    let cycles = [f64::ln_1p, |n| n]
        .map(|scale| polynomials(&seen.kinds, &by(&|o| scale(o.cycles)), OVER_CYCLES))
        .map(|functions| seen.share(&all, &functions));
    let of_depths = |i: usize| likelihood.observation(i).quantity == Quantity::WearDepth;
    let depths: Vec<f64> = (0..rows)
        .map(|i| if of_depths(i) { model[i] } else { 0.0 })
        .collect();
    let depth = match differs(&depths) {
        true => seen.share(&all, &polynomials(&seen.kinds, &depths, OVER_DEPTH)),
        false => 0.0,
    };
    let others = [
        ("position", position),
        ("member", member),
        ("cycles", cycles[0].max(cycles[1])),
        ("depth", depth),
        ("torque", condition(&|at| at.torque_nmm.ln())),
        ("speed", condition(&|at| at.speed_rpm.ln())),
        ("misalignment", condition(&|at| at.misalignment_mm)),
        ("bulk_temperature", temperature),
    ];
    let most = others.iter().fold(0.0, |most, (_, share)| share.max(most));
    let traces = seen.share_of_traces(&by(&|o| o.cycles), most);
    let mut shares: Vec<(&str, f64)> = others.into_iter().chain([("trace", traces)]).collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    let driver = |(name, share): (&str, f64)| Driver {
        name: name.to_owned(),
        variance_share: share.clamp(0.0, 1.0),
    };
    shares.into_iter().map(driver).collect()
}

/// A discrepancy as the data see it.
struct DriverAnalysis<'a> {
    likelihood: &'a Likelihood<'a>,
    model: &'a [f64],
    /// Number of each row's quantity: functions are none of different quantities' in common.
    kinds: Vec<usize>,
    white: DVector<f64>,
    attainable: f64,
}

impl DriverAnalysis<'_> {
    /// Share that functions of one driver explain, one set of them for each group of rows.
    fn share(&self, groups: &[usize], functions: &Functions) -> f64 {
        let groups = numbered(groups.iter().zip(&self.kinds));
        let ones = vec![1.0; self.model.len()];
        let free = self.columns(&self.kinds, self.model, &constant(self.model.len()));
        let (at_first, before) = self.fall(&free);
        [ones.as_slice(), self.model]
            .map(|g| {
                let mut columns = free.clone();
                columns.extend(self.columns(&groups, g, functions));
                let (fall, count) = self.fall(&columns);
                (fall - at_first - (count - before) as f64) / self.attainable
            })
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// g φ_j at the rows of each group.
    fn columns(&self, groups: &[usize], g: &[f64], functions: &Functions) -> Vec<Vec<f64>> {
        let count = groups.iter().max().map_or(0, |last| last + 1);
        let at = |group: usize, of: &Vec<f64>| -> Vec<f64> {
            (0..g.len())
                .map(|i| {
                    if groups[i] == group {
                        g[i] * of[i]
                    } else {
                        0.0
                    }
                })
                .collect()
        };
        (0..count)
            .flat_map(|group| functions.iter().map(move |of| at(group, of)))
            .filter(|column| column.iter().any(|v| *v != 0.0))
            .collect()
    }

    /// Fall of χ² by columns, and how many of them the data tell apart.
    fn fall(&self, columns: &[Vec<f64>]) -> (f64, usize) {
        let rows = self.model.len();
        let matrix = DMatrix::from_fn(rows, columns.len(), |i, j| columns[j][i]);
        let mut white = self.likelihood.covariance.whiten_all(&matrix);
        for mut column in white.column_iter_mut() {
            let size = column.norm();
            if size > 0.0 {
                column /= size;
            }
        }
        let right = white.tr_mul(&self.white);
        let eigen = white.tr_mul(&white).symmetric_eigen();
        let (mut fall, mut count) = (0.0, 0);
        for (value, vector) in eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter())
        {
            if *value > RIDGE {
                fall += vector.dot(&right).powi(2) / value;
                count += 1;
            }
        }
        (fall, count)
    }

    /// Share that the traces explain, each by a constant, a factor and a slope: all of it where they explain clearly more than
    /// test, member and cycles, alone or together, do with no more of them; else only what they explain beyond those. One trace
    /// for each test, member and time so explains nothing, unless its slopes go up and down: more than slopes that change evenly with
    /// the cycles explain, and than any other driver does (`most`).
    fn share_of_traces(&self, cycles: &[f64], most: f64) -> f64 {
        let of = |i: usize| self.likelihood.observation(i);
        let rows = self.model.len();
        let traces: Vec<Option<usize>> = (0..rows).map(|i| of(i).trace).collect();
        let cells: Vec<[u64; 3]> = (0..rows)
            .map(of)
            .map(|o| [o.test as u64, o.member as u64, o.cycles.to_bits()])
            .collect();
        let places: Vec<f64> = (0..rows).map(|i| of(i).position.unwrap_or(0.0)).collect();
        let functions = polynomials(&self.kinds, &places, 2);
        let series = numbered(cells.iter().map(|[test, member, _]| (test, member)));
        let even = products(&functions, &polynomials(&self.kinds, cycles, 2));
        // So many functions explain much of a weak discrepancy's noise now and then: two standard deviations of that do not count.
        let functions_of_all = 3 * numbered(traces.iter())
            .iter()
            .max()
            .map_or(0, |last| last + 1);
        let noise = 2.0 * (2.0 * functions_of_all as f64).sqrt() / self.attainable;
        let alone = |share: f64| {
            let sure = share - noise - ALONE;
            sure > most && sure > self.share(&series, &even)
        };
        of_traces(&traces, &cells, &alone, &|groups| {
            self.share(groups, &functions)
        })
    }
}

/// What [`DriverAnalysis::share_of_traces`] says, with the share that groups of rows explain, and whether the traces' own is theirs alone.
fn of_traces(
    traces: &[Option<usize>],
    cells: &[[u64; 3]],
    alone: &dyn Fn(f64) -> bool,
    explained: &dyn Fn(&[usize]) -> f64,
) -> f64 {
    let count = |groups: &[usize]| groups.iter().copied().collect::<BTreeSet<_>>().len();
    let own = numbered(traces.iter());
    let most = count(&own);
    if most < 2 {
        return 0.0;
    }
    let share = explained(&own);
    if alone(share) {
        return share;
    }
    // Every set of test, member and cycles by the bits of its number; what is not in the set is made alike.
    let others = (1..8).filter_map(|set| {
        let of = |cell: &[u64; 3]| [0, 1, 2].map(|i| if set >> i & 1 == 1 { cell[i] } else { 0 });
        let groups = numbered(cells.iter().map(of));
        (count(&groups) <= most).then(|| explained(&groups))
    });
    let beyond = share - others.fold(0.0, f64::max);
    if beyond > CLEARLY {
        share
    } else {
        beyond.max(0.0)
    }
}

/// Every function of the one times every function of the other.
fn products(one: &Functions, other: &Functions) -> Functions {
    let times = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect();
    one.iter()
        .flat_map(|a| other.iter().map(move |b| times(a, b)))
        .collect()
}

fn constant(rows: usize) -> Functions {
    vec![vec![1.0; rows]]
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    /// Two tests, two members, four times, three places each, with one trace for each of them all.
    fn cells() -> Vec<[u64; 3]> {
        (0..48).map(|i| [i / 24, i / 12 % 2, i / 3 % 4]).collect()
    }

    /// Share of the variance of `m` between groups.
    fn between(m: &[f64], groups: &[usize]) -> f64 {
        let mut sums: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
        for (m, group) in m.iter().zip(groups) {
            let sum = sums.entry(*group).or_default();
            sum[0] += m;
            sum[1] += 1.0;
        }
        let total: f64 = m.iter().map(|m| m * m).sum();
        sums.values().map(|s| s[0] * s[0] / s[1]).sum::<f64>() / total
    }

    fn share(m: &[f64], traces: &[Option<usize>]) -> f64 {
        of_traces(traces, &cells(), &|_| false, &|groups| between(m, groups))
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
        assert_eq!(share(&m, &[None; 48]), 0.0);
    }
}
