//! From a study and its measurements to a fit and what it says: the one way that commands go.
//!
//! ```text
//! study, measurements -> members -> tests on the bench -> fit of what is free -> Comparison
//! ```

mod attempt;

use self::attempt::{Attempt, FirstFit};
use super::missed::BaselineMisfit;
use super::record::Comparison;
use crate::effects::ParamRole;
use crate::gear::JAM_TOLERANCE;
use crate::learn::fitting::fit::{FitError, Problem, ScaledPrediction};
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::{Measured, Misfit};
use crate::learn::fitting::starts::Start;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::bench::Bench;
use crate::measure::Dataset;
use crate::simulate::forward::{self, ForwardError};
use crate::study::{ContactKind, EffectSpec, FreeParameter, Study, StudyError, WEAR_COEFFICIENT};

/// A fit and what it says of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// The fit.
    pub fit: Fit,
    /// How wrong the fitted model is, and where.
    pub comparison: Comparison,
    /// Where the fit was given up early: the share that it had explained of what the model without its last effect misses beyond noise.
    pub given_up: Option<f64>,
    /// χ² of the fit tests that a cheaper model promised; None where none was asked.
    pub(super) promised: Option<f64>,
}

impl Compared {
    /// The same where a fit ended before its last decimals, or where its effect has no hold on the measurements: some standard deviations may be
    /// left to go.
    pub(super) fn without_intervals(mut self) -> Self {
        for parameter in &mut self.comparison.parameters {
            parameter.interval_95 = None;
        }
        self
    }
}

/// What a comparison is at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CompareStage {
    /// Meshing and condensing the members.
    Members,
    /// Preparing the tests' mesh cycles.
    Tests,
    /// Fitting.
    Fitting {
        /// Wear histories of single tests so far.
        histories: usize,
        /// About how many it will take.
        expected: usize,
    },
}

