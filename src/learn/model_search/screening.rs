//! Which candidates matter: all are looked at by the analytic model, those that stay in play are fitted by it.

use nalgebra::{DVector, Matrix2, Vector2};
use rayon::prelude::*;

use super::context::Context;
use crate::learn::candidates::candidate_model::{Anchored, model, predictions};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::candidate::{Candidate, LEAST_AMPLITUDE};
use crate::learn::inference::quadratic::State;
use crate::learn::inference::search::{Effort, SearchEnd};
use crate::learn::prediction::fidelity::Fidelity;

/// The first look at a candidate: two steps with the derivatives of its start.
pub(in crate::learn) const LOOK: Effort = Effort {
    iterations: 2,
    tolerance: 0.2,
    floor: 0.3,
    carry: 1.0,
    ..Effort::STAY
};
/// The screening fit of those that the first look leaves in play.
pub(in crate::learn) const SCREEN: Effort = Effort {
    iterations: 6,
    tolerance: 0.1,
    floor: 0.3,
    carry: 0.4,
    ..Effort::STAY
};
/// Candidates in play after the first look: this many, and all that gained this share of the leader's gain.
const IN_PLAY: usize = 8;
const IN_PLAY_SHARE: f64 = 0.5;
/// Linear gain (of ln likelihood) behind the leader's, and share of it, from which a candidate is not even looked at. Not safe
/// where all starts lie far from the truth: a coating with a small ratio was given up so.
const FAR_BEHIND: f64 = 20.0;
const FAR_BEHIND_SHARE: f64 = 0.8;
/// Second starts are followed if their linear gain is this share of the best one's.
const SECOND_START: f64 = 0.6;
/// Amplitudes of starts; across the face, where a lead does little at mid-face until it lifts an end of the face off, and much from there on, near
/// ones only. Off mid-face small leads act in proportion.
const AMPLITUDES: [f64; 2] = [0.0, 4.0];
const NEAR_AMPLITUDES: [f64; 2] = [2.0 / 3.0, 1.5];
/// Difference of two gains, relative, below which the starts are mirror images.
const MIRRORED: f64 = 1e-6;
/// How far apart in their priors' standard deviations two starts must be in some parameter for both to be followed: nearer ones, brought to the
/// amplitude that gains most, end in one place.
const APART: f64 = 0.25;
/// Change of ln k from which wear is worn anew with it.
const SCALED: f64 = 0.1;

