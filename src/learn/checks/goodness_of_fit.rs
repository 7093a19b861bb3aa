//! Whether the model that nothing is said to be missing from leaves more than noise.
//!
//! ```text
//! Q = Σ ((measured − model − datum)/σ)²         N rows, σ as stated, or where that has the wrong shape as neighbours scatter
//! z = ((Q/N)^(1/3) − (1 − 2/(9N)))/√(2/(9N))    P(χ²_N ≥ Q) = erfc(z/√2)/2
//! said if   P < 0.001   and   Q/N > max(1.1, s)²          s: scatter of neighbours along traces over σ, where there are enough
//! ```
//! The tail is by Wilson and Hilferty (Proc. Natl. Acad. Sci. 17, 1931): right to a tenth of itself from N = 10 on. Datums and k are fitted, so
//! that Q is rather smaller than χ²_N: what is said is said on the safe side. Two conditions, since either alone would mislead: of a few rows
//! Q/N of 1.5 is chance, and of ten thousand rows 1.05 is not, but no one knows σ to 2 %. A σ from 50 repeats is itself known to 10 %; and
//! where neighbours scatter more than that, the noise is what is larger, and the diagnosis says so by itself.
//!
//! The verdict does not hang on this: that compares causes, and a misfit that no effect and nothing smooth can follow is none of them.

use serde::Serialize;

use super::noise_level;
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::noise::SigmaModel;
use crate::numeric::chi_squared::upper_tail;

/// Largest error of stated noise sizes that is taken for ordinary, as a factor.
const ORDINARY: f64 = 1.1;
/// Tail of χ² below which what is left is no chance.
const NO_CHANCE: f64 = 1e-3;

/// How well the base model fits where nothing is missing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GoodnessOfFit {
    /// Mean squared residual, in stated sigmas; where their shape is wrong, in those by which neighbours scatter.
    pub chi2_per_point: f64,
    /// Number of rows.
    pub points: usize,
    /// Probability that noise of the stated sizes alone leaves as much or more.
    pub tail_probability: f64,
    /// χ² per point that noise sizes as wrong as they may be leave.
    pub allowed_chi2_per_point: f64,
    /// What is to be said, if more is left than that.
    pub warning: Option<String>,
}

impl GoodnessOfFit {
    /// Of a model's values for all rows.
    pub(in crate::learn) fn new(likelihood: &Likelihood<'_>, model: &[f64]) -> Self {
        if !matches!(likelihood.noise.sigma, SigmaModel::Stated { .. }) {
            // neighbours scatter as this σ by the choice of it
            let rows = likelihood.observations();
            let sigma = likelihood.noise.sigma.of(&rows);
            let off = likelihood.standardised(model);
            let squares = (off.iter().zip(rows).zip(sigma))
                .map(|((z, row), sigma)| (z * row.sigma / sigma).powi(2));
            let chi2_per_point = squares.sum::<f64>() / likelihood.len() as f64;
            return Self::of(chi2_per_point, likelihood.len(), None);
        }
        Self::of(
            likelihood.chi2_per_point(model),
            likelihood.len(),
            noise_level::scatter(likelihood, model),
        )
    }

    /// Of χ² per point of so many rows, and the scatter of neighbours over the stated σ.
    fn of(chi2_per_point: f64, points: usize, scatter: Option<f64>) -> Self {
        let tail_probability = upper_tail(chi2_per_point, points as f64);
        let allowed = ORDINARY.max(scatter.unwrap_or(0.0)).powi(2);
        let too_much = tail_probability < NO_CHANCE && chi2_per_point > allowed;
        let neighbours = scatter.map_or(String::new(), |scatter| {
            format!(" Neighbours along traces scatter {scatter:.2} times the stated sigma.")
        });
        Self {
            chi2_per_point,
            points,
            tail_probability,
            allowed_chi2_per_point: allowed,
            warning: too_much.then(|| {
                format!(
                    "But the fit is not as good as the stated noise: χ² {chi2_per_point:.2} per point of {points} rows, where noise sizes wrong by {:.0} % would leave {allowed:.2} at most.{neighbours} Either sigma is stated too small, or something is left that neither the catalogue nor anything smooth follows, the model's own numerical error among it: look at the residuals by test, member and quantity.",
                    100.0 * (allowed.sqrt() - 1.0)
                )
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::GoodnessOfFit;

    #[test]
    fn only_what_is_neither_chance_nor_a_common_error_of_sigma_is_said() {
        let says =
            |chi2, points, scatter| GoodnessOfFit::of(chi2, points, scatter).warning.is_some();
        assert!(says(1.24, 1700, None) && says(1.24, 1700, Some(1.02)));
        // a mean square of few rows; noise sizes wrong by 9 %; noise that is larger by the neighbours' scatter
        assert!(
            !says(1.24, 60, None) && !says(1.18, 10_000, None) && !says(1.24, 1700, Some(1.15))
        );
        assert!(says(2.0, 60, None) && !says(1.0, 1700, None) && !says(0.4, 50, None));
        let found = GoodnessOfFit::of(1.24, 1700, None);
        assert!(
            found.tail_probability < 1e-9 && (found.allowed_chi2_per_point - 1.21).abs() < 1e-12
        );
    }
}
