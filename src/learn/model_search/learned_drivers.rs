//! What nothing of the catalogue explains, as a law of one driver: every driver a candidate, the one with the greatest evidence the answer.
//!
//! Each is first fitted with one size and length of its process, the best few with all; by the analytic model, which tells drivers apart at
//! a hundredth of the price of finite elements and only has to rank them here: `add` fits the law by the study's own model.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::context::Context;
use crate::effects::Hook;
use crate::learn::fidelity::Fidelity;
use crate::learn::fitted::Fit;
use crate::learn::fitted_candidate::FittedCandidate;
use crate::learn::learned_law::{LearnedFit, WantedLaw, deviations};
use crate::learn::measured::Measured;
use crate::learn::noise::NoiseModel;
use crate::learn::search::Effort;
use crate::study::Role;

/// Laws that are looked at. Pressure and what follows from it stand behind what measurements tell directly.
const DRIVERS: &[&str] = &[
    "cycles",
    "cycles:pinion",
    "cycles:gear",
    "s",
    "radius:pinion",
    "radius:gear",
    "depth",
    "slid_distance",
    "p",
    "v_slide",
    "film_ratio",
    "flash_temperature",
    "torque",
    "speed",
    "bulk_temperature",
];
/// How many of them are fitted with every size and length.
const CLOSELY: usize = 3;
/// Gain of ln evidence below which no law is told of: the prior odds against one of so many drivers, and a thousand beside.
const LEAST_GAIN: f64 = 10.0;

/// A law learned from the measurements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LearnedAnswer {
    /// `learned:cycles`, `learned:radius:pinion`: what `add` takes.
    pub name: String,
    /// `wear_factor`: values are natural logarithms of a factor on k.
    pub acts: String,
    /// The variable that it follows.
    pub driver: String,
    /// Its unit.
    pub unit: String,
    /// `both`, `pinion` or `gear`.
    pub member: String,
    /// Log evidence over the same model without it.
    pub evidence_gain: f64,
    /// Values of the driver.
    pub knots: Vec<f64>,
    /// Values of the law there.
    pub values: Vec<f64>,
    /// One standard deviation of each.
    pub sigma: Vec<f64>,
    /// Prior standard deviation of the values.
    pub size: f64,
    /// Over which distance of the driver they change.
    pub length: f64,
    /// χ² per point of the fit tests without the law and with it.
    pub fit_chi2_per_point: [f64; 2],
    /// Of the held-out tests; None where none is held out.
    pub holdout_chi2_per_point: Option<[f64; 2]>,
    /// By which model.
    pub decided_by: Fidelity,
    /// The other drivers, the best first.
    pub others: Vec<OtherDriver>,
}

/// A driver that was looked at beside.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OtherDriver {
    /// As [`LearnedAnswer::name`].
    pub name: String,
    /// Log evidence over the same model without it.
    pub evidence_gain: f64,
}

/// The law beside what is `known` that the measurements ask for most, by the analytic model; None where none is worth its freedom.
pub(in crate::learn) fn learned_driver(
    context: &Context<'_>,
    known: &FittedCandidate,
) -> Option<LearnedAnswer> {
    let likelihood = &context.likelihood;
    let (measured, version) = (likelihood.measured, &known.candidate.version);
    // a study whose own model is the analytic one
    let own = context.fidelity == Fidelity::Screening && !context.approximate;
    let bench = if own { context.middle } else { context.hertz };
    let noise = NoiseModel {
        // what finite elements make else is not to be learned as a law
        model_error: if own {
            likelihood.noise.model_error
        } else {
            Some(Fidelity::Screening.model_error())
        },
        ..likelihood.noise
    };
    let (_, start) = likelihood.arguments(&known.candidate.parameters, &known.found.state);
    let effort = Effort {
        settle: 0,
        ..Effort::for_simulations()
    };
    let without = measured
        .fit(bench, version, noise, &[start], &effort, &|_| {})
        .ok()?;
    let study = measured.study();
    let wanted: Vec<WantedLaw> = (DRIVERS.iter())
        .filter_map(|name| WantedLaw::of_name(&format!("learned:{name}"), Hook::WearFactor).ok())
        .filter(|law| law.driver.needs.iter().all(|key| study.states(key)))
        .filter(|law| !version.effects.has(&law.name()))
        .collect();
    let look = |law: &WantedLaw| {
        let found = measured.glance(bench, version, &without, law, noise).ok()?;
        Some((*law, found))
    };
    let mut found: Vec<(WantedLaw, LearnedFit)> = wanted.par_iter().filter_map(look).collect();
    let best_first = |found: &mut Vec<(WantedLaw, LearnedFit)>| {
        found.sort_by(|a, b| b.1.log_evidence.total_cmp(&a.1.log_evidence));
    };
    best_first(&mut found);
    let count = found.len().min(CLOSELY);
    let close = |(law, glance): &(WantedLaw, LearnedFit)| {
        let learned = measured.learn(bench, version, &without, law, noise, &|_| {});
        (*law, learned.unwrap_or_else(|_| glance.clone()))
    };
    let closer: Vec<(WantedLaw, LearnedFit)> = found[..count].par_iter().map(close).collect();
    found.splice(..count, closer);
    best_first(&mut found);
    let gain = |fit: &LearnedFit| fit.log_evidence - without.log_evidence;
    let ((law, best), others) = found.split_first()?;
    let both = |role| {
        Some([
            chi2(measured, &without, role)?,
            chi2(measured, &best.fit, role)?,
        ])
    };
    let fitted = both(Role::Fit)?;
    if !is_worth(gain(best), fitted) {
        return None;
    }
    Some(LearnedAnswer {
        name: law.name(),
        acts: law.hook.name().to_owned(),
        driver: law.driver.name.to_owned(),
        unit: law.driver.unit.to_owned(),
        member: law
            .member
            .map_or("both", crate::gear::Member::name)
            .to_owned(),
        evidence_gain: gain(best),
        knots: best.law.law.knots().to_vec(),
        values: best.law.values.clone(),
        sigma: deviations(&best.law, &best.fit),
        size: best.law.size,
        length: best.law.length,
        fit_chi2_per_point: fitted,
        holdout_chi2_per_point: both(Role::Holdout),
        decided_by: Fidelity::Screening,
        others: (others.iter())
            .map(|(law, fit)| OtherDriver {
                name: law.name(),
                evidence_gain: gain(fit),
            })
            .collect(),
    })
}

/// Whether a law is worth its freedom: by its gain of ln evidence, and since it lowers χ² per point of the fit tests. Evidence alone may rise while the
/// residuals grow, where their correlated model error takes up what the law leaves.
fn is_worth(gain: f64, [before, after]: [f64; 2]) -> bool {
    gain >= LEAST_GAIN && after < before
}

/// χ² per point of the tests with a role; None if they have no points.
fn chi2(measured: &Measured<'_>, fit: &Fit, role: Role) -> Option<f64> {
    let rows = measured.data.observations.iter().zip(&fit.rows);
    let own = rows.filter(|(o, _)| measured.roles[o.test] == role);
    let squares: Vec<f64> = own.map(|(_, row)| row.standardised.powi(2)).collect();
    (!squares.is_empty()).then(|| squares.iter().sum::<f64>() / squares.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A law that raises χ² is never offered, whatever its evidence; nor one that gains little.
    #[test]
    fn laws_that_leave_more_are_not_offered() {
        assert!(is_worth(111.0, [6.91, 3.0]));
        assert!(!is_worth(111.0, [6.91, 7.55]));
        assert!(!is_worth(0.5 * LEAST_GAIN, [6.91, 3.0]));
    }
}
