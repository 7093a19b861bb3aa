//! How wrong a fitted model is, and where: what `comparison.json` is written from.

use serde::{Deserialize, Serialize};

use super::far_datums::far_datums;
use super::fit_warnings::{correlation, fit_warnings};
use super::lone_row::lone_rows;
use super::misfit_location::sentence;
use super::misfit_ranking::{fails, worst_first};
use super::ratio::{Ratio, ratios};
use super::residual_statistics::{Cell, FittedRow, Group, Share, cells, fitted, role_name, wear};
use super::sanity::sanity;
use super::uncertainty::{Validation, validate};
use super::unlike_tests::differing_tests;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::quantity_misfit::misfit_of_one_quantity;
use crate::learn::fitting::region::FlankRegions;
use crate::learn::hypothesis::parameters::Estimate;
use crate::measure::{Dataset, Quantity};
use crate::study::{Role, Study};

/// Standardised residuals beyond which a row is listed: one in 16 000 by chance.
const OUTLIER: f64 = 4.0;

/// A fitted model against its measurements. Depths in µm; signs are model minus measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Number of observations.
    pub points: usize,
    /// Mean squared standardised residual of all of them; 1 is the noise floor.
    pub chi2_per_point: f64,
    /// Root mean square of model minus measured over wear depths; None without any.
    pub rms_um: Option<f64>,
    /// Root mean square of their sigmas.
    pub noise_rms_um: Option<f64>,
    /// Of the fit tests.
    pub fit: Share,
    /// Of the held-out tests.
    pub holdout: Share,
    /// What was free.
    pub parameters: Vec<ParameterRecord>,
    /// Correlation of `parameters` with each other, a row each; of its logarithm where a parameter's prior is log-normal.
    #[serde(default)]
    pub correlation: Vec<Vec<f64>>,
    /// Every cell of test, member, quantity, region and cycle interval, the worst first.
    #[serde(rename = "where")]
    pub places: Vec<Cell>,
    /// Where the model fails worst, in plain words.
    pub worst: String,
    /// What looks wrong about the measurements themselves, signs and units first; until it is put right the rest means little.
    #[serde(default)]
    pub sanity: Vec<String>,
    /// What is doubtful about the measurements or the fit.
    pub warnings: Vec<String>,
    /// Each test with its own wear coefficient.
    pub tests: Vec<TestRecord>,
    /// Scatter of the wear coefficient between tests, relative, and where 68 % of its posterior lie.
    pub coefficient_scatter: f64,
    /// See `coefficient_scatter`.
    pub coefficient_scatter_interval: [f64; 2],
    /// By member.
    pub by_member: Vec<Group>,
    /// By region of the path of contact.
    pub by_region: Vec<Group>,
    /// By share of the test's length.
    pub by_life: Vec<Group>,
    /// By quantity.
    pub by_quantity: Vec<Group>,
    /// Measured over computed wear of each test, member and checkpoint.
    pub ratios: Vec<Ratio>,
    /// Comparison error against validation uncertainty, in the way of ASME V&V 20.
    pub validation: Vec<Validation>,
    /// Rows further off than four of their sigmas, the furthest first.
    pub outliers: Vec<Outlier>,
    /// Where the prior of the wear coefficient is from: a pair of materials; empty: the program's own, that of mild wear of metals.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub coefficient_prior: String,
    /// k of pinion and gear, mm²/N, where the study states coefficients of their own: `wear.coefficient` times what each is of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub member_coefficients: Option<[f64; 2]>,
    /// Whether the fit converged.
    pub converged: bool,
    /// Logarithm of the marginal likelihood of the fit tests.
    pub log_evidence: f64,
    /// Predictions of single tests that the fit took.
    pub evaluations: usize,
}

/// A fitted parameter as result files have it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParameterRecord {
    /// `wear.coefficient` or `effect.parameter`.
    pub name: String,
    /// Most probable value.
    pub value: f64,
    /// One standard deviation.
    pub sigma: f64,
    /// Whether it lies on a bound.
    pub at_bound: bool,
    /// 95 % interval; None where the fit supports none: it did not converge, was given up or ended far from the measurements, or its value lies outside.
    pub interval_95: Option<[f64; 2]>,
    /// Unit.
    pub unit: String,
}

