//! By what factor measured wear exceeds the computed one, checkpoint by checkpoint: a datum hides a wrong level, not a wrong size.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::residual_statistics::{FittedRow, role_name};
use crate::measure::{Quantity, Subject};
use crate::study::Study;

/// Measured over computed wear of one member at one checkpoint.
///
/// ```text
/// least Σ ((y − d_trace − s f)/σ)² over s and each trace's d:
/// s = Σ (f − f̄)(y − ȳ)/σ² / Σ (f − f̄)²/σ²,   sd = (Σ (f − f̄)²/σ²)^(−1/2)       means weighted by 1/σ² within each trace
/// ```
/// Rows without a trace have no d.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ratio {
    /// Id of the test.
    pub test: String,
    /// `fit` or `holdout`.
    pub role: String,
    /// `pinion` or `gear`.
    pub member: String,
    /// When, pinion revolutions.
    pub cycles: f64,
    /// s: measured over computed depth.
    pub measured_over_computed: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Number of observations.
    pub points: usize,
    /// χ² per point of the comparison.
    pub chi2_per_point: f64,
    /// χ² per point with s and d of these points alone.
    pub chi2_scaled: f64,
}

impl Ratio {
    /// The share of what exceeds the noise that the factor takes away.
    pub(in crate::learn) fn explains(&self) -> f64 {
        (self.chi2_per_point - self.chi2_scaled) / (self.chi2_per_point - 1.0).max(1e-9)
    }

    /// Whether it differs from 1 by more than five standard deviations and explains half of the misfit.
    pub(in crate::learn) fn matters(&self) -> bool {
        (self.measured_over_computed - 1.0).abs() > 5.0 * self.sigma && self.explains() > 0.5
    }
}

/// What rows of one ratio share: test, member, cycles.
type Key = (usize, Subject, u64);

/// Of every test, member and checkpoint with wear depths, where the computed wear varies along the flank.
pub(in crate::learn) fn ratios(
    study: &Study,
    rows: &[FittedRow<'_>],
) -> BTreeMap<(usize, Subject), Vec<Ratio>> {
    let mut groups: BTreeMap<Key, Vec<FittedRow<'_>>> = BTreeMap::new();
    for &(o, row) in rows
        .iter()
        .filter(|(o, _)| o.quantity == Quantity::WearDepth)
    {
        let key = (o.test, o.member, o.cycles.to_bits());
        groups.entry(key).or_default().push((o, row));
    }
    let mut ratios: BTreeMap<(usize, Subject), Vec<Ratio>> = BTreeMap::new();
    for ((test, member, _), rows) in groups {
        let Some((s, sigma, chi2_scaled)) = scaled(&rows) else {
            continue;
        };
        let chi2: f64 = rows.iter().map(|(_, row)| row.standardised.powi(2)).sum();
        ratios.entry((test, member)).or_default().push(Ratio {
            test: study.tests[test].id.clone(),
            role: role_name(study.tests[test].role).to_owned(),
            member: member.name().to_owned(),
            cycles: rows[0].0.cycles,
            measured_over_computed: s,
            sigma,
            points: rows.len(),
            chi2_per_point: chi2 / rows.len() as f64,
            chi2_scaled,
        });
    }
    ratios
}

/// s, its standard deviation and χ² per point with it.
fn scaled(rows: &[FittedRow<'_>]) -> Option<(f64, f64, f64)> {
    let mut means: BTreeMap<usize, [f64; 3]> = BTreeMap::new();
    for (o, row) in rows {
        let Some(trace) = o.trace else { continue };
        let weight = o.sigma.powi(-2);
        let sums = means.entry(trace).or_default();
        for (sum, x) in sums.iter_mut().zip([1.0, row.model, o.value]) {
            *sum += weight * x;
        }
    }
    let centred: Vec<(f64, f64)> = rows
        .iter()
        .map(|(o, row)| {
            let [w, f, y] = o.trace.map_or([1.0, 0.0, 0.0], |trace| means[&trace]);
            ((row.model - f / w) / o.sigma, (o.value - y / w) / o.sigma)
        })
        .collect();
    let square: f64 = centred.iter().map(|(f, _)| f * f).sum();
    let product: f64 = centred.iter().map(|(f, y)| f * y).sum();
    if square <= 0.0 {
        return None;
    }
    let s = product / square;
    let rest: f64 = centred.iter().map(|(f, y)| (y - s * f).powi(2)).sum();
    Some((s, square.sqrt().recip(), rest / rows.len() as f64))
}
