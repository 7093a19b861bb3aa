//! Log evidence of a smooth discrepancy of unknown cause, a Gaussian process beside the base model.
//!
//! ```text
//! of every curve its own:   m ~ GP(0, r² a_i a_j exp(−Δs²/2l²) exp(−Δln n²/2g²)) within one test, member, quantity and place across the face
//! common to all tests:      m = g Σ_j a_j φ_j(driver),  a_j ~ N(0, r² w_j)       driver: the position on a member, or the cycles;
//!                           of the cycles also (1/n) ∫₀ⁿ φ_j dn', what a factor φ_j on the wear rate leaves on a depth worn evenly
//! ln Z(r) = ½ bᵀ (A + V⁻¹)⁻¹ b − ½ ln det(I + V A)       A = XᵀX, b = Xᵀz whitened, freed of what k and the model's parameters do
//! ```
//! a: a curve's largest magnitude, the model's own where a curve is a single row; g: the same, or the model's own value. What is common to all tests has few terms and is seen where
//! it is weak; but so is what the model itself computes a little wrong at the same place in every test: only what is gained beyond a
//! discrepancy of the size of the model's own error counts.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::basis::{self, mean_waves, numbered, polynomials, waves};
use crate::learn::candidates::fitted_candidate::orthonormalise;
use crate::learn::candidates::likelihood::{Likelihood, OWN_FORM};
use crate::learn::fitting::region::FlankRegions;
use crate::learn::hypothesis::parameters::Parameter;
use crate::learn::inference::search::SearchEnd;
use crate::learn::noise::{Covariance, Discrepancy, ModelError, amplitudes};
use crate::measure::{Observation, Quantity, Subject};
use crate::numeric::logarithm::log_mean_exp;

/// Sizes of the discrepancy relative to the curve; where it is common to all tests also larger ones, since a rate may change at any time
/// as much as it will.
const SIZES: [f64; 4] = [0.02, 0.05, 0.12, 0.3];
const COMMON_SIZES: [f64; 5] = [0.02, 0.05, 0.12, 0.3, 0.7];
/// Functions of the position and of the cycles.
const ALONG: usize = 32;
const OVER_CYCLES: usize = 8;
/// Correlation lengths along the position, shares of the range, and ratios of a polynomial's variance to that of a degree less.
const LENGTHS: [f64; 3] = [0.03, 0.08, 0.25];
const RATIOS: [f64; 2] = [0.3, 0.7];

/// Log evidence of a fitted model with a discrepancy: the mean over its kinds and sizes. `change`: what the model's effects change, whose
/// form is uncertain ([`Likelihood::evidence`]); None of the base model.
pub(in crate::learn) fn log_evidence(
    likelihood: &Likelihood<'_>,
    fit: &SearchEnd,
    parameters: &[Parameter],
    change: Option<&[f64]>,
) -> f64 {
    let observations = likelihood.observations();
    let size = sizes(&observations, &fit.model);
    let form = change.map(|change| (change, OWN_FORM));
    let even = even_sizes(&observations, &size);
    let each = curves(&size, &even).into_par_iter().map(|error| {
        let errors: Vec<_> = [error].into_iter().chain(form).collect();
        let covariance = likelihood.covariance_with(&errors);
        likelihood.evidence_in(&covariance, fit, parameters).0
    });
    let each: Vec<f64> = each.collect();
    // the fit may have been made with another covariance, so its own normal equations are not asked
    let own: Vec<_> = form.into_iter().collect();
    let covariance = likelihood.covariance_with(&own);
    let before = likelihood.evidence_in(&covariance, fit, parameters).0;
    let common = before + log_mean_exp(&common(likelihood, fit, &covariance, &observations, &size));
    log_mean_exp(&[log_mean_exp(&each), common])
}

/// Discrepancies of each curve's own, with their sizes at each row: as large as the curve is, or `even` where a measuring machine makes
/// them, a new one at every checkpoint.
fn curves<'a>(size: &'a [f64], even: &'a [f64]) -> Vec<(&'a [f64], ModelError)> {
    let mut grid = Vec::new();
    for relative in SIZES {
        let error = |along, over_cycles| ModelError {
            relative,
            along,
            over_cycles,
        };
        for along in [0.08, 0.25] {
            grid.push((size, error(along, 0.7)));
            grid.push((size, error(along, 3.0)));
        }
        grid.push((even, error(0.5, 0.1)));
    }
    grid
}

/// The largest magnitude measured in each row's curve, or what the model gives where a curve is a single row: a discrepancy in proportion to a
/// measured value would follow that value's own noise.
fn sizes(observations: &[&Observation], model: &[f64]) -> Vec<f64> {
    let rows = rows_at_checkpoints(observations);
    let measured = amplitudes(observations).into_iter();
    let each = measured.zip(model).zip(observations);
    each.map(|((measured, model), o)| match rows[&checkpoint(o)] {
        1 => model.abs(),
        _ => measured,
    })
    .collect()
}

