//! Climbing: one effect after the other, each kept only if it pays.
//!
//! ```text
//! diagnosis -> proposals -> fit -> pays?  -> still needed, each of those before? -> diagnosis …
//! ```
//! Of effects that the diagnosis cannot tell apart all are fitted, and of those that pay the one is kept that makes all measurements the most
//! likely, those of the fit by evidence and the others by their error.
//!
//! An effect pays if the evidence outweighs the prior odds of nothing more against one effect of the catalogue, and the error on tests that
//! it was not fitted to does not rise beyond its own standard error, or their whole χ² by no more than one value may:
//!
//! ```text
//! ln Z_after − ln Z_before > ln(π_nothing n/π_singles)        n: single effects of the catalogue
//! χ²_after/N ≤ χ²_before/N (1 + √(2/N))  or  χ²_after ≤ χ²_before + 4      N: their points; χ² of N residuals has a relative spread of √(2/N)
//! ```

mod proposal;

pub use proposal::{Answer, Choice, Proposal, choose, proposal};

use serde::{Deserialize, Serialize};

use crate::effects::CATALOGUE;
use crate::learn::comparison::{Comparison, LeftOut};
use crate::learn::decision::DecisionRule;

/// One version of the model on the way up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClimbStep {
    /// Effects found so far, in the order in which they were added; the study's own are not among them.
    pub effects: Vec<String>,
    /// The effect that is new in this version.
    pub added: Option<String>,
    /// The effect that is left out of it.
    pub removed: Option<String>,
    /// χ² per point of the fit tests.
    pub fit_chi2_per_point: Option<f64>,
    /// Of the held-out tests; None where none is held out.
    pub holdout_chi2_per_point: Option<f64>,
    /// Of tests that are left out of the fit one at a time; only where none is held out.
    pub left_out_chi2_per_point: Option<f64>,
    /// ln evidence over the version before.
    pub log_evidence_gain: Option<f64>,
    /// Whether the version is gone on from.
    pub kept: bool,
    /// Why not.
    pub why: Option<String>,
    /// Why this effect and no other of those that the diagnosis cannot tell apart; None where there was no choice.
    #[serde(default)]
    pub choice: Option<String>,
}

/// How a version of the model stands.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Standing {
    /// χ² per point of the fit tests.
    pub fit: Option<f64>,
    /// Logarithm of the marginal likelihood.
    pub log_evidence: f64,
    /// χ² per point of the held-out tests.
    pub holdout: Option<f64>,
    /// χ² per point of the tests left out one at a time.
    pub left_out: Option<f64>,
    /// Points of the one or the other.
    pub points: usize,
}

/// Why a version does not pay.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum DoesNotPay {
    /// By evidence.
    #[error("the evidence gains {gain:.1}, one more effect must bring {least:.1}")]
    Evidence {
        /// Gain of ln Z.
        gain: f64,
        /// What it must be.
        least: f64,
    },
    /// By the error on tests that it was not fitted to.
    #[error("χ² per point of tests that it was not fitted to rises from {before:.3} to {after:.3}")]
    Predicts {
        /// Without it.
        before: f64,
        /// With it.
        after: f64,
    },
}

/// Rise of the whole χ² of tests that a version was not fitted to which is nothing by itself: two standard deviations of one value.
const LEAST_RISE: f64 = 4.0;

impl Standing {
    /// Of a fitted version, with its error on tests left out if that was asked for.
    pub fn new(comparison: &Comparison, left_out: Option<LeftOut>) -> Self {
        Self {
            fit: comparison.fit.chi2_per_point,
            log_evidence: comparison.log_evidence,
            holdout: comparison.holdout.chi2_per_point,
            left_out: left_out.map(|left_out| left_out.chi2_per_point),
            points: left_out.map_or(comparison.holdout.points, |left_out| left_out.points),
        }
    }

