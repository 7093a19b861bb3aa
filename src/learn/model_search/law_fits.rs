//! What fits of learned laws share: the noise they are judged by, the model without a law, and what either leaves.

use super::context::Context;
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::inference::search::Effort;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::fidelity::Fidelity;
use crate::study::Role;

/// The noise of the analytic model's fits, where that is not the study's own: what finite elements make else is not to be learned as a law.
pub(super) fn screening_noise(context: &Context<'_>) -> NoiseModel {
    let noise = context.likelihood.noise;
    match context.fidelity {
        Fidelity::Screening => noise,
        Fidelity::Middle | Fidelity::Full => NoiseModel {
            model_error: Some(Fidelity::Screening.model_error()),
            ..noise
        },
    }
}

/// The model without a law, fitted from where it is known to stand.
pub(super) fn without(
    context: &Context<'_>,
    known: &FittedCandidate,
    bench: &Bench<'_>,
    noise: NoiseModel,
) -> Option<Fit> {
    let likelihood = &context.likelihood;
    let (_, start) = likelihood.arguments(&known.candidate.parameters, &known.found.state);
    let effort = Effort {
        settle: 0,
        ..Effort::for_simulations()
    };
    let version = &known.candidate.version;
    let fit = (likelihood.measured).fit(bench, version, noise, &[start], &effort, &|_| {});
    fit.ok()
}

/// χ² per point of the tests with a role; None if they have no points.
pub(super) fn chi2(measured: &Measured<'_>, fit: &Fit, role: Role) -> Option<f64> {
    mean_square(measured, fit, |test| measured.roles[test] == role)
}

/// χ² per point of some tests, by their places in the study; None if they have no points.
pub(super) fn mean_square(
    measured: &Measured<'_>,
    fit: &Fit,
    is_meant: impl Fn(usize) -> bool,
) -> Option<f64> {
    let rows = measured.data.observations.iter().zip(&fit.rows);
    let own = rows.filter(|(o, _)| is_meant(o.test));
    let squares: Vec<f64> = own.map(|(_, row)| row.standardised.powi(2)).collect();
    (!squares.is_empty()).then(|| squares.iter().sum::<f64>() / squares.len() as f64)
}
