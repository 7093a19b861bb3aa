//! What a second effect promises once a first one is in, as fitted: linearised, of either sign, for beside the first one an effect may act the other
//! way than alone.
//!
//! ```text
//! gain = ½ (oᵀ r)²/oᵀo       o: the second's change that neither k nor the first one can make;  r: what the first leaves
//! ```
//! Which pairs are fitted is asked with the first one's amplitude taken from o, for it may be fitted in another valley beside the second. What is left
//! to be said of the first one's fit is asked with all of its parameters taken from o: half of Rao's score statistic. A part that its other parameters follow would
//! count in oᵀo and not in oᵀr, where the fit has made it 0, and a second effect that a wrong decay had stood for would promise next to nothing.

use nalgebra::DVector;
use rayon::prelude::*;

use super::context::Context;
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::EffectSet;

/// Gain of ln likelihood from which a second effect is worth a sentence: of some fifty forms the best gains 4 to 5 from noise.
const WORTH_A_SENTENCE: f64 = 10.0;
/// Share of the largest promise from which another effect may be the one as well: no promise is nearer to what the fit then brings.
const ALIKE: f64 = 0.8;
/// So many of them are named.
const NAMED: usize = 3;
/// Least part of a change's square that the first effect cannot make: of less, the changes' own curvature is left.
const LEAST_OWN: f64 = 1e-3;

/// The gain of each of the `fitted`, of which `seen` are the visible changes, once `leader` of them is in; none for other forms of its own effects.
pub(super) fn on_top(
    context: &Context<'_>,
    base: &BaseFit,
    fitted: &[&FittedCandidate],
    seen: &[DVector<f64>],
    leader: usize,
) -> Vec<(f64, usize)> {
    let first = fitted[leader];
    let left = base.left(&context.likelihood, &first.found.model, &first.found.state);
    let direction = &seen[leader];
    let length = direction.norm_squared();
    let others = (0..fitted.len())
        .filter(|&other| fitted[other].candidate.effects != first.candidate.effects);
    let own = |other: &DVector<f64>| {
        let mut other = other.clone();
        if length > 0.0 {
            let share = other.dot(direction) / length;
            other.axpy(-share, direction, 1.0);
        }
        other
    };
    others
        .map(|other| (gain(&own(&seen[other]), &left, 1e-9), other))
        .collect()
}

/// ½ (oᵀ r)²/oᵀo; 0 where o is no longer than `least`, squared.
fn gain(own: &DVector<f64>, left: &DVector<f64>, least: f64) -> f64 {
    let square = own.norm_squared();
    if square > least {
        0.5 * own.dot(left).powi(2) / square
    } else {
        0.0
    }
}

/// The single effects that promise most beside `leader`, the best first, and the fall of χ² that it promises, if it is worth a sentence.
pub(in crate::learn) fn next(
    context: &Context<'_>,
    base: &BaseFit,
    fitted: &[FittedCandidate],
    leader: &FittedCandidate,
) -> Option<(Vec<EffectSet>, f64)> {
    let likelihood = &context.likelihood;
    let follows = base.follows(likelihood, leader);
    let beyond = |v: DVector<f64>| {
        let along = follows.tr_mul(&v);
        v - &follows * along
    };
    let left = beyond(base.left(likelihood, &leader.found.model, &leader.found.state));
    let is_other_single = |other: &&FittedCandidate| {
        other.candidate.effects.len() == 1
            && !leader.candidate.effects.contains(&other.candidate.effects)
    };
    let all: Vec<&FittedCandidate> = fitted.iter().filter(is_other_single).collect();
    let promised = |other: &&FittedCandidate| {
        let mut change = likelihood.covariance.whiten(&other.change);
        change.resize(left.len(), 0.0);
        let change = DVector::from_vec(change);
        let least = LEAST_OWN * change.norm_squared();
        gain(&beyond(change), &left, least)
    };
    let gains: Vec<f64> = all.par_iter().map(promised).collect();
    let mut gains: Vec<(f64, &FittedCandidate)> = gains.into_iter().zip(all).collect();
    gains.sort_by(|a, b| b.0.total_cmp(&a.0));
    let &(most, _) = gains.first().filter(|best| best.0 > WORTH_A_SENTENCE)?;
    let mut promising: Vec<EffectSet> = Vec::new();
    for (_, other) in gains.iter().take_while(|other| other.0 > ALIKE * most) {
        if !promising.contains(&other.candidate.effects) {
            promising.push(other.candidate.effects.clone());
        }
    }
    promising.truncate(NAMED);
    Some((promising, 2.0 * most))
}
