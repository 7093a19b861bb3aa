//! Cheaper models that a fit asks before it asks fine finite elements.

use crate::effects::{Hook, ParamRole};
use crate::learn::fitting::fit::{Problem, ScaledPrediction};
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::anchored::Anchored;
use crate::learn::prediction::bench::{Workshop, for_looks};
use crate::learn::prediction::fidelity::Fidelity;
use crate::simulate::forward::{ContactKind, ForwardError};
use crate::study::{ContactKind as StudiedContact, EffectSpec, FreeParameter};

/// How far a cheaper model is fitted from each place: where it stays far from the measurements its last decimals say nothing.
const LOOK: Effort = Effort {
    iterations: 15,
    tolerance: 0.1,
    floor: 0.3,
    carry: 0.3,
    share: 2e-3,
    ..Effort::STAY
};
/// Places spread over the priors that are looked at: so many for each free parameter of an effect, and so many for a wave, whose lengths and phases all
/// have valleys of their own, unless it runs around the teeth: these meet all teeth of the other member in turn, which levels out most of its phase.
const SPREAD: usize = 8;
const WAVES: usize = 64;
/// From fewer free parameters than these, without a phase among them, the fit goes on from so many of them at most: a threshold, a length or a sign may
/// have two valleys.
const MANY: usize = 3;
const OF_FEW: usize = 2;
/// The same by finite elements, where each place costs a history: places in all, of which one is fitted on.
const BY_ELEMENTS: usize = 4;
/// How weak the waves looked at are, as a share of the prior's median: weak ones come nearer to the measurements the more they are like what
/// is missing, strong ones only if their size is right too.
const WEAK: f64 = 0.25;

/// A model cheaper than fine finite elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::learn) enum Cheaper {
    /// The analytic contact model, coarsely resolved: a hundredth of the price.
    Analytic,
    /// Coarse finite elements: a sixth of the price.
    Coarse,
}

/// How much is spent on a cheaper model's fit.
pub(in crate::learn) struct Budget {
    /// From how many of the places, at most, it is fitted.
    pub(in crate::learn) places: usize,
    /// Most steps from each by coarse elements.
    pub(in crate::learn) coarse_steps: usize,
}

/// Where a cheaper model is anchored, and what fine elements give there.
pub(in crate::learn) struct Anchor {
    place: Vec<f64>,
    fine: ScaledPrediction,
}

impl Anchor {
    pub(in crate::learn) fn at(place: Vec<f64>, fine: ScaledPrediction) -> Self {
        Self { place, fine }
    }
}

impl Cheaper {
    /// The model that tells where a fit of the effect that joined last should start.
    pub(in crate::learn) fn that_starts(version: &ModelVersion) -> Self {
        let last = version.effects.specs().last();
        // the analytic model knows of friction only the torque, and of a face one section
        let unseen =
            last.is_some_and(|last| last.hook() == Hook::Friction || last.acts_across_the_face());
        if unseen { Self::Coarse } else { Self::Analytic }
    }

    /// The model that tells how much of the misfit a fit of the effect that joined last can take away.
    pub(in crate::learn) fn that_promises(version: &ModelVersion) -> Self {
        let last = version.effects.specs().last();
        // the analytic model does not know how fast weak waves of the profile wear
        let waves = version.of_last().any(is_phase)
            && last.is_some_and(|last| last.hook() == Hook::Profile);
        if waves {
            Self::Coarse
        } else {
            Self::that_starts(version)
        }
    }
}

impl Measured<'_> {
    /// A cheaper model's fit, anchored, from the best of `places`, of others spread over the priors of the effect that joined last, of the study's
    /// own values and of the priors' medians.
    pub(in crate::learn) fn cheaper_fit(
        &self,
        cheaper: Cheaper,
        version: &ModelVersion,
        noise: NoiseModel,
        anchor: &Anchor,
        places: Vec<Vec<f64>>,
        spent: Budget,
    ) -> Option<Fit> {
        let wave = version.of_last().any(is_phase);
        let on_teeth = (version.effects.specs().last()).is_some_and(EffectSpec::acts_on_teeth);
        let smooth = (version.of_last()).all(|free| free.role == ParamRole::SmoothPart);
        let by_elements =
            cheaper == Cheaper::Coarse && self.study().contact != StudiedContact::Hertz;
        let (spread, most) = match version.of_last().count() {
            // the coefficients of a smooth function have no valleys to be told apart
            _ if smooth => (0, 0),
            // thousands of histories by elements cost more than they save
            n if by_elements && (wave || n >= MANY) => (0, 0),
            _ if by_elements => (BY_ELEMENTS, 1),
            n if wave && !on_teeth => (n * WAVES, spent.places),
            n if wave || n >= MANY => (n * SPREAD, spent.places),
            n => (n * SPREAD, OF_FEW.min(spent.places)),
        };
        self.by(cheaper, version, noise, |problem| {
            let better = anchor.fine.predictions.clone();
            let k = anchor.fine.coefficient;
            let predictor = Anchored::at(problem.predictor, k, &anchor.place, better);
            let anchored = Problem {
                predictor: &predictor.ok()?,
                parameters: problem.parameters.clone(),
                coefficient: problem.coefficient.clone(),
                ..*problem
            };
            let mut all = problem.places(spread);
            all.iter_mut().for_each(|place| settle(version, place));
            let stated = places.len().min(spent.places);
            all.extend(places);
            let mut starts = anchored.nearest(all, most.max(stated));
            let mut look = LOOK;
            match cheaper {
                Cheaper::Analytic => starts.extend([version.own_values(), version.medians()]),
                Cheaper::Coarse => {
                    look.iterations = spent.coarse_steps;
                    if starts.is_empty() {
                        starts.push(version.own_values());
                    }
                }
            }
            starts.dedup();
            anchored.fit_from(&starts, &look).ok()
        })
    }

    /// A version's problem by a cheaper model.
    pub(in crate::learn) fn by<T>(
        &self,
        cheaper: Cheaper,
        version: &ModelVersion,
        noise: NoiseModel,
        act: impl FnOnce(&Problem<'_>) -> Option<T>,
    ) -> Option<T> {
        let workshop = &self.cheaper[cheaper as usize];
        let workshop = workshop.get_or_init(|| self.cheaper_workshop(cheaper).ok());
        let bench = self.bench(workshop.as_ref()?).ok()?;
        self.with_problem(&bench, version, noise, &|_| {}, act)
    }

    fn cheaper_workshop(&self, cheaper: Cheaper) -> Result<Workshop, ForwardError> {
        let fine = self.study().resolution();
        let studied = match self.study().contact {
            StudiedContact::Hertz => ContactKind::Hertz,
            _ => ContactKind::Fem,
        };
        let (kind, numerics) = match cheaper {
            Cheaper::Analytic => (ContactKind::Hertz, for_looks(fine)),
            Cheaper::Coarse => (studied, Fidelity::Middle.resolution(fine)),
        };
        let set = self.study().gear_set();
        Workshop::new(set, numerics, kind, self.tests())
    }
}

/// A place with the effects before the last one as they are, for they have been fitted already; waves become weak.
fn settle(version: &ModelVersion, place: &mut [f64]) {
    let before = version.free_of_effects().count() - version.of_last().count();
    let wave = version.of_last().any(is_phase);
    for (i, (value, free)) in place.iter_mut().zip(version.free_of_effects()).enumerate() {
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
