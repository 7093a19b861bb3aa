//! What a model without an effect misses: against it, a fit with the effect is seen to be hopeless, and is given up.

use std::cell::OnceCell;

use crate::learn::fitting::fit::ScaledPrediction;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::{Measured, Misfit};
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::bench::Bench;
use crate::study::Role;

/// Share of what is missed below which a fit is hopeless after a look.
const HOPELESS: f64 = 0.1;

/// Misfit beyond noise, as a share of that of noise, from which an effect can be hopeless.
const LEAST_MISSED: f64 = 0.5;

/// What a model without an effect misses, asked for only where a fit of the effect does not come to an end soon, or leaves far more than noise.
pub(super) struct BaselineMisfit<'m> {
    version: &'m ModelVersion,
    bench: &'m Bench<'m>,
    base: OnceCell<Option<Base>>,
}

/// The model without the effect where it fits best.
struct Base {
    scaled: ScaledPrediction,
    /// Of the held-out tests; None where it cannot be computed.
    held_out: Option<Misfit>,
    log_evidence: f64,
    /// Scatter of k between the tests, relative.
    scatter: f64,
}

impl<'m> BaselineMisfit<'m> {
    /// By the model without the effect, what else is free fitted anew.
    pub(super) fn by(version: &'m ModelVersion, bench: &'m Bench<'m>) -> Self {
        Self {
            version,
            bench,
            base: OnceCell::new(),
        }
    }

    /// The misfit of the model without the effect where it fits best, and its predictions at the study's own values; None where it cannot be
    /// computed.
    pub(super) fn base(&self, measured: &Measured<'_>) -> Option<&ScaledPrediction> {
        self.fitted(measured).map(|base| &base.scaled)
    }

    /// Its χ² per point of the held-out tests; None without any.
    pub(super) fn held_out(&self, measured: &Measured<'_>) -> Option<f64> {
        let Misfit { square, points } = self.fitted(measured)?.held_out?;
        (points > 0.0).then(|| square / points)
    }

    /// Its log evidence; None where it cannot be computed.
    pub(super) fn log_evidence(&self, measured: &Measured<'_>) -> Option<f64> {
        self.fitted(measured).map(|base| base.log_evidence)
    }

    /// Its scatter of k between the tests, relative; None where it cannot be computed.
    pub(super) fn scatter(&self, measured: &Measured<'_>) -> Option<f64> {
        self.fitted(measured).map(|base| base.scatter)
    }

    fn fitted(&self, measured: &Measured<'_>) -> Option<&Base> {
        let base = self.base.get_or_init(|| {
            let noise = NoiseModel::of(&measured.study().noise);
            let version = measured.with_teeth_left(self.version);
            let own = version.own_values();
            let effort = Effort {
                settle: 0,
                ..Effort::for_simulations()
            };
            measured.with_problem(self.bench, &version, noise, &|_| {}, |problem| {
                let fit = problem.fit_from(std::slice::from_ref(&own), &effort).ok()?;
                let (log_evidence, scatter) = (fit.log_evidence, fit.scatter);
                let judged = problem.judged(fit.clone(), &effort).ok();
                Some(Base {
                    scaled: ScaledPrediction {
                        square: measured.misfit(&fit).square,
                        ..problem.scaled(&own)?
                    },
                    log_evidence,
                    scatter,
                    held_out: judged.map(|fit| measured.misfit_of(Role::Holdout, &fit)),
                })
            })
        });
        base.as_ref()
    }

    /// The share that `fit` explains, if that is so little that it is hopeless.
    pub(super) fn hopeless(&self, measured: &Measured<'_>, fit: &Fit) -> Option<f64> {
        self.explained(measured, fit)
            .filter(|share| *share < HOPELESS)
    }

    /// Whether a cheaper model promises that an effect explains some of it, by χ² `promised` where it was asked already; also where it cannot tell.
    pub(super) fn promises(
        &self,
        measured: &Measured<'_>,
        version: &ModelVersion,
        promised: Option<f64>,
    ) -> bool {
        let share = || {
            let base = self.base(measured)?;
            let promised = promised.or_else(|| measured.promised(version, base, Vec::new()))?;
            let noise = measured.fitted_points() as f64;
            Some((base.square - promised) / (base.square - noise))
        };
        share().is_none_or(|share| share > HOPELESS)
    }

    /// The share of the misfit beyond noise that `fit` explains; None where it leaves little, or the model without the effect does.
    fn explained(&self, measured: &Measured<'_>, fit: &Fit) -> Option<f64> {
        let with = measured.misfit(fit);
        let points = with.points;
        if fit.converged && with.square < points * (1.0 + LEAST_MISSED) {
            return None;
        }
        let square = self.base(measured)?.square;
        let missed = square - points;
        (missed > points * LEAST_MISSED).then(|| (square - with.square) / missed)
    }
}
