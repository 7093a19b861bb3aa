//! Which candidates matter: all are fitted by the analytic model, those that may matter by coarse finite elements.

use nalgebra::{DVector, Matrix2, Vector2};
use rayon::prelude::*;

use super::anchored::{Anchored, model, predictions};
use super::candidate::{Candidate, LEAST_AMPLITUDE};
use super::fidelity::Fidelity;
use super::flexible::Flexible;
use super::judge::{Base, Judge, Judged, linear_gain};
use crate::learn::quadratic::State;
use crate::learn::search::{Effort, Found};

/// The first look at a candidate: two steps with the derivatives of its start.
const LOOK: Effort = Effort {
    iterations: 2,
    tolerance: 0.2,
    floor: 0.3,
    carry: 1.0,
    ..Effort::STAY
};
/// The screening fit of those that the first look leaves in play.
const SCREEN: Effort = Effort {
    iterations: 6,
    tolerance: 0.1,
    floor: 0.3,
    carry: 0.4,
    ..Effort::STAY
};
/// Candidates in play after the first look: this many (of those looked at by finite elements), and all that gained this share
/// of the leader's gain.
const IN_PLAY: usize = 8;
const IN_PLAY_REFINED: usize = 4;
const IN_PLAY_SHARE: f64 = 0.5;
/// Candidates fitted by coarse finite elements: this many, and all with this share of the leader's gain of log evidence, if they
/// gain as much as this at all.
const REFINED: usize = 3;
const REFINED_SHARE: f64 = 0.4;
const MEANT: f64 = 1.0;
/// Share of the leader's gain with which a law that is sharp in pressure is fitted so too: the analytic model sees that much of it.
const SHARP_SHARE: f64 = 0.15;
/// Share of the attainable fall of χ² below which nothing explains what is there.
const EXPLAINED: f64 = 0.85;
/// Linear gain (of ln likelihood) behind the leader's, and share of it, from which a candidate is not even looked at. Not safe
/// where all starts lie far from the truth: a coating with a small ratio was given up so.
const FAR_BEHIND: f64 = 20.0;
const FAR_BEHIND_SHARE: f64 = 0.8;
/// Second starts are followed if their linear gain is this share of the best one's.
const SECOND_START: f64 = 0.6;
/// How many starts are followed at most.
const FOLLOWED: usize = 2;
/// Change of ln k from which wear is worn anew with it.
const SCALED: f64 = 0.1;

