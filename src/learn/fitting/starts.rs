//! Where a fit starts.
//!
//! A search goes downhill; phases, wave numbers, resonances and steep laws have several valleys. A cheaper model tells valleys apart,
//! and what it is fitted to is most of the way there.

use crate::learn::fitting::cheaper::{Anchor, Budget, Cheaper};
use crate::learn::fitting::fit::{Problem, ScaledPrediction};
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::noise::NoiseModel;
use crate::study::{FreeParameter, WEAR_COEFFICIENT};

/// How much of an effect is left where a cheaper model is anchored if not at the study's own values: a strong effect that is not there is no
/// place to judge other values from.
const FAINT: f64 = 0.05;

/// How far the analytic model may be off from finite elements in the wear coefficient of the same measurements, ln.
const ANALYTIC_ERROR: f64 = 0.25;

/// Depth in modules from which a guessed wear coefficient would leave no teeth, and the share of that with which it is measured instead.
const WORN_AWAY: f64 = 0.5;
const WITH_TEETH: f64 = 0.1;

/// How much is spent on telling where a fit starts, and on telling what it promises.
const STARTS: Budget = Budget {
    places: 6,
    coarse_steps: 5,
};
const PROMISES: Budget = Budget {
    places: 3,
    coarse_steps: 3,
};

/// Where a fit is to start.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::learn) struct Start {
    /// A value for each free parameter but k.
    pub(in crate::learn) values: Vec<f64>,
    /// The cheaper model's fit with these values; None where they are not from one.
    pub(in crate::learn) fit: Option<Fit>,
    /// χ² of the fit tests that the cheaper model promises of the fit; None where none was asked.
    pub(in crate::learn) promised: Option<f64>,
}

impl Start {
    /// At values that no cheaper model has found.
    pub(in crate::learn) fn at(values: Vec<f64>) -> Self {
        Self {
            values,
            fit: None,
            promised: None,
        }
    }

    /// k to begin with, mm²/N; None: the version's own.
    pub(in crate::learn) fn coefficient(&self) -> Option<f64> {
        self.fit.as_ref().map(|fit| fit.coefficient)
    }
}

