//! The fits that decide: coarse finite elements say how predictions change, exact ones where they stand.

use super::anchored::{Anchored, model, offset, predictions};
use super::candidate::Candidate;
use super::judge::{Base, Judge, Judged};
use crate::learn::predictor::PredictError;
use crate::learn::quadratic::State;
use crate::learn::search::{Effort, Found};

/// A deciding fit between two anchors.
pub(super) const DECIDE: Effort = Effort {
    iterations: 8,
    tolerance: 0.05,
    floor: 0.2,
    ..Effort::STAY
};
/// The leader's last steps with derivatives of the exact model, if anchors did not bring it to rest.
const POLISH: Effort = Effort {
    iterations: 4,
    tolerance: 0.1,
    floor: 0.3,
    ..Effort::STAY
};
/// Anchors of a deciding fit.
const ANCHORS: usize = 4;
/// Gain of ln posterior for which another anchor is worth its runs.
const WORTH: f64 = 0.15;
/// The same as a share of what the candidate gains: the contact's own rounding in sharp laws grows with it.
const WORTH_SHARE: f64 = 0.003;
/// Ln posterior behind the leader, and share of its gain, from which a candidate is not followed further.
const HOPELESS: f64 = 15.0;
const HOPELESS_SHARE: f64 = 0.05;

impl Judge<'_> {
    /// Fits a candidate from a state on the exact bench, unless it turns out hopeless against the least objective so far.
    pub(super) fn decide(
        &self,
        candidate: &Candidate,
        start: State,
        base: Option<&Base>,
        least: f64,
    ) -> Result<Judged, PredictError> {
        let parameters = &candidate.parameters;
        let exact = model(self.exact, candidate);
        let cheap = model(self.middle, candidate);
        let mut state = start;
        let mut best: Option<(Found, Vec<Vec<f64>>)> = None;
        let mut converged = false;
        for _ in 0..ANCHORS {
            let at = predictions(&self.ground, &exact, candidate, &state)?;
            let near = predictions(&self.ground, &cheap, candidate, &state)?;
            let offset = offset(&self.ground, &at, &near);
            let predictor = Anchored::new(model(self.middle, candidate), offset.clone());
            let here = self
                .ground
                .fit(&predictor, parameters, state.clone(), &Effort::STAY)?;
            let next = self
                .ground
                .fit(&predictor, parameters, state.clone(), &DECIDE)?;
            let promised = here.objective - next.objective;
            let better = best
                .as_ref()
                .is_none_or(|(b, _)| here.objective < b.objective);
            let own = base.map_or(0.0, |b| b.judged.found.objective - here.objective);
            let worth = WORTH.max(WORTH_SHARE * own);
            if better {
                best = Some((here, offset));
                state = next.state.clone();
                if promised < worth {
                    converged = next.converged;
                    break;
                }
                let gain = base.map_or(0.0, |b| (b.judged.found.objective - least).max(0.0));
                if next.objective > least + HOPELESS + HOPELESS_SHARE * gain {
                    break;
                }
            } else if let Some((b, _)) = &best {
                // The cheap model's changes led too far: back half the way.
                if b.objective - next.objective < worth {
                    converged = true;
                    break;
                }
                state = between(&b.state, &state);
            }
        }
        let (mut found, offset) = best.expect("at least one anchor was taken");
        found.converged = converged;
        Ok(self.judged(candidate.clone(), found, offset, base, self.fidelity))
    }

    /// A fit on the exact bench with its own derivatives; None if it finds nothing better.
    pub(super) fn polish(&self, base: &Base, judged: &Judged) -> Option<Judged> {
        let candidate = &judged.candidate;
        let exact = model(self.exact, candidate);
        let start = judged.found.state.clone();
        let found = self
            .ground
            .fit(&exact, &candidate.parameters, start, &POLISH)
            .ok()?;
        if found.objective > judged.found.objective {
            return None;
        }
        let at = predictions(&self.ground, &exact, candidate, &found.state).ok()?;
        let cheap = model(self.middle, candidate);
        let near = predictions(&self.ground, &cheap, candidate, &found.state).ok()?;
        let offset = offset(&self.ground, &at, &near);
        Some(self.judged(candidate.clone(), found, offset, Some(base), self.fidelity))
    }
}

fn between(a: &State, b: &State) -> State {
    let mean = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect();
    State {
        log_k: 0.5 * (a.log_k + b.log_k),
        theta: mean(&a.theta, &b.theta),
        epsilon: mean(&a.epsilon, &b.epsilon),
    }
}