impl Judge<'_> {
    /// Fits all candidates by the analytic model: the gain of each start in the linearised model, a first look at each candidate,
    /// then in full those that the look leaves in play.
    pub(super) fn screen(&self, base: &Base, candidates: &[Candidate]) -> Vec<Judged> {
        // one predictor for all that is asked of a candidate: it keeps its histories
        let predictors: Vec<Anchored> = candidates
            .iter()
            .map(|candidate| Anchored::new(model(self.hertz, candidate), base.hertz_offset.clone()))
            .collect();
        let starts: Vec<Vec<(f64, State)>> = (candidates.par_iter().zip(&predictors))
            .map(|(candidate, predictor)| self.starts(base, candidate, predictor))
            .collect();
        let best = |starts: &[(f64, State)]| starts.first().map_or(0.0, |s| s.0);
        let leader = starts.iter().map(|s| best(s)).fold(0.0, f64::max);
        let looks: Vec<Option<Found>> = (candidates.par_iter().zip(&predictors).zip(starts))
            .map(|((candidate, predictor), starts)| {
                let behind = leader - best(&starts);
                let hopeless = behind > FAR_BEHIND && behind > FAR_BEHIND_SHARE * leader;
                let effort = if hopeless { &Effort::STAY } else { &LOOK };
                self.look(candidate, predictor, starts, effort)
            })
            .collect();
        let least = (looks.iter().flatten()).map(|found| found.objective);
        let bar = in_play(base.judged.found.objective, least, IN_PLAY);
        (candidates.par_iter().zip(&predictors).zip(looks))
            .filter_map(|((candidate, predictor), found)| {
                let mut found = found?;
                if found.objective <= bar && !found.converged {
                    let state = found.state.clone();
                    let parameters = &candidate.parameters;
                    if let Ok(further) = self.ground.fit(predictor, parameters, state, &SCREEN) {
                        found = further;
                    }
                }
                Some(self.judged(
                    candidate.clone(),
                    found,
                    base.hertz_offset.clone(),
                    Some(base),
                    Fidelity::Screening,
                ))
            })
            .collect()
    }

    /// Fits by coarse finite elements, anchored at the base fit, those of the screened candidates that may matter: the
    /// leaders, and where the discrepancy is real what the analytic model knows least: all whose rate is sharp in the local pressure, and, if
    /// more than wear is missed, all that change how the teeth touch.
    pub(super) fn refine(&self, base: &Base, screened: Vec<Judged>, real: bool) -> Vec<Judged> {
        let before = base.judged.log_evidence;
        let mut gains: Vec<f64> = screened.iter().map(|j| j.log_evidence - before).collect();
        gains.sort_by(|a, b| b.total_cmp(a));
        let Some(best) = gains.first() else {
            return screened;
        };
        let bar = gains[(REFINED - 1).min(gains.len() - 1)]
            .min(REFINED_SHARE * best)
            .max(MEANT);
        let bar_of_sharp = if real { SHARP_SHARE * best } else { bar };
        let contact_missed = real && self.ground.misses_more_than_wear(&base.judged.found.model);
        let offset = &base.judged.offset;
        let fit = |candidate: &Candidate, state: State, effort: &Effort| {
            let predictor = Anchored::new(model(self.middle, candidate), offset.clone());
            let parameters = &candidate.parameters;
            self.ground.fit(&predictor, parameters, state, effort).ok()
        };
        let looks: Vec<Option<Found>> = (screened.par_iter())
            .map(|judged| {
                let candidate = &judged.candidate;
                let bar = if candidate.sharp() {
                    bar_of_sharp.min(bar)
                } else {
                    bar
                };
                let wanted = judged.log_evidence - before >= bar
                    || contact_missed && candidate.changes_contact();
                wanted.then(|| fit(candidate, judged.found.state.clone(), &LOOK))?
            })
            .collect();
        let least = (looks.iter().flatten()).map(|found| found.objective);
        let bar = in_play(base.judged.found.objective, least, IN_PLAY_REFINED);
        (screened.into_par_iter().zip(looks))
            .map(|(judged, look)| {
                let Some(mut found) = look else {
                    return judged;
                };
                let candidate = judged.candidate;
                if found.objective <= bar && !found.converged {
                    let further = fit(&candidate, found.state.clone(), &SCREEN);
                    found = further.unwrap_or(found);
                }
                self.judged(
                    candidate,
                    found,
                    offset.clone(),
                    Some(base),
                    Fidelity::Middle,
                )
            })
            .collect()
    }

    /// Looks by coarse finite elements, from the first starts on, for what the analytic model may not see, where no candidate explains what
    /// is there.
    pub(super) fn with_unseen(
        &self,
        base: &Base,
        refined: Vec<Judged>,
        flexible: &Flexible,
    ) -> Vec<Judged> {
        let fallen = |j: &Judged| base.judged.square - j.square;
        let most = refined.iter().map(fallen).fold(0.0, f64::max);
        if flexible.drop < flexible.spread() || most > EXPLAINED * flexible.drop {
            return refined;
        }
        let offset = &base.judged.offset;
        let anew = |judged: &Judged| {
            let candidate = &judged.candidate;
            let predictor = Anchored::new(model(self.middle, candidate), offset.clone());
            let starts = self.starts(base, candidate, &predictor);
            let found = self.look(candidate, &predictor, starts, &SCREEN)?;
            let (candidate, offset) = (candidate.clone(), offset.clone());
            let found = self.judged(candidate, found, offset, Some(base), Fidelity::Middle);
            (found.log_evidence > judged.log_evidence).then_some(found)
        };
        let all = refined.into_par_iter().map(|judged| {
            let unseen = judged.candidate.may_be_unseen();
            unseen.then(|| anew(&judged)).flatten().unwrap_or(judged)
        });
        all.collect()
    }

    /// A candidate's starts with their gain in the linearised model, the largest first.
    fn starts(
        &self,
        base: &Base,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
    ) -> Vec<(f64, State)> {
        let seen = |values: &[f64]| {
            let state = self.added(base, candidate, values);
            let (_, predicted) = self.at_measured_wear(state, candidate, predictor)?;
            let rescaled = self.ground.rescaled(&predicted);
            let change: Vec<f64> = (rescaled.iter().zip(&base.judged.found.model))
                .map(|(f, b)| f - b)
                .collect();
            Some(self.visible(base, &change))
        };
        let mut starts: Vec<(f64, State)> = scaled_starts(candidate, seen, &base.residual)
            .map(|(gain, values)| (gain, self.added(base, candidate, &values)))
            .collect();
        starts.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, state) in starts.iter_mut().take(FOLLOWED) {
            if let Some((at, _)) = self.at_measured_wear(state.clone(), candidate, predictor) {
                *state = at;
            }
        }
        starts
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
            let of_tests = predictions(&self.ground, predictor, candidate, state).ok()?;
            Some(self.ground.joined(&of_tests))
        };
        let model = predicted(&state)?;
        let more = self.ground.wear_scale(&model).ln();
        if more.abs() < SCALED
            || !self
                .ground
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

    /// A fit from the first of the starts, and from a near second.
    fn look(
        &self,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
        starts: Vec<(f64, State)>,
        effort: &Effort,
    ) -> Option<Found> {
        let best = starts.first()?.0;
        let near = |gain: f64| gain > SECOND_START * best && gain > 3.0;
        let second = effort.iterations > 0 && starts.get(1).is_some_and(|s| near(s.0));
        let parameters = &candidate.parameters;
        (starts.into_iter().take(if second { FOLLOWED } else { 1 }))
            .filter_map(|(_, state)| self.ground.fit(predictor, parameters, state, effort).ok())
            .min_by(|a, b| a.objective.total_cmp(&b.objective))
    }
}

