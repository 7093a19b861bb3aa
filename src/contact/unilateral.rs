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
//! set; should it not settle, a primal active-set method with one change per iteration (Nocedal & Wright, Numerical
//! Optimization, 2006, Alg. 16.3), which cannot cycle on a strictly convex problem. The multipliers returned are always
//! computed from the sorted final set alone, so they do not depend on the way there.

mod one_by_one;
mod sensitivity;
mod trial;

use nalgebra::DMatrix;

use one_by_one::one_by_one;
pub use sensitivity::{Linearised, sensitivity};
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
    let mut active: Vec<usize> = start.iter().copied().filter(|&k| k < n).collect();
    if active.is_empty() {
        active = first_guess(problem)?;
    }
    let mut flipping = Vec::new();
    for iteration in 1..=PRIMAL_DUAL_LIMIT {
        let trial = Trial::on(problem, active)?;
        let next = trial.primal_dual_set(problem);
        if next == trial.active {
            return Ok(trial.into_solution(problem, iteration));
        }
        flipping = symmetric_difference(&next, &trial.active);
        active = if next.is_empty() {
            first_guess(problem)?
        } else {
            next
        };
    }
    if !problem.symmetric {
        return Err(UnilateralError::NotSettled {
            iterations: PRIMAL_DUAL_LIMIT,
            flipping,
        });
    }
    one_by_one(problem)
}

/// The points within the smallest gap plus a tenth of the spread: enough to start from.
fn first_guess(problem: &Problem) -> Result<Vec<usize>, UnilateralError> {
    let reduced: Vec<f64> = problem
        .gap
        .iter()
        .zip(problem.arm)
        .map(|(g, a)| g / a)
        .collect();
    let (index, &least) = reduced
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(b.1))
        .ok_or(UnilateralError::Separated {
            gap: f64::NAN,
            approach: 0.0,
        })?;
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
            // the approach if only the nearest point carried the load bounds the approach from above
            let bound = least
                + problem.w[(index, index)] * load / (problem.arm[index] * problem.lever[index]);
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
mod tests {
    use super::*;

    /// Independent second formulation: every one of the 2^n sets tried.
    fn brute_force(w: &DMatrix<f64>, gap: &[f64], arm: &[f64], load: f64) -> Vec<f64> {
        let n = gap.len();
        let problem = Problem {
            w,
            gap,
            arm,
            lever: arm,
            drive: Drive::Load(load),
            symmetric: true,
        };
        for mask in 1u32..(1 << n) {
            let set: Vec<usize> = (0..n).filter(|k| mask >> k & 1 == 1).collect();
            let trial = Trial::on(&problem, set).unwrap();
            if trial.pressure.iter().all(|&p| p >= 0.0)
                && trial.residual(&problem).iter().all(|&r| r >= -1e-10)
            {
                return trial.into_solution(&problem, 0).pressure;
            }
        }
        panic!("no solution")
    }

    fn random(seed: &mut u64) -> f64 {
        *seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1u64 << 53) as f64
    }

    #[test]
    fn agrees_with_trying_every_set() {
        let mut seed = 7;
        for n in [1, 2, 5, 8] {
            for _ in 0..50 {
                let m = DMatrix::from_fn(n, n, |_, _| random(&mut seed) - 0.5);
                let w = &m * m.transpose() + DMatrix::identity(n, n) * 0.05;
                let gap: Vec<f64> = (0..n).map(|_| random(&mut seed)).collect();
                let arm: Vec<f64> = (0..n).map(|_| 0.5 + random(&mut seed)).collect();
                let problem = Problem {
                    w: &w,
                    gap: &gap,
                    arm: &arm,
                    lever: &arm,
                    drive: Drive::Load(2.0),
                    symmetric: true,
                };
                let expected = brute_force(&w, &gap, &arm, 2.0);
                for solution in [solve(&problem, &[]).unwrap(), one_by_one(&problem).unwrap()] {
                    for (a, b) in solution.pressure.iter().zip(&expected) {
                        assert!(
                            (a - b).abs() < 1e-9,
                            "{:?} against {expected:?}",
                            solution.pressure
                        );
                    }
                    let load: f64 = solution.pressure.iter().zip(&arm).map(|(p, a)| p * a).sum();
                    assert!((load - 2.0).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn sensitivity_matches_differences() {
        let mut seed = 3;
        let n = 6;
        let m = DMatrix::from_fn(n, n, |_, _| random(&mut seed) - 0.5);
        let w = &m * m.transpose() + DMatrix::identity(n, n) * 0.1;
        let arm = vec![1.0; n];
        let gap: Vec<f64> = (0..n).map(|_| 0.1 * random(&mut seed)).collect();
        let problem = Problem {
            w: &w,
            gap: &gap,
            arm: &arm,
            lever: &arm,
            drive: Drive::Load(5.0),
            symmetric: true,
        };
        let base = solve(&problem, &[]).unwrap();
        let s = sensitivity(&problem, &base.active).unwrap();
        for (column, &k) in base.active.iter().enumerate() {
            let mut moved = gap.clone();
            moved[k] += 1e-7;
            let changed = solve(
                &Problem {
                    gap: &moved,
                    ..problem
                },
                &base.active,
            )
            .unwrap();
            for (row, &l) in base.active.iter().enumerate() {
                let slope = (changed.pressure[l] - base.pressure[l]) / 1e-7;
                assert!((slope + s[(row, column)]).abs() < 1e-5 * (1.0 + slope.abs()));
            }
        }
    }

    #[test]
    fn refuses_what_cannot_be_loaded() {
        let w = DMatrix::identity(2, 2);
        let at = |drive| Problem {
            w: &w,
            gap: &[0.1, 0.2],
            arm: &[1.0, 1.0],
            lever: &[1.0, 1.0],
            drive,
            symmetric: true,
        };
        assert!(matches!(
            solve(&at(Drive::Load(0.0)), &[]),
            Err(UnilateralError::BadLoad { .. })
        ));
        assert!(matches!(
            solve(&at(Drive::Load(f64::NAN)), &[]),
            Err(UnilateralError::BadLoad { .. })
        ));
        assert!(matches!(
            solve(&at(Drive::Approach(0.05)), &[]),
            Err(UnilateralError::Separated { .. })
        ));
        assert_eq!(
            solve(&at(Drive::Approach(0.15)), &[]).unwrap().active,
            vec![0]
        );
    }
}
