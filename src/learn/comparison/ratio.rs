//! By what factor measured wear exceeds the computed one, checkpoint by checkpoint: a datum hides a wrong level, not a wrong size.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::residual_statistics::{FittedRow, role_name};
use crate::measure::{Quantity, Subject};
use crate::study::Study;

/// Measured over computed wear of one member at one checkpoint.
///
/// ```text
/// least Σ ((y − d_trace − s f)/σ)² + Σ (d_trace/D)² over s and each trace's d:
/// s = <f, y>/<f, f>,   sd = <f, f>^(−1/2),   <a, b> = Σ a b/σ² − Σ_traces (Σ a/σ²)(Σ b/σ²)/(Σ 1/σ² + 1/D²)
/// ```
/// D is the datum that the study states; rows without a trace have no d.
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
        let Some((s, sigma, chi2_scaled)) = scaled(&rows, study.noise.datum_um) else {
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

/// s, its standard deviation and χ² per point with it, where a trace's datum has the standard deviation `datum`, µm.
fn scaled(rows: &[FittedRow<'_>], datum: f64) -> Option<(f64, f64, f64)> {
    // Σ 1/σ² + 1/D², Σ f/σ², Σ y/σ²
    let mut traces: BTreeMap<usize, [f64; 3]> = BTreeMap::new();
    let (mut ff, mut fy) = (0.0, 0.0);
    for (o, row) in rows {
        let weight = o.sigma.powi(-2);
        ff += weight * row.model * row.model;
        fy += weight * row.model * o.value;
        let Some(trace) = o.trace else { continue };
        let sums = traces.entry(trace).or_insert([datum.powi(-2), 0.0, 0.0]);
        for (sum, x) in sums.iter_mut().zip([1.0, row.model, o.value]) {
            *sum += weight * x;
        }
    }
    for [w, f, y] in traces.values() {
        ff -= f * f / w;
        fy -= f * y / w;
    }
    if ff <= 0.0 {
        return None;
    }
    let s = fy / ff;
    let left = |(o, row): &FittedRow<'_>| {
        let sums = o.trace.map(|trace| traces[&trace]);
        let own = sums.map_or(0.0, |[w, f, y]| (y - s * f) / w);
        ((o.value - own - s * row.model) / o.sigma).powi(2)
    };
    let rest: f64 = rows.iter().map(left).sum();
    Some((s, ff.sqrt().recip(), rest / rows.len() as f64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    #[test]
    fn a_datum_takes_as_much_as_its_prior_allows() {
        let study = include_str!("../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        // y = 2 f + 1 at f 1 and 3, σ 1
        let text = "test,member,cycles,quantity,position,value,sigma,trace\n\
                    A,pinion,200000,wear_depth,27.0,3,1,a\nA,pinion,200000,wear_depth,27.2,7,1,a\n";
        let data = Dataset::parse(text, "m.csv", &study.known()).unwrap();
        let fits = super::super::sanity::fits_of(&[1.0, 3.0]);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        let s = |datum: f64| scaled(&rows, datum).unwrap().0;
        assert!((s(1e6) - 2.0).abs() < 1e-9);
        // none: Σ f y/Σ f²
        assert!((s(0.0) - 2.4).abs() < 1e-12);
        // D = 2: (24 − 4·10/2.25)/(10 − 16/2.25)
        assert!((s(2.0) - 28.0 / 13.0).abs() < 1e-12);
        let (_, sigma, left) = scaled(&rows, 1e6).unwrap();
        assert!((sigma - 0.5_f64.sqrt()).abs() < 1e-9 && left < 1e-9);
    }
}
