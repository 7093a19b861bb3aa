//! Frictionless (or full-slip) unilateral contact as a small dense complementarity problem.
//!
//! ```text
//! find λ ≥ 0 and the approach φ with
//!   r = g + W λ − φ a ≥ 0,   λ·r = 0,   b·λ = load
//! ```
//! λ_k are contact pressures (MPa) at the multiplier nodes, g the weighted gaps, W the weighted compliance, a the
//! weighted lever arms of the one rigid motion that closes the gap, b those of the load. Without friction b = a and W is
//! symmetric: then these are the optimality conditions of a strictly convex quadratic programme, so the solution is unique.
//!
//! Method: primal-dual active set (Hintermüller, Ito & Kunisch, SIAM J. Optim. 13, 2002), started from the neighbour's
//! set. As soon as it comes back to a set that it has been at, it would go round for ever, and the safe methods take over: with
//! a symmetric W and b = a a primal active-set method with one change per iteration (Nocedal & Wright, Numerical
//! Optimization, 2006, Alg. 16.3), which cannot cycle on a strictly convex problem; else principal pivoting at given approaches.
//! The multipliers returned are always computed from the sorted final set alone, so they do not depend on the way there.
//! Points that stand for the same place make W singular; they share that place's pressure.

mod by_approach;
mod factor;
mod joint;
mod one_by_one;
mod sensitivity;
mod tied;
mod trial;

use nalgebra::DMatrix;

use by_approach::by_approach;
use factor::ridged;
pub use joint::{
    JointLinearised, JointProblem, JointSolution, Section, SliceSensitivity, solve_joint,
};
use one_by_one::one_by_one;
pub use sensitivity::{Linearised, sensitivity};
pub use tied::{TiedSection, Ties, solve_tied};
use trial::Trial;

/// The rigid motion that presses the bodies together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive {
    /// The generalised load `b·λ` is given; the approach follows.
    Load(f64),
    /// The approach φ is given; the load follows.
    Approach(f64),
}

/// One contact problem; all slices have the same length n, `w` is n × n.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// Weighted compliance: closing of weighted gap k by unit pressure l, taken as opening.
    pub w: &'a DMatrix<f64>,
    /// Weighted initial gap at φ = 0.
    pub gap: &'a [f64],
    /// Weighted lever arm: closing of weighted gap k per unit of φ.
    pub arm: &'a [f64],
    /// Weighted lever of the load: generalised load per unit pressure (equal to `arm` without friction).
    pub lever: &'a [f64],
    /// Load or approach.
    pub drive: Drive,
    /// False if friction makes `w` unsymmetric.
    pub symmetric: bool,
}

/// Solution of a [`Problem`].
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Pressures, zero outside the active set.
    pub pressure: Vec<f64>,
    /// Approach φ.
    pub approach: f64,
    /// Indices in contact, ascending.
    pub active: Vec<usize>,
    /// Linear solves used.
    pub iterations: usize,
    /// Largest violation of r ≥ 0 over |φ| a (0 if none): a measure of penetration.
    pub penetration: f64,
}

/// Why a contact problem has no trustworthy solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnilateralError {
    /// The load is not positive or the data are not finite.
    #[error("contact load {load} is not a positive finite number, or the gaps are not finite")]
    BadLoad {
        /// The load found.
        load: f64,
    },
    /// The compliance of the active set is not positive definite.
    #[error("the compliance of {active} contact points is not positive definite")]
    Singular {
        /// Points in contact when it happened.
        active: usize,
    },
    /// The active set did not settle.
    #[error(
        "the contact set did not settle in {iterations} iterations; points {flipping:?} keep changing"
    )]
    NotSettled {
        /// Iterations spent.
        iterations: usize,
        /// Points that changed in the last iteration.
        flipping: Vec<usize>,
    },
    /// Nothing touches at the given approach.
    #[error("the bodies do not touch: smallest gap {gap:e}, approach {approach:e}")]
    Separated {
        /// Smallest weighted gap over arm.
        gap: f64,
        /// Approach given.
        approach: f64,
    },
}