/// Whom a comparison tells what it is at; from any thread.
pub type Watch<'w> = &'w (dyn Fn(CompareStage) + Sync);

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// The study cannot be compared.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The gears or a test cannot run.
    #[error(transparent)]
    Forward(#[from] ForwardError),
    /// There is no fit.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// The contact model that measurements of a study are compared with.
///
/// # Errors
/// A [`StudyError`] for the published model: it is a printed table for one pair, with the pinion's wear alone. And for meshes
/// of the user's own: they are fine for one load and mounting, the tests of a study and the parameters of a fit ask for many.
pub fn contact_of(study: &Study) -> Result<forward::ContactKind, StudyError> {
    match study.contact {
        ContactKind::Fem => {
            let own = study.own_meshes();
            match own.into_iter().find(|(_, mesh)| mesh.is_some()) {
                Some((member, _)) => Err(study.refuse(
                    &format!("numerics.mesh_{}", member.name()),
                    "meshes of one's own are not compared with measurements",
                    "no such key, or [model] contact = \"hertz\"",
                    "without it the members are meshed finely enough for every test; `gearwear run` uses the mesh",
                )),
                None => Ok(forward::ContactKind::Fem),
            }
        }
        ContactKind::Hertz => Ok(forward::ContactKind::Hertz),
        ContactKind::Paper => Err(study.refuse(
            "model.contact",
            "the published model is not compared with measurements",
            "\"fem\" or \"hertz\"",
            "it wears the pinion alone, takes no effects and has no transmission error; `gearwear models` shows it beside the others",
        )),
    }
}

/// Fits a version of the study's model to the measurements and judges it; `version` is [`ModelVersion::of`] the study for
/// what the study itself says.
///
/// # Errors
/// [`CompareError`].
pub fn compare(
    study: &Study,
    data: &Dataset,
    version: &ModelVersion,
    watch: Watch<'_>,
) -> Result<Compared, CompareError> {
    let kind = contact_of(study)?;
    let measured = Measured::new(study, data.clone());
    watch(CompareStage::Members);
    let workshop = measured.workshop(kind)?;
    watch(CompareStage::Tests);
    let bench = measured.bench(&workshop)?;
    Ok(measured.compare(&bench, version, watch)?)
}

impl Measured<'_> {
    /// Fits a version of the model on a bench that is ready, and judges it.
    ///
    /// Once more from the priors' medians, if the fit does not converge or ends on a bound.
    ///
    /// # Errors
    /// [`FitError`].
    pub fn compare(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        watch: Watch<'_>,
    ) -> Result<Compared, FitError> {
        self.compare_from(bench, version, Vec::new(), None, watch)
    }

    /// The same where a fit may start from some places too, each a value for every free parameter but k, and is given up early where that is
    /// hopeless against `missed`.
    ///
    /// Against `missed`, a fit that leaves far more than noise is not looked for from elsewhere to its end, nor with finer wear steps: its last
    /// decimals say nothing.
    ///
    /// # Errors
    /// [`FitError`].
    pub(super) fn compare_from(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        places: Vec<Vec<f64>>,
        missed: Option<&BaselineMisfit<'_>>,
        watch: Watch<'_>,
    ) -> Result<Compared, FitError> {
        let noise = NoiseModel::of(&self.study().noise);
        let one_valley = smooth(version);
        let effort = if one_valley {
            SMOOTH
        } else {
            Effort::for_simulations()
        };
        let effort = Effort {
            share: missed.map_or(effort.share, |_| FAR_SHARE),
            ..effort
        };
        let expected = self.roles.len() * HISTORIES_PER_TEST * (1 + version.free.len());
        let told = |histories| {
            watch(CompareStage::Fitting {
                histories,
                expected,
            });
        };
        told(0);
        let has_effects = bench.is_elastic() && !version.effects.is_empty();
        let sized = has_effects || self.wears_away(version);
        let version = &if sized {
            self.sized(version)
        } else {
            version.clone()
        };
        let dear = version.effects.specs().last().is_some_and(multiplies_work);
        let chosen = version
            .of_last()
            .any(|free| free.value != free.prior.median().clamp(free.lower, free.upper));
        // values that somebody chose may be nearer to the measurements than the model without the effect
        let anchor = missed.filter(|_| dear || !chosen);
        let without = anchor.and_then(|missed| missed.base(self));
        self.with_problem(bench, version, noise, &told, |problem| {
            let start = self.start_of(problem, version, places, without);
            let promised = start.promised;
            let attempt = Attempt {
                measured: self,
                problem: &problem.beginning_at(start.coefficient()),
                version,
                start: &start,
                missed,
                effort: &effort,
                dear,
            };
            let first = match attempt.first(without.is_some())? {
                FirstFit::Hopeless { fit, share } => {
                    let mut compared = self.compared(bench, version, fit, promised);
                    // what a fit that was given up warns of says nothing of the measurements
                    compared.comparison.warnings.clear();
                    return Ok(Compared {
                        given_up: Some(share),
                        ..compared.without_intervals()
                    });
                }
                FirstFit::Hopeful(fit) => fit,
            };
            let fit = if one_valley {
                first
            } else {
                attempt.best_of_starts(first)
            };
            if attempt.is_far(&fit) {
                let fit = attempt.problem.judged(fit, &effort)?;
                return Ok(self
                    .compared(bench, version, fit, promised)
                    .without_intervals());
            }
            let fit = self.refined(bench, version, attempt.problem, fit, &effort, &told)?;
            let misfit = self.misfit(&fit);
            let mut compared = self.compared(bench, version, fit, promised);
            if misfit.is_far()
                && version
                    .free
                    .iter()
                    .any(|free| free.name != WEAR_COEFFICIENT)
            {
                compared.comparison.warnings.push(far(misfit));
            }
            Ok(compared)
        })
    }

    /// Values that somebody has chosen or fitted, for they may leave nothing to look for, or else what a cheaper model finds.
    fn start_of(
        &self,
        problem: &Problem<'_>,
        version: &ModelVersion,
        places: Vec<Vec<f64>>,
        without: Option<&ScaledPrediction>,
    ) -> Start {
        let own = version.own_values();
        if version.is_chosen() && own != version.medians() && problem.is_within_noise(&own) {
            return Start::at(own);
        }
        self.start(problem, version, places, without)
    }

    /// A fit with what it says of the model.
    fn compared(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        fit: Fit,
        promised: Option<f64>,
    ) -> Compared {
        let mut comparison = Comparison::new(self.study(), &self.data, &fit);
        let closed = self.closed_backlash(bench, version, &fit);
        comparison.warnings.extend(closed);
        let study = self.study();
        let face = study.warnings_on_places_across_the_face(&self.data, &version.effects);
        comparison.warnings.extend(face);
        let teeth = study.warning_on_teeth(&self.data, &version.effects);
        comparison.warnings.extend(teeth);
        Compared {
            fit,
            comparison,
            given_up: None,
            promised,
        }
    }

    /// What to say where the fitted effects bring the axes so close that teeth of full thickness would jam.
    fn closed_backlash(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        fit: &Fit,
    ) -> Option<String> {
        let fitted = |name: &str| {
            let parameter = fit.parameters.iter().find(|p| p.name == name);
            parameter.map(|p| p.value)
        };
        let of_test = |test| {
            Some((
                test,
                bench.moved_backlash(test, version.effects.build(&fitted))?,
            ))
        };
        let all = (0..bench.tests.len()).filter_map(of_test);
        let (test, least) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (-least > JAM_TOLERANCE * bench.set().gears[0].rack.module).then(|| {
            format!(
                "the effects bring the axes so close in test {} that teeth of full thickness would overlap by {:.1} µm: the model takes \
                 them to be thinner; state thickness_reduction if they are",
                self.study().tests[test].id,
                -1e3 * least
            )
        })
    }

    /// The fit followed on with the finest wear steps; then the held-out tests.
    fn refined(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        problem: &Problem<'_>,
        fit: Fit,
        effort: &Effort,
        watch: &(dyn Fn(usize) + Sync),
    ) -> Result<Fit, FitError> {
        let Ok(Some(finest)) = bench.finest() else {
            return problem.judged(fit, effort);
        };
        self.with_problem(&finest, version, problem.noise, watch, |finest| {
            match finest.go_on(&fit, effort) {
                Ok(next) => {
                    let next = Fit {
                        iterations: fit.iterations + next.iterations,
                        evaluations: fit.evaluations + next.evaluations,
                        ..next
                    };
                    finest.judged(next, effort)
                }
                // finer steps that fail say nothing against the coarser ones
                Err(_) => problem.judged(fit, effort),
            }
        })
    }
}

