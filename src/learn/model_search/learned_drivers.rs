//! What nothing of the catalogue explains, as a law of one driver: every driver a candidate, the one with the greatest evidence the answer.
//!
//! Each is first fitted with one size and length of its process, the best few with all; by the analytic model, which tells drivers apart at
//! a hundredth of the price of finite elements. The best is then fitted by the coarse finite elements that effects are judged by, alone and together with
//! the effects that lead, so that a name does not stand for what the law does better.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::context::Context;
use super::screening::SCREEN;
use crate::effects::Hook;
use crate::learn::candidate_model::{Anchored, model};
use crate::learn::fidelity::Fidelity;
use crate::learn::fitted::Fit;
use crate::learn::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::EffectSet;
use crate::learn::learned_law::{LearnedFit, WantedLaw};
use crate::learn::measured::Measured;
use crate::learn::noise::NoiseModel;
use crate::learn::quadratic::State;
use crate::learn::search::Effort;
use crate::study::{LearnedLaw, Role};

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
/// Effects that are fitted together with the law.
const BESIDE: usize = 2;

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
    /// Log evidence over the same model without it, by the analytic model, as of the other drivers.
    pub evidence_gain: f64,
    /// Fall of χ² by the law alone, by the model that the effects are judged by.
    pub chi2_drop: f64,
    /// Leading effects, fitted together with the law.
    pub beside: Vec<BesideLaw>,
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
    /// Of the held-out tests, by the analytic model; None where none is held out.
    pub holdout_chi2_per_point: Option<[f64; 2]>,
    /// By which model the law's values are fitted.
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

/// An effect fitted together with a learned law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BesideLaw {
    /// The effect.
    pub effects: EffectSet,
    /// Fall of χ² by the effect alone.
    pub chi2_drop: f64,
    /// ln Z(effect and law) − ln Z(law alone).
    pub gain_over_law: f64,
}

/// The law that the measurements ask for most; None where none is worth its freedom. The first of `leaders` are fitted together with it.
pub(in crate::learn) fn learned_driver(
    context: &Context<'_>,
    base: &BaseFit,
    leaders: &[&FittedCandidate],
) -> Option<LearnedAnswer> {
    let known = &base.fitted;
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
    if gain(best) < LEAST_GAIN {
        return None;
    }
    let judged = by_elements(
        context,
        base,
        &base.fitted,
        &base.fitted.found.state,
        &best.law,
    )?;
    let beside = beside(context, base, leaders, &judged, &best.law);
    let holdout = [&without, &best.fit].map(|fit| chi2(measured, fit, Role::Holdout));
    let own = coefficients(&judged, &best.law);
    let chi2 = |fitted: &FittedCandidate| likelihood.chi2_per_point(&fitted.found.model);
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
        chi2_drop: base.fitted.square - judged.square,
        beside,
        knots: best.law.law.knots().to_vec(),
        values: best.law.values_at(&own),
        sigma: deviations_of(&judged, &best.law),
        size: best.law.size,
        length: best.law.length,
        fit_chi2_per_point: [chi2(known), chi2(&judged)],
        holdout_chi2_per_point: match holdout {
            [Some(before), Some(after)] => Some([before, after]),
            _ => None,
        },
        decided_by: judged.fidelity,
        others: (others.iter())
            .map(|(law, fit)| OtherDriver {
                name: law.name(),
                evidence_gain: gain(fit),
            })
            .collect(),
    })
}

/// The law fitted beside `known`, from this state of it, by the model that effects are judged by. Its form is not uncertain as an effect's
/// is: it has the freedom of a curve.
fn by_elements(
    context: &Context<'_>,
    base: &BaseFit,
    known: &FittedCandidate,
    state: &State,
    law: &LearnedLaw,
) -> Option<FittedCandidate> {
    let candidate = known.candidate.with_law(law.clone().spec());
    let added = &candidate.parameters[known.candidate.parameters.len()..];
    let start = State {
        theta: (state.theta.iter().copied())
            .chain(added.iter().map(|p| p.natural_start(p.start)))
            .collect(),
        ..state.clone()
    };
    let (bench, offset) = match context.fidelity {
        Fidelity::Screening => (context.hertz, &base.hertz_offset),
        Fidelity::Middle | Fidelity::Full => (context.middle, &base.fitted.offset),
    };
    let found = {
        let predictor = Anchored::new(model(bench, &candidate), offset.clone());
        (context.likelihood)
            .fit(&predictor, &candidate.parameters, start, &SCREEN)
            .ok()?
    };
    Some(FittedCandidate::new(
        &context.likelihood,
        candidate,
        found,
        offset.clone(),
        None,
        context.fidelity.min(Fidelity::Middle),
    ))
}

/// The first of the leading effects, each together with the law, where the law brings more than the effect: what an effect
/// accounts for as well needs no law.
fn beside(
    context: &Context<'_>,
    base: &BaseFit,
    leaders: &[&FittedCandidate],
    law: &FittedCandidate,
    learned: &LearnedLaw,
) -> Vec<BesideLaw> {
    let drop = |fitted: &FittedCandidate| base.fitted.square - fitted.square;
    let together = |effect: &&FittedCandidate| {
        let joint = by_elements(context, base, effect, &effect.found.state, learned)?;
        Some(BesideLaw {
            effects: effect.candidate.effects.clone(),
            chi2_drop: drop(effect),
            gain_over_law: joint.log_evidence - law.log_evidence,
        })
    };
    (leaders.iter().take(BESIDE))
        .filter(|effect| drop(effect) < drop(law))
        .filter_map(together)
        .collect()
}

/// The law's coefficients among the parameters of a fit, which they end.
fn coefficients(fitted: &FittedCandidate, law: &LearnedLaw) -> Vec<f64> {
    let parameters = &fitted.candidate.parameters;
    let values = parameters.iter().zip(&fitted.found.state.theta);
    let all: Vec<f64> = values.map(|(p, &x)| p.value(x)).collect();
    all[all.len() - law.clone().spec().parameters.len()..].to_vec()
}

/// Standard deviations of the law's values at its knots.
fn deviations_of(fitted: &FittedCandidate, law: &LearnedLaw) -> Vec<f64> {
    let (all, own) = (
        fitted.covariance.nrows(),
        law.clone().spec().parameters.len(),
    );
    law.deviations(&(fitted.covariance.view((all - own, all - own), (own, own))).into_owned())
}

/// χ² per point of the tests with a role; None if they have no points.
fn chi2(measured: &Measured<'_>, fit: &Fit, role: Role) -> Option<f64> {
    let rows = measured.data.observations.iter().zip(&fit.rows);
    let own = rows.filter(|(o, _)| measured.roles[o.test] == role);
    let squares: Vec<f64> = own.map(|(_, row)| row.standardised.powi(2)).collect();
    (!squares.is_empty()).then(|| squares.iter().sum::<f64>() / squares.len() as f64)
}
