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
//! the datums is judged beside E therefore, against what noise, numerics and open parameters leave of it:
//!
//! ```text
//! v_i = σ_i² + u_num²        rms² > Σ v_i/n + 3 √(2 Σ v_i²)/n + 4 mean of u_input,i²          the model misses the curve
//! ```
//! The chance of Σ v_i is that of a sum of squares of independent rows. Open parameters move all rows at once: they count with two standard
//! deviations, as in E. Of fewer than three rows there is no curve.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::residual_statistics::role_name;
use crate::learn::fitting::fitted::Fit;
use crate::measure::{Dataset, Observation, Quantity, Subject};
use crate::study::Role;

/// Stated numerical error of the model, relative to a curve's largest magnitude.
const NUMERICAL: f64 = 0.002;
/// Least rows of a curve.
const CURVE: usize = 3;
/// How much more than noise leaves is no chance, in standard deviations of noise's own.
const NO_CHANCE: f64 = 3.0;

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
    /// What noise, numerical error and open parameters alone leave of that.
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
        let in_group = |row: usize| group.binary_search(&row).is_ok();
        let left = Left {
            own: (group.iter())
                .map(|&i| rows[i].sigma.powi(2) + u_num.powi(2))
                .collect(),
            shared: own.map_or(0.0, |own| own.uncertainty.mean_square(in_group)),
        };
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
            noise_rms: left.mean_square().sqrt(),
            curve_resolved: left.is_exceeded_by(square / n),
            mean_is_fitted: group.iter().all(has_datum),
        }
    };
    groups.into_iter().map(of).collect()
}

/// What is left of a curve's mean square error without any error of the model.
struct Left {
    /// Variance of each row by itself: noise and numerical error.
    own: Vec<f64>,
    /// Mean variance by what moves all rows at once: the parameters that the fit leaves open.
    shared: f64,
}

impl Left {
    fn mean_square(&self) -> f64 {
        self.own.iter().sum::<f64>() / self.own.len() as f64 + self.shared
    }

    /// Whether so large a mean square is no chance.
    fn is_exceeded_by(&self, square: f64) -> bool {
        let n = self.own.len() as f64;
        let fourth: f64 = self.own.iter().map(|v| v * v).sum();
        let chance = NO_CHANCE * (2.0 * fourth).sqrt() / n;
        // two standard deviations of the shared part, one of which is in the mean
        self.own.len() >= CURVE && square > self.mean_square() + chance + 3.0 * self.shared
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 8 rows of variance 1 are exceeded from 1 + 3 √(2·8)/8 = 2.5.
    #[test]
    fn a_curve_is_missed_where_its_mean_square_is_more_than_chance() {
        let left = |own: &[f64], shared: f64| Left {
            own: own.to_vec(),
            shared,
        };
        let equal = left(&[1.0; 8], 0.0);
        assert!(!equal.is_exceeded_by(2.49) && equal.is_exceeded_by(2.51));
        // one row with most of the variance: 8/8 + 3 √(2·50)/8 for variances 7, 1/7 …: it scatters more
        let mut unequal = vec![1.0 / 7.0; 8];
        unequal[0] = 7.0;
        assert!(!left(&unequal, 0.0).is_exceeded_by(4.5));
        // open parameters move the whole curve: by two standard deviations without being an error
        let open = left(&[0.01; 8], 1.0);
        assert!((open.mean_square() - 1.01).abs() < 1e-12);
        assert!(!open.is_exceeded_by(3.9) && open.is_exceeded_by(4.1));
        // two rows are no curve
        assert!(!left(&[1.0; 2], 0.0).is_exceeded_by(100.0));
    }
}