/// One test as fitted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TestRecord {
    /// Its id.
    pub test: String,
    /// `fit` or `holdout`.
    pub role: String,
    /// Its own most probable wear coefficient, mm²/N.
    pub coefficient: f64,
    /// Standard deviation of that, mm²/N.
    pub coefficient_sigma: f64,
    /// Number of observations.
    pub points: usize,
    /// Mean squared standardised residual.
    pub chi2_per_point: f64,
    /// Mean of model minus measured over wear depths, µm.
    pub bias_um: Option<f64>,
    /// Root mean square of the same, µm.
    pub rms_um: Option<f64>,
}

/// A row far off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outlier {
    /// File and line.
    pub place: String,
    /// Id of the test.
    pub test: String,
    /// `pinion`, `gear` or `pair`.
    pub member: String,
    /// What was measured.
    pub quantity: String,
    /// When, pinion revolutions.
    pub cycles: f64,
    /// Where, in the file's unit.
    pub position: Option<f64>,
    /// (model − measured)/sigma, the datum subtracted.
    pub standardised: f64,
}

/// The pair of materials from which a study has its prior of k, in words.
fn coefficient_prior(study: &Study) -> String {
    study.wear.material.map_or(String::new(), |pair| {
        format!(
            "{} ({:.3e} mm2/N, factor {}): {} against {}",
            pair.name, pair.coefficient, pair.spread, pair.worn, pair.against
        )
    })
}

impl Comparison {
    /// Whether the model misses the measurements of some place by more than their noise: [`Comparison::worst`] says of which most.
    pub fn fails_somewhere(&self) -> bool {
        self.places.iter().any(fails)
    }

    /// Of a fit to a study's measurements.
    pub fn new(study: &Study, data: &Dataset, fit: &Fit) -> Self {
        let map = FlankRegions::new(study, data);
        let rows = fitted(data, fit);
        let roles: Vec<Role> = study.tests.iter().map(|test| test.role).collect();
        let with = |role: Role| {
            rows.iter()
                .copied()
                .filter(move |(o, _)| study.tests[o.test].role == role)
        };
        let all = Share::of(rows.iter().copied());
        let cells = cells(study, &rows, &map);
        let ratios = ratios(study, &rows);
        let worst = sentence(
            &cells,
            &ratios,
            &map,
            &lone_rows(data, &rows, &map),
            all.chi2_per_point,
        );
        let places = worst_first(cells);
        let life = |o: &crate::measure::Observation| {
            let share = o.cycles / study.tests[o.test].conditions.cycles;
            Some(((4.0 * share).ceil() as usize).clamp(1, 4))
        };
        let sanity = sanity(study, data, fit);
        // what is wrong as a whole shows most somewhere
        let carried = match sanity.is_empty() {
            true => misfit_of_one_quantity(study, data, fit),
            false => None,
        };
        Self {
            points: all.points,
            chi2_per_point: all.chi2_per_point.unwrap_or_default(),
            rms_um: all.rms_um,
            noise_rms_um: noise_rms(&rows),
            fit: Share::of(with(Role::Fit)),
            holdout: Share::of(with(Role::Holdout)),
            parameters: (fit.parameters.iter())
                .map(|estimate| ParameterRecord::new(estimate, fit.converged))
                .collect(),
            places,
            worst,
            correlation: correlation(fit),
            sanity,
            warnings: (carried.into_iter())
                .chain(differing_tests(study, data, fit))
                .chain(far_datums(study, data, fit))
                .chain(fit_warnings(data, fit))
                .collect(),
            tests: test_records(study, fit, &rows),
            coefficient_prior: coefficient_prior(study),
            member_coefficients: (study.wear.members != [1.0, 1.0])
                .then(|| study.wear.members.map(|of| of * fit.coefficient)),
            coefficient_scatter: fit.scatter,
            coefficient_scatter_interval: fit.scatter_interval,
            by_member: Group::by(&rows, |o| Some(o.member), |m| m.name().to_owned()),
            by_region: Group::by(&rows, |o| map.region(o), |r| r.name().to_owned()),
            by_life: Group::by(&rows, life, |q| {
                format!("{} to {} % of the test", 25 * (q - 1), 25 * q)
            }),
            by_quantity: Group::by(&rows, |o| Some(o.quantity), |q| q.name().to_owned()),
            ratios: ratios.into_values().flatten().collect(),
            validation: validate(data, &roles, fit),
            outliers: outliers(data, &rows),
            converged: fit.converged,
            log_evidence: fit.log_evidence,
            evaluations: fit.evaluations,
        }
    }
}

