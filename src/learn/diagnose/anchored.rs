//! Candidates' models, anchored in finite elements: the cheap model is the analytic one or coarse finite elements.
//!
//! The screening's changes are the analytic model's, those of a second and of the deciding fits coarse finite elements'. A fit that
//! takes its result as the next anchor, until nothing moves, ends on fine finite-element values with the cheap model's derivatives.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::ground::Ground;
use crate::learn::anchored;
use crate::learn::bench::Bench;
use crate::learn::gear_model::GearModel;
use crate::learn::predictor::{PredictError, Predictor};
use crate::learn::quadratic::State;

/// A candidate's cheap model, anchored.
pub(super) type Anchored<'a> = anchored::Anchored<GearModel<'a>>;

/// A candidate's model on a bench.
pub(super) fn model<'b>(bench: &'b Bench<'b>, candidate: &'b Candidate) -> GearModel<'b> {
    let names: Vec<&str> = candidate
        .parameters
        .iter()
        .map(|p| p.name.as_str())
        .collect();
    let effects = &candidate.version.effects;
    GearModel::new(
        bench,
        Box::new(move |values| {
            effects.build(&|name| {
                let place = names.iter().position(|known| *known == name)?;
                values.get(place).copied()
            })
        }),
    )
    .stretching(effects.stretches_time())
}

/// Predictions of all tests of a ground at a state, by test of the ground.
pub(super) fn predictions(
    ground: &Ground<'_>,
    predictor: &dyn Predictor,
    candidate: &Candidate,
    state: &State,
) -> Result<Vec<Vec<f64>>, PredictError> {
    let (k, theta) = ground.arguments(&candidate.parameters, state);
    (0..ground.tests.len())
        .into_par_iter()
        .map(|i| predictor.predict(ground.tests[i], k[i], &theta))
        .collect()
}

/// a − b per test of the data set, from values per test of the ground.
pub(super) fn offset(ground: &Ground<'_>, a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut offset = vec![Vec::new(); ground.measured.data.tests.len()];
    for (i, &test) in ground.tests.iter().enumerate() {
        offset[test] = a[i].iter().zip(&b[i]).map(|(a, b)| a - b).collect();
    }
    offset
}