impl Context<'_> {
    /// Fits all candidates by the analytic model: the gain of each start in the linearised model, a first look at each candidate,
    /// then in full those that the look leaves in play.
    pub(in crate::learn) fn screen(
        &self,
        base: &BaseFit,
        candidates: &[Candidate],
    ) -> Vec<FittedCandidate> {
        // one predictor for all that is asked of a candidate: it keeps its histories
        let predictors: Vec<Anchored> = candidates
            .iter()
            .map(|candidate| Anchored::new(model(self.hertz, candidate), base.hertz_offset.clone()))
            .collect();
        let starts: Vec<Vec<(f64, State)>> = (candidates.par_iter().zip(&predictors))
            .map(|(candidate, predictor)| {
                let starts = self.starts(base, candidate, predictor);
                self.stages.one_done();
                starts
            })
            .collect();
        let best = |starts: &[(f64, State)]| starts.first().map_or(0.0, |s| s.0);
        let leader = starts.iter().map(|s| best(s)).fold(0.0, f64::max);
        let looks: Vec<Option<SearchEnd>> = (candidates.par_iter().zip(&predictors).zip(starts))
            .map(|((candidate, predictor), starts)| {
                let behind = leader - best(&starts);
                let hopeless = behind > FAR_BEHIND && behind > FAR_BEHIND_SHARE * leader;
                let effort = if hopeless { &Effort::STAY } else { &LOOK };
                let look = self.look(candidate, predictor, starts, effort);
                self.stages.one_done();
                look
            })
            .collect();
        let least = (looks.iter().flatten()).map(|found| found.objective);
        let bar = in_play(base.fitted.found.objective, least, IN_PLAY);
        (candidates.par_iter().zip(&predictors).zip(looks))
            .filter_map(|((candidate, predictor), found)| {
                let mut found = found?;
                if found.objective - found.promised <= bar && !found.converged {
                    let state = found.state.clone();
                    let parameters = &candidate.parameters;
                    if let Ok(further) = self.likelihood.fit(predictor, parameters, state, &SCREEN)
                    {
                        found = further;
                    }
                }
                Some(FittedCandidate::new(
                    &self.likelihood,
                    candidate.clone(),
                    found,
                    base.hertz_offset.clone(),
                    Some(base),
                    Fidelity::Screening,
                ))
            })
            .collect()
    }

    /// A candidate's starts with their gain in the linearised model, the largest first.
    pub(in crate::learn) fn starts(
        &self,
        base: &BaseFit,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
    ) -> Vec<(f64, State)> {
        let seen = |values: &[f64]| self.seen(base, candidate, predictor, values);
        let amplitudes = self.amplitudes(candidate);
        let mut starts: Vec<(f64, State)> =
            scaled_starts(candidate, amplitudes, seen, &base.residual)
                .into_iter()
                .map(|(gain, values)| (gain, base.added(candidate, &values)))
                .collect();
        starts.sort_by(|a, b| b.0.total_cmp(&a.0));
        starts
    }

    /// Amplitudes of a start's change between which the linearised model is trusted.
    pub(super) fn amplitudes(&self, candidate: &Candidate) -> [f64; 2] {
        if !candidate.acts_across_the_face() {
            return AMPLITUDES;
        }
        let [least, most] = NEAR_AMPLITUDES;
        if candidate.is_own_form() && self.likelihood.states_places_off_mid_face() {
            [0.0, most]
        } else {
            [least, most]
        }
    }

    /// The visible change of the fitted base model by a candidate with these values of the added parameters; None if it has no answer there.
    pub(super) fn seen(
        &self,
        base: &BaseFit,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
        values: &[f64],
    ) -> Option<DVector<f64>> {
        let state = base.added(candidate, values);
        let (_, predicted) = self.at_measured_wear(state, candidate, predictor)?;
        let rescaled = self.likelihood.rescaled(&predicted);
        let change: Vec<f64> = (rescaled.iter().zip(&base.fitted.found.model))
            .map(|(f, b)| f - b)
            .collect();
        Some(base.visible(&self.likelihood, &change))
    }

    /// The state, with its predictions, where k may have to be another one to bring wear to the size of what was measured: neither a
    /// transmission error nor how wear shifts load between pairs scales with k as wear does.
    fn at_measured_wear(
        &self,
        state: State,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
    ) -> Option<(State, Vec<f64>)> {
        let predicted = |state: &State| {
            let of_tests = predictions(&self.likelihood, predictor, candidate, state).ok()?;
            Some(self.likelihood.joined(&of_tests))
        };
        let model = predicted(&state)?;
        let more = self.likelihood.wear_scale(&model).ln();
        if more.abs() < SCALED
            || !self
                .likelihood
                .k_does_more_than_scale(candidate.changes_contact())
        {
            return Some((state, model));
        }
        let state = State {
            log_k: state.log_k + more,
            ..state
        };
        let model = predicted(&state)?;
        Some((state, model))
    }

    /// A fit from the first of the starts, and from a near second that is not its mirror image; where the model has no answer there (axes that jam), from
    /// the first of the others at which it has one.
    pub(in crate::learn) fn look(
        &self,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
        starts: Vec<(f64, State)>,
        effort: &Effort,
    ) -> Option<SearchEnd> {
        let (best, first) = starts.first()?;
        let parameters = &candidate.parameters;
        let near = |gain: f64| gain > SECOND_START * best && gain > 3.0;
        let differs = |gain: f64| (best - gain).abs() > MIRRORED * best.abs();
        let apart = |state: &State| self.likelihood.distance(parameters, first, state) > APART;
        let second = (starts.iter()).position(|s| near(s.0) && differs(s.0) && apart(&s.1));
        let second = second.filter(|_| effort.iterations > 0);
        let is_followed = |i: usize| i == 0 || Some(i) == second;
        let fit = |state: &State| {
            let state = match effort.iterations {
                // not fitted on: k stays where the base model is best
                0 => state.clone(),
                _ => self
                    .at_measured_wear(state.clone(), candidate, predictor)
                    .map_or_else(|| state.clone(), |(at, _)| at),
            };
            let found = self.likelihood.fit(predictor, parameters, state, effort);
            found.ok()
        };
        let (followed, others): (Vec<_>, Vec<_>) =
            (starts.iter().enumerate()).partition(|(i, _)| is_followed(*i));
        let fits = followed.iter().filter_map(|(_, (_, state))| fit(state));
        fits.min_by(|a, b| a.objective.total_cmp(&b.objective))
            .or_else(|| others.iter().find_map(|(_, (_, state))| fit(state)))
    }
}

