//! Other partners for an effect of a fitted pair.

use nalgebra::DVector;
use rayon::prelude::*;

use super::anchored::{Anchored, model, offset, predictions};
use super::candidate::{Candidate, LEAST_AMPLITUDE};
use super::judge::{Base, Judge, Judged, linear_gain};
use super::pair_fit::{self, PairStart};
use super::pairs::PROMISE;
use crate::learn::quadratic::State;
use crate::learn::search::Effort;

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
pub(super) fn kept<'j>(
    judge: &Judge<'_>,
    singles: &'j [Judged],
    pair: &Judged,
    best: &Judged,
) -> Vec<&'j Judged> {
    let part = |s: &&Judged| {
        let (own, joint) = (&s.candidate, &pair.candidate);
        let mut effects = joint.names.iter().zip(&joint.forms);
        effects.any(|effect| effect == (&own.names[0], &own.forms[0]))
    };
    let mut parts: Vec<&Judged> = singles.iter().filter(part).collect();
    parts.sort_by(|a, b| a.square.total_cmp(&b.square));
    let rows = judge.ground.len() as f64;
    let leaves = pair.square > rows + LEFT * (2.0 * rows).sqrt();
    parts.truncate(if pair.log_evidence > best.log_evidence {
        2
    } else {
        usize::from(leaves)
    });
    parts
}

/// One effect of a fitted pair with other partners: those whose starts gain most, in the linearised analytic model, on what it
/// leaves with its values of the pair, are fitted by the analytic model, and the best of these by the middle fidelity.
pub(super) fn fit(
    judge: &Judge<'_>,
    base: &Base,
    singles: &[Judged],
    fitted: &[Judged],
    pair: &Judged,
    kept: &Judged,
) -> Vec<Judged> {
    let ground = &judge.ground;
    let Some(state) = state_in(&kept.candidate, pair) else {
        return Vec::new();
    };
    let predicted = |bench, offset: &[Vec<f64>], candidate: &Candidate, state: &State| {
        let predictor = Anchored::new(model(bench, candidate), offset.to_vec());
        predictions(ground, &predictor, candidate, state).ok()
    };
    let alone = predicted(judge.middle, &base.judged.offset, &kept.candidate, &state);
    let analytic = predicted(judge.hertz, &[], &kept.candidate, &state);
    let (Some(alone), Some(analytic)) = (alone, analytic) else {
        return Vec::new();
    };
    let anchor = offset(ground, &alone, &analytic);
    let left = ground.residual(&ground.joined(&alone));
    let left = DVector::from_vec(ground.covariance.whiten(&left));
    let analytic = ground.rescaled(&ground.joined(&analytic));
    let known = |s: &Judged| {
        let both = [s.candidate.names[0], kept.candidate.names[0]];
        (fitted.iter()).any(|f| both.iter().all(|name| f.candidate.names.contains(name)))
    };
    let mut gains: Vec<(f64, Candidate, State)> = (singles.par_iter())
        .filter(|s| s.candidate.names != kept.candidate.names && !known(s))
        .flat_map_iter(|s| s.candidate.starts.iter().map(move |values| (s, values)))
        .filter_map(|(s, values)| {
            let both = kept.candidate.with(&s.candidate);
            let own = &s.candidate.parameters[s.candidate.inherited..];
            let with = |values: &[f64]| State {
                theta: (state.theta.iter().copied())
                    .chain(own.iter().zip(values).map(|(p, &x)| p.natural_start(x)))
                    .collect(),
                ..state.clone()
            };
            let predicted = predicted(judge.hertz, &[], &both, &with(values))?;
            let predicted = ground.rescaled(&ground.joined(&predicted));
            let change = predicted.iter().zip(&analytic).map(|(f, a)| f - a);
            let change: Vec<f64> = change.collect();
            let (gain, amplitude) = linear_gain(&judge.visible(base, &change), &left);
            let scaled = s.candidate.scaled(values, amplitude.max(LEAST_AMPLITUDE));
            (gain > PROMISE).then(|| (gain, both, with(&scaled)))
        })
        .collect();
    gains.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<(f64, Candidate, State)> = Vec::new();
    for gain in gains {
        if chosen.len() < PARTNERS && chosen.iter().all(|c| c.1.names != gain.1.names) {
            chosen.push(gain);
        }
    }
    let looked = |both: &Candidate, start: State| {
        let predictor = Anchored::new(model(judge.hertz, both), anchor.clone());
        ground.fit(&predictor, &both.parameters, start, &LOOK).ok()
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
        offset: base.judged.offset.clone(),
    });
    pair_fit::fit(judge, base, starts.collect())
}

/// A fitted pair's state with the parameters of one of its effects only.
fn state_in(candidate: &Candidate, pair: &Judged) -> Option<State> {
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
