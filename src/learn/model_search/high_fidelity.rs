//! The fits that decide: coarse finite elements say how predictions change, exact ones where they stand.

use super::context::Context;
use super::medium_fidelity::look_alikes_left;
use super::unseen::EXPLAINED;
use crate::learn::candidates::candidate_model::{Anchored, AnchoredOn, model, offset, predictions};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::fitting::fit::is_within_noise;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::inference::search::{Effort, SearchEnd};
use crate::learn::prediction::fidelity::Fidelity;
use crate::learn::prediction::predictor::PredictError;

/// A deciding fit between two anchors.
pub(in crate::learn) const DECIDE: Effort = Effort {
    iterations: 8,
    tolerance: 0.05,
    floor: 0.2,
    carry: 0.4,
    ..Effort::STAY
};
/// The leader's last steps with derivatives of the exact model, if anchors did not bring it to rest.
const POLISH: Effort = Effort {
    iterations: 4,
    tolerance: 0.1,
    floor: 0.3,
    carry: 1.0,
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

/// Log evidence behind the leader within which candidates are decided by finite elements.
const WITHIN: f64 = 10.0;
/// The same as a share of the leader's gain, for the middle fidelity's own error.
const WITHIN_SHARE: f64 = 0.02;
/// Least and most single candidates decided by finite elements.
const DECIDED: [usize; 2] = [3, 7];
/// Share of the leader's gain with which an effect that coarse finite elements have fitted may still lead, and one that the leader is mistaken for is
/// decided like it: coarse and fine finite elements agree on gains within a few per cent.
const ALIKE_SHARE: f64 = 0.85;
/// Gain of log evidence without which only the first of them is: the prior odds of one effect against nothing missing ask for 3.7.
const GAIN: f64 = 0.0;

impl Context<'_> {
    /// Fits a candidate from a state on the exact bench, unless it turns out hopeless against the least objective so far.
    pub(in crate::learn) fn decide(
        &self,
        candidate: &Candidate,
        start: State,
        base: Option<&BaseFit>,
        least: f64,
    ) -> Result<FittedCandidate, PredictError> {
        let parameters = &candidate.parameters;
        let exact = model(self.exact, candidate);
        let cheap = model(self.middle, candidate);
        let mut state = start;
        let mut best: Option<(SearchEnd, Vec<Vec<f64>>)> = None;
        let mut converged = false;
        for _ in 0..ANCHORS {
            let (at, near) = rayon::join(
                || predictions(&self.likelihood, &exact, candidate, &state),
                || {
                    // with the derivatives that the fit asks for next
                    self.likelihood.prepare(&cheap, parameters, &state);
                    predictions(&self.likelihood, &cheap, candidate, &state)
                },
            );
            let offset = offset(&self.likelihood, &at?, &near?);
            let predictor = AnchoredOn::new(&cheap, offset.clone());
            let here = self
                .likelihood
                .fit(&predictor, parameters, state.clone(), &Effort::STAY)?;
            let next = self
                .likelihood
                .fit(&predictor, parameters, state.clone(), &DECIDE)?;
            self.stages.one_done();
            let promised = here.objective - next.objective;
            let better = best
                .as_ref()
                .is_none_or(|(b, _)| here.objective < b.objective);
            let own = base.map_or(0.0, |b| b.fitted.found.objective - here.objective);
            let worth = WORTH.max(WORTH_SHARE * own);
            if better {
                best = Some((here, offset));
                state = next.state.clone();
                if promised < worth {
                    converged = next.converged;
                    break;
                }
                let gain = base.map_or(0.0, |b| (b.fitted.found.objective - least).max(0.0));
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
        Ok(FittedCandidate::new(
            &self.likelihood,
            candidate.clone(),
            found,
            offset,
            base,
            self.fidelity,
        ))
    }

    /// A fit of another form of an effect that has been decided, with that one's anchor; None if it comes to no end.
    fn anchored_on(
        &self,
        decided: &FittedCandidate,
        form: &FittedCandidate,
        base: &BaseFit,
    ) -> Option<FittedCandidate> {
        let candidate = &form.candidate;
        let cheap = model(self.middle, candidate);
        let predictor = AnchoredOn::new(&cheap, decided.offset.clone());
        let start = form.found.state.clone();
        let found = self
            .likelihood
            .fit(&predictor, &candidate.parameters, start, &DECIDE)
            .ok()
            .filter(|found| found.converged)?;
        Some(FittedCandidate::new(
            &self.likelihood,
            candidate.clone(),
            found,
            decided.offset.clone(),
            Some(base),
            self.fidelity,
        ))
    }

    /// A fit on the exact bench with its own derivatives; None if it finds nothing better.
    pub(in crate::learn) fn polish(
        &self,
        base: &BaseFit,
        judged: &FittedCandidate,
    ) -> Option<FittedCandidate> {
        let candidate = &judged.candidate;
        let exact = model(self.exact, candidate);
        let start = judged.found.state.clone();
        let found = self
            .likelihood
            .fit(&exact, &candidate.parameters, start, &POLISH)
            .ok()?;
        self.exactly(base, judged, found)
    }

    /// A fit on the exact bench that begins anew, from the best of the candidate's starts; None if it finds nothing better. Valleys of sharp laws that coarse
    /// elements tell apart wrongly are left in no other way.
    fn anew(&self, base: &BaseFit, judged: &FittedCandidate) -> Option<FittedCandidate> {
        let candidate = &judged.candidate;
        let cheap = Anchored::new(model(self.middle, candidate), base.fitted.offset.clone());
        let (_, start) = self.starts(base, candidate, &cheap).into_iter().next()?;
        let exact = model(self.exact, candidate);
        let parameters = &candidate.parameters;
        let found = (self.likelihood)
            .fit(&exact, parameters, start, &Effort::for_simulations())
            .ok()?;
        self.exactly(base, judged, found)
    }

    /// What a fit on the exact bench found, with its anchor; None if it is no better than `judged`.
    fn exactly(
        &self,
        base: &BaseFit,
        judged: &FittedCandidate,
        found: SearchEnd,
    ) -> Option<FittedCandidate> {
        if found.objective > judged.found.objective {
            return None;
        }
        let candidate = &judged.candidate;
        let exact = model(self.exact, candidate);
        let at = predictions(&self.likelihood, &exact, candidate, &found.state).ok()?;
        let cheap = model(self.middle, candidate);
        let near = predictions(&self.likelihood, &cheap, candidate, &found.state).ok()?;
        let offset = offset(&self.likelihood, &at, &near);
        Some(FittedCandidate::new(
            &self.likelihood,
            candidate.clone(),
            found,
            offset,
            Some(base),
            self.fidelity,
        ))
    }
}

/// Finite elements for the leaders of the screening; the others stay as screened. `from` and `to`: the shares of the search at which this begins and
/// ends; `attainable`: the fall of χ² by anything smooth.
pub(in crate::learn) fn decide_leaders(
    context: &Context<'_>,
    base: &BaseFit,
    mut screened: Vec<FittedCandidate>,
    attainable: f64,
    [from, to]: [f64; 2],
) -> Vec<FittedCandidate> {
    screened.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    let before = base.fitted.log_evidence;
    let leader = screened
        .first()
        .map_or(before, |j| j.log_evidence.max(before));
    let within = WITHIN + WITHIN_SHARE * (leader - before).max(0.0);
    let chosen = screened
        .iter()
        .enumerate()
        .take_while(|(i, j)| {
            let gain = j.log_evidence - before;
            let may_lead = j.fidelity == Fidelity::Screening
                || gain > ALIKE_SHARE * (leader - before) - WITHIN;
            let near = *i < DECIDED[0] && may_lead || j.log_evidence > leader - within;
            *i == 0 || *i < DECIDED[1] && near && j.log_evidence > before + GAIN
        })
        .count();
    let mut least = base.fitted.found.objective;
    let mut decided = |candidate: FittedCandidate, share: f64| {
        let at = from + (to - from) * share;
        let end = at + (to - from) / (chosen + 1) as f64;
        let doing = format!("deciding: {}", candidate.candidate.effects);
        context.stages.begin([at, end], doing, ANCHORS);
        let start = candidate.found.state.clone();
        let decided = context.decide(&candidate.candidate, start, Some(base), least);
        let decided = decided.unwrap_or(candidate);
        least = least.min(decided.found.objective);
        decided
    };
    let rest = screened.split_off(chosen);
    let mut judged: Vec<FittedCandidate> = Vec::with_capacity(screened.len() + rest.len());
    for (i, candidate) in screened.into_iter().enumerate() {
        // what fine elements make else of an effect they make of its other forms too
        let by_sibling = (judged.iter())
            .find(|form| form.converged && form.candidate.effects == candidate.candidate.effects)
            .and_then(|form| context.anchored_on(form, &candidate, base))
            .filter(|found| {
                judged
                    .iter()
                    .all(|form| form.found.objective < found.found.objective)
            });
        judged
            .push(by_sibling.unwrap_or_else(|| decided(candidate, i as f64 / (chosen + 1) as f64)));
    }
    judged.extend(rest);
    let last = chosen as f64 / (chosen + 1) as f64;
    let alike = look_alikes_left(&judged, before, (GAIN, &|_| ALIKE_SHARE));
    let mut judged: Vec<FittedCandidate> = (judged.into_iter().zip(alike))
        .map(|(j, alike)| if alike { decided(j, last) } else { j })
        .collect();
    let rest = judged.split_off(chosen);
    judged.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    if let Some(leader) = judged.first_mut().filter(|j| !j.converged) {
        let doing = format!("polishing: {}", leader.candidate.effects);
        context.stages.begin([to; 2], doing, 1);
        if let Some(better) = context.polish(base, leader) {
            *leader = better;
        }
    }
    // the right law in a wrong valley
    let left = |leader: &FittedCandidate| {
        let explained = base.fitted.square - leader.square > EXPLAINED * attainable;
        let is_noise = is_within_noise(leader.square, context.likelihood.len());
        leader.candidate.sharp() && explained && !is_noise
    };
    if let Some(leader) = judged.first_mut().filter(|j| left(j)) {
        let doing = format!("once more: {}", leader.candidate.effects);
        context.stages.begin([to; 2], doing, 1);
        if let Some(better) = context.anew(base, leader) {
            *leader = better;
        }
    }
    judged.extend(rest);
    judged
}

fn between(a: &State, b: &State) -> State {
    let mean = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect();
    State {
        log_k: 0.5 * (a.log_k + b.log_k),
        theta: mean(&a.theta, &b.theta),
        epsilon: mean(&a.epsilon, &b.epsilon),
    }
}
