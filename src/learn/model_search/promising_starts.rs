//! Which starts of a candidate are worth a prediction of every test: those that are not far behind the best one in the test that the base model
//! misses most.
//!
//! Most of what a screening costs are the first predictions at all starts. Several tests of one gear pair tell the starts of one effect apart in much the
//! same way, so one test is asked first.

use nalgebra::DVector;

use super::context::Context;
use super::screening::{SCALED, scaled_starts};
use crate::learn::candidates::candidate_model::Anchored;
use crate::learn::candidates::fitted_candidate::BaseFit;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::prediction::predictor::Predictor;

/// A start whose linear gain (of ln likelihood) in one test is not behind the best one's there by more than this is promising, and so are the best few
/// of those that have more than a share of the best one's.
const BEHIND: f64 = 10.0;
const SHARE: f64 = 0.5;
const BEST: usize = 4;

impl Context<'_> {
    /// The candidate with its promising starts; all of them where there is but one test to ask.
    pub(super) fn with_promising_starts(
        &self,
        base: &BaseFit,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
    ) -> Candidate {
        if self.likelihood.tests.len() < 2 {
            return candidate.clone();
        }
        let seen = |values: &[f64]| self.seen_in_worst_test(base, candidate, predictor, values);
        let gain = |one: &Candidate| {
            let found = scaled_starts(one, seen, &base.worst_test.residual);
            found.first().map_or(f64::NEG_INFINITY, |start| start.0)
        };
        let alone = |values: &Vec<f64>| gain(&candidate.starting(vec![values.clone()], Vec::new()));
        let wave = |pair: &[Vec<f64>; 2]| gain(&candidate.starting(Vec::new(), vec![pair.clone()]));
        let of_starts: Vec<f64> = candidate.starts.iter().map(alone).collect();
        let of_waves: Vec<f64> = candidate.quarters.iter().map(wave).collect();
        let least = least_promising(of_starts.iter().chain(&of_waves).copied());
        candidate.starting(
            kept(&candidate.starts, &of_starts, least),
            kept(&candidate.quarters, &of_waves, least),
        )
    }

    /// As [`Context::seen`], in one test and whatever its k.
    fn seen_in_worst_test(
        &self,
        base: &BaseFit,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
        values: &[f64],
    ) -> Option<DVector<f64>> {
        let (likelihood, test) = (&self.likelihood, &base.worst_test);
        let state = base.added(candidate, values);
        let (k, theta) = likelihood.arguments(&candidate.parameters, &state);
        let predicted = |factor: f64| {
            let place = test.place();
            predictor
                .predict(likelihood.tests[place], factor * k[place], &theta)
                .ok()
        };
        let mut found = predicted(1.0)?;
        let factor = test.wear_scale(likelihood, &found);
        if factor.ln().abs() >= SCALED
            && likelihood.k_does_more_than_scale(candidate.changes_contact())
        {
            found = predicted(factor)?;
        }
        Some(test.visible(likelihood, &base.fitted.found.model, &found))
    }
}

/// The least gain that is promising; none is less where there is no gain.
fn least_promising(gains: impl Iterator<Item = f64>) -> f64 {
    let mut ordered: Vec<f64> = gains.collect();
    ordered.sort_by(|a, b| b.total_cmp(a));
    let none = f64::NEG_INFINITY;
    let best = ordered.first().copied().unwrap_or(none);
    let last = ordered.get(BEST - 1).copied().unwrap_or(none);
    (best - BEHIND).min(last.max(SHARE * best))
}

/// Those with this gain or more.
fn kept<T: Clone>(all: &[T], gains: &[f64], least: f64) -> Vec<T> {
    let each = all.iter().zip(gains);
    each.filter(|(_, gain)| **gain >= least)
        .map(|(start, _)| start.clone())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{kept, least_promising};

    fn promising(gains: &[f64]) -> Vec<f64> {
        kept(gains, gains, least_promising(gains.iter().copied()))
    }

    /// Starts that one test does not tell apart stay, however many; of those that it does the best four, if they have half of what the best one has.
    #[test]
    fn starts_far_behind_in_one_test_are_left_out() {
        assert_eq!(promising(&[0.0, 3.0, 9.9, 1.0, 2.0, 0.0]).len(), 6);
        let many = [100.0, 300.0, 299.0, 291.0, 295.0, 292.0, 200.0];
        assert_eq!(promising(&many), [300.0, 299.0, 291.0, 295.0, 292.0]);
        assert_eq!(promising(&[149.0, 300.0, 151.0]), [300.0, 151.0]);
        assert_eq!(
            promising(&[280.0, 270.0, 300.0, 260.0, 250.0]),
            [280.0, 270.0, 300.0, 260.0]
        );
        let none = f64::NEG_INFINITY;
        assert_eq!(promising(&[none, none]).len(), 2);
        assert_eq!(promising(&[none, 50.0]), [50.0]);
        assert!(promising(&[]).is_empty());
    }
}
