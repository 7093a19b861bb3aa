//! Comparison error against validation uncertainty, in the way of ASME V&V 20-2009.
//!
//! ```text
//! E = S − D          u_val² = u_num² + u_input² + u_D²          E − 2 u_val ≤ δ_model ≤ E + 2 u_val
//! ```
//! ASME V&V 20-2009, Eqs. (1-5-1) and (1-5-10). S and D are means over the observations of one test, member and quantity, the
//! most probable datums subtracted from D. For fit tests S has been fitted to D, so that E shows only what no parameter can
//! mend; held-out tests are validation in the standard's sense.
//!
//! Where all rows belong to traces, their datums, and of a held-out test its own k, make E small whatever the model is. The root mean square about
//! the datums is judged beside E therefore, against what noise and numerics leave of it:
//!
//! ```text
//! rms² > (mean of σ² + u_num²)(1 + 3 √(2/n))          the model misses the curve
//! ```

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::residual_statistics::role_name;
use crate::learn::fitting::fit::is_within_noise;
use crate::learn::fitting::fitted::Fit;
use crate::measure::{Dataset, Observation, Quantity, Subject};
use crate::study::Role;

/// Stated numerical error of the model, relative to a curve's largest magnitude.
const NUMERICAL: f64 = 0.002;

/// Comparison error and validation uncertainty of the mean of a quantity of one test and member, in its unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Validation {
    /// Id of the test.
    pub test: String,
    /// `fit` or `holdout`.
    pub role: String,
    /// `pinion`, `gear` or `pair`.
    pub member: String,
    /// What was measured.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// E, mean of model minus measured.
    pub error: f64,
    /// `u_num`: numerical error, 0.2 % of the largest magnitude of each curve, alike in all of them.
    pub u_num: f64,
    /// `u_input`: what the fit leaves open in the parameters.
    pub u_input: f64,
    /// `u_D`: independent noise and the datums.
    pub u_data: f64,
    /// `u_val`.
    pub u_val: f64,
    /// E − 2 u_val and E + 2 u_val: where the model's own error lies with 95 % confidence.
    pub model_error: [f64; 2],
    /// Whether that interval leaves out 0: the model's error rises above what the comparison can resolve.
    pub resolved: bool,
    /// Number of observations.
    #[serde(default)]
    pub points: usize,
    /// Root mean square of model minus measured, the most probable datums subtracted.
    #[serde(default)]
    pub rms: f64,
    /// What noise and numerical error alone leave of that.
    #[serde(default)]
    pub noise_rms: f64,
    /// Whether `rms` is more than chance makes of `noise_rms`: the model misses the curve, whatever its mean.
    #[serde(default)]
    pub curve_resolved: bool,
    /// Whether every row belongs to a trace, whose datum is fitted to it and takes the mean error with it.
    #[serde(default)]
    pub mean_is_fitted: bool,
}

/// Of every test, member and quantity.
pub(in crate::learn) fn validate(data: &Dataset, roles: &[Role], fit: &Fit) -> Vec<Validation> {
    let mut groups: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    let judged = |(_, o): &(usize, &Observation)| fit.judges(o.test);
    for (i, o) in data.observations.iter().enumerate().filter(judged) {
        groups
            .entry((o.test, o.member, o.quantity))
            .or_default()
            .push(i);
    }
    let of = |((test, member, quantity), group): ((usize, Subject, Quantity), Vec<usize>)| {
        let n = group.len() as f64;
        let rows = &data.observations;
        let error = group.iter().map(|&i| fit.rows[i].residual).sum::<f64>() / n;
        let noise: f64 = group.iter().map(|&i| rows[i].sigma.powi(2)).sum();
        let datums: f64 = fit
            .datums
            .iter()
            .map(|datum| {
                let points = group
                    .iter()
                    .filter(|&&i| rows[i].trace == Some(datum.trace))
                    .count();
                (points as f64 * datum.sigma).powi(2)
            })
            .sum();
        let mut tops: BTreeMap<u64, f64> = BTreeMap::new();
        for &i in &group {
            let top = tops.entry(rows[i].cycles.to_bits()).or_default();
            *top = top.max(fit.rows[i].model.abs());
        }
        let u_num = NUMERICAL
            * group
                .iter()
                .map(|&i| tops[&rows[i].cycles.to_bits()])
                .sum::<f64>()
            / n;
        let u_data = (noise + datums).sqrt() / n;
        let own = fit.tests.iter().find(|fitted| fitted.test == test);
        let weight = |row: usize| {
            if group.binary_search(&row).is_ok() {
                1.0 / n
            } else {
                0.0
            }
        };
        let u_input = own.map_or(0.0, |own| own.uncertainty.of_sum(weight));
        let u_val = (u_num.powi(2) + u_input.powi(2) + u_data.powi(2)).sqrt();
        let square = group
            .iter()
            .map(|&i| fit.rows[i].residual.powi(2))
            .sum::<f64>();
        let left = noise / n + u_num.powi(2);
        let has_datum = |i: &usize| {
            let trace = rows[*i].trace;
            fit.datums.iter().any(|datum| trace == Some(datum.trace))
        };
        Validation {
            test: data.tests[test].clone(),
            role: role_name(roles[test]).to_owned(),
            member: member.name().to_owned(),
            quantity: quantity.name().to_owned(),
            unit: quantity.unit().to_owned(),
            error,
            u_num,
            u_input,
            u_data,
            u_val,
            model_error: [error - 2.0 * u_val, error + 2.0 * u_val],
            resolved: error.abs() > 2.0 * u_val,
            points: group.len(),
            rms: (square / n).sqrt(),
            noise_rms: left.sqrt(),
            curve_resolved: !is_within_noise(square / left, group.len()),
            mean_is_fitted: group.iter().all(has_datum),
        }
    };
    groups.into_iter().map(of).collect()
}
