//! Fits by coarse finite elements in valleys that the analytic model does not know: it may hold a profile in one that finite elements do not have, or
//! let another form seem better.

use rayon::prelude::*;

use super::context::Context;
use super::medium_fidelity::{MEANT, fitted_on};
use super::screening::LOOK;
use crate::learn::candidates::candidate_model::{AnchoredOn, model};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::fitting::fit::is_within_noise;
use crate::learn::inference::quadratic::State;
use crate::learn::inference::search::{Effort, SearchEnd};
use crate::learn::prediction::fidelity::Fidelity;

/// Share of the leader's gain by which a fit may promise to be behind it to be followed.
const BEHIND_LEADER: f64 = 0.25;

impl Context<'_> {
    /// Where the leader leaves more than noise, each effect of several parameters is fitted once more from its defaults; then the leader's other forms
    /// that screening has passed over, from where it ended.
    pub(in crate::learn) fn with_other_valleys(
        &self,
        base: &BaseFit,
        mut refined: Vec<FittedCandidate>,
    ) -> Vec<FittedCandidate> {
        if let Some(leader) = leader(base, &refined)
            && !is_within_noise(refined[leader].square, self.likelihood.len())
        {
            let several_valleys = |form: &FittedCandidate| {
                form.fidelity == Fidelity::Middle
                    && form.candidate.changes_contact()
                    && form.candidate.parameters.len() > form.candidate.inherited + 1
            };
            let from_defaults = |form: &FittedCandidate| {
                let defaults = form.candidate.starts.first();
                let defaults = defaults.filter(|_| several_valleys(form))?;
                Some(base.added(&form.candidate, defaults))
            };
            refined = self.in_other_valleys(base, refined, leader, from_defaults);
        }
        let Some(place) = leader(base, &refined) else {
            return refined;
        };
        let leader = refined[place].candidate.clone();
        let end = refined[place].found.state.clone();
        let from_end = |form: &FittedCandidate| {
            let passed_over = form.fidelity == Fidelity::Screening
                && form.candidate.effects == leader.effects
                && form.candidate.has_parameters_of(&leader);
            passed_over.then(|| end.clone())
        };
        self.in_other_valleys(base, refined, place, from_end)
    }

    /// All with those fitted once more that `start` somewhere else and end better; those by the analytic model only if they end better than the leader.
    fn in_other_valleys(
        &self,
        base: &BaseFit,
        refined: Vec<FittedCandidate>,
        leader: usize,
        start: impl Fn(&FittedCandidate) -> Option<State> + Sync,
    ) -> Vec<FittedCandidate> {
        let least = refined[leader].found.objective;
        let nearly = least + BEHIND_LEADER * (base.fitted.found.objective - least);
        // sections of the face differ by what the analytic model knows, and cost too much to look again
        let fits: Vec<Option<SearchEnd>> = (refined.par_iter())
            .map(|form| {
                if form.candidate.is_costly() {
                    return None;
                }
                let found = self.in_another_valley(base, form, start(form)?, nearly)?;
                let own = match form.fidelity {
                    Fidelity::Screening => least,
                    _ => form.found.objective,
                };
                (found.objective < own).then_some(found)
            })
            .collect();
        (refined.into_iter().zip(fits))
            .map(|(form, found)| match found {
                Some(found) => self.refined(base, form.candidate, found),
                None => form,
            })
            .collect()
    }

    /// A fit of a form from a start, given up if its first steps promise to leave more than the objective `nearly`.
    fn in_another_valley(
        &self,
        base: &BaseFit,
        form: &FittedCandidate,
        start: State,
        nearly: f64,
    ) -> Option<SearchEnd> {
        let parameters = &form.candidate.parameters;
        let model = model(self.middle, &form.candidate);
        let predictor = AnchoredOn::new(&model, base.fitted.offset.clone());
        let fit = |start: State, effort: &Effort| {
            let found = self.likelihood.fit(&predictor, parameters, start, effort);
            found.ok()
        };
        let there = fit(start, &Effort::STAY)?;
        if there.objective - there.promised > nearly {
            return None;
        }
        Some(fitted_on(fit(there.state, &LOOK)?, nearly, fit))
    }
}

/// The place of the fit with the most log evidence, if it gains any and is one by coarse elements of an effect that changes how the teeth touch: of
/// others the analytic model knows the valleys.
fn leader(base: &BaseFit, refined: &[FittedCandidate]) -> Option<usize> {
    let all = refined.iter().enumerate();
    let (place, leader) = all.max_by(|a, b| a.1.log_evidence.total_cmp(&b.1.log_evidence))?;
    let gains = leader.log_evidence > base.fitted.log_evidence + MEANT;
    let by_elements = leader.fidelity == Fidelity::Middle;
    (gains && by_elements && leader.candidate.changes_contact()).then_some(place)
}