/// A candidate's starts, brought to the amplitude and waves to the phase too that gain most on what is left in the linearised model, with
/// that gain. `amplitudes`: least and largest one; `seen`: the visible change by values of the added parameters.
pub(in crate::learn) fn scaled_starts(
    candidate: &Candidate,
    amplitudes: [f64; 2],
    seen: impl Fn(&[f64]) -> Option<DVector<f64>>,
    left: &DVector<f64>,
) -> Vec<(f64, Vec<f64>)> {
    let alone = candidate.starts.iter().map(|values| (values, None));
    let quarters = candidate.quarters.iter();
    let waves = quarters.map(|[first, second]| (first, Some(second)));
    // a wave that joins others is held against what those leave
    let others = candidate.without_wave.as_deref().and_then(&seen);
    let of_others = |seen: DVector<f64>| match &others {
        Some(others) => seen - others,
        None => seen,
    };
    let gain_of_others =
        (others.as_ref()).map_or(0.0, |others| others.dot(left) - 0.5 * others.norm_squared());
    let left = others
        .as_ref()
        .map_or_else(|| left.clone(), |others| left - others);
    let all = alone.chain(waves).filter_map(|(first, second)| {
        let along = of_others(seen(first)?);
        let Some(second) = second else {
            let (gain, amplitude) = linear_gain(&along, &left, amplitudes);
            let amplitude = amplitude.max(LEAST_AMPLITUDE);
            return Some((gain, candidate.scaled(first, amplitude)));
        };
        let (gain, shares) = plane_gain([&along, &of_others(seen(second)?)], &left)?;
        Some((gain_of_others + gain, candidate.turned(first, shares)))
    });
    all.collect()
}

/// Largest fall of χ²/2 by one of the `amplitudes` of a change, and that amplitude.
pub(super) fn linear_gain(
    seen: &DVector<f64>,
    residual: &DVector<f64>,
    [least, most]: [f64; 2],
) -> (f64, f64) {
    let length = seen.norm_squared();
    if length < 1e-12 {
        return (0.0, 0.0);
    }
    let along = seen.dot(residual);
    let amplitude = (along / length).clamp(least, most);
    let gain = amplitude * along - 0.5 * amplitude * amplitude * length;
    (gain, amplitude)
}

/// Largest fall of χ²/2 by any sum of two changes, and their shares in it; None if they are one.
pub(super) fn plane_gain(
    seen: [&DVector<f64>; 2],
    residual: &DVector<f64>,
) -> Option<(f64, [f64; 2])> {
    let dot = |i: usize, j: usize| seen[i].dot(seen[j]);
    let gram = Matrix2::new(dot(0, 0), dot(0, 1), dot(1, 0), dot(1, 1));
    let along = Vector2::new(seen[0].dot(residual), seen[1].dot(residual));
    let shares = gram.cholesky()?.solve(&along);
    Some((0.5 * shares.dot(&along), [shares.x, shares.y]))
}

/// The objective up to which candidates stay in play after a first look: the best `count`, and those near the leader.
pub(in crate::learn) fn in_play(
    before: f64,
    looks: impl Iterator<Item = f64>,
    count: usize,
) -> f64 {
    let mut objectives: Vec<f64> = looks.collect();
    objectives.sort_by(f64::total_cmp);
    let Some(leader) = objectives.first() else {
        return before;
    };
    let share = before - IN_PLAY_SHARE * (before - leader).max(0.0);
    objectives[(count - 1).min(objectives.len() - 1)].max(share)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is a sum of two changes is explained whole, by its own shares; what stands across both is left.
    #[test]
    fn a_plane_of_two_changes_explains_their_sums() {
        let (a, b) = (
            DVector::from_vec(vec![1.0, 2.0, 0.0, 1.0]),
            DVector::from_vec(vec![0.5, -1.0, 1.0, 0.0]),
        );
        // (4, 1, −1, −6) stands across both
        let sum = 2.0 * &a - 3.0 * &b;
        let residual = &sum + DVector::from_vec(vec![4.0, 1.0, -1.0, -6.0]);
        let (gain, shares) = plane_gain([&a, &b], &residual).unwrap();
        assert!((shares[0] - 2.0).abs() < 1e-12 && (shares[1] + 3.0).abs() < 1e-12);
        assert!((gain - 0.5 * sum.norm_squared()).abs() < 1e-12);
        assert!(plane_gain([&a, &(0.0 * &a)], &residual).is_none());
    }
}
