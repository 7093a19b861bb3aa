//! Stiff integration of wear over cycles (or sliding distance) with error control.
//!
//! Short waves of a profile wear off within thousands of cycles while the depth grows over millions, so explicit steps
//! oscillate once they exceed the short waves' time constant (a saw tooth of spacing h grows when a step removes more
//! than about (4/π)·h·p/E*). The linearly implicit two-stage method ROS2 (Verwer, Spee, Blom & Hundsdorfer, SIAM J. Sci.
//! Comput. 20, 1999) is L-stable and of second order whatever matrix stands in for the Jacobian J:
//!
//! ```text
//! (I − γ τ J) k₁ = F(n, u)                      u' = u + (3/2) τ k₁ + (1/2) τ k₂
//! (I − γ τ J) k₂ = F(n + τ, u + τ k₁) − 2 k₁     error = (τ/2) (k₁ + k₂)
//! ```
//! with γ = 1 − 1/√2. The error is that of the embedded first-order solution u + τ k₁, so the step is on the safe side.

mod attempt;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use faer::Mat;

use self::attempt::Attempt;
use crate::contact::sequence::Sharing;
use crate::numeric::patchy::PatchyMatrix;
use crate::wear::shifted::Shifted;

/// A system du/dn = F(n, u) of worn depths u.
pub trait WearSystem {
    /// Error of an evaluation.
    type Error;

    /// F at `n` for the depths `u`.
    ///
    /// # Errors
    /// Whatever makes the rates unavailable.
    fn rate(&mut self, n: f64, u: &[f64]) -> Result<Vec<f64>, Self::Error>;

    /// An approximation of ∂F/∂u; it decides the stability, not the order, of a step. `None`: not stiff.
    ///
    /// # Errors
    /// Whatever makes the rates unavailable.
    fn jacobian(&mut self, n: f64, u: &[f64]) -> Result<Option<Jacobian>, Self::Error>;
}

/// A matrix that stands in for ∂F/∂u.
pub enum Jacobian {
    /// Any.
    Full(PatchyMatrix),
    /// Systems of one size that act on one another through few common quantities (slices of a face through the approach of each mesh
    /// position): J = diag(blocks) + U Vᵀ with U and V by block, each with one column for each quantity.
    Blocks {
        /// Each system by itself.
        blocks: Vec<PatchyMatrix>,
        /// How its rate follows the common quantities.
        drive: Vec<Mat<f64>>,
        /// How these follow its unknowns.
        follow: Vec<Mat<f64>>,
    },
    /// Passages of teeth of which some are in several: that of the classes of teeth.
    Shared {
        /// By class.
        of_classes: PatchyMatrix,
        /// Which passage holds which.
        sharing: Arc<Sharing>,
    },
}

/// A system whose rate is differentiated by some parameters.
pub trait Differentiable {
    /// Error of an evaluation.
    type Error;

    /// Derivatives at `n` where the depths `u` change by `du` per unit of each parameter: of the rate, (∂F/∂u) du + ∂F/∂θ, and of the
    /// products of [`WearSystem::jacobian`] with the vectors `along`.
    ///
    /// # Errors
    /// Whatever makes the rates unavailable.
    fn tangents(
        &mut self,
        n: f64,
        u: &[f64],
        du: &[Vec<f64>],
        along: &[&[f64]],
    ) -> Result<Tangents, Self::Error>;
}

/// What [`Differentiable::tangents`] gives.
pub struct Tangents {
    /// Of the rate, by parameter.
    pub rates: Vec<Vec<f64>>,
    /// Of the Jacobian's products, by parameter and vector.
    pub products: Vec<Vec<Vec<f64>>>,
}

/// Step control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepControl {
    /// Allowed error of a step, root mean square over the unknowns, relative to the largest depth.
    pub tolerance: f64,
    /// Smallest depth the tolerance refers to (unit of u).
    pub floor: f64,
    /// Largest depth the tolerance refers to (unit of u): deeper flanks are not worn more coarsely.
    pub ceiling: f64,
    /// First step (unit of n); later ones follow the error.
    pub first_step: f64,
    /// Whether the step after a refused one is no longer than it.
    pub hesitates: bool,
    /// Growth of the fastest unknown in a step below which the integration gives up (unit of u).
    pub least_growth: f64,
}

/// Where an integration stands: all it needs to go on, and so all a checkpoint must hold.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Stand {
    /// Cycles (or sliding distance) done.
    pub n: f64,
    /// Worn depths.
    pub u: Vec<f64>,
    /// Step proposed next.
    pub step: f64,
    /// Accepted steps so far.
    pub accepted: usize,
    /// Rejected steps so far.
    pub rejected: usize,
}

impl Stand {
    /// The start of an integration.
    pub fn new(u: Vec<f64>, control: StepControl) -> Self {
        Self {
            n: 0.0,
            u,
            step: control.first_step,
            accepted: 0,
            rejected: 0,
        }
    }
}

