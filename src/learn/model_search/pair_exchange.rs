//! Other partners for an effect of a fitted pair.

use rayon::prelude::*;

use super::changes_alone::ChangesAlone;
use super::context::Context;
use super::pair_fit::PROMISE;
use super::pair_fit::{self, PairStart};
use super::screening::scaled_starts;
use crate::effects::{Card, Form};
use crate::learn::candidates::candidate_model::{Anchored, model, offset, predictions};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::inference::search::Effort;

/// Other partners tried for each effect of the best pair, and the χ² per degree of freedom above 1, in standard deviations, that a
/// pair which does not lead must leave for that.
const PARTNERS: usize = 6;
const LEFT: f64 = 1.0;
/// Of these, the best after a fit by the analytic model are fitted by the middle fidelity.
const FOLLOWED: usize = 2;
const LOOK: Effort = Effort {
    iterations: 4,
    ..pair_fit::LOOK
};

/// The effects of a fitted pair that are to be tried with other partners: both if the pair beats the best single effect, for one
/// of them may stand for a look-alike that was not followed alone; the stronger one if the pair leaves more than noise.
pub(in crate::learn) fn kept<'j>(
    context: &Context<'_>,
    singles: &'j [FittedCandidate],
    pair: &FittedCandidate,
    best: &FittedCandidate,
) -> Vec<&'j FittedCandidate> {
    let mut parts: Vec<&FittedCandidate> = singles.iter().filter(|s| is_part(s, pair)).collect();
    parts.sort_by(|a, b| a.square.total_cmp(&b.square));
    let rows = context.likelihood.len() as f64;
    let leaves = pair.square > rows + LEFT * (2.0 * rows).sqrt();
    parts.truncate(if pair.log_evidence > best.log_evidence {
        2
    } else {
        usize::from(leaves)
    });
    parts
}

/// Whether a pair holds a single effect in its form.
pub(super) fn is_part(single: &FittedCandidate, pair: &FittedCandidate) -> bool {
    let name = |(card, form): (&Card, Option<&Form>)| (card.name, form.map(|form| form.name));
    let own = single.candidate.added_forms().map(name);
    let mut joint = pair.candidate.added_forms().map(name);
    own.take(1).all(|own| joint.any(|effect| effect == own))
}

/// One effect of a fitted pair (or a single one, in place of that) with other partners, or the same in another form: those whose
/// starts gain most, in the linearised analytic model, on what it leaves with its values of the pair, are fitted by the analytic model,
/// and the best of these by the middle fidelity.
pub(in crate::learn) fn fit(
    context: &Context<'_>,
    base: &BaseFit,
    (singles, alone): (&[FittedCandidate], &ChangesAlone),
    fitted: &[FittedCandidate],
    pair: &FittedCandidate,
    kept: &FittedCandidate,
) -> Vec<FittedCandidate> {
    let likelihood = &context.likelihood;
    let Some(state) = state_in(&kept.candidate, pair) else {
        return Vec::new();
    };
    let predicted = |bench, offset: &[Vec<f64>], candidate: &Candidate, state: &State| {
        let predictor = Anchored::new(model(bench, candidate), offset.to_vec());
        predictions(likelihood, &predictor, candidate, state).ok()
    };
    let by_elements = predicted(context.middle, &base.fitted.offset, &kept.candidate, &state);
    let analytic = predicted(context.hertz, &[], &kept.candidate, &state);
    let (Some(by_elements), Some(analytic)) = (by_elements, analytic) else {
        return Vec::new();
    };
    let anchor = offset(likelihood, &by_elements, &analytic);
    let left = base.left(likelihood, &likelihood.joined(&by_elements), &state);
    let analytic = likelihood.rescaled(&likelihood.joined(&analytic));
    let known = |s: &FittedCandidate| fitted.iter().any(|f| is_part(s, f) && is_part(kept, f));
    let other = |s: &FittedCandidate| s.candidate.effects != kept.candidate.effects && !known(s);
    let promising = alone.promising(context, singles, other, &left);
    let mut gains: Vec<(f64, Candidate, State)> = (singles.par_iter().zip(promising))
        .filter_map(|(s, promises)| promises.then_some(s))
        .flat_map_iter(|s| {
            let both = kept.candidate.with(&s.candidate);
            let own = &s.candidate.parameters[s.candidate.inherited..];
            let with = |values: &[f64]| State {
                theta: (state.theta.iter().copied())
                    .chain(own.iter().zip(values).map(|(p, &x)| p.natural_start(x)))
                    .collect(),
                ..state.clone()
            };
            let seen = |values: &[f64]| {
                let predicted = predicted(context.hertz, &[], &both, &with(values))?;
                let predicted = likelihood.rescaled(&likelihood.joined(&predicted));
                let change = predicted.iter().zip(&analytic).map(|(f, a)| f - a);
                Some(base.visible(&context.likelihood, &change.collect::<Vec<f64>>()))
            };
            let amplitudes = context.amplitudes(&s.candidate);
            let starts = scaled_starts(&s.candidate, amplitudes, seen, &left).into_iter();
            let starts = starts.filter(|(gain, _)| *gain > PROMISE);
            let starts = starts.map(|(gain, values)| (gain, both.clone(), with(&values)));
            starts.collect::<Vec<_>>()
        })
        .collect();
    gains.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<(f64, Candidate, State)> = Vec::new();
    for gain in gains {
        if chosen.len() < PARTNERS && chosen.iter().all(|c| c.1.effects != gain.1.effects) {
            chosen.push(gain);
        }
    }
    let looked = |both: &Candidate, start: State| {
        let predictor = Anchored::new(model(context.hertz, both), anchor.clone());
        let found = likelihood.fit(&predictor, &both.parameters, start, &LOOK);
        context.stages.one_done();
        found.ok()
    };
    let mut looks: Vec<(f64, Candidate, State)> = (chosen.into_par_iter())
        .filter_map(|(_, both, start)| {
            let found = looked(&both, start)?;
            Some((found.objective, both, found.state))
        })
        .collect();
    looks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let starts = looks.into_iter().take(FOLLOWED);
    let starts = starts.map(|(_, candidate, state)| PairStart {
        candidate,
        state,
        offset: base.fitted.offset.clone(),
    });
    pair_fit::fit(context, base, starts.collect())
}

/// A fitted pair's state with the parameters of one of its effects only.
pub(super) fn state_in(candidate: &Candidate, pair: &FittedCandidate) -> Option<State> {
    let value = |name: &str| {
        let at = (pair.candidate.parameters.iter()).position(|p| p.name == name)?;
        Some(pair.found.state.theta[at])
    };
    let theta: Option<Vec<f64>> = (candidate.parameters.iter())
        .map(|p| value(&p.name))
        .collect();
    Some(State {
        theta: theta?,
        ..pair.found.state.clone()
    })
}
