//! Where a fit starts.
//!
//! A search goes downhill; phases, wave numbers, resonances and steep laws have several valleys. The analytic model tells valleys apart
//! at a hundredth of the price of finite elements, and what it is fitted to is most of the way there.

use super::bench::Bench;
use super::fit::Problem;
use super::measured::{Measured, ModelVersion};
use super::noise::NoiseModel;
use super::search::Effort;
use crate::simulate::forward::ContactKind;
use crate::study::{FreeParameter, WEAR_COEFFICIENT};

/// How far the analytic model is fitted from each place.
const LOOK: Effort = Effort {
    iterations: 15,
    tolerance: 0.1,
    floor: 0.3,
    carry: 0.3,
    settle: 0,
    share: 0.0,
};
/// From so many free effect parameters on, places spread over their priors are looked at: so many for each parameter, and so many for
/// a wave, whose lengths and phases all have valleys of their own.
const MANY: usize = 3;
const SPREAD: usize = 8;
const WAVES: usize = 64;
/// How weak the waves looked at are, as a share of the prior's median: weak ones come nearer to the measurements the more they are like what
/// is missing, strong ones only if their size is right too.
const WEAK: f64 = 0.25;
/// From how many of the places, at most, the analytic model is fitted.
const KEEP: usize = 6;

impl Measured<'_> {
    /// Where a fit of a version on `bench` is to start, a value for each free parameter but k: where the analytic model's own fit to the
    /// measurements ends, from the best of `places` and of others spread over the priors, or at the study's values if the model on
    /// `bench` is nearer to the measurements there.
    pub(super) fn start(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        noise: NoiseModel,
        places: Vec<Vec<f64>>,
        watch: &(dyn Fn(usize) + Sync),
    ) -> Vec<f64> {
        let own: Vec<f64> = effects(version).map(|free| free.value).collect();
        let waves = effects(version).any(is_phase);
        let spread = match own.len() {
            0 => return own,
            n if waves => n * WAVES,
            n if n >= MANY => n * SPREAD,
            _ => 0,
        };
        let look = |problem: &Problem<'_>| -> Option<Vec<f64>> {
            let mut all = problem.places(spread);
            if waves {
                all.iter_mut().for_each(|place| weaken(version, place));
            }
            all.extend(places);
            let mut starts = problem.nearest(all, KEEP);
            starts.push(own.clone());
            let fit = problem.fit_from(&starts, &LOOK).ok()?;
            let parameters = fit.parameters.into_iter();
            let values = parameters.filter(|p| p.name != WEAR_COEFFICIENT);
            Some(values.map(|p| p.value).collect())
        };
        let analytic = self.workshop(ContactKind::Hertz).ok();
        let found = analytic.and_then(|workshop| {
            let cheap = self.bench(&workshop).ok()?;
            self.with_problem(&cheap, version, noise, &|_| {}, look)
        });
        let Some(found) = found else { return own };
        let mut nearer = self.with_problem(bench, version, noise, watch, |problem| {
            problem.nearest(vec![found], 1)
        });
        nearer.pop().unwrap_or(own)
    }
}

/// The free parameters but k.
fn effects(version: &ModelVersion) -> impl Iterator<Item = &FreeParameter> {
    let free = version.free.iter();
    free.filter(|free| free.name != WEAR_COEFFICIENT)
}

/// For a place at which waves are looked at: what is no wave keeps its own value, and waves become weak.
fn weaken(version: &ModelVersion, place: &mut [f64]) {
    let effect = |free: &FreeParameter| free.name.split('.').next().map(str::to_owned);
    let wavy: Vec<_> = effects(version)
        .filter(|f| is_phase(f))
        .map(effect)
        .collect();
    for (value, free) in place.iter_mut().zip(effects(version)) {
        if !wavy.contains(&effect(free)) {
            *value = free.value;
        } else if let Some(none) = free.neutral.filter(|none| none.is_finite()) {
            *value = none + WEAK * (free.prior.median() - none);
        }
    }
}

fn is_phase(free: &FreeParameter) -> bool {
    free.unit == "rad"
}