/// Why an integration ended early.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError<E> {
    /// The system could not be evaluated.
    #[error("{source}")]
    System {
        /// Where it happened (unit of n).
        n: f64,
        /// The reason.
        source: E,
    },
    /// The error cannot be held even with the smallest step.
    #[error(
        "at {n:.4e} cycles even a wear step of {step:.1e} cycles is too long (error {error:.3} of the allowed): the wear there is far too fast, or its law jumps"
    )]
    TooSmall {
        /// Where it happened (unit of n).
        n: f64,
        /// The step tried (unit of n).
        step: f64,
        /// Error over tolerance.
        error: f64,
    },
}

const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
const SAFETY: f64 = 0.85;

/// An accepted step: what its derivatives follow from.
pub struct Step {
    /// Where it began (unit of n).
    n: f64,
    /// Its length.
    tau: f64,
    /// Depths where it began, and at the second stage.
    u: [Vec<f64>; 2],
    k1: Vec<f64>,
    k2: Vec<f64>,
    shifted: Option<Shifted>,
}

/// Takes one accepted step of at most the proposed size, not beyond `end`.
///
/// # Errors
/// [`StepError`]; `stand` is untouched then.
pub fn advance<S: WearSystem>(
    system: &mut S,
    stand: &mut Stand,
    end: f64,
    control: StepControl,
) -> Result<Step, StepError<S::Error>> {
    let n = stand.n;
    let fail = |source| StepError::System { n, source };
    // first, for the rate comes with it
    let jacobian = system.jacobian(n, &stand.u).map_err(fail)?;
    let rate = system.rate(n, &stand.u).map_err(fail)?;
    let mut step = stand.step;
    let mut refused = false;
    loop {
        let tau = length(n, step, end);
        let attempt = Attempt::new(system, stand, (&rate, jacobian.as_ref()), tau).map_err(fail)?;
        let error = attempt.error(stand, control);
        // the error is of second order in the step
        let most = if refused && control.hesitates {
            1.0
        } else {
            4.0
        };
        let factor = if error > 0.0 {
            (SAFETY / error.sqrt()).clamp(0.2, most)
        } else {
            most
        };
        if error <= 1.0 {
            let taken = attempt.taken(stand);
            stand.n = if tau == end - n { end } else { n + tau };
            // a step shortened by the end says little about the size that would do
            stand.step = if tau < step {
                step.max(tau * factor)
            } else {
                tau * factor
            };
            stand.accepted += 1;
            return Ok(taken);
        }
        stand.rejected += 1;
        refused = true;
        let shorter = factor.min(0.7);
        step = tau * shorter;
        if shorter * attempt.growth() <= control.least_growth || !error.is_finite() {
            return Err(StepError::TooSmall { n, step, error });
        }
    }
}

/// The length of a step from `n` not beyond `end`: stretched a little rather than to leave a sliver before the end.
fn length(n: f64, step: f64, end: f64) -> f64 {
    if n + 1.01 * step >= end {
        end - n
    } else if n + 2.0 * step > end {
        0.5 * (end - n)
    } else {
        step
    }
}

impl Step {
    /// Its length (unit of n).
    pub fn length(&self) -> f64 {
        self.tau
    }

    /// Takes the derivatives `du` of the depths, one vector for each parameter, over the step.
    ///
    /// # Errors
    /// Whatever makes the rates unavailable; `du` is untouched then.
    pub fn follow<S: Differentiable>(
        &self,
        system: &mut S,
        du: &mut [Vec<f64>],
    ) -> Result<(), S::Error> {
        let Self { n, tau, .. } = *self;
        let stiff = self.shifted.is_some();
        let along: &[&[f64]] = if stiff { &[&self.k1, &self.k2] } else { &[] };
        let first = system.tangents(n, &self.u[0], du, along)?;
        let solve = |rate: &[f64], product: Option<&Vec<f64>>, dk1: Option<&Vec<f64>>| {
            let right = (0..rate.len()).map(|i| {
                let product = product.map_or(0.0, |p| GAMMA * tau * p[i]);
                rate[i] + product - dk1.map_or(0.0, |dk1| 2.0 * dk1[i])
            });
            implicit(self.shifted.as_ref(), right.collect())
        };
        let dk1: Vec<Vec<f64>> = (first.rates.iter().zip(&first.products))
            .map(|(rate, products)| solve(rate, products.first(), None))
            .collect();
        let middle: Vec<Vec<f64>> = (du.iter().zip(&dk1))
            .map(|(du, dk)| du.iter().zip(dk).map(|(u, k)| u + tau * k).collect())
            .collect();
        let second = system.tangents(n + tau, &self.u[1], &middle, &[])?;
        for (j, (du, rate)) in du.iter_mut().zip(&second.rates).enumerate() {
            let dk2 = solve(rate, first.products[j].get(1), Some(&dk1[j]));
            for ((u, a), b) in du.iter_mut().zip(&dk1[j]).zip(&dk2) {
                *u += tau * (1.5 * a + 0.5 * b);
            }
        }
        Ok(())
    }
}

/// Solves with I − γτJ.
fn implicit(shifted: Option<&Shifted>, mut rhs: Vec<f64>) -> Vec<f64> {
    if let Some(shifted) = shifted {
        shifted.solve(&mut rhs);
    }
    rhs
}