/// What rows of one curve have in common, but for the place across the face.
type Checkpoint = (usize, Subject, Quantity, u64);

fn checkpoint(o: &Observation) -> Checkpoint {
    (o.test, o.member, o.quantity, o.cycles.to_bits())
}

fn rows_at_checkpoints(observations: &[&Observation]) -> BTreeMap<Checkpoint, usize> {
    let mut rows = BTreeMap::new();
    for o in observations {
        *rows.entry(checkpoint(o)).or_default() += 1;
    }
    rows
}

/// The mean of the sizes over all rows of a quantity, at each row that does not stand alone at its checkpoint: a discrepancy that is a new one at
/// every checkpoint of a single row is nothing but noise larger than stated, and no cause.
fn even_sizes(observations: &[&Observation], size: &[f64]) -> Vec<f64> {
    let rows = rows_at_checkpoints(observations);
    let mut sums: BTreeMap<Quantity, (f64, f64)> = BTreeMap::new();
    for (o, size) in observations.iter().zip(size) {
        let sum = sums.entry(o.quantity).or_default();
        *sum = (sum.0 + size, sum.1 + 1.0);
    }
    let mean = |o: &&Observation| sums[&o.quantity].0 / sums[&o.quantity].1;
    let even = |o: &&Observation| {
        if rows[&checkpoint(o)] > 1 {
            mean(o)
        } else {
            0.0
        }
    };
    observations.iter().map(even).collect()
}

/// The most probable discrepancy beside a model, of each curve's own or common to all tests.
pub(in crate::learn) fn most_probable(
    likelihood: &Likelihood<'_>,
    fit: &SearchEnd,
    parameters: &[Parameter],
) -> Discrepancy {
    let observations = likelihood.observations();
    let size = sizes(&observations, &fit.model);
    let even = even_sizes(&observations, &size);
    let each = curves(&size, &even).into_par_iter().map(|(size, error)| {
        let covariance = likelihood.covariance_with(&[(size, error)]);
        let evidence = likelihood.evidence_in(&covariance, fit, parameters).0;
        (evidence, Discrepancy::EachCurve(size.to_vec(), error))
    });
    let mut all: Vec<(f64, Discrepancy)> = each.collect();
    let covariance = likelihood.covariance_with(&[]);
    let before = likelihood.evidence_in(&covariance, fit, parameters).0;
    let left = ProjectedResidual::new(likelihood, fit, &covariance);
    for (functions, weights) in shared(likelihood, &fit.model, &observations, &size) {
        let seen = SharedFunctions::new(&left, &functions);
        for weight in &weights {
            let best = (COMMON_SIZES.into_iter().zip(seen.gains(weight)))
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .expect("there are sizes");
            let roots = seen.deviations(weight, best.0);
            let columns = functions.columns();
            let scaled: Vec<DVector<f64>> = (columns.into_iter().zip(roots.iter()))
                .map(|(column, root)| DVector::from_vec(column) * *root)
                .collect();
            if !scaled.is_empty() {
                let functions = DMatrix::from_columns(&scaled);
                all.push((before + best.1, Discrepancy::Shared(functions)));
            }
        }
    }
    let best = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    best.expect("there are kinds of discrepancy").1
}

/// Functions common to all tests, each times `g`, one set for each group of rows.
struct Functions<'a> {
    g: &'a [f64],
    groups: Vec<(usize, usize)>,
    functions: basis::Functions,
}

/// The variance of a function by its degree.
type Weight = Box<dyn Fn(usize) -> f64 + Sync>;

impl Functions<'_> {
    /// Group and degree of each column.
    fn wanted(&self) -> Vec<((usize, usize), usize)> {
        let mut distinct = self.groups.clone();
        distinct.sort_unstable();
        distinct.dedup();
        (distinct.iter())
            .flat_map(|&group| (0..self.functions.len()).map(move |degree| (group, degree)))
            .collect()
    }

    fn column(&self, (group, degree): ((usize, usize), usize)) -> Vec<f64> {
        let own = |i: usize| self.groups[i] == group;
        let value = |i: usize| self.g[i] * self.functions[degree][i];
        let rows = 0..self.g.len();
        rows.map(|i| if own(i) { value(i) } else { 0.0 }).collect()
    }

    fn columns(&self) -> Vec<Vec<f64>> {
        self.wanted()
            .into_iter()
            .map(|at| self.column(at))
            .collect()
    }
}

