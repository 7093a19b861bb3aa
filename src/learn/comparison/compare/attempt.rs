//! A fit from one start or from several, and given up early where it is hopeless.

use crate::learn::comparison::missed::BaselineMisfit;
use crate::learn::fitting::fit::{FitError, Problem};
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::fitting::starts::Start;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;

/// A fit that is far from the measurements, and by no more than this share of χ² farther than a cheaper model promises of the best of several starts,
/// is not looked for from elsewhere.
const ATTAINED: f64 = 0.05;

/// Steps after which it is looked at whether a fit is hopeless.
const LOOK_STEPS: usize = 6;

/// A version of the model to be fitted, and from where.
pub(super) struct Attempt<'a> {
    pub(super) measured: &'a Measured<'a>,
    pub(super) problem: &'a Problem<'a>,
    pub(super) version: &'a ModelVersion,
    pub(super) start: &'a Start,
    /// What the model without its last effect misses, if a hopeless fit may be given up.
    pub(super) missed: Option<&'a BaselineMisfit<'a>>,
    pub(super) effort: &'a Effort,
    /// Whether the last effect multiplies the work.
    pub(super) dear: bool,
}

/// The fit from the first start.
pub(super) enum FirstFit {
    /// It explains only this share of what the model without its last effect misses beyond noise.
    Hopeless {
        fit: Fit,
        share: f64,
    },
    Hopeful(Fit),
}

impl Attempt<'_> {
    /// From its start; `anchored` where a cheaper model's end is known on this bench.
    pub(super) fn first(&self, anchored: bool) -> Result<FirstFit, FitError> {
        let Some(missed) = self.missed else {
            let fit = self.from(self.start.values.clone(), self.effort)?;
            return Ok(FirstFit::Hopeful(fit));
        };
        let little = self.dear
            && anchored
            && !missed.promises(self.measured, self.version, self.start.promised);
        let fit = self.look(missed, little)?;
        if let Some(share) = missed.hopeless(self.measured, &fit) {
            // not worth the price of the held-out tests
            let fit = if self.dear {
                fit
            } else {
                self.problem.judged(fit, self.effort)?
            };
            return Ok(FirstFit::Hopeless { fit, share });
        }
        let fit = if fit.converged {
            fit
        } else {
            self.go_on(&fit)?
        };
        Ok(FirstFit::Hopeful(fit))
    }

    /// A look at a fit against what the model without its last effect `missed`: where a cheaper model promises `little` at that model's end, else some
    /// steps from the start, and if these are hopeless though more is promised, from the priors' medians too.
    fn look(&self, missed: &BaselineMisfit<'_>, little: bool) -> Result<Fit, FitError> {
        let is_hopeless = |fit: &Fit| missed.hopeless(self.measured, fit).is_some();
        if little
            && let Some(cheaper) = &self.start.fit
            && let Ok(fit) = self.problem.go_on(cheaper, &Effort::STAY)
            && is_hopeless(&fit)
        {
            return Ok(fit);
        }
        let first = self.from(self.start.values.clone(), &self.look_effort())?;
        if is_hopeless(&first) && missed.promises(self.measured, self.version, self.start.promised)
        {
            let second = self.from(self.version.medians(), &self.look_effort()).ok();
            let better =
                second.filter(|second| second.attained_evidence() > first.attained_evidence());
            return Ok(better.unwrap_or(first));
        }
        Ok(first)
    }

    /// The first fit or, where that has not settled or leaves more than noise, the one from the priors' medians if it attains more evidence: a cheaper
    /// model may have led the first one into a valley of its own.
    pub(super) fn best_of_starts(&self, first: Fit) -> Fit {
        let done = first.is_settled() && self.measured.misfit(&first).is_noise();
        if done || self.version.effects.is_empty() || self.attains_promise(&first) {
            return first;
        }
        let attained = first.attained_evidence();
        let medians = self.version.medians();
        if first.is_settled() && self.start.values == medians {
            return first;
        }
        let second = if first.is_settled() || self.is_far(&first) {
            (self.from(medians, &self.look_effort()).ok())
                .filter(|second| second.attained_evidence() > attained)
                .and_then(|second| self.go_on(&second).ok())
        } else {
            self.from(medians, self.effort).ok()
        };
        second
            .filter(|second| second.attained_evidence() > attained + self.effort.tolerance)
            .unwrap_or(first)
    }

    /// Whether a fit that may be given up leaves far more than noise.
    pub(super) fn is_far(&self, fit: &Fit) -> bool {
        self.missed.is_some() && self.measured.misfit(fit).is_far()
    }

    /// Whether a far fit leaves about what the cheaper model promised.
    fn attains_promise(&self, fit: &Fit) -> bool {
        let near = |promised| self.measured.misfit(fit).square < (1.0 + ATTAINED) * promised;
        self.is_far(fit) && self.start.promised.is_some_and(near)
    }

    /// A look followed to its end.
    fn go_on(&self, look: &Fit) -> Result<Fit, FitError> {
        let end = self.problem.go_on(look, self.effort)?;
        Ok(Fit {
            iterations: look.iterations + end.iterations,
            evaluations: look.evaluations + end.evaluations,
            ..end
        })
    }

    fn from(&self, start: Vec<f64>, effort: &Effort) -> Result<Fit, FitError> {
        self.problem.fit_from(&[start], effort)
    }

    fn look_effort(&self) -> Effort {
        Effort {
            iterations: LOOK_STEPS,
            ..*self.effort
        }
    }
}
