//! Which partners of an effect are worth a look beside it, which may cost ten times a look without it: those that gain most if what they change alone is
//! added to it.

use nalgebra::DVector;
use rayon::prelude::*;

use super::context::Context;
use super::pair_fit::PROMISE;
use super::screening::scaled_starts;
use crate::learn::candidates::candidate_model::{Anchored, model};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::EffectSet;
use crate::learn::hypothesis::candidate::Candidate;

/// Partners that are looked at, and the gain of ln likelihood from which one is.
const LOOKED_AT: usize = 12;
const GAIN: f64 = 0.5 * PROMISE;

/// What the starts of single effects change of the fitted base model by the analytic one, as far as k cannot.
pub(in crate::learn) struct ChangesAlone(Vec<Vec<(Vec<f64>, DVector<f64>)>>);

impl ChangesAlone {
    pub(in crate::learn) fn new(
        context: &Context<'_>,
        base: &BaseFit,
        singles: &[FittedCandidate],
    ) -> Self {
        let changes = |single: &FittedCandidate| {
            let candidate = &single.candidate;
            let predictor =
                Anchored::new(model(context.hertz, candidate), base.hertz_offset.clone());
            let change = |values: &Vec<f64>| {
                let seen = context.seen(base, candidate, &predictor, values)?;
                Some((values.clone(), seen))
            };
            candidate.looked_at().filter_map(change).collect()
        };
        Self(singles.par_iter().map(changes).collect())
    }

    /// The largest gain on `left` of a start of the single effect at this place, if it acted beside others as it does alone.
    fn gain(
        &self,
        context: &Context<'_>,
        candidate: &Candidate,
        place: usize,
        left: &DVector<f64>,
    ) -> f64 {
        let of = |values: &[f64]| {
            let known = self.0[place].iter().find(|(own, _)| own == values);
            known.map(|(_, change)| change.clone())
        };
        let starts = scaled_starts(candidate, context.amplitudes(candidate), of, left);
        starts.iter().map(|(gain, _)| *gain).fold(0.0, f64::max)
    }

    /// Whether each of the single effects is to be looked at beside one that leaves `left`: all forms of those `wanted` that gain most.
    pub(in crate::learn) fn promising(
        &self,
        context: &Context<'_>,
        singles: &[FittedCandidate],
        wanted: impl Fn(&FittedCandidate) -> bool,
        left: &DVector<f64>,
    ) -> Vec<bool> {
        let gains: Vec<(f64, &EffectSet)> = (singles.iter().enumerate())
            .filter(|(_, single)| wanted(single))
            .map(|(place, single)| {
                let gain = self.gain(context, &single.candidate, place, left);
                (gain, &single.candidate.effects)
            })
            .collect();
        let first = first_of(gains);
        let is_first =
            |single: &FittedCandidate| wanted(single) && first.contains(&&single.candidate.effects);
        singles.iter().map(is_first).collect()
    }
}

/// What gains most, each once however many forms it has; nothing that gains too little.
fn first_of<T: PartialEq>(mut gains: Vec<(f64, T)>) -> Vec<T> {
    gains.retain(|(gain, _)| *gain > GAIN);
    gains.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut first = Vec::new();
    for (_, effect) in gains {
        if first.len() < LOOKED_AT && !first.contains(&effect) {
            first.push(effect);
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effects_are_looked_at_once_by_their_best_form() {
        let forms = vec![(4.0, "b"), (2.9, "c"), (9.0, "a"), (3.1, "d"), (8.0, "a")];
        assert_eq!(first_of(forms), ["a", "b", "d"]);
        let many: Vec<(f64, u32)> = (0..40).map(|i| (10.0 + f64::from(i), i)).collect();
        assert_eq!(first_of(many), (28..40).rev().collect::<Vec<u32>>());
    }
}
