//! Where a fit starts.
//!
//! A search goes downhill; phases, wave numbers, resonances and steep laws have several valleys. The analytic model tells valleys apart
//! at a hundredth of the price of finite elements, and what it is fitted to is most of the way there.

use super::anchored::Anchored;
use super::bench::{Workshop, for_looks};
use super::fit::Problem;
use super::hypothesis::version::ModelVersion;
use super::measured::Measured;
use super::noise::NoiseModel;
use super::search::Effort;
use crate::effects::ParamRole;
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

impl Measured<'_> {
    /// Where a fit of a version's `problem` is to start, a value for each free parameter but k: where the analytic model's own fit to the
    /// measurements ends, from the best of `places` and of others spread over the priors of the effect that joined last, or at the study's
    /// values if the problem's own model is nearer to the measurements there.
    ///
    /// The analytic model is anchored: it differs from finite elements by more than a weak effect does.
    pub(super) fn start(
        &self,
        problem: &Problem<'_>,
        version: &ModelVersion,
        places: Vec<Vec<f64>>,
    ) -> Vec<f64> {
        let own = own_values(version);
        let spread = match of_last(version).count() {
            0 => return own,
            // the coefficients of a smooth function have no valleys to be told apart
            _ if of_last(version).all(|free| free.role == ParamRole::SmoothPart) => 0,
            n if of_last(version).any(is_phase) => n * WAVES,
            n if n >= MANY => n * SPREAD,
            _ => 0,
        };
        let found = self.analytic(version, problem.noise, |analytic| {
            let (k, fine) = problem.scaled(&own).ok()?;
            let anchored = Problem {
                predictor: &Anchored::at(analytic.predictor, k, &own, fine).ok()?,
                parameters: analytic.parameters.clone(),
                coefficient: analytic.coefficient.clone(),
                ..*analytic
            };
            let mut all = analytic.places(spread);
            all.iter_mut().for_each(|place| settle(version, place));
            all.extend(places);
            let mut starts = anchored.nearest(all, KEEP);
            starts.push(own.clone());
            let fit = anchored.fit_from(&starts, &LOOK).ok()?;
            let parameters = fit.parameters.into_iter();
            let values = parameters.filter(|p| p.name != WEAR_COEFFICIENT);
            Some(values.map(|p| p.value).collect())
        });
        let mut nearer = problem.nearest(found.into_iter().collect(), 1);
        nearer.pop().unwrap_or(own)
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
