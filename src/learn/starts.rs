//! Where a fit starts.
//!
//! A search goes downhill; phases, wave numbers, resonances and steep laws have several valleys. The analytic model tells valleys apart
//! at a hundredth of the price of finite elements, and what it is fitted to is most of the way there.

use super::anchored::Anchored;
use super::bench::{Workshop, for_looks};
use super::fit::{Problem, Scaled};
use super::fitted::Fit;
use super::hypothesis::version::ModelVersion;
use super::measured::Measured;
use super::noise::NoiseModel;
use super::search::Effort;
use crate::effects::{Hook, ParamRole};
use crate::simulate::forward::ContactKind;
use crate::study::{FreeParameter, WEAR_COEFFICIENT};

/// How far the analytic model is fitted from each place.
const LOOK: Effort = Effort {
    iterations: 15,
    tolerance: 0.1,
    floor: 0.3,
    carry: 0.3,
    ..Effort::STAY
};
/// From so many free parameters of an effect on, places spread over their priors are looked at: so many for each parameter, and so many
/// for a wave, whose lengths and phases all have valleys of their own.
const MANY: usize = 3;
const SPREAD: usize = 8;
const WAVES: usize = 64;
/// How weak the waves looked at are, as a share of the prior's median: weak ones come nearer to the measurements the more they are like what
/// is missing, strong ones only if their size is right too.
const WEAK: f64 = 0.25;
/// From how many of the places, at most, the analytic model is fitted.
const KEEP: usize = 6;
/// How much of an effect is left where the analytic model is anchored if not at the study's own values: a strong effect that is not there is no
/// place to judge other values from.
const FAINT: f64 = 0.05;

impl Measured<'_> {
    /// Where a fit of a version's `problem` is to start, a value for each free parameter but k: where the analytic model's own fit to the
    /// measurements ends, from the best of `places` and of others spread over the priors of the effect that joined last, or at the study's
    /// values if the problem's own model is nearer to the measurements there.
    ///
    /// The analytic model is anchored: it differs from finite elements by more than a weak effect does. So it is where finite elements are nearer
    /// to the measurements: at the study's values, or with hardly any of the effect.
    pub(super) fn start(
        &self,
        problem: &Problem<'_>,
        version: &ModelVersion,
        places: Vec<Vec<f64>>,
    ) -> Vec<f64> {
        let own = own_values(version);
        if of_last(version).count() == 0 {
            return own;
        }
        let Some(fine) = problem.scaled(&own) else {
            return own;
        };
        let faint = faint(version).and_then(|faint| Some((problem.scaled(&faint)?, faint)));
        let anchor: (&[f64], &Scaled) = match &faint {
            Some((scaled, faint)) if scaled.square < fine.square => (faint, scaled),
            _ => (&own, &fine),
        };
        let Some(found) = self.analytic_fit(version, problem.noise, anchor, places) else {
            return own;
        };
        let parameters = found.parameters.into_iter();
        let values = parameters.filter(|p| p.name != WEAR_COEFFICIENT);
        let values: Vec<f64> = values.map(|p| p.value).collect();
        let nearer = problem.scaled(&values);
        if nearer.is_some_and(|nearer| nearer.square < fine.square) {
            values
        } else {
            own
        }
    }

    /// χ² of the fit tests that a fit of a version promises by the analytic model, anchored at the model without the effect that joined last; None
    /// where that does not tell: the analytic model knows too little of the effect, or it has no strength to take away.
    pub(super) fn promised(
        &self,
        version: &ModelVersion,
        without: &Scaled,
        places: Vec<Vec<f64>>,
    ) -> Option<f64> {
        // it knows of friction only the torque, of a face one section, and not how fast weak waves of the profile wear
        let last = version.effects.specs().last()?;
        let unseen = last.hook() == Hook::Friction || last.acts_across_the_face();
        if unseen || of_last(version).any(is_phase) && last.hook() == Hook::Profile {
            return None;
        }
        let noise = NoiseModel::of(&self.study().noise);
        let fit = self.analytic_fit(version, noise, (&faint(version)?, without), places)?;
        Some(self.misfit(&fit).square)
    }

    /// The analytic model's fit, anchored, from the best of `places`, of others spread over the priors of the effect that joined last, of the study's
    /// own values and of the priors' medians.
    fn analytic_fit(
        &self,
        version: &ModelVersion,
        noise: NoiseModel,
        (place, anchor): (&[f64], &Scaled),
        places: Vec<Vec<f64>>,
    ) -> Option<Fit> {
        let spread = match of_last(version).count() {
            // the coefficients of a smooth function have no valleys to be told apart
            _ if of_last(version).all(|free| free.role == ParamRole::SmoothPart) => 0,
            n if of_last(version).any(is_phase) => n * WAVES,
            n if n >= MANY => n * SPREAD,
            _ => 0,
        };
        self.analytic(version, noise, |analytic| {
            let better = anchor.predictions.clone();
            let predictor = Anchored::at(analytic.predictor, anchor.coefficient, place, better);
            let anchored = Problem {
                predictor: &predictor.ok()?,
                parameters: analytic.parameters.clone(),
                coefficient: analytic.coefficient.clone(),
                ..*analytic
            };
            let mut all = analytic.places(spread);
            all.iter_mut().for_each(|place| settle(version, place));
            all.extend(places);
            let mut starts = anchored.nearest(all, KEEP);
            starts.extend([own_values(version), medians(version)]);
            starts.dedup();
            anchored.fit_from(&starts, &LOOK).ok()
        })
    }

    /// The analytic model's problem, coarsely resolved.
    fn analytic<T>(
        &self,
        version: &ModelVersion,
        noise: NoiseModel,
        act: impl FnOnce(&Problem<'_>) -> Option<T>,
    ) -> Option<T> {
        let (set, coarse) = (
            self.study().gear_set(),
            for_looks(self.study().resolution()),
        );
        let workshop = Workshop::new(set, coarse, ContactKind::Hertz, self.tests()).ok()?;
        let bench = self.bench(&workshop).ok()?;
        self.with_problem(&bench, version, noise, &|_| {}, act)
    }
}

