//! Those candidates that may matter are fitted by coarse finite elements, anchored at the base fit.

use rayon::prelude::*;

use super::context::Context;
use super::screening::{LOOK, SCREEN, in_play};
use crate::learn::candidates::candidate_model::{AnchoredOn, model};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::fitting::fit::is_within_noise;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::inference::search::{Effort, SearchEnd};
use crate::learn::prediction::fidelity::Fidelity;
use crate::learn::prediction::gear_model::GearModel;

/// Candidates fitted by coarse finite elements: this many, and all with this share of the leader's gain of log evidence, if they
/// gain as much as this at all.
const REFINED: usize = 3;
const REFINED_SHARE: f64 = 0.4;
pub(super) const MEANT: f64 = 1.0;
/// Share of the attainable fall of χ² with which a leader leaves nothing for a second effect, and the share of its gain that another must have then to
/// lead in its place: the analytic model knows gains to a tenth of the leader's.
const NEARLY_ALL: f64 = 0.97;
const REFINED_SHARE_OF_ALL: f64 = 0.75;
/// Candidates in play after the look, as in the screening.
const IN_PLAY: usize = 4;
/// Once more, with wider differences, where no step betters a fit that promises much: the roughness of sharp laws.
const UNSTUCK: Effort = Effort {
    settle: 1,
    ..SCREEN
};
/// Share of what the best form of an effect gains by which another must be behind to be fitted once more from where that one ended.
const BEHIND_ITS_BEST: f64 = 0.002;
/// Share of the way back that one step from there must go for the other fit to be one of the same valley.
const LEADS_BACK: f64 = 0.5;
/// Share of the leader's gain with which a law that is sharp in pressure is fitted so too: the analytic model sees that much of it.
const SHARP_SHARE: f64 = 0.15;
/// Share of the leader's gain by which a form must be behind the best form of its effect not to be fitted: the analytic model is right to a tenth of
/// that where the rate is not sharp in the pressure.
const BEHIND_FORM: f64 = 0.15;
/// Share of the leader's gain below which what moves single teeth is left to screening: the analytic model shares the load between them as
/// elements do, but for the corners.
const SINGLE_TEETH_SHARE: f64 = 0.25;
/// The same for what moves the gears to another centre distance, and so to another mesh with every step: where the teeth touch then is geometry,
/// which the analytic model knows.
const OPERATION_SHARE: f64 = 0.05;
/// Share of the leader's gain that what costs many sections (single teeth, the face) must have by screening where anything else leaves no more than
/// noise: it may still lead in its place.
const COSTLY_SHARE_OF_ALL: f64 = 0.6;

