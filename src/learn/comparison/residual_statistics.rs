//! Figures of a set of residuals: χ² per point, bias, root mean square; and the cells into which a comparison is cut.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::gear::Region;
use crate::learn::fitting::fit::is_within_noise;
use crate::learn::fitting::fitted::{Fit, RowFit};
use crate::learn::fitting::measured::Misfit;
use crate::learn::fitting::region::FlankRegions;
use crate::measure::{Dataset, Observation, Quantity, Subject};
use crate::study::{Role, Study};

/// χ² per point of some rows.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Share {
    /// Number of observations.
    pub points: usize,
    /// Mean of ((model − measured)/sigma)², the most probable datums subtracted; None without points.
    pub chi2_per_point: Option<f64>,
    /// Root mean square of model − measured over wear depths, µm; None without any.
    pub rms_um: Option<f64>,
}

impl Share {
    /// Whether χ² is no more than noise makes.
    pub fn is_within_noise(&self) -> bool {
        let within = |chi2: f64| is_within_noise(chi2 * self.points as f64, self.points);
        self.chi2_per_point.is_some_and(within)
    }

    /// Whether χ² is far more than noise makes: a fit that leaves so much supports no interval.
    pub fn is_far(&self) -> bool {
        let points = self.points as f64;
        self.chi2_per_point.is_some_and(|chi2| {
            let square = chi2 * points;
            Misfit { square, points }.is_far()
        })
    }
}

/// Residuals of one test, member, region and cycle interval.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Id of the test.
    pub test: String,
    /// `fit` or `holdout`.
    pub role: String,
    /// `pinion`, `gear` or `pair`.
    pub member: String,
    /// What was measured.
    pub quantity: String,
    /// Region of the path of contact; `all` for quantities that do not stand on a flank.
    pub region: String,
    /// From the checkpoint before to the last one counted here, pinion revolutions.
    pub cycles: [f64; 2],
    /// Number of observations.
    pub points: usize,
    /// Mean of the squared standardised residuals.
    pub chi2_per_point: f64,
    /// Mean of model − measured, in `unit`.
    pub bias: f64,
    /// Its standard deviation from the noise alone.
    pub bias_sigma: f64,
    /// Root mean square of model − measured, in `unit`.
    pub rms: f64,
    /// Unit of the three.
    pub unit: String,
    /// `bias` of wear depths, µm.
    pub bias_um: Option<f64>,
    /// `rms` of wear depths, µm.
    pub rms_um: Option<f64>,
}

/// Residuals of all rows that have something in common.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Group {
    /// What they have in common: a test, a member, a region, a part of the test's life.
    pub name: String,
    /// Number of observations.
    pub points: usize,
    /// Mean of the squared standardised residuals.
    pub chi2_per_point: f64,
    /// Mean of model − measured over wear depths, µm; None without any.
    pub bias_um: Option<f64>,
    /// Root mean square of model − measured over wear depths, µm; None without any.
    pub rms_um: Option<f64>,
}

/// One row with its fit.
pub(in crate::learn) type FittedRow<'a> = (&'a Observation, &'a RowFit);
/// What rows of one cell share: test, member, quantity, region, cycle interval.
pub(in crate::learn) type CellKey = (usize, Subject, Quantity, Option<Region>, usize);

/// Every observation with its fit, in order.
pub(in crate::learn) fn fitted<'a>(data: &'a Dataset, fit: &'a Fit) -> Vec<FittedRow<'a>> {
    let rows = data.observations.iter().zip(&fit.rows);
    rows.filter(|(o, _)| fit.judges(o.test)).collect()
}

/// The word for a role.
pub(in crate::learn) fn role_name(role: Role) -> &'static str {
    match role {
        Role::Fit => "fit",
        Role::Holdout => "holdout",
    }
}

impl Share {
    pub(in crate::learn) fn of<'a>(rows: impl Iterator<Item = FittedRow<'a>>) -> Self {
        let rows: Vec<FittedRow<'_>> = rows.collect();
        Self {
            points: rows.len(),
            chi2_per_point: chi2(&rows),
            rms_um: wear(&rows, |r| r * r).map(f64::sqrt),
        }
    }
}

impl Group {
    /// Groups of rows with equal keys, in the keys' order.
    pub(in crate::learn) fn by<'a, K: Ord>(
        rows: &[FittedRow<'a>],
        key: impl Fn(&'a Observation) -> Option<K>,
        name: impl Fn(&K) -> String,
    ) -> Vec<Self> {
        let mut groups: BTreeMap<K, Vec<FittedRow<'a>>> = BTreeMap::new();
        for &(o, row) in rows {
            if let Some(key) = key(o) {
                groups.entry(key).or_default().push((o, row));
            }
        }
        let group = |(key, rows): (K, Vec<FittedRow<'a>>)| Self {
            name: name(&key),
            points: rows.len(),
            chi2_per_point: chi2(&rows).unwrap_or_default(),
            bias_um: wear(&rows, |r| r),
            rms_um: wear(&rows, |r| r * r).map(f64::sqrt),
        };
        groups.into_iter().map(group).collect()
    }
}

/// All cells by key.
pub(in crate::learn) fn cells(
    study: &Study,
    rows: &[FittedRow<'_>],
    map: &FlankRegions,
) -> BTreeMap<CellKey, Cell> {
    let mut parts: BTreeMap<CellKey, Vec<FittedRow<'_>>> = BTreeMap::new();
    for &(o, row) in rows {
        let key = (o.test, o.member, o.quantity, map.region(o), map.interval(o));
        parts.entry(key).or_default().push((o, row));
    }
    let cell = |key: CellKey, rows: &[FittedRow<'_>]| {
        let (test, member, quantity, region, interval) = key;
        let n = rows.len() as f64;
        let bias = rows.iter().map(|r| r.1.residual).sum::<f64>() / n;
        let rms = (rows.iter().map(|r| r.1.residual.powi(2)).sum::<f64>() / n).sqrt();
        let noise: f64 = rows.iter().map(|r| r.0.sigma.powi(2)).sum();
        let is_wear = quantity == Quantity::WearDepth;
        Cell {
            test: study.tests[test].id.clone(),
            role: role_name(study.tests[test].role).to_owned(),
            member: member.name().to_owned(),
            quantity: quantity.name().to_owned(),
            region: region.map_or("all", Region::name).to_owned(),
            cycles: map.cycles(test, interval),
            points: rows.len(),
            chi2_per_point: chi2(rows).unwrap_or_default(),
            bias,
            bias_sigma: noise.sqrt() / n,
            rms,
            unit: quantity.unit().to_owned(),
            bias_um: is_wear.then_some(bias),
            rms_um: is_wear.then_some(rms),
        }
    };
    parts
        .iter()
        .map(|(key, rows)| (*key, cell(*key, rows)))
        .collect()
}

/// Mean of the squared standardised residuals.
pub(in crate::learn) fn chi2(rows: &[FittedRow<'_>]) -> Option<f64> {
    let sum: f64 = rows.iter().map(|(_, row)| row.standardised.powi(2)).sum();
    (!rows.is_empty()).then(|| sum / rows.len() as f64)
}

/// Mean of a function of the residuals of wear depths.
pub(in crate::learn) fn wear(rows: &[FittedRow<'_>], f: impl Fn(f64) -> f64) -> Option<f64> {
    let depths = rows
        .iter()
        .filter(|(o, _)| o.quantity == Quantity::WearDepth);
    let values: Vec<f64> = depths.map(|(_, row)| f(row.residual)).collect();
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}
