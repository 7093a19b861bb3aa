//! What a fitted effect is worth where its strength is not what the catalogue expects.
//!
//! How strong an effect is differs from rig to rig by more than any table knows, and a weak one in another form must not be given the name of
//! one whose usual strength happens to fit. So half of a strength's prior is the catalogue's, half is even over its order of magnitude:
//!
//! ```text
//! p(s) = ½ p_catalogue(s) + ½ /(|s| ln 10⁴),   s the distance from no effect on the parameter's natural scale, its sign left open
//! ```
//! Between effects that explain as much, what then counts is the shape and not the size.

use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::hypothesis::parameters::Parameter;
use crate::learn::inference::quadratic::State;

/// Orders of magnitude that the even half spans, as a logarithm.
const SPAN: f64 = 4.0 * std::f64::consts::LN_10;
/// Log evidence that each strength loses by it at the least: the data pin it to a third of itself, ln(3 SPAN/√(2π)).
const LEAST_LOSS: f64 = 2.4;

/// What the evidence of a fit gains over that under the catalogue's priors, which is `gain` over the base model's where χ² falls by `fall`.
///
/// A strength that the data do not pin gains nothing.
pub(in crate::learn) fn regained(
    candidate: &Candidate,
    state: &State,
    gain: f64,
    fall: f64,
) -> f64 {
    let added = (candidate.parameters.iter().zip(&state.theta)).skip(candidate.inherited);
    let of_each: Vec<f64> = (added.zip(candidate.neutrals()))
        .filter_map(|((parameter, &natural), neutral)| Some(more(parameter, natural, neutral?)))
        .collect();
    let least_loss = LEAST_LOSS * of_each.len() as f64;
    let more: f64 = of_each.iter().sum();
    more.min((0.5 * fall - least_loss - gain).max(0.0))
}

/// ln p/p_catalogue of one strength at `natural`, which does nothing at the value `neutral`.
fn more(parameter: &Parameter, natural: f64, neutral: f64) -> f64 {
    let (prior, none) = (parameter.natural_prior(), parameter.natural(neutral));
    let even = if none.is_infinite() {
        1.0 / SPAN
    } else {
        let sides = if prior.lower < none { 2.0 } else { 1.0 };
        1.0 / (sides * SPAN * (natural - none).abs())
    };
    (0.5 + 0.5 * even / prior.log_density(natural).exp()).ln()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;

    /// A coating that is 8.5 ± 1.2 % harder than its base where ten times is usual: the integral of likelihood times prior, by sums over the
    /// whole of both halves, against what a fit under the catalogue's prior gives and `more`.
    #[test]
    fn a_fit_under_the_catalogue_s_prior_becomes_one_under_both_halves() {
        let card = find("coating").unwrap();
        let ratio = Parameter::of_card("coating", &card.params[0]);
        let prior = ratio.natural_prior();
        let (best, sd) = (0.0817_f64, 0.0114_f64);
        let likelihood = |t: f64| (-0.5 * ((t - best) / sd).powi(2)).exp();
        let step = 1e-6;
        let sum = |density: &dyn Fn(f64) -> f64| -> f64 {
            // four decades about the fit on one side of no effect; none of the other side's is seen
            let places = (1..1_000_000).map(|i| step * f64::from(i));
            places.map(|t| likelihood(t) * density(t) * step).sum()
        };
        let catalogue = |t: f64| prior.log_density(t).exp();
        let even = |t: f64| 0.5 / (t * 10_000_f64.ln());
        let both = sum(&|t| 0.5 * catalogue(t) + 0.5 * if t > 1e-3 { even(t) } else { 0.0 });
        let wanted = (both / sum(&catalogue)).ln();
        let found = more(&ratio, best, 1.0);
        assert!(wanted > 2.0, "{wanted}");
        assert!((found - wanted).abs() < 0.05, "{found} {wanted}");
    }
}
