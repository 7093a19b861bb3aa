//! Log evidence of a smooth discrepancy of unknown cause, a Gaussian process beside the base model.
//!
//! ```text
//! of every curve its own:   m ~ GP(0, r² a_i a_j exp(−Δs²/2l²) exp(−Δln n²/2g²)) within one test, member and quantity
//! common to all tests:      m = g Σ_j a_j φ_j(driver),  a_j ~ N(0, r² w_j)       driver: the position on a member, or the cycles
//! ln Z(r) = ½ bᵀ (A + V⁻¹)⁻¹ b − ½ ln det(I + V A)       A = XᵀX, b = Xᵀz whitened, freed of what k and the model's parameters do
//! ```
//! a: a curve's largest magnitude; g: the same, or the model's own value. What is common to all tests has few terms and is seen where
//! it is weak; but so is what the model itself computes a little wrong at the same place in every test: only what is gained beyond a
//! discrepancy of the size of the model's own error counts.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::basis::{numbered, polynomials, waves};
use crate::learn::fitted_candidate::BaseFit;
use crate::learn::likelihood::Likelihood;
use crate::learn::noise::{ModelError, amplitudes};
use crate::learn::region::Map;
use crate::measure::Observation;
use crate::numeric::logarithm::log_mean_exp;

/// Sizes of the discrepancy relative to the curve or the model.
const SIZES: [f64; 4] = [0.02, 0.05, 0.12, 0.3];
/// Functions of the position and of the cycles.
const ALONG: usize = 32;
const OVER_CYCLES: usize = 8;
/// Correlation lengths along the position, shares of the range, and ratios of a polynomial's variance to that of a degree less.
const LENGTHS: [f64; 3] = [0.03, 0.08, 0.25];
const RATIOS: [f64; 2] = [0.3, 0.7];

/// Log evidence of the base model with a discrepancy: the mean over its kinds and sizes.
pub(in crate::learn) fn log_evidence(likelihood: &Likelihood<'_>, base: &BaseFit) -> f64 {
    let observations: Vec<&Observation> = (0..likelihood.len())
        .map(|i| likelihood.observation(i))
        .collect();
    let size = amplitudes(&observations);
    let before = base.fitted.log_evidence;
    let common = before + log_mean_exp(&common(likelihood, base, &observations, &size));
    log_mean_exp(&[log_mean_exp(&each_its_own(likelihood, base, &size)), common])
}

/// Each curve with a discrepancy of its own.
fn each_its_own(likelihood: &Likelihood<'_>, base: &BaseFit, size: &[f64]) -> Vec<f64> {
    let mut grid = Vec::new();
    for relative in SIZES {
        for along in [0.08, 0.25] {
            for over_cycles in [0.7, 3.0] {
                grid.push(ModelError {
                    relative,
                    along,
                    over_cycles,
                });
            }
        }
    }
    let base = &base.fitted;
    grid.par_iter()
        .map(|error| {
            let parameters = &base.candidate.parameters;
            let error = Some((size, *error));
            likelihood.evidence_with(&base.found, parameters, error).0
        })
        .collect()
}

/// Gains of log evidence by functions common to all tests.
fn common(
    likelihood: &Likelihood<'_>,
    base: &BaseFit,
    observations: &[&Observation],
    size: &[f64],
) -> Vec<f64> {
    let observations = || observations.iter().copied();
    let map = Map::new(likelihood.measured.study(), &likelihood.measured.data);
    let kinds = numbered(observations().map(|o| o.quantity));
    let model = base.fitted.found.model.as_slice();
    let places: Vec<f64> = observations()
        .map(|o| map.path(o).or(o.position).unwrap_or(0.0))
        .collect();
    let groups: Vec<(usize, usize)> = observations()
        .map(|o| (o.member as usize, o.quantity as usize))
        .collect();
    let of_place = waves(&kinds, &places, ALONG);
    let mut gains = Vec::new();
    for g in [model, size] {
        let seen = SharedFunctions::new(likelihood, base, &groups, &of_place, g);
        for length in LENGTHS {
            let weight = |p: usize| {
                let exponent = 0.5 * (PI * length * p as f64).powi(2);
                (-exponent).exp()
            };
            gains.extend(seen.gains(weight));
        }
    }
    let quantities: Vec<(usize, usize)> =
        observations().map(|o| (0, o.quantity as usize)).collect();
    for scale in [f64::ln_1p, |n| n] {
        let cycles: Vec<f64> = observations().map(|o| scale(o.cycles)).collect();
        let functions = polynomials(&kinds, &cycles, OVER_CYCLES);
        let seen = SharedFunctions::new(likelihood, base, &quantities, &functions, model);
        for ratio in RATIOS {
            gains.extend(seen.gains(|degree| f64::powi(ratio, degree as i32)));
        }
    }
    gains
}