/// The kinds of discrepancy common to all tests: of the position on each member, and of the cycles.
fn shared<'a>(
    likelihood: &Likelihood<'_>,
    model: &'a [f64],
    observations: &[&Observation],
    size: &'a [f64],
) -> Vec<(Functions<'a>, Vec<Weight>)> {
    let observations = || observations.iter().copied();
    let map = FlankRegions::new(likelihood.measured.study(), &likelihood.measured.data);
    let kinds = numbered(observations().map(|o| o.quantity));
    let places: Vec<f64> = observations()
        .map(|o| map.path(o).or(o.position).unwrap_or(0.0))
        .collect();
    let members: Vec<(usize, usize)> = observations()
        .map(|o| (o.member as usize, o.quantity as usize))
        .collect();
    let quantities: Vec<(usize, usize)> =
        observations().map(|o| (0, o.quantity as usize)).collect();
    let of_place = waves(&kinds, &places, ALONG);
    let by_length = |length: f64| -> Weight {
        Box::new(move |p| (-0.5 * (PI * length * p as f64).powi(2)).exp())
    };
    let along = |g: &'a [f64]| {
        let functions = Functions {
            g,
            groups: members.clone(),
            functions: of_place.clone(),
        };
        (functions, LENGTHS.map(by_length).into())
    };
    let over_cycles = |scale: fn(f64) -> f64| {
        let cycles: Vec<f64> = observations().map(|o| scale(o.cycles)).collect();
        let weight = |ratio: f64| -> Weight { Box::new(move |degree| ratio.powi(degree as i32)) };
        let functions = Functions {
            g: model,
            groups: quantities.clone(),
            functions: polynomials(&kinds, &cycles, OVER_CYCLES),
        };
        (functions, RATIOS.map(weight).into())
    };
    let rate_over_cycles = || {
        let cycles: Vec<f64> = observations().map(|o| o.cycles).collect();
        let functions = Functions {
            g: model,
            groups: quantities.clone(),
            functions: mean_waves(&cycles, ALONG),
        };
        (functions, LENGTHS.map(by_length).into())
    };
    vec![
        along(model),
        along(size),
        over_cycles(f64::ln_1p),
        over_cycles(|n| n),
        rate_over_cycles(),
    ]
}

/// Gains of log evidence by functions common to all tests.
fn common(
    likelihood: &Likelihood<'_>,
    fit: &SearchEnd,
    covariance: &Covariance,
    observations: &[&Observation],
    size: &[f64],
) -> Vec<f64> {
    let left = ProjectedResidual::new(likelihood, fit, covariance);
    let kinds = shared(likelihood, &fit.model, observations, size);
    let of = |(functions, weights): &(Functions<'_>, Vec<Weight>)| {
        let seen = SharedFunctions::new(&left, functions);
        weights
            .iter()
            .flat_map(move |weight| seen.gains(weight))
            .collect::<Vec<_>>()
    };
    kinds.iter().flat_map(of).collect()
}

/// What a fit leaves, whitened, with what its own parameters could still change taken out.
struct ProjectedResidual<'a> {
    covariance: &'a Covariance,
    /// The model's own error, relative.
    error: f64,
    adjustable: DMatrix<f64>,
    residual: DVector<f64>,
}

impl<'a> ProjectedResidual<'a> {
    fn new(likelihood: &Likelihood<'_>, fit: &SearchEnd, covariance: &'a Covariance) -> Self {
        let mut adjustable = covariance.whiten_all(&fit.jacobian);
        orthonormalise(&mut adjustable);
        let residual = covariance.whiten(&likelihood.residual(&fit.model));
        let own = likelihood.noise.model_error;
        Self {
            error: own.map_or(0.0, |error| error.relative),
            residual: DVector::from_vec(residual),
            adjustable,
            covariance,
        }
    }

    fn visible(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let white = self.covariance.whiten_all(columns);
        let along = self.adjustable.tr_mul(&white);
        white - &self.adjustable * along
    }
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
    fn new(left: &ProjectedResidual<'_>, functions: &Functions<'_>) -> Self {
        let wanted = functions.wanted();
        let columns: Vec<DVector<f64>> = (wanted.iter())
            .map(|&at| DVector::from_vec(functions.column(at)))
            .collect();
        let x = left.visible(&DMatrix::from_columns(&columns));
        Self {
            error: left.error,
            degrees: wanted.iter().map(|w| w.1).collect(),
            normal: x.tr_mul(&x),
            right: x.tr_mul(&left.residual),
        }
    }

    /// Each column's prior standard deviation at a size of the discrepancy, with variances in the ratio of `weight`.
    fn deviations(&self, weight: &Weight, size: f64) -> DVector<f64> {
        let most = self.degrees.iter().max().map_or(0, |last| last + 1);
        // cosines and polynomials have a mean square of about a half, but the constant
        let square = |degree: usize| if degree == 0 { 1.0 } else { 0.5 };
        let total: f64 = (0..most).map(|d| weight(d) * square(d)).sum();
        let variance = |d: &usize| size * size * weight(*d) / total;
        let roots = self.degrees.iter().map(|d| variance(d).sqrt());
        DVector::from_iterator(self.degrees.len(), roots)
    }

    /// For each size, beyond what the model's own error gains.
    fn gains(&self, weight: &Weight) -> Vec<f64> {
        let of_size = |size: f64| {
            let roots = self.deviations(weight, size);
            log_gain(&self.normal, &self.right, &roots)
        };
        let unmissed = of_size(self.error);
        COMMON_SIZES.map(|size| of_size(size) - unmissed).to_vec()
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
