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

use nalgebra::{DMatrix, DVector};

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

/// Equality-constrained solution on one set.
struct Trial {
    active: Vec<usize>,
    pressure: DVector<f64>,
    approach: f64,
}

impl Trial {
    fn on(problem: &Problem, mut active: Vec<usize>) -> Result<Self, UnilateralError> {
        active.sort_unstable();
        let reduced = Reduced::new(problem, &active)?;
        let approach = match problem.drive {
            Drive::Load(load) => {
                (load + reduced.lever.dot(&reduced.y)) / reduced.lever.dot(&reduced.x)
            }
            Drive::Approach(phi) => phi,
        };
        let pressure = &reduced.x * approach - &reduced.y;
        Ok(Self {
            active,
            pressure,
            approach,
        })
    }

    /// Residual r of every point.
    fn residual(&self, problem: &Problem) -> Vec<f64> {
        let mut r: Vec<f64> = problem
            .gap
            .iter()
            .zip(problem.arm)
            .map(|(g, a)| g - self.approach * a)
            .collect();
        for (&l, &p) in self.active.iter().zip(self.pressure.iter()) {
            for (rk, w) in r.iter_mut().zip(problem.w.column(l).iter()) {
                *rk += w * p;
            }
        }
        r
    }

    fn primal_dual_set(&self, problem: &Problem) -> Vec<usize> {
        let mut keep = vec![false; problem.gap.len()];
        let residual = self.residual(problem);
        let scale = self.scale(problem);
        for (k, flag) in keep.iter_mut().enumerate() {
            *flag = residual[k] < -1e-12 * scale * problem.arm[k].abs();
        }
        for (&k, &p) in self.active.iter().zip(self.pressure.iter()) {
            keep[k] = p > 0.0;
        }
        (0..keep.len()).filter(|&k| keep[k]).collect()
    }

    /// A length typical of the approach, for tolerances relative to it.
    fn scale(&self, problem: &Problem) -> f64 {
        let least = problem
            .gap
            .iter()
            .zip(problem.arm)
            .map(|(g, a)| g / a)
            .fold(f64::INFINITY, f64::min);
        (self.approach - least).abs().max(f64::MIN_POSITIVE)
    }

    fn into_solution(self, problem: &Problem, iterations: usize) -> Solution {
        let residual = self.residual(problem);
        let scale = self.scale(problem);
        let penetration = residual
            .iter()
            .zip(problem.arm)
            .map(|(r, a)| -r / (a.abs() * scale))
            .fold(0.0, f64::max);
        let mut pressure = vec![0.0; problem.gap.len()];
        for (&k, &p) in self.active.iter().zip(self.pressure.iter()) {
            pressure[k] = p;
        }
        Solution {
            pressure,
            approach: self.approach,
            active: self.active,
            iterations,
            penetration,
        }
    }
}

/// The two solves on a set: x = W⁻¹ a, y = W⁻¹ g.
struct Reduced {
    lever: DVector<f64>,
    x: DVector<f64>,
    y: DVector<f64>,
}

impl Reduced {
    fn new(problem: &Problem, active: &[usize]) -> Result<Self, UnilateralError> {
        let m = active.len();
        let w = DMatrix::from_fn(m, m, |i, j| problem.w[(active[i], active[j])]);
        let mut rhs = DMatrix::from_fn(m, 2, |i, c| [problem.arm, problem.gap][c][active[i]]);
        let singular = UnilateralError::Singular { active: m };
        if problem.symmetric {
            w.cholesky().ok_or(singular)?.solve_mut(&mut rhs);
        } else if !w.lu().solve_mut(&mut rhs) {
            return Err(singular);
        }
        let lever = DVector::from_fn(m, |i, _| problem.lever[active[i]]);
        Ok(Self {
            lever,
            x: rhs.column(0).into(),
            y: rhs.column(1).into(),
        })
    }
}

/// Primal active-set method, one change per iteration.
fn one_by_one(problem: &Problem) -> Result<Solution, UnilateralError> {
    let n = problem.gap.len();
    let limit = 50 * n + 100;
    let (start, _) = problem
        .gap
        .iter()
        .zip(problem.arm)
        .map(|(g, a)| g / a)
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .ok_or(UnilateralError::Separated {
            gap: f64::NAN,
            approach: 0.0,
        })?;
    let mut feasible = vec![0.0; n];
    let mut active = vec![start];
    if let Drive::Load(load) = problem.drive {
        feasible[start] = load / problem.lever[start];
    }
    let mut last = Vec::new();
    for iteration in 1..=limit {
        let trial = Trial::on(problem, active.clone())?;
        // largest step towards the trial that keeps every pressure ≥ 0
        let mut step = 1.0;
        let mut blocking = None;
        for (&k, &p) in trial.active.iter().zip(trial.pressure.iter()) {
            if p < 0.0 {
                let t = feasible[k] / (feasible[k] - p);
                if t < step {
                    step = t;
                    blocking = Some(k);
                }
            }
        }
        for (&k, &p) in trial.active.iter().zip(trial.pressure.iter()) {
            feasible[k] += step * (p - feasible[k]);
        }
        if let Some(k) = blocking {
            feasible[k] = 0.0;
            active.retain(|&a| a != k);
            last = vec![k];
            if active.is_empty() {
                return Err(UnilateralError::Separated {
                    gap: 0.0,
                    approach: trial.approach,
                });
            }
            continue;
        }
        let residual = trial.residual(problem);
        let scale = trial.scale(problem);
        let worst = (0..n)
            .filter(|k| trial.active.binary_search(k).is_err())
            .map(|k| (k, residual[k] / problem.arm[k].abs()))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        match worst {
            Some((k, violation)) if violation < -1e-12 * scale => {
                active.push(k);
                last = vec![k];
            }
            _ => return Ok(trial.into_solution(problem, PRIMAL_DUAL_LIMIT + iteration)),
        }
    }
    Err(UnilateralError::NotSettled {
        iterations: limit,
        flipping: last,
    })
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

/// Sensitivity of the pressures on the active set to their weighted gaps at fixed load:
/// dλ = −S dg with S = W⁻¹ − x (W⁻ᵀ b)ᵀ/(b·x), x = W⁻¹ a (at fixed approach S = W⁻¹). Rows and columns follow `active`.
///
/// # Errors
/// [`UnilateralError::Singular`] if the set's compliance cannot be inverted.
pub fn sensitivity(problem: &Problem, active: &[usize]) -> Result<DMatrix<f64>, UnilateralError> {
    let m = active.len();
    let singular = UnilateralError::Singular { active: m };
    let w = DMatrix::from_fn(m, m, |i, j| problem.w[(active[i], active[j])]);
    let arm = DVector::from_fn(m, |i, _| problem.arm[active[i]]);
    let mut s = if problem.symmetric {
        w.cholesky().ok_or(singular)?.inverse()
    } else {
        w.try_inverse().ok_or(singular)?
    };
    if matches!(problem.drive, Drive::Load(_)) {
        let x = &s * &arm;
        let lever = DVector::from_fn(m, |i, _| problem.lever[active[i]]);
        let left = s.tr_mul(&lever);
        let scale = 1.0 / lever.dot(&x);
        s.ger(-scale, &x, &left, 1.0);
    }
    Ok(s)
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