impl Context<'_> {
    /// Fits by coarse finite elements those of the screened candidates that may matter: the leaders, and where the discrepancy is real what
    /// the analytic model knows least: all whose rate is sharp in the local pressure, and, if more than wear is missed, all that change how
    /// the teeth touch, unless they cost more than their gain by screening is worth. `attainable`: the fall of χ² by anything smooth.
    pub(in crate::learn) fn refine(
        &self,
        base: &BaseFit,
        screened: Vec<FittedCandidate>,
        real: bool,
        attainable: f64,
    ) -> Vec<FittedCandidate> {
        let before = base.fitted.log_evidence;
        let mut gains: Vec<f64> = screened.iter().map(|j| j.log_evidence - before).collect();
        gains.sort_by(|a, b| b.total_cmp(a));
        let Some(best) = gains.first() else {
            return screened;
        };
        let fallen = |j: &FittedCandidate| base.fitted.square - j.square;
        let most = screened.iter().map(fallen).fold(0.0, f64::max);
        // a fit that was not followed to its end says little
        let share = |judged: &FittedCandidate| {
            let known = judged.converged && !judged.candidate.sharp();
            if known && most > NEARLY_ALL * attainable {
                REFINED_SHARE_OF_ALL
            } else {
                REFINED_SHARE
            }
        };
        let third = gains[(REFINED - 1).min(gains.len() - 1)];
        let contact_missed = real
            && self
                .likelihood
                .misses_more_than_wear(&base.fitted.found.model);
        let wanted = |judged: &FittedCandidate| {
            let candidate = &judged.candidate;
            let bar = third.min(share(judged) * best).max(MEANT);
            let bar = if real && candidate.sharp() {
                bar.min(SHARP_SHARE * best)
            } else {
                bar
            };
            let best_form = (screened.iter())
                .filter(|other| other.candidate.effects == candidate.effects)
                .map(|other| other.log_evidence)
                .fold(f64::NEG_INFINITY, f64::max);
            // forms of one effect stand or fall by the best of them, and of sharp ones the analytic model may know no more than that
            let behind = !candidate.sharp() && best_form - judged.log_evidence > BEHIND_FORM * best;
            let evidence = if real && candidate.sharp() {
                best_form
            } else {
                judged.log_evidence
            };
            evidence - before >= bar && !behind
                || contact_missed
                    && candidate.changes_contact()
                    && worth_its_cost(judged, before, *best)
        };
        let wanted: Vec<bool> = screened.iter().map(wanted).collect();
        let refined =
            self.costly_last(base, screened, &wanted, before + COSTLY_SHARE_OF_ALL * best);
        // what the leader is mistaken for is held against it by the same means
        let alike = look_alikes_left(&refined, before, (MEANT, &share));
        self.by_coarse_elements(base, refined, &alike, &[])
    }

    /// Fits those that are `wanted` by coarse finite elements, the costly ones after all others. Where one of these leaves no more than noise, costly ones are
    /// fitted only from a log evidence `least` by screening on.
    fn costly_last(
        &self,
        base: &BaseFit,
        screened: Vec<FittedCandidate>,
        wanted: &[bool],
        least: f64,
    ) -> Vec<FittedCandidate> {
        let costly: Vec<bool> = screened.iter().map(|j| j.candidate.is_costly()).collect();
        let cheap: Vec<bool> = wanted.iter().zip(&costly).map(|(w, c)| *w && !c).collect();
        let refined = self.by_coarse_elements(base, screened, &cheap, &[]);
        let fitted: Vec<&FittedCandidate> = (refined.iter().zip(&cheap))
            .filter_map(|(judged, cheap)| cheap.then_some(judged))
            .collect();
        let points = self.likelihood.len();
        let settled = fitted.iter().any(|j| is_within_noise(j.square, points));
        let known: Vec<f64> = fitted.iter().map(|j| j.found.objective).collect();
        let dear: Vec<bool> = (refined.iter().zip(wanted).zip(&costly))
            .map(|((judged, wanted), costly)| {
                *wanted && *costly && (!settled || judged.log_evidence >= least)
            })
            .collect();
        self.by_coarse_elements(base, refined, &dear, &known)
    }

    /// Fits by coarse finite elements those that are wanted; the others stay as they are. `known`: the objectives of fits that these must come near to be
    /// followed to their ends.
    fn by_coarse_elements(
        &self,
        base: &BaseFit,
        screened: Vec<FittedCandidate>,
        wanted: &[bool],
        known: &[f64],
    ) -> Vec<FittedCandidate> {
        if !wanted.contains(&true) {
            return screened;
        }
        // one model for all fits of a candidate: it keeps its histories
        let models: Vec<Option<GearModel<'_>>> = (screened.iter().zip(wanted))
            .map(|(judged, wanted)| wanted.then(|| model(self.middle, &judged.candidate)))
            .collect();
        let fit = |place: usize, start: State, effort: &Effort| -> Option<SearchEnd> {
            let predictor = AnchoredOn::new(models[place].as_ref()?, base.fitted.offset.clone());
            let parameters = &screened[place].candidate.parameters;
            let found = self.likelihood.fit(&predictor, parameters, start, effort);
            self.stages.one_done();
            found.ok()
        };
        let places = || (0..screened.len()).into_par_iter();
        let looks: Vec<Option<SearchEnd>> = places()
            .map(|place| fit(place, screened[place].found.state.clone(), &LOOK))
            .collect();
        let looked_at = (looks.iter().flatten()).map(|found| found.objective);
        let all = known.iter().copied().chain(looked_at);
        let bar = in_play(base.fitted.found.objective, all, IN_PLAY);
        let refined: Vec<Option<SearchEnd>> = (places().zip(looks))
            .map(|(place, look)| {
                Some(fitted_on(look?, bar, |start, effort| {
                    fit(place, start, effort)
                }))
            })
            .collect();
        // each fitted once more from where the best form of its effect ended, if it is far behind that
        let again: Vec<Option<SearchEnd>> = places()
            .map(|place| {
                let start = from_sibling(place, &screened, &refined, base, bar)?;
                let own = refined[place].as_ref()?;
                let there = fit(place, start.clone(), &Effort::STAY)?;
                let parameters = &screened[place].candidate.parameters;
                let led = self.likelihood.next_state(&there, parameters);
                // a step that leads back says that both lie in one valley
                let back = self.likelihood.distance(parameters, &led, &own.state)
                    < LEADS_BACK * self.likelihood.distance(parameters, &start, &own.state);
                if back && own.converged {
                    return None;
                }
                fit(place, start, &SCREEN)
            })
            .collect();
        drop(models);
        (screened.into_par_iter().zip(refined).zip(again))
            .map(|((judged, found), again)| {
                let Some(found) = found else { return judged };
                let better = again.filter(|again| again.objective < found.objective);
                self.refined(base, judged.candidate, better.unwrap_or(found))
            })
            .collect()
    }

    /// A candidate with its fit by coarse finite elements.
    pub(super) fn refined(
        &self,
        base: &BaseFit,
        candidate: Candidate,
        found: SearchEnd,
    ) -> FittedCandidate {
        let offset = base.fitted.offset.clone();
        FittedCandidate::new(
            &self.likelihood,
            candidate,
            found,
            offset,
            Some(base),
            Fidelity::Middle,
        )
    }
}

