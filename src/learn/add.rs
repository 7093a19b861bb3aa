//! Adds an effect: its parameters and everything else that is free are fitted anew, from where the base model's fit ended.

use super::fit::{Coefficient, Fit, FitError, Problem};
use super::search::Effort;
use crate::study::Role;

/// A base model with an effect more, in the form that fits best.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Which of the forms.
    pub form: usize,
    /// Its fit.
    pub fit: Fit,
    /// Log evidence of every form, in their order; None where a form could not be fitted.
    pub log_evidence: Vec<Option<f64>>,
    /// How much the logarithm of the marginal likelihood rises over the base model's.
    pub evidence_gain: f64,
}

/// Fits a base model with an effect added, in each accepted form of it, and returns the form of the highest evidence.
///
/// Each form is a problem whose parameters include the base model's. k and parameters that the base fit knows by name start from
/// where it ended, the effect's own from their starts (the card's defaults); from their priors' medians too, if the first fit does not
/// converge, ends on a bound or gains nothing.
///
/// # Errors
/// The first form's [`FitError`] if no form can be fitted.
pub fn add(base: &Fit, forms: Vec<Problem<'_>>, effort: &Effort) -> Result<Addition, FitError> {
    let mut best: Option<(usize, Fit)> = None;
    let mut failure = FitError::NoObservations;
    let mut log_evidence = Vec::with_capacity(forms.len());
    for (form, problem) in forms.into_iter().enumerate() {
        match problem.starting_from(base).fit_added(base, effort) {
            Ok(fit) => {
                log_evidence.push(Some(fit.log_evidence));
                if best
                    .as_ref()
                    .is_none_or(|(_, b)| fit.log_evidence > b.log_evidence)
                {
                    best = Some((form, fit));
                }
            }
            Err(error) => {
                if form == 0 {
                    failure = error;
                }
                log_evidence.push(None);
            }
        }
    }
    let (form, fit) = best.ok_or(failure)?;
    Ok(Addition {
        evidence_gain: fit.log_evidence - base.log_evidence,
        form,
        fit,
        log_evidence,
    })
}

impl Fit {
    /// Sum of the squared standardised residuals of the fit tests.
    fn fit_square(&self) -> f64 {
        let tests = self.tests.iter().filter(|test| test.role == Role::Fit);
        let rows = tests.flat_map(|test| &test.uncertainty.rows);
        rows.map(|&row| self.rows[row].standardised.powi(2)).sum()
    }
}

impl Problem<'_> {
    /// The same with k and the parameters that `base` knows by name starting where it ended. Priors stay.
    #[must_use]
    pub fn starting_from(mut self, base: &Fit) -> Self {
        if let Coefficient::Free(parameter) = &mut self.coefficient {
            parameter.start = base.coefficient;
        }
        for parameter in &mut self.parameters {
            if let Some(known) = base.parameters.iter().find(|p| p.name == parameter.name) {
                parameter.start = known.value;
            }
        }
        self
    }

    fn fit_added(&self, base: &Fit, effort: &Effort) -> Result<Fit, FitError> {
        let fit = self.fit(effort);
        // Two units of χ² are one of ln posterior.
        let enough = |fit: &Fit| {
            fit.converged
                && fit.parameters.iter().all(|p| !p.at_bound)
                && fit.fit_square() < base.fit_square() - 2.0
        };
        if fit.as_ref().is_ok_and(enough) {
            return fit;
        }
        let known = |name: &str| base.parameters.iter().any(|p| p.name == name);
        let medians: Vec<f64> = self
            .parameters
            .iter()
            .map(|p| {
                if known(&p.name) {
                    p.start
                } else {
                    p.prior.median().clamp(p.lower, p.upper)
                }
            })
            .collect();
        let second = self.fit_from(&[medians], effort);
        match (fit, second) {
            (Ok(fit), Ok(second)) if fit.log_posterior >= second.log_posterior => Ok(fit),
            (Ok(fit), Err(_)) => Ok(fit),
            (_, second) => second,
        }
    }
}