/// Functions common to all tests as the data see them.
struct SharedFunctions {
    /// The model's own error, relative.
    error: f64,
    /// Degree of each column's function.
    degrees: Vec<usize>,
    /// XᵀX.
    normal: DMatrix<f64>,
    /// Xᵀz.
    right: DVector<f64>,
}

impl SharedFunctions {
    /// g φ_j at the rows of each group.
    fn new(
        likelihood: &Likelihood<'_>,
        base: &BaseFit,
        groups: &[(usize, usize)],
        functions: &[Vec<f64>],
        g: &[f64],
    ) -> Self {
        let mut distinct = groups.to_vec();
        distinct.sort_unstable();
        distinct.dedup();
        let wanted: Vec<((usize, usize), usize)> = (distinct.iter())
            .flat_map(|&group| (0..functions.len()).map(move |degree| (group, degree)))
            .collect();
        let columns: Vec<DVector<f64>> = (wanted.par_iter())
            .map(|&(group, degree)| {
                let function = &functions[degree];
                let column: Vec<f64> = (0..g.len())
                    .map(|i| {
                        if groups[i] == group {
                            g[i] * function[i]
                        } else {
                            0.0
                        }
                    })
                    .collect();
                base.visible(likelihood, &column)
            })
            .collect();
        let x = DMatrix::from_columns(&columns);
        let own = likelihood.noise.model_error;
        Self {
            error: own.map_or(0.0, |error| error.relative),
            degrees: wanted.iter().map(|w| w.1).collect(),
            normal: x.tr_mul(&x),
            right: x.tr_mul(&base.residual),
        }
    }

    /// For each size, with variances in the ratio of `weight`, beyond what the model's own error gains.
    fn gains(&self, weight: impl Fn(usize) -> f64) -> Vec<f64> {
        let most = self.degrees.iter().max().map_or(0, |last| last + 1);
        // cosines and polynomials have a mean square of about a half, but the constant
        let square = |degree: usize| if degree == 0 { 1.0 } else { 0.5 };
        let total: f64 = (0..most).map(|d| weight(d) * square(d)).sum();
        let of_size = |size: f64| {
            let variance = |d: &usize| size * size * weight(*d) / total;
            let roots = DVector::from_iterator(
                self.degrees.len(),
                self.degrees.iter().map(|d| variance(d).sqrt()),
            );
            log_gain(&self.normal, &self.right, &roots)
        };
        let unmissed = of_size(self.error);
        SIZES.map(|size| of_size(size) - unmissed).to_vec()
    }
}

/// ½ bᵀ (A + V⁻¹)⁻¹ b − ½ ln det(I + V A) with the roots of the diagonal V.
fn log_gain(normal: &DMatrix<f64>, right: &DVector<f64>, roots: &DVector<f64>) -> f64 {
    let scaled = right.component_mul(roots);
    let mut matrix = DMatrix::from_fn(roots.len(), roots.len(), |i, j| {
        roots[i] * normal[(i, j)] * roots[j]
    });
    for i in 0..roots.len() {
        matrix[(i, i)] += 1.0;
    }
    let Some(factor) = matrix.cholesky() else {
        return f64::NEG_INFINITY;
    };
    let half_log_determinant: f64 = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
    0.5 * scaled.dot(&factor.solve(&scaled)) - half_log_determinant
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One column, one unknown size: the closed form of the Gaussian integral over it.
    #[test]
    fn the_gain_of_one_function_is_its_closed_form() {
        let (a, b, v) = (40.0, 30.0, 0.09f64);
        let gain = log_gain(
            &DMatrix::from_element(1, 1, a),
            &DVector::from_element(1, b),
            &DVector::from_element(1, v.sqrt()),
        );
        // ∫ exp(b x − a x²/2) N(x; 0, v) dx by the midpoint rule
        let (steps, reach) = (20_000, 10.0 * v.sqrt());
        let width = 2.0 * reach / steps as f64;
        let integral: f64 = (0..steps)
            .map(|i| {
                let x = -reach + (i as f64 + 0.5) * width;
                let prior = (-0.5 * x * x / v).exp() / (2.0 * PI * v).sqrt();
                (b * x - 0.5 * a * x * x).exp() * prior * width
            })
            .sum();
        assert!(
            (gain - integral.ln()).abs() < 1e-9,
            "{gain} {}",
            integral.ln()
        );
    }
}
