//! Those candidates that may matter are fitted by coarse finite elements, anchored at the base fit.

use rayon::prelude::*;

use super::anchored::{Anchored, model};
use super::candidate::Candidate;
use super::fidelity::Fidelity;
use super::flexible::Flexible;
use super::judge::{Base, Judge, Judged};
use super::screening::{LOOK, SCREEN, in_play};
use crate::learn::quadratic::State;
use crate::learn::search::{Effort, Found};

/// Candidates fitted by coarse finite elements: this many, and all with this share of the leader's gain of log evidence, if they
/// gain as much as this at all.
const REFINED: usize = 3;
const REFINED_SHARE: f64 = 0.4;
const MEANT: f64 = 1.0;
/// Candidates in play after the look, as in the screening.
const IN_PLAY: usize = 4;
/// Share of what the best form of an effect gains by which another must be behind to be fitted once more from where that one ended.
const BEHIND_ITS_BEST: f64 = 0.002;
/// Share of the leader's gain with which a law that is sharp in pressure is fitted so too: the analytic model sees that much of it.
const SHARP_SHARE: f64 = 0.15;
/// Share of the attainable fall of χ² below which nothing explains what is there.
const EXPLAINED: f64 = 0.85;

impl Judge<'_> {
    /// Fits by coarse finite elements those of the screened candidates that may matter: the leaders, and where the discrepancy is real what
    /// the analytic model knows least: all whose rate is sharp in the local pressure, and, if more than wear is missed, all that change how
    /// the teeth touch.
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
                let start = judged.found.state.clone();
                wanted.then(|| self.fit_middle(base, candidate, start, &LOOK))?
            })
            .collect();
        let least = (looks.iter().flatten()).map(|found| found.objective);
        let bar = in_play(base.judged.found.objective, least, IN_PLAY);
        let refined: Vec<Judged> = (screened.into_par_iter().zip(looks))
            .map(|(judged, look)| match look {
                None => judged,
                Some(look) => {
                    let found = self.fitted_on(base, &judged.candidate, look, bar);
                    self.refined(base, judged.candidate, found)
                }
            })
            .collect();
        self.started_again(base, refined, bar)
    }

    /// A look at a candidate fitted on if it is in play.
    fn fitted_on(&self, base: &Base, candidate: &Candidate, look: Found, bar: f64) -> Found {
        if look.objective > bar || look.converged {
            return look;
        }
        let further = self.fit_middle(base, candidate, look.state.clone(), &SCREEN);
        further
            .filter(|further| further.objective <= look.objective)
            .unwrap_or(look)
    }

    /// Each fitted once more from where the best form of its effect ended, if it is far behind that.
    fn started_again(&self, base: &Base, refined: Vec<Judged>, bar: f64) -> Vec<Judged> {
        let before = base.judged.found.objective;
        let starts: Vec<Option<State>> = (refined.iter())
            .map(|own| from_sibling(own, &refined, before, bar))
            .collect();
        (refined.into_par_iter().zip(starts))
            .map(|(judged, start)| {
                let fit = |start| self.fit_middle(base, &judged.candidate, start, &SCREEN);
                match start.and_then(fit) {
                    Some(found) if found.objective < judged.found.objective => {
                        self.refined(base, judged.candidate, found)
                    }
                    _ => judged,
                }
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
        let anew = |judged: &Judged| {
            let candidate = &judged.candidate;
            let predictor =
                Anchored::new(model(self.middle, candidate), base.judged.offset.clone());
            let starts = self.starts(base, candidate, &predictor);
            let found = self.look(candidate, &predictor, starts, &SCREEN)?;
            let found = self.refined(base, candidate.clone(), found);
            (found.log_evidence > judged.log_evidence).then_some(found)
        };
        let all = refined.into_par_iter().map(|judged| {
            let unseen = judged.candidate.may_be_unseen();
            unseen.then(|| anew(&judged)).flatten().unwrap_or(judged)
        });
        all.collect()
    }

    fn fit_middle(
        &self,
        base: &Base,
        candidate: &Candidate,
        start: State,
        effort: &Effort,
    ) -> Option<Found> {
        let predictor = Anchored::new(model(self.middle, candidate), base.judged.offset.clone());
        let parameters = &candidate.parameters;
        self.ground.fit(&predictor, parameters, start, effort).ok()
    }

    fn refined(&self, base: &Base, candidate: Candidate, found: Found) -> Judged {
        let offset = base.judged.offset.clone();
        self.judged(candidate, found, offset, Some(base), Fidelity::Middle)
    }
}

/// Where the best form of the same effect with the same parameters ended, if that one is in play and `own` far behind it.
fn from_sibling(own: &Judged, all: &[Judged], before: f64, bar: f64) -> Option<State> {
    if own.fidelity != Fidelity::Middle {
        return None;
    }
    let siblings = all.iter().filter(|other| {
        other.fidelity == Fidelity::Middle
            && other.found.objective <= bar
            && other.candidate.names == own.candidate.names
            && other.candidate.has_parameters_of(&own.candidate)
    });
    let best = siblings.min_by(|a, b| a.found.objective.total_cmp(&b.found.objective))?;
    let behind = own.found.objective - best.found.objective;
    let far = MEANT.max(BEHIND_ITS_BEST * (before - best.found.objective));
    (behind > far).then(|| best.found.state.clone())
}