/// Which candidates are the best form of an effect that the leader is mistaken for, were not fitted by what the leader was, and gain more over
/// the base model's log evidence `before` than `least` and than this `share` of what the leader gains. Screening does not settle what changes how the
/// teeth touch, whatever it gains there: the analytic model knows of friction only the torque, not the teeth that it bends.
pub(super) fn look_alikes_left(
    fitted: &[FittedCandidate],
    before: f64,
    (least, share): (f64, &dyn Fn(&FittedCandidate) -> f64),
) -> Vec<bool> {
    let best = |of: &dyn Fn(&FittedCandidate) -> bool| {
        let all = fitted.iter().filter(|&j| of(j));
        all.max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence))
    };
    let leader = best(&|_| true).filter(|leader| leader.log_evidence > before + least);
    let left = |judged: &FittedCandidate| {
        let Some(leader) = leader else { return false };
        let bar = before + least.max(share(judged) * (leader.log_evidence - before));
        let own = &judged.candidate.effects;
        let unsettled = judged.fidelity == Fidelity::Screening
            && judged.candidate.changes_contact()
            && worth_its_cost(judged, before, leader.log_evidence - before);
        judged.candidate.is_look_alike_of(&leader.candidate)
            && judged.fidelity != leader.fidelity
            && (unsettled || judged.log_evidence > bar)
            && best(&|other| other.candidate.effects == *own)
                .is_some_and(|best| std::ptr::eq(best, judged))
    };
    fitted.iter().map(left).collect()
}

/// Whether what is costly by elements gains enough of what the leader gains over the base model's log evidence `before` to be fitted by them; all else
/// is not asked.
fn worth_its_cost(judged: &FittedCandidate, before: f64, leader: f64) -> bool {
    let gains = |share: f64| judged.log_evidence - before >= share * leader;
    let candidate = &judged.candidate;
    (!candidate.acts_on_single_teeth() || gains(SINGLE_TEETH_SHARE))
        && (!candidate.moves_the_centres() || gains(OPERATION_SHARE))
}

/// A look at a candidate fitted on if it is in play, or promises to be.
pub(super) fn fitted_on(
    look: SearchEnd,
    bar: f64,
    fit: impl Fn(State, &Effort) -> Option<SearchEnd>,
) -> SearchEnd {
    if look.objective - look.promised > bar || look.converged {
        return look;
    }
    let on = |found: SearchEnd, effort| {
        fit(found.state.clone(), effort)
            .filter(|further| further.objective <= found.objective)
            .unwrap_or(found)
    };
    let found = on(look, &SCREEN);
    if found.converged || found.iterations == SCREEN.iterations {
        found
    } else {
        on(found, &UNSTUCK)
    }
}

/// Where the best form of the same effect with the same parameters ended, if that one is in play and the candidate far behind it.
fn from_sibling(
    place: usize,
    candidates: &[FittedCandidate],
    refined: &[Option<SearchEnd>],
    base: &BaseFit,
    bar: f64,
) -> Option<State> {
    let (candidate, own) = (&candidates[place].candidate, refined[place].as_ref()?);
    let siblings = candidates.iter().zip(refined).filter_map(|(other, found)| {
        let found = found.as_ref().filter(|found| found.objective <= bar)?;
        let related = other.candidate.effects == candidate.effects
            && other.candidate.has_parameters_of(candidate);
        related.then_some(found)
    });
    let best = siblings.min_by(|a, b| a.objective.total_cmp(&b.objective))?;
    let behind = own.objective - best.objective;
    let gain = base.fitted.found.objective - best.objective;
    (behind > MEANT.max(BEHIND_ITS_BEST * gain)).then(|| best.state.clone())
}