    /// Whether this version, with one effect more than `before`, pays.
    ///
    /// # Errors
    /// [`DoesNotPay`]: why not.
    pub fn pays_over(&self, before: &Self) -> Result<(), DoesNotPay> {
        let gain = self.log_evidence - before.log_evidence;
        let least = least_gain(&DecisionRule::default());
        if gain <= least {
            return Err(DoesNotPay::Evidence { gain, least });
        }
        let errors = [
            (before.holdout, self.holdout),
            (before.left_out, self.left_out),
        ];
        for (before, after) in errors {
            let (Some(before), Some(after)) = (before, after) else {
                continue;
            };
            let points = self.points.max(1) as f64;
            let spread = (2.0 / points).sqrt();
            // of a handful of points the standard error says little
            if after > before * (1.0 + spread) && points * (after - before) > LEAST_RISE {
                return Err(DoesNotPay::Predicts { before, after });
            }
        }
        Ok(())
    }

    /// χ² per point of tests that it was not fitted to: the held-out ones, else those left out in turn.
    pub fn error(&self) -> Option<f64> {
        self.holdout.or(self.left_out)
    }

    /// ln likelihood of all measurements up to a constant: the evidence of the fit tests and, given that fit, the error of the others.
    fn log_likelihood_of_all(&self) -> f64 {
        let of_others = self.error().map_or(0.0, |error| self.points as f64 * error);
        self.log_evidence - 0.5 * of_others
    }

    /// As a step to this version from the one `before`.
    pub fn step(&self, before: Option<&Self>, effects: Vec<String>) -> ClimbStep {
        ClimbStep {
            effects,
            added: None,
            removed: None,
            fit_chi2_per_point: self.fit,
            holdout_chi2_per_point: self.holdout,
            left_out_chi2_per_point: self.left_out,
            log_evidence_gain: before.map(|before| self.log_evidence - before.log_evidence),
            kept: true,
            why: None,
            choice: None,
        }
    }
}

/// ln of the prior odds of nothing more against one effect of the catalogue.
fn least_gain(rule: &DecisionRule) -> f64 {
    (rule.prior_nothing * CATALOGUE.len() as f64 / rule.prior_singles).ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standing(log_evidence: f64, holdout: f64) -> Standing {
        Standing {
            fit: Some(1.0),
            log_evidence,
            holdout: Some(holdout),
            left_out: None,
            points: 200,
        }
    }

    #[test]
    fn an_effect_pays_by_evidence_and_on_tests_it_was_not_fitted_to() {
        let before = standing(0.0, 2.0);
        assert!(standing(50.0, 1.0).pays_over(&before).is_ok());
        // a tenth is the standard error of 200 points
        assert!(standing(50.0, 2.19).pays_over(&before).is_ok());
        assert!(matches!(
            standing(50.0, 2.21).pays_over(&before),
            Err(DoesNotPay::Predicts { .. })
        ));
        assert!(matches!(
            standing(3.0, 1.0).pays_over(&before),
            Err(DoesNotPay::Evidence { .. })
        ));
    }

    /// Five held-out masses, of which one is 2.9 standard deviations off beside 2.2: evidence of 14 is not to be lost for that.
    #[test]
    fn a_handful_of_points_stops_nothing_by_a_little() {
        let of = |log_evidence, holdout| Standing {
            points: 5,
            ..standing(log_evidence, holdout)
        };
        let before = of(0.0, 1.0);
        assert!(of(14.4, 1.691).pays_over(&before).is_ok());
        assert!(matches!(
            of(14.4, 1.9).pays_over(&before),
            Err(DoesNotPay::Predicts { .. })
        ));
    }

    /// Bayes' rule with the rule's own priors: at the least gain nothing more and one effect of the catalogue are as probable.
    #[test]
    fn the_least_gain_makes_up_for_the_prior() {
        let rule = DecisionRule::default();
        let one = rule.prior_singles / CATALOGUE.len() as f64;
        let odds = one * least_gain(&rule).exp() / rule.prior_nothing;
        assert!((odds - 1.0).abs() < 1e-12);
    }
}
