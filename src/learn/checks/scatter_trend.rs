//! What the scatter of k between tests follows, if it is none.

use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::fitting::coefficient_trend::trend_of_coefficients;
use crate::learn::inference::quadratic::State;

/// The condition that the fitted tests' own k follow, in words; None if they follow none.
pub(in crate::learn) fn trend_of_scatter(
    likelihood: &Likelihood<'_>,
    state: &State,
) -> Option<String> {
    let own = likelihood.tests.iter().zip(&state.epsilon);
    let own: Vec<(usize, f64)> = own
        .map(|(&test, epsilon)| (test, state.log_k + epsilon))
        .collect();
    let measured = likelihood.measured;
    trend_of_coefficients(measured.study(), &measured.data, &own)
}
