//! Effects that move the gears to another centre distance, from where one does what another one does.
//!
//! What is added to coarse elements so that they say what fine ones say has edges where the flanks begin and end, and the corners of the tips touch there; both move with the
//! centre distance. A fit of such an effect with what is to be added to the base model rests on the way, with a tenth of what it could gain. So fine elements themselves look some way
//! to both sides, and what they see is decided with anchors of its own; others begin where they move the gears as far: there the same is to be added.
//!
//! ```text
//! x = argmin |c(x) − c₁|²/|c₁|²      c₁, c: whitened changes by the one that was found and by the other, both by the analytic model
//! ```

use rayon::prelude::*;

use super::context::Context;
use super::high_fidelity::DECIDE;
use super::pair_exchange::{is_part, state_in};
use super::pair_fit::PairStart;
use crate::learn::candidates::candidate_model::{AnchoredOn, model, predictions};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::prediction::fidelity::Fidelity;
use crate::numeric::golden_section::place_of_largest;

/// Amplitudes of a start that are tried, as powers of 2.
const POWERS: [f64; 2] = [-5.0, 6.0];
/// How closely the power is found.
const LENGTH: f64 = 0.03;
/// Share of the attainable fall of χ² with which an effect leaves nothing for a look by fine elements, and the share from which what they see is followed.
const NEARLY_ALL: f64 = 0.9;
const WORTH_SHARE: f64 = 0.2;
/// Starts that are looked at by fine elements, one to each side, and their amplitudes.
const BOTH_SIGNS: usize = 2;
const FAR: [f64; 3] = [0.7, 1.4, 2.8];
/// Share of the square of the change that may be left for two effects to act alike.
const UNLIKE: f64 = 0.3;

/// Whether a single effect in its own form may stand for another one by moving the gears as far.
fn may_stand_for(other: &Candidate, one: &Candidate) -> bool {
    one.moves_the_centres()
        && other.moves_the_centres()
        && other.is_own_form()
        && other.is_look_alike_of(one)
}

/// Whether a single effect in its own form moves the centres by one parameter, to either side.
fn is_plain(candidate: &Candidate) -> bool {
    let own = &candidate.parameters[candidate.inherited..];
    let either_side = own.iter().all(|p| p.lower < 0.0 && p.upper > 0.0);
    let one = own.len() == 1 && candidate.is_own_form() && !candidate.is_costly();
    one && either_side && candidate.moves_the_centres()
}

impl Context<'_> {
    /// Where no effect accounts for what there is: all with the plainest of those that move the centres decided by anchors of its own, from where fine elements
    /// leave least, and others of its kind begun where they move the gears as far, with its anchor. `attainable`: the fall of χ² by anything smooth.
    pub(in crate::learn) fn with_moved_centres(
        &self,
        base: &BaseFit,
        mut refined: Vec<FittedCandidate>,
        attainable: f64,
    ) -> Vec<FittedCandidate> {
        let fallen = |fitted: &FittedCandidate| base.fitted.square - fitted.square;
        let most = refined.iter().map(fallen).fold(0.0, f64::max);
        let plainest = refined
            .iter()
            .position(|fitted| is_plain(&fitted.candidate));
        let Some(best) = plainest.filter(|_| most < NEARLY_ALL * attainable) else {
            return refined;
        };
        let start = self.far_start(base, &refined[best].candidate);
        let Some((_, start)) = start.filter(|(fall, _)| *fall > WORTH_SHARE * attainable) else {
            return refined;
        };
        let candidate = refined[best].candidate.clone();
        let decided = self.decide(&candidate, start, Some(base), f64::INFINITY);
        let better = |d: &FittedCandidate| d.found.objective < refined[best].found.objective;
        let Some(better) = decided.ok().filter(better) else {
            return refined;
        };
        refined[best] = better;
        let found = refined[best].clone();
        let others: Vec<Option<FittedCandidate>> = (refined.par_iter())
            .map(|other| {
                let acting = may_stand_for(&other.candidate, &found.candidate)
                    .then(|| self.acting_as(base, &found, &other.candidate))?;
                acting.filter(|acting| acting.found.objective < other.found.objective)
            })
            .collect();
        (refined.into_iter().zip(others))
            .map(|(before, better)| better.unwrap_or(before))
            .collect()
    }

    /// The state with the base model's k in which a candidate leaves least by fine elements, of some far apart, and the fall of χ² there.
    fn far_start(&self, base: &BaseFit, candidate: &Candidate) -> Option<(f64, State)> {
        let (likelihood, exact) = (&self.likelihood, model(self.exact, candidate));
        let starts = candidate.starts.iter().take(BOTH_SIGNS);
        let ways = starts.flat_map(|start| FAR.map(|amplitude| candidate.scaled(start, amplitude)));
        let fall = |values: Vec<f64>| {
            let state = base.added(candidate, &values);
            let predicted = predictions(likelihood, &exact, candidate, &state).ok()?;
            let rescaled = likelihood.rescaled(&likelihood.joined(&predicted));
            Some((base.fitted.square - likelihood.square(&rescaled), state))
        };
        let ways: Vec<Vec<f64>> = ways.collect();
        let falls: Vec<(f64, State)> = ways.into_par_iter().filter_map(fall).collect();
        falls.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// A candidate fitted by coarse elements from where it moves the gears as far as the one that was `found`, with that one's anchor.
    fn acting_as(
        &self,
        base: &BaseFit,
        found: &FittedCandidate,
        candidate: &Candidate,
    ) -> Option<FittedCandidate> {
        let end = &found.found.state;
        let with = |values: &[f64]| State {
            theta: beside(&end.theta[..candidate.inherited], candidate, values),
            ..end.clone()
        };
        let start = acting_alike(self, found, candidate, candidate, with)?;
        let cheap = model(self.middle, candidate);
        let predictor = AnchoredOn::new(&cheap, found.offset.clone());
        let parameters = &candidate.parameters;
        let fitted = self.likelihood.fit(&predictor, parameters, start, &DECIDE);
        Some(FittedCandidate::new(
            &self.likelihood,
            candidate.clone(),
            fitted.ok()?,
            found.offset.clone(),
            Some(base),
            Fidelity::Middle,
        ))
    }
}

