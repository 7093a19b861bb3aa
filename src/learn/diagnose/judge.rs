//! Fits and evidence of candidates: screened by the analytic model, fitted by coarse finite elements, decided by fine ones.

use nalgebra::{DMatrix, DVector};

use super::anchored::{Anchored, model, offset, predictions};
use super::candidate::Candidate;
use super::fidelity::Fidelity;
use super::ground::{Ground, whiten};
use crate::learn::bench::Bench;
use crate::learn::predictor::PredictError;
use crate::learn::quadratic::State;
use crate::learn::search::{Effort, Found};
use rayon::prelude::*;

/// The first look at a candidate: two steps with the derivatives of its start.
const LOOK: Effort = Effort {
    iterations: 2,
    tolerance: 0.2,
    floor: 0.3,
    carry: 1.0,
    settle: 0,
};
/// The screening fit of those that the first look leaves in play.
const SCREEN: Effort = Effort {
    iterations: 6,
    tolerance: 0.1,
    floor: 0.3,
    carry: 0.4,
    settle: 0,
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
/// A deciding fit between two anchors.
const DECIDE: Effort = Effort {
    iterations: 8,
    tolerance: 0.05,
    floor: 0.2,
    carry: 0.4,
    settle: 0,
};
/// The leader's last steps with derivatives of the exact model, if anchors did not bring it to rest.
const POLISH: Effort = Effort {
    iterations: 4,
    tolerance: 0.1,
    floor: 0.3,
    carry: 1.0,
    settle: 0,
};
/// Taking stock of a state without leaving it.
const STAY: Effort = Effort {
    iterations: 0,
    tolerance: 0.0,
    floor: 0.0,
    carry: 0.0,
    settle: 0,
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
/// Linear gain (of ln likelihood) behind the leader's, and share of it, from which a candidate is not even looked at. Not safe
/// where all starts lie far from the truth: a coating with a small ratio was given up so.
const FAR_BEHIND: f64 = 20.0;
const FAR_BEHIND_SHARE: f64 = 0.8;
/// Most log evidence that a fit may gain, over half its fall of χ²; and what any may gain beyond.
const EXCUSED: f64 = 1.2;
const EXCUSED_AT_LEAST: f64 = 5.0;
/// Starts are scaled to the amplitude that gains most in the linearised model, but to no less than this.
pub(super) const LEAST_AMPLITUDE: f64 = 0.02;
/// Second starts are followed if their linear gain is this share of the best one's.
const SECOND_START: f64 = 0.6;

/// What is judged on, and the benches: the analytic one to screen, coarse finite elements for changes, the exact one that decides.
pub(super) struct Judge<'a> {
    pub(super) ground: Ground<'a>,
    pub(super) hertz: &'a Bench<'a>,
    pub(super) middle: &'a Bench<'a>,
    pub(super) exact: &'a Bench<'a>,
    /// By which candidates are compared at last.
    pub(super) fidelity: Fidelity,
    /// Whether that is the analytic model in place of the study's finite elements.
    pub(super) approximate: bool,
}

/// A fitted candidate.
pub(super) struct Judged {
    pub(super) candidate: Candidate,
    pub(super) found: Found,
    /// Finite elements minus the cheaper model at the fit, per test of the data set; empty without finite elements.
    pub(super) offset: Vec<Vec<f64>>,
    /// Log evidence, the effect's form taken as uncertain.
    pub(super) log_evidence: f64,
    /// Covariance of (ln k, θ).
    pub(super) covariance: DMatrix<f64>,
    /// What the added effects change of the fitted base model, per row.
    pub(super) change: Vec<f64>,
    /// χ² with the whole covariance.
    pub(super) square: f64,
    /// By what it was fitted.
    pub(super) fidelity: Fidelity,
    pub(super) converged: bool,
}

/// The base model's fit with what the screening projects out.
pub(super) struct Base {
    pub(super) judged: Judged,
    /// Orthonormal columns: whitened changes by which k and the base model's own parameters adjust.
    pub(super) adjustable: DMatrix<f64>,
    /// Whitened residual.
    pub(super) residual: DVector<f64>,
    /// Exact minus analytic model at the fit, per test of the data set.
    pub(super) hertz_offset: Vec<Vec<f64>>,
}

impl<'a> Judge<'a> {
    /// Fits the base model.
    pub(super) fn base(&self, candidate: Candidate) -> Result<Base, PredictError> {
        let start = self.ground.state(
            &candidate.parameters,
            &candidate
                .parameters
                .iter()
                .map(|p| p.start)
                .collect::<Vec<f64>>(),
        );
        let predictor = model(self.middle, &candidate);
        let found = self
            .ground
            .fit(&predictor, &candidate.parameters, start, &DECIDE)?;
        let start = found.state;
        let judged = self.decide(&candidate, start, None, f64::INFINITY)?;
        let mut adjustable = whiten(&self.ground.covariance, &judged.found.jacobian);
        orthonormalise(&mut adjustable);
        let residual = self.ground.residual(&judged.found.model);
        let hertz_offset = {
            let (candidate, state) = (&judged.candidate, &judged.found.state);
            let of = |bench| predictions(&self.ground, &model(bench, candidate), candidate, state);
            offset(&self.ground, &of(self.exact)?, &of(self.hertz)?)
        };
        Ok(Base {
            hertz_offset,
            residual: DVector::from_vec(self.ground.covariance.whiten(&residual)),
            adjustable,
            judged,
        })
    }

    /// The part of a whitened change that k and the base model's own parameters cannot make, by row values.
    pub(super) fn visible(&self, base: &Base, change: &[f64]) -> DVector<f64> {
        let v = DVector::from_vec(self.ground.covariance.whiten(change));
        let along = base.adjustable.tr_mul(&v);
        v - &base.adjustable * along
    }

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
                let effort = if hopeless { &STAY } else { &LOOK };
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
    /// leaders, and where the discrepancy is real all whose rate is sharp in the local pressure, of which the analytic model
    /// knows least.
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
                let wanted = judged.log_evidence - before >= bar;
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

    /// A candidate's starts with their gain in the linearised model, the largest first.
    fn starts(
        &self,
        base: &Base,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
    ) -> Vec<(f64, State)> {
        let mut starts: Vec<(f64, State)> = candidate
            .starts
            .iter()
            .filter_map(|values| {
                let state = self.added(base, candidate, values);
                let predicted = predictions(&self.ground, predictor, candidate, &state).ok()?;
                let joined = self.ground.rescaled(&self.ground.joined(&predicted));
                let change: Vec<f64> = (joined.iter().zip(&base.judged.found.model))
                    .map(|(f, b)| f - b)
                    .collect();
                let (gain, amplitude) = linear_gain(&self.visible(base, &change), &base.residual);
                let scaled = candidate.scaled(values, amplitude.max(LEAST_AMPLITUDE));
                Some((gain, self.added(base, candidate, &scaled)))
            })
            .collect();
        starts.sort_by(|a, b| b.0.total_cmp(&a.0));
        starts
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
        (starts.into_iter().take(if second { 2 } else { 1 }))
            .filter_map(|(_, state)| self.ground.fit(predictor, parameters, state, effort).ok())
            .min_by(|a, b| a.objective.total_cmp(&b.objective))
    }

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
                .fit(&predictor, parameters, state.clone(), &STAY)?;
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

    /// The state of the base fit with an added effect's values.
    pub(super) fn added(&self, base: &Base, candidate: &Candidate, values: &[f64]) -> State {
        let known = &base.judged.found.state;
        let own = &candidate.parameters[candidate.inherited..];
        let added = own.iter().zip(values).map(|(p, &x)| p.natural_start(x));
        State {
            theta: known.theta.iter().copied().chain(added).collect(),
            ..known.clone()
        }
    }

    pub(super) fn judged(
        &self,
        candidate: Candidate,
        found: Found,
        offset: Vec<Vec<f64>>,
        base: Option<&Base>,
        fidelity: Fidelity,
    ) -> Judged {
        let change: Vec<f64> = match base {
            Some(base) => (found.model.iter().zip(&base.judged.found.model))
                .map(|(f, b)| f - b)
                .collect(),
            None => Vec::new(),
        };
        let own = (!change.is_empty()).then_some(change.as_slice());
        let (mut log_evidence, covariance) =
            self.ground.evidence(&found, &candidate.parameters, own);
        let square = self.ground.square(&found.model);
        // the tolerance of a large change may excuse some of what a fit leaves, but not stand for what it does not explain
        if let Some(before) = base.map(|base| &base.judged) {
            let gain = 0.5 * (before.square - square);
            let most = if gain > 0.0 {
                EXCUSED * gain + EXCUSED_AT_LEAST
            } else {
                gain
            };
            log_evidence = log_evidence.min(before.log_evidence + most);
        }
        Judged {
            square,
            converged: found.converged,
            candidate,
            offset,
            log_evidence,
            covariance,
            change,
            found,
            fidelity,
        }
    }
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

/// Largest fall of χ²/2 by an amplitude between 0 and 4 of a change, and that amplitude.
pub(super) fn linear_gain(seen: &DVector<f64>, residual: &DVector<f64>) -> (f64, f64) {
    let length = seen.norm_squared();
    if length < 1e-12 {
        return (0.0, 0.0);
    }
    let along = seen.dot(residual);
    let amplitude = (along / length).clamp(0.0, 4.0);
    let gain = amplitude * along - 0.5 * amplitude * amplitude * length;
    (gain, amplitude)
}

/// Gram and Schmidt's columns of length 1, twice for rounding; dependent ones become 0.
fn orthonormalise(columns: &mut DMatrix<f64>) {
    for i in 0..columns.ncols() {
        let before = columns.column(i).norm();
        for _ in 0..2 {
            for j in 0..i {
                let share = columns.column(i).dot(&columns.column(j));
                let other = columns.column(j).into_owned();
                columns.column_mut(i).axpy(-share, &other, 1.0);
            }
        }
        let length = columns.column(i).norm();
        let scale = if length > 1e-9 * before {
            length.recip()
        } else {
            0.0
        };
        columns.column_mut(i).scale_mut(scale);
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
