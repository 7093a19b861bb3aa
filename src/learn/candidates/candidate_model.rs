//! Candidates' models, anchored in finite elements: the cheap model is the analytic one or coarse finite elements.
//!
//! The screening's changes are the analytic model's, those of a second and of the deciding fits coarse finite elements'. A fit that
//! takes its result as the next anchor, until nothing moves, ends on fine finite-element values with the cheap model's derivatives.

use rayon::prelude::*;

use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::prediction::anchored;
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::gear_model::GearModel;
use crate::learn::prediction::predictor::{PredictError, Predictor};

/// A candidate's cheap model, anchored.
pub(in crate::learn) type Anchored<'a> = anchored::Anchored<GearModel<'a>>;

/// The same on a model that serves several fits: it keeps its histories.
pub(in crate::learn) type AnchoredOn<'a> = anchored::Anchored<&'a GearModel<'a>>;

/// A candidate's model on a bench.
pub(in crate::learn) fn model<'b>(bench: &'b Bench<'b>, candidate: &'b Candidate) -> GearModel<'b> {
    let names: Vec<&str> = (candidate.parameters.iter())
        .map(|p| p.name.as_str())
        .collect();
    GearModel::of_effects(bench, &candidate.version.effects, names).giving_up()
}

/// Predictions of all tests of a likelihood at a state, by test of the likelihood.
pub(in crate::learn) fn predictions(
    likelihood: &Likelihood<'_>,
    predictor: &dyn Predictor,
    candidate: &Candidate,
    state: &State,
) -> Result<Vec<Vec<f64>>, PredictError> {
    let (k, theta) = likelihood.arguments(&candidate.parameters, state);
    (0..likelihood.tests.len())
        .into_par_iter()
        .map(|i| predictor.predict(likelihood.tests[i], k[i], &theta))
        .collect()
}

/// The same of one test, by its place in the likelihood.
pub(in crate::learn) fn prediction_of_test(
    likelihood: &Likelihood<'_>,
    predictor: &dyn Predictor,
    candidate: &Candidate,
    state: &State,
    test: usize,
) -> Result<Vec<f64>, PredictError> {
    let (k, theta) = likelihood.arguments(&candidate.parameters, state);
    predictor.predict(likelihood.tests[test], k[test], &theta)
}

/// a − b per test of the data set, from values per test of the likelihood.
pub(in crate::learn) fn offset(
    likelihood: &Likelihood<'_>,
    a: &[Vec<f64>],
    b: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let mut offset = vec![Vec::new(); likelihood.measured.data.tests.len()];
    for (i, &test) in likelihood.tests.iter().enumerate() {
        offset[test] = a[i].iter().zip(&b[i]).map(|(a, b)| a - b).collect();
    }
    offset
}