const PRIMAL_DUAL_LIMIT: usize = 20;

/// Solves `problem`, starting from the set `start` (empty: from the points nearest to touching).
///
/// # Errors
/// See [`UnilateralError`]; an iterate that did not converge is never returned.
pub fn solve(problem: &Problem, start: &[usize]) -> Result<Solution, UnilateralError> {
    let n = problem.gap.len();
    let finite = problem.gap.iter().chain(problem.arm).all(|x| x.is_finite());
    let (drive, sound) = match problem.drive {
        Drive::Load(load) => (load, load.is_finite() && load > 0.0),
        Drive::Approach(approach) => (approach, approach.is_finite()),
    };
    if !(sound && finite) {
        return Err(UnilateralError::BadLoad { load: drive });
    }
    let start: Vec<usize> = start.iter().copied().filter(|&k| k < n).collect();
    match settle(problem, &start) {
        Err(UnilateralError::Singular { .. } | UnilateralError::NotSettled { .. }) => {
            let ridged = ridged(problem.w);
            let problem = Problem {
                w: &ridged,
                ..*problem
            };
            settle(&problem, &[])
        }
        settled => settled,
    }
}

/// The solution, if the compliance of every set met on the way is regular.
fn settle(problem: &Problem, start: &[usize]) -> Result<Solution, UnilateralError> {
    let mut active = start.to_vec();
    if active.is_empty() {
        active = first_guess(problem)?;
    }
    let mut been: Vec<Vec<usize>> = Vec::new();
    for iteration in 1..=PRIMAL_DUAL_LIMIT {
        let trial = Trial::on(problem, active)?;
        let next = trial.primal_dual_set(problem);
        if next == trial.active {
            return Ok(trial.into_solution(problem, iteration));
        }
        been.push(trial.active);
        active = if next.is_empty() {
            first_guess(problem)?
        } else {
            next
        };
        if been.contains(&active) {
            break;
        }
    }
    if problem.symmetric && problem.lever == problem.arm {
        one_by_one(problem)
    } else {
        by_approach(problem, &active)
    }
}

/// The point nearest to touching, and its gap over its arm.
fn nearest(problem: &Problem) -> Result<(usize, f64), UnilateralError> {
    let reduced = problem.gap.iter().zip(problem.arm).map(|(g, a)| g / a);
    reduced
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .ok_or(UnilateralError::Separated {
            gap: f64::NAN,
            approach: 0.0,
        })
}

/// How far the bodies approach if the point `k` alone carries the load: no less than where all that touch do.
fn alone(problem: &Problem, k: usize, load: f64) -> f64 {
    problem.w[(k, k)] * load / (problem.arm[k] * problem.lever[k])
}

/// The points within the smallest gap plus half of what the nearest would give way: enough to start from.
fn first_guess(problem: &Problem) -> Result<Vec<usize>, UnilateralError> {
    let (index, least) = nearest(problem)?;
    let reduced: Vec<f64> = problem
        .gap
        .iter()
        .zip(problem.arm)
        .map(|(g, a)| g / a)
        .collect();
    match problem.drive {
        Drive::Approach(phi) => {
            let set: Vec<usize> = (0..reduced.len()).filter(|&k| reduced[k] < phi).collect();
            if set.is_empty() {
                Err(UnilateralError::Separated {
                    gap: least,
                    approach: phi,
                })
            } else {
                Ok(set)
            }
        }
        Drive::Load(load) => {
            let bound = least + alone(problem, index, load);
            Ok((0..reduced.len())
                .filter(|&k| reduced[k] <= least + 0.5 * (bound - least))
                .collect())
        }
    }
}

fn symmetric_difference(a: &[usize], b: &[usize]) -> Vec<usize> {
    let only = |x: &[usize], y: &[usize]| {
        x.iter()
            .copied()
            .filter(|k| y.binary_search(k).is_err())
            .collect::<Vec<_>>()
    };
    let mut all = only(a, b);
    all.extend(only(b, a));
    all.sort_unstable();
    all
}

#[cfg(test)]
mod tests;
