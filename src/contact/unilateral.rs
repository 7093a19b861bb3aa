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
mod one_by_one;
mod sensitivity;
mod trial;

use nalgebra::DMatrix;

use by_approach::by_approach;
use factor::ridged;
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

    /// What makes λ the solution, whatever way led there: r ≥ 0, λ ≥ 0, no pressure across a gap, the load carried.
    fn assert_solves(problem: &Problem, solution: &Solution) {
        let p = &solution.pressure;
        let largest = p.iter().fold(0.0, |m: f64, p| m.max(*p));
        let n = p.len();
        let opening = |k: usize| (0..n).map(|l| problem.w[(k, l)] * p[l]).sum::<f64>();
        // the size of the terms that cancel
        let terms = |k: usize| {
            (0..n)
                .map(|l| (problem.w[(k, l)] * p[l]).abs())
                .sum::<f64>()
        };
        let scale = (0..n)
            .map(|k| terms(k) + problem.gap[k].abs())
            .fold(f64::MIN_POSITIVE, f64::max);
        for k in 0..n {
            let r = problem.gap[k] + opening(k) - solution.approach * problem.arm[k];
            assert!(p[k] >= 0.0, "negative pressure: {p:?}");
            assert!(r >= -1e-9 * scale, "penetration {r} of {scale} at {k}");
            assert!(
                p[k] <= 1e-9 * largest || r.abs() <= 1e-9 * scale,
                "pressure {} across a gap of {r}",
                p[k]
            );
        }
        if let Drive::Load(load) = problem.drive {
            let carried: f64 = p.iter().zip(problem.lever).map(|(p, b)| p * b).sum();
            assert!((carried / load - 1.0).abs() < 1e-9, "{carried} of {load}");
        }
    }

    /// Ben Gharbia & Gilbert, Math. Program. 134 (2012): on this P-matrix the primal-dual method goes round for ever from any
    /// set of one or two points.
    #[test]
    fn a_set_that_goes_round_for_ever_is_settled_by_the_safe_method() {
        let w = DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 2.0, 2.0, 1.0, 0.0, 0.0, 2.0, 1.0]);
        let one = [1.0; 3];
        for drive in [Drive::Approach(1.0), Drive::Load(1.0)] {
            let problem = Problem {
                w: &w,
                gap: &[0.0; 3],
                arm: &one,
                lever: &one,
                drive,
                symmetric: false,
            };
            for start in [&[0][..], &[1], &[2], &[0, 2], &[0, 1, 2]] {
                let solution = solve(&problem, start).unwrap();
                for p in &solution.pressure {
                    assert!((p - 1.0 / 3.0).abs() < 1e-12, "{:?}", solution.pressure);
                }
            }
        }
    }

    mod any_problem {
        use super::*;
        use proptest::prelude::*;

        /// A body of `n` points of which some stand for the places of others, its compliance of less than full rank or nearly so.
        #[derive(Debug)]
        struct Drawn {
            w: DMatrix<f64>,
            gap: Vec<f64>,
            arm: Vec<f64>,
            lever: Vec<f64>,
            load: f64,
            start: Vec<usize>,
        }

        fn drawn(twins: bool, friction: f64) -> impl Strategy<Value = Drawn> {
            (3usize..24, any::<u64>(), -6f64..6.0, prop::bool::ANY).prop_map(
                move |(places, seed, load, flat)| {
                    let mut seed = seed;
                    let m = DMatrix::from_fn(places, places, |_, _| random(&mut seed) - 0.5);
                    // eigenvalues over twelve decades, as finer and finer grids have them
                    let stiff = DMatrix::from_fn(places, places, |i, j| {
                        if i == j {
                            10f64.powf(-12.0 * random(&mut seed))
                        } else {
                            0.0
                        }
                    });
                    let mut w = &m * stiff * m.transpose();
                    let size = w.diagonal().max();
                    w += DMatrix::identity(places, places) * (0.02 * size);
                    let skew = friction * 0.02 * size;
                    for i in 1..places {
                        w[(i, i - 1)] += skew;
                        w[(i - 1, i)] -= skew;
                    }
                    let at: Vec<usize> = (0..places)
                        .chain((0..places).filter(|_| twins && random(&mut seed) < 0.4))
                        .collect();
                    let gaps: Vec<f64> = (0..places)
                        .map(|_| if flat { 0.0 } else { size * random(&mut seed) })
                        .collect();
                    let arms: Vec<f64> = (0..places).map(|_| 0.5 + random(&mut seed)).collect();
                    let levers: Vec<f64> = arms
                        .iter()
                        .map(|a| {
                            if friction == 0.0 {
                                *a
                            } else {
                                a * (0.8 + 0.4 * random(&mut seed))
                            }
                        })
                        .collect();
                    Drawn {
                        w: DMatrix::from_fn(at.len(), at.len(), |i, j| w[(at[i], at[j])]),
                        gap: at.iter().map(|&i| gaps[i]).collect(),
                        arm: at.iter().map(|&i| arms[i]).collect(),
                        lever: at.iter().map(|&i| levers[i]).collect(),
                        load: 10f64.powf(load),
                        start: (0..at.len()).filter(|_| random(&mut seed) < 0.3).collect(),
                    }
                },
            )
        }

        /// The safe methods solve or say that points depend on one another.
        fn either(problem: &Problem, solved: Result<Solution, UnilateralError>) {
            match solved {
                Ok(solution) => assert_solves(problem, &solution),
                Err(error) => assert!(matches!(error, UnilateralError::Singular { .. }), "{error}"),
            }
        }

        fn holds(drawn: &Drawn, symmetric: bool) {
            let problem = Problem {
                w: &drawn.w,
                gap: &drawn.gap,
                arm: &drawn.arm,
                lever: &drawn.lever,
                drive: Drive::Load(drawn.load),
                symmetric,
            };
            let solution = solve(&problem, &drawn.start).unwrap();
            assert_solves(&problem, &solution);
            if symmetric && drawn.lever == drawn.arm {
                either(&problem, one_by_one(&problem));
            }
            either(&problem, by_approach(&problem, &[0]));
            assert!(sensitivity(&problem, &solution.active).is_ok());
        }

        proptest! {
            #![proptest_config(ProptestConfig { cases: 300, rng_seed: proptest::test_runner::RngSeed::Fixed(22), failure_persistence: None, ..ProptestConfig::default() })]

            #[test]
            fn is_settled(drawn in drawn(false, 0.0)) {
                holds(&drawn, true);
            }

            #[test]
            fn is_settled_where_points_stand_for_one_place(drawn in drawn(true, 0.0)) {
                holds(&drawn, true);
            }

            #[test]
            fn is_settled_with_friction(drawn in drawn(false, 0.9)) {
                holds(&drawn, false);
            }

            #[test]
            fn is_settled_with_friction_where_points_stand_for_one_place(drawn in drawn(true, 0.9)) {
                holds(&drawn, false);
            }
        }
    }
}