impl Measured<'_> {
    /// The version with a wear coefficient, if that is free, near the measured one: a first guess may be far off, and the analytic model
    /// sets it right at a hundredth of the price of finite elements. One that is as near as the analytic model can tell stays: it may have been fitted.
    pub(in crate::learn) fn sized(&self, version: &ModelVersion) -> ModelVersion {
        let mut sized = version.clone();
        let mut free = sized.free.iter_mut();
        let Some(k) = free.find(|free| free.name == WEAR_COEFFICIENT) else {
            return sized;
        };
        let noise = NoiseModel::of(&self.study().noise);
        let own = version.own_values();
        let worn = self.worn_away(k.value);
        let begins = (worn > 1.0).then_some(WITH_TEETH * k.value / worn);
        let measured = self.by(Cheaper::Analytic, version, noise, |analytic| {
            Some(analytic.beginning_at(begins).scaled(&own)?.coefficient)
        });
        let off = |measured: &f64| worn > 1.0 || (measured / k.value).ln().abs() > ANALYTIC_ERROR;
        if let Some(measured) = measured.filter(off) {
            k.value = measured.clamp(k.lower, k.upper);
        }
        sized
    }

    /// The version with a wear coefficient, if that is free, that leaves teeth.
    pub(in crate::learn) fn with_teeth_left(&self, version: &ModelVersion) -> ModelVersion {
        if self.wears_away(version) {
            self.sized(version)
        } else {
            version.clone()
        }
    }

    /// Whether the wear coefficient with which a version's fit begins would leave no teeth in a test, so that no history with it ends.
    pub(in crate::learn) fn wears_away(&self, version: &ModelVersion) -> bool {
        let mut free = version.free.iter();
        let k = free.find(|free| free.name == WEAR_COEFFICIENT);
        k.is_some_and(|k| self.worn_away(k.value) > 1.0)
    }

    /// The deepest wear of any test, held-out ones among them, by load times a sliding as long as the flank rolls, k F' N, over what leaves no teeth.
    fn worn_away(&self, k: f64) -> f64 {
        let gears = &self.study().gears;
        let pinion = &gears.pinion;
        let depth = |torque_nmm: f64, cycles: f64| {
            k * torque_nmm / (pinion.base_radius * gears.face_width) * cycles
        };
        let all = self.study().tests.iter().map(|test| &test.conditions);
        let deepest = all
            .map(|c| depth(c.torque_nmm, c.cycles))
            .fold(0.0, f64::max);
        deepest / (WORN_AWAY * pinion.rack.module)
    }

    /// Where a fit of a version's `problem` is to start: where a cheaper model's own fit to the measurements ends, from the best of `places` and of
    /// others spread over the priors of the effect that joined last, or at the study's values if the problem's own model is nearer to the
    /// measurements there.
    ///
    /// The cheaper model is anchored: it differs from fine elements by more than a weak effect does. So it is where these are nearer
    /// to the measurements: at the study's values, or with hardly any of the effect. An effect with which fine elements cost much
    /// more than `without` it is anchored there.
    pub(in crate::learn) fn start(
        &self,
        problem: &Problem<'_>,
        version: &ModelVersion,
        places: Vec<Vec<f64>>,
        without: Option<&ScaledPrediction>,
    ) -> Start {
        let own = version.own_values();
        if version.of_last().count() == 0 {
            return Start::at(own);
        }
        let (anchor, least) = match (without, faint(version)) {
            (Some(without), Some(place)) => (Anchor::at(place, without.clone()), None),
            (_, faint) => {
                let Some(fine) = problem.scaled(&own) else {
                    return Start::at(own);
                };
                let least = fine.square;
                let faint = faint.and_then(|place| Some((problem.scaled(&place)?, place)));
                let anchor = match faint {
                    Some((scaled, place)) if scaled.square < least => Anchor::at(place, scaled),
                    _ => Anchor::at(own.clone(), fine),
                };
                (anchor, Some(least))
            }
        };
        let cheaper = Cheaper::that_starts(version);
        let Some(found) =
            self.cheaper_fit(cheaper, version, problem.noise, &anchor, places, STARTS)
        else {
            return Start::at(own);
        };
        let promised = self.misfit(&found).square;
        let values = of_effects(&found);
        let nearer = |least| {
            let begins = problem.beginning_at(Some(found.coefficient));
            let scaled = begins.scaled(&values);
            scaled.is_some_and(|scaled| scaled.square < least)
        };
        let promised = Some(promised).filter(|_| cheaper == Cheaper::that_promises(version));
        if least.is_none_or(nearer) {
            Start {
                values,
                fit: Some(found),
                promised,
            }
        } else {
            Start {
                promised,
                ..Start::at(own)
            }
        }
    }

    /// χ² of the fit tests that a fit of a version promises by a cheaper model, anchored at the model without the effect that joined last; None
    /// where that does not tell: the effect has no strength to take away.
    pub(in crate::learn) fn promised(
        &self,
        version: &ModelVersion,
        without: &ScaledPrediction,
        places: Vec<Vec<f64>>,
    ) -> Option<f64> {
        let noise = NoiseModel::of(&self.study().noise);
        let anchor = Anchor::at(faint(version)?, without.clone());
        let (starts, promises) = (
            Cheaper::that_starts(version),
            Cheaper::that_promises(version),
        );
        let mut places = places;
        // valleys are told apart by the model that starts fits
        if starts != promises
            && let Some(found) =
                self.cheaper_fit(starts, version, noise, &anchor, places.clone(), PROMISES)
        {
            places.push(of_effects(&found));
        }
        let fit = self.cheaper_fit(promises, version, noise, &anchor, places, PROMISES)?;
        Some(self.misfit(&fit).square)
    }
}

/// Values of a fit's parameters but k.
fn of_effects(fit: &Fit) -> Vec<f64> {
    let parameters = fit.parameters.iter();
    let values = parameters.filter(|p| p.name != WEAR_COEFFICIENT);
    values.map(|p| p.value).collect()
}

/// The version's own values with hardly any of the effect that joined last; None if it has no strength to take away.
fn faint(version: &ModelVersion) -> Option<Vec<f64>> {
    let before = version.free_of_effects().count() - version.of_last().count();
    let strength = |free: &FreeParameter| free.neutral.filter(|none| none.is_finite());
    version.of_last().find_map(strength)?;
    let value = |(i, free): (usize, &FreeParameter)| match strength(free) {
        Some(none) if i >= before => {
            (none + FAINT * (free.value - none)).clamp(free.lower, free.upper)
        }
        _ => free.value,
    };
    Some(version.free_of_effects().enumerate().map(value).collect())
}