impl ParameterRecord {
    /// From the estimate of a fit that converged or did not.
    pub fn new(estimate: &Estimate, converged: bool) -> Self {
        let [low, high] = estimate.interval;
        let supported = converged && low <= estimate.value && estimate.value <= high;
        Self {
            name: estimate.name.clone(),
            value: estimate.value,
            sigma: estimate.sigma,
            at_bound: estimate.at_bound,
            interval_95: supported.then_some(estimate.interval),
            unit: estimate.unit.clone(),
        }
    }
}

fn noise_rms(rows: &[FittedRow<'_>]) -> Option<f64> {
    let depths: Vec<f64> = rows
        .iter()
        .filter(|(o, _)| o.quantity == Quantity::WearDepth)
        .map(|(o, _)| o.sigma.powi(2))
        .collect();
    (!depths.is_empty()).then(|| (depths.iter().sum::<f64>() / depths.len() as f64).sqrt())
}

fn test_records(study: &Study, fit: &Fit, rows: &[FittedRow<'_>]) -> Vec<TestRecord> {
    let record = |fitted: &crate::learn::fitting::fitted::TestFit| {
        let own: Vec<FittedRow<'_>> = rows
            .iter()
            .copied()
            .filter(|(o, _)| o.test == fitted.test)
            .collect();
        let share = Share::of(own.iter().copied());
        TestRecord {
            test: study.tests[fitted.test].id.clone(),
            role: role_name(fitted.role).to_owned(),
            coefficient: fitted.coefficient,
            coefficient_sigma: fitted.coefficient * fitted.sigma,
            points: share.points,
            chi2_per_point: share.chi2_per_point.unwrap_or_default(),
            bias_um: wear(&own, |r| r),
            rms_um: share.rms_um,
        }
    };
    fit.tests.iter().map(record).collect()
}

fn outliers(data: &Dataset, rows: &[FittedRow<'_>]) -> Vec<Outlier> {
    let far = rows
        .iter()
        .filter(|(_, row)| row.standardised.abs() > OUTLIER);
    let mut outliers: Vec<Outlier> = far
        .map(|(o, row)| Outlier {
            place: data.place(o),
            test: data.tests[o.test].clone(),
            member: o.member.name().to_owned(),
            quantity: o.quantity.name().to_owned(),
            cycles: o.cycles,
            position: o.position,
            standardised: row.standardised,
        })
        .collect();
    outliers.sort_by(|a, b| b.standardised.abs().total_cmp(&a.standardised.abs()));
    outliers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_interval_stands_that_the_fit_does_not_support() {
        let estimate = Estimate {
            name: "film_thickness.lambda0".to_owned(),
            unit: "-".to_owned(),
            value: 0.446,
            sigma: 0.01,
            interval: [0.020, 0.077],
            at_bound: false,
            logarithmic: true,
        };
        assert_eq!(ParameterRecord::new(&estimate, true).interval_95, None);
        let within = Estimate {
            value: 0.05,
            ..estimate
        };
        let record = |converged| ParameterRecord::new(&within, converged).interval_95;
        assert_eq!(record(true), Some([0.020, 0.077]));
        assert_eq!(record(false), None);
    }
}
