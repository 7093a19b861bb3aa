//! What a second effect promises once a first one is in, as fitted: linearised, of either sign, for beside the first one an effect may act the other
//! way than alone.
//!
//! ```text
//! gain = ½ (oᵀ r)²/oᵀo       o: the second's change that neither k nor an amplitude of the first one's change can make;  r: what the first leaves
//! ```

use nalgebra::DVector;
use rayon::prelude::*;

use super::context::Context;
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::EffectSet;

/// Gain of ln likelihood from which a second effect is worth a sentence: of some fifty forms the best gains 4 to 5 from noise.
const WORTH_A_SENTENCE: f64 = 10.0;

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
    let gain = |other: &DVector<f64>| {
        let mut other = other.clone();
        if length > 0.0 {
            let share = other.dot(direction) / length;
            other.axpy(-share, direction, 1.0);
        }
        let square = other.norm_squared();
        if square > 1e-9 {
            0.5 * other.dot(&left).powi(2) / square
        } else {
            0.0
        }
    };
    others.map(|other| (gain(&seen[other]), other)).collect()
}

/// The single effect that promises most beside `leader`, and the fall of χ² that it promises, if it is worth a sentence.
pub(in crate::learn) fn next(
    context: &Context<'_>,
    base: &BaseFit,
    fitted: &[FittedCandidate],
    leader: &FittedCandidate,
) -> Option<(EffectSet, f64)> {
    let mut all = vec![leader];
    let is_other_single = |other: &&FittedCandidate| {
        other.candidate.effects.len() == 1
            && !leader.candidate.effects.contains(&other.candidate.effects)
    };
    all.extend(fitted.iter().filter(is_other_single));
    let seen: Vec<DVector<f64>> = (all.par_iter())
        .map(|fitted| base.visible(&context.likelihood, &fitted.change))
        .collect();
    let gains = on_top(context, base, &all, &seen, 0);
    let (gain, best) = gains.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    (gain > WORTH_A_SENTENCE).then(|| (all[best].candidate.effects.clone(), 2.0 * gain))
}
