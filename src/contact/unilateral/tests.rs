//! The solver against trying every set, and against the conditions of contact on random problems.

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
        if trial.pressure.iter().all(|&p| p >= 0.0) && trial.residual.iter().all(|&r| r >= -1e-10) {
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

/// One slice is the contact that it was, by the same conditions of contact.
#[test]
fn one_slice_is_the_contact_itself() {
    let mut seed = 11;
    for n in [2, 6, 20] {
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
        let alone = solve(&problem, &[]).unwrap();
        let joint = JointProblem {
            sections: &[Section {
                w: &w,
                arm: &arm,
                lever: &arm,
            }],
            at: &[0],
            gaps: std::slice::from_ref(&gap),
            weights: &[1.0],
            load: 2.0,
            symmetric: true,
        };
        let found = solve_joint(&joint, &[]).unwrap();
        assert_eq!(found.active[0], alone.active);
        for (a, b) in found.pressure[0].iter().zip(&alone.pressure) {
            assert!((a - b).abs() < 1e-12);
        }
    }
}

/// Slices of unlike gaps satisfy the conditions of contact with one approach and carry the load together, some of them nothing.
#[test]
fn slices_share_one_approach_and_one_load() {
    let mut seed = 5;
    for case in 0..40 {
        let (n, count) = (8, 5);
        let m = DMatrix::from_fn(n, n, |_, _| random(&mut seed) - 0.5);
        let w = &m * m.transpose() + DMatrix::identity(n, n) * 0.05;
        let arm: Vec<f64> = (0..n).map(|_| 0.5 + random(&mut seed)).collect();
        let gaps: Vec<Vec<f64>> = (0..count)
            .map(|i| {
                (0..n)
                    .map(|_| random(&mut seed) + 0.3 * f64::from(i * (case % 4)))
                    .collect()
            })
            .collect();
        let weights = [0.1, 0.3, 0.2, 0.15, 0.25];
        let problem = JointProblem {
            sections: &[Section {
                w: &w,
                arm: &arm,
                lever: &arm,
            }],
            at: &vec![0; gaps.len()],
            gaps: &gaps,
            weights: &weights,
            load: 0.7,
            symmetric: true,
        };
        let found = solve_joint(&problem, &[]).unwrap();
        let mut carried = 0.0;
        for (i, pressure) in found.pressure.iter().enumerate() {
            for k in 0..n {
                let closed: f64 = (0..n).map(|l| w[(k, l)] * pressure[l]).sum();
                let r = gaps[i][k] + closed - found.approach * arm[k];
                assert!(pressure[k] >= 0.0 && r > -1e-10, "{r} at {k} of {i}");
                assert!(pressure[k] * r < 1e-10);
            }
            let own: f64 = pressure.iter().zip(&arm).map(|(p, a)| p * a).sum();
            carried += weights[i] * own;
        }
        assert!((carried - 0.7).abs() < 1e-12, "{carried}");
    }
}

/// A rigid wedge on Winkler springs: K_Hβ = 1 + X up to X = 1 and 2 √X beyond, X = F c/(2 w) (ISO 6336-1 and DIN 3990-1, linear bedding),
/// at the end of the face; at the outermost of n slices, half a slice from it, the straight line of the load is 2X/(2n) or less lower.
#[test]
fn a_rigid_wedge_on_springs_loads_its_end_as_the_standards_say() {
    let (stiffness, mean) = (20.0, 150.0);
    let w = DMatrix::from_element(1, 1, 1.0 / stiffness);
    let count = 2000;
    for wedge in [3.0, 10.0, 15.0, 40.0, 150.0] {
        let place = |i: usize| (i as f64 + 0.5) / count as f64 - 0.5;
        let gaps: Vec<Vec<f64>> = (0..count).map(|i| vec![wedge * place(i)]).collect();
        let weights = vec![1.0 / count as f64; count];
        let problem = JointProblem {
            sections: &[Section {
                w: &w,
                arm: &[1.0],
                lever: &[1.0],
            }],
            at: &vec![0; gaps.len()],
            gaps: &gaps,
            weights: &weights,
            load: mean,
            symmetric: true,
        };
        let found = solve_joint(&problem, &[]).unwrap();
        let x: f64 = wedge * stiffness / (2.0 * mean);
        let expected = if x <= 1.0 { 1.0 + x } else { 2.0 * x.sqrt() };
        let factor = found.pressure[0][0] / mean;
        let off = x / count as f64;
        assert!(
            (factor + off - expected).abs() < 1e-3 * expected,
            "{factor}, {expected}"
        );
        let carrying = found.pressure.iter().filter(|p| p[0] > 0.0).count() as f64 / count as f64;
        let wide = if x <= 1.0 { 1.0 } else { 1.0 / x.sqrt() };
        assert!(
            (carrying - wide).abs() < 2.0 / count as f64,
            "{carrying}, {wide}"
        );
    }
}

/// Small changes of the gaps change pressures and approach as differences do.
#[test]
fn joint_linearisation_is_that_of_differences() {
    let mut seed = 23;
    let n = 6;
    let m = DMatrix::from_fn(n, n, |_, _| random(&mut seed) - 0.5);
    let w = &m * m.transpose() + DMatrix::identity(n, n) * 0.1;
    let arm = vec![1.0; n];
    let gaps: Vec<Vec<f64>> = (0..3)
        .map(|_| (0..n).map(|_| 0.1 * random(&mut seed)).collect())
        .collect();
    let at = |gaps: &[Vec<f64>]| {
        let problem = JointProblem {
            sections: &[Section {
                w: &w,
                arm: &arm,
                lever: &arm,
            }],
            at: &[0; 3],
            gaps,
            weights: &[0.2, 0.5, 0.3],
            load: 3.0,
            symmetric: true,
        };
        let found = solve_joint(&problem, &[]).unwrap();
        let active: Vec<&[usize]> = found.active.iter().map(Vec::as_slice).collect();
        let linear = JointLinearised::new(&problem, None, &active).unwrap();
        (found, linear)
    };
    let (base, linear) = at(&gaps);
    let change: Vec<Vec<f64>> = (0..3)
        .map(|_| (0..n).map(|_| random(&mut seed) - 0.5).collect())
        .collect();
    let h = 1e-7;
    let moved: Vec<Vec<f64>> = (gaps.iter().zip(&change))
        .map(|(g, d)| g.iter().zip(d).map(|(g, d)| g + h * d).collect())
        .collect();
    let (after, _) = at(&moved);
    let right = (base.active.iter().zip(&change))
        .map(|(active, d)| nalgebra::DVector::from_fn(active.len(), |i, _| -d[active[i]]));
    let (x, psi) = linear.solve(right.collect(), 0.0);
    assert!(((after.approach - base.approach) / h - psi).abs() < 1e-5 * psi.abs().max(1.0));
    let sensitivities = linear.sensitivities();
    for i in 0..3 {
        // the same by the sensitivities at a fixed approach and the common approach
        let own = &sensitivities[i];
        let gap =
            nalgebra::DVector::from_fn(base.active[i].len(), |j, _| change[i][base.active[i][j]]);
        let by_parts = &own.drive * psi - &own.fixed * gap;
        for (j, &k) in base.active[i].iter().enumerate() {
            let difference = (after.pressure[i][k] - base.pressure[i][k]) / h;
            assert!((difference - x[i][j]).abs() < 1e-4 * difference.abs().max(1.0));
            assert!((by_parts[j] - x[i][j]).abs() < 1e-10 * x[i][j].abs().max(1.0));
        }
    }
}

/// A body that pulls where it is pushed has no solution: the set of points in contact turns to and fro, and that is said.
#[test]
fn a_set_that_never_settles_is_refused() {
    let w = DMatrix::from_element(1, 1, -1.0);
    let problem = Problem {
        w: &w,
        gap: &[0.0],
        arm: &[1.0],
        lever: &[1.0],
        drive: Drive::Approach(1.0),
        symmetric: false,
    };
    let error = by_approach::by_approach(&problem, &[0]).unwrap_err();
    assert!(
        matches!(&error, UnilateralError::NotSettled { iterations, flipping } if *iterations > 0 && flipping == &[0]),
        "{error}"
    );
}