/// What the parameters' intervals are worth where far more than noise is left.
fn far(misfit: Misfit) -> String {
    format!(
        "\u{3c7}\u{b2} is {:.2} per point: the intervals of the fitted parameters count the noise alone, and hold only for a model that leaves no more than that",
        misfit.square / misfit.points
    )
}

/// Whether nothing is free but k and the parts of smooth functions: these have no valleys of their own, so that another start ends in the same one.
fn smooth(version: &ModelVersion) -> bool {
    let mut effects = (version.free.iter()).filter(|free| free.name != WEAR_COEFFICIENT);
    let is_part = |free: &FreeParameter| free.role == ParamRole::SmoothPart;
    version.free.len() > 1 && effects.all(is_part)
}

/// Fits of smooth functions: many parameters, of which the last hardly matter, so that what derivatives promise is their own error. A step
/// that gains little of it is none, and known to half of ln posterior is known enough.
const SMOOTH: Effort = Effort {
    iterations: 15,
    tolerance: 0.1,
    floor: 0.5,
    carry: 0.3,
    settle: 2,
    share: 3e-4,
    gain: 0.1,
};

/// Part of the misfit beyond noise that a fit of an effect more may leave of ln posterior: what such a fit is asked is how much the effect takes away.
pub(super) const FAR_SHARE: f64 = 2e-3;

/// Whether an effect multiplies the work of fine elements: by the slices of the face, or by the teeth that differ.
fn multiplies_work(effect: &EffectSpec) -> bool {
    effect.acts_across_the_face() || effect.acts_on_teeth()
}

/// Wear histories of one test that a fit of one parameter takes, from experience.
const HISTORIES_PER_TEST: usize = 6;