/// Where the fits of pairs begin that have another effect in place of one of the `pair`'s.
pub(super) fn in_pair(
    context: &Context<'_>,
    singles: &[FittedCandidate],
    pair: &FittedCandidate,
) -> Vec<PairStart> {
    let parts: Vec<&FittedCandidate> = singles.iter().filter(|s| is_part(s, pair)).collect();
    let [a, b] = parts[..] else {
        return Vec::new();
    };
    let replaced = [(a, b), (b, a)].into_iter();
    let others = replaced.flat_map(|(one, kept)| {
        let all = singles.iter();
        let others = all.filter(|other| may_stand_for(&other.candidate, &one.candidate));
        others.map(move |other| (kept, &other.candidate))
    });
    let start = |(kept, other): (&FittedCandidate, &Candidate)| {
        let joint = kept.candidate.with(other);
        let end = state_in(&kept.candidate, pair)?;
        let with = |values: &[f64]| State {
            theta: beside(&end.theta, other, values),
            ..end.clone()
        };
        let state = acting_alike(context, pair, &joint, other, with)?;
        Some(PairStart {
            candidate: joint,
            state,
            offset: pair.offset.clone(),
        })
    };
    others.filter_map(start).collect()
}

/// Parameters on natural scales with the `values` of an effect's own behind them.
fn beside(known: &[f64], effect: &Candidate, values: &[f64]) -> Vec<f64> {
    let own = &effect.parameters[effect.inherited..];
    let added = own.iter().zip(values).map(|(p, &x)| p.natural_start(x));
    known.iter().copied().chain(added).collect()
}

/// The state of `joint` in which it comes nearest to what `found` does with its effects; None where it comes to nothing like it. `other`: the
/// effect whose starts are tried; `with`: the state of `joint` with its values.
fn acting_alike(
    context: &Context<'_>,
    found: &FittedCandidate,
    joint: &Candidate,
    other: &Candidate,
    with: impl Fn(&[f64]) -> State + Sync,
) -> Option<State> {
    let likelihood = &context.likelihood;
    let whitened = |candidate: &Candidate, state: &State| {
        let analytic = model(context.hertz, candidate);
        let predicted = predictions(likelihood, &analytic, candidate, state).ok()?;
        Some(likelihood.covariance.whiten(&likelihood.joined(&predicted)))
    };
    let one = whitened(&found.candidate, &found.found.state)?;
    let distance = |state: &State| {
        let other = whitened(joint, state)?;
        let squares = one.iter().zip(&other).map(|(a, b)| (a - b).powi(2));
        Some(squares.sum::<f64>())
    };
    let nearest = |start: &Vec<f64>| {
        let at = |power: f64| with(&other.scaled(start, power.exp2()));
        let likeness = |power: f64| distance(&at(power)).map_or(f64::NEG_INFINITY, |d| -d);
        let state = at(place_of_largest(likeness, POWERS, LENGTH));
        Some((distance(&state)?, state))
    };
    let none = distance(&with(&other.scaled(other.starts.first()?, 0.0)))?;
    let all: Vec<(f64, State)> = other.starts.par_iter().filter_map(nearest).collect();
    let (left, state) = all.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
    (left < UNLIKE * none).then_some(state)
}