/// A candidate's starts, brought to the amplitude and waves to the phase too that gain most on what is left in the linearised model, with
/// that gain. `seen` is the visible change by values of the added parameters.
pub(super) fn scaled_starts(
    candidate: &Candidate,
    seen: impl Fn(&[f64]) -> Option<DVector<f64>>,
    left: &DVector<f64>,
) -> impl Iterator<Item = (f64, Vec<f64>)> {
    let alone = candidate.starts.iter().map(|values| (values, None));
    let quarters = candidate.quarters.iter();
    let waves = quarters.map(|[first, second]| (first, Some(second)));
    alone.chain(waves).filter_map(move |(first, second)| {
        let along = seen(first)?;
        let Some(second) = second else {
            let (gain, amplitude) = linear_gain(&along, left);
            let amplitude = amplitude.max(LEAST_AMPLITUDE);
            return Some((gain, candidate.scaled(first, amplitude)));
        };
        let (gain, shares) = plane_gain([&along, &seen(second)?], left)?;
        Some((gain, candidate.turned(first, shares)))
    })
}

/// Largest fall of χ²/2 by any sum of two changes, and their shares in it; None if they are one.
fn plane_gain(seen: [&DVector<f64>; 2], residual: &DVector<f64>) -> Option<(f64, [f64; 2])> {
    let dot = |i: usize, j: usize| seen[i].dot(seen[j]);
    let gram = Matrix2::new(dot(0, 0), dot(0, 1), dot(1, 0), dot(1, 1));
    let along = Vector2::new(seen[0].dot(residual), seen[1].dot(residual));
    let shares = gram.cholesky()?.solve(&along);
    Some((0.5 * shares.dot(&along), [shares.x, shares.y]))
}

/// The objective up to which candidates stay in play after a first look: the best `count`, and those near the leader.
fn in_play(before: f64, looks: impl Iterator<Item = f64>, count: usize) -> f64 {
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