/// A version's own values of its free parameters but k.
pub(super) fn own_values(version: &ModelVersion) -> Vec<f64> {
    effects(version).map(|free| free.value).collect()
}

/// The version's own values with hardly any of the effect that joined last; None if it has no strength to take away.
fn faint(version: &ModelVersion) -> Option<Vec<f64>> {
    let before = effects(version).count() - of_last(version).count();
    let strength = |free: &FreeParameter| free.neutral.filter(|none| none.is_finite());
    of_last(version).find_map(strength)?;
    let value = |(i, free): (usize, &FreeParameter)| match strength(free) {
        Some(none) if i >= before => {
            (none + FAINT * (free.value - none)).clamp(free.lower, free.upper)
        }
        _ => free.value,
    };
    Some(effects(version).enumerate().map(value).collect())
}

/// The priors' medians of the effects' free parameters.
pub(super) fn medians(version: &ModelVersion) -> Vec<f64> {
    effects(version)
        .map(|free| free.prior.median().clamp(free.lower, free.upper))
        .collect()
}

/// The free parameters but k.
fn effects(version: &ModelVersion) -> impl Iterator<Item = &FreeParameter> {
    let free = version.free.iter();
    free.filter(|free| free.name != WEAR_COEFFICIENT)
}

/// Those of the effect that joined last.
fn of_last(version: &ModelVersion) -> impl Iterator<Item = &FreeParameter> {
    let last = effects(version).last().map(effect);
    effects(version).filter(move |free| Some(effect(free)) == last)
}

fn effect(free: &FreeParameter) -> &str {
    free.name.split('.').next().unwrap_or_default()
}

/// A place with the effects before the last one as they are, for they have been fitted already; waves become weak.
fn settle(version: &ModelVersion, place: &mut [f64]) {
    let before = effects(version).count() - of_last(version).count();
    let wave = of_last(version).any(is_phase);
    for (i, (value, free)) in place.iter_mut().zip(effects(version)).enumerate() {
        if i < before {
            *value = free.value;
        } else if let Some(none) = free.neutral.filter(|none| wave && none.is_finite()) {
            *value = none + WEAK * (free.prior.median() - none);
        }
    }
}

fn is_phase(free: &FreeParameter) -> bool {
    free.role == ParamRole::WavePhase
}
