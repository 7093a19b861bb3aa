//! Claim: slices that are tied are one contact problem with a full compliance, and a prism under an even load is in plane strain.
//!
//! Sources: the plain contact solver on the full compliance; differences; the plane-strain solver; the closed forms of `gearwear validate S1`. Tolerance:
//! rounding, that of differences, that of the family.

use gearwear::contact::unilateral::{
    Drive, JointLinearised, JointProblem, Problem, Section, Ties, solve, solve_tied,
};
use gearwear::fem::structured::{Order, Patch};
use gearwear::fem::{Body, Prism};
use gearwear::material::Elastic;
use gearwear::numeric::Vec2;
use gearwear::verify::contact_and_wear::Effort;
use gearwear::verify::face_slices;
use nalgebra::{DMatrix, DVector};

/// Numbers from 0 to 1 (a linear congruence).
fn random(seed: &mut u64) -> f64 {
    *seed = seed
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

/// Slices tied to one another are one contact problem with a full compliance, which the plain solver solves.
#[test]
fn tied_slices_are_one_problem_with_a_full_compliance() {
    let mut seed = 41;
    for case in 0..30 {
        let (n, count) = (8, 4);
        let groups = [0..5, 5..8];
        let length: Vec<f64> = (0..n).map(|_| 0.5 + random(&mut seed)).collect();
        let m = DMatrix::from_fn(n, n, |_, _| 0.3 * (random(&mut seed) - 0.5));
        let lengths = DMatrix::from_fn(n, 2, |k, s| {
            if groups[s].contains(&k) {
                length[k]
            } else {
                0.0
            }
        });
        // each group bends by c per load, and ties take away what slices would bend apart
        let common = 0.4;
        let bending = &lengths * lengths.transpose() * common;
        let w = &m * m.transpose() + DMatrix::identity(n, n) * 0.05 + bending;
        let change = DMatrix::from_fn(2 * count, 2 * count, |a, b| {
            let apart = f64::from(u8::from(a == b)) - f64::from(u8::from(a % 2 == b % 2)) / 4.0;
            -common * apart
        });
        let arm: Vec<f64> = (0..n).map(|_| 0.5 + random(&mut seed)).collect();
        let gaps: Vec<Vec<f64>> = (0..count)
            .map(|i| {
                let apart = 0.2 * i as f64 * f64::from(case % 4);
                (0..n).map(|_| random(&mut seed) + apart).collect()
            })
            .collect();
        let weights = [0.1, 0.3, 0.35, 0.25];
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
        let ties = Ties {
            change: &change,
            groups: &groups,
            length: &length,
        };
        let (found, _) = solve_tied(&problem, &ties, &[]).unwrap();

        let at = |k: usize| (k / n, k % n);
        let full = DMatrix::from_fn(n * count, n * count, |a, b| {
            let ((i, k), (j, l)) = (at(a), at(b));
            let group = |k: usize| usize::from(!groups[0].contains(&k));
            let own = if i == j { w[(k, l)] } else { 0.0 };
            let tie = change[(2 * i + group(k), 2 * j + group(l))];
            own + length[k] * length[l] * tie
        });
        let all = |of: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
            (0..n * count).map(|a| of(at(a).0, at(a).1)).collect()
        };
        let one = Problem {
            w: &full,
            gap: &all(&|i, k| gaps[i][k]),
            arm: &all(&|_, k| arm[k]),
            lever: &all(&|i, k| weights[i] * arm[k]),
            drive: Drive::Load(0.7),
            symmetric: false,
        };
        let expected = solve(&one, &[]).unwrap();
        assert!((found.approach / expected.approach - 1.0).abs() < 1e-9);
        let scale = expected.pressure.iter().fold(0.0, |m: f64, p| m.max(*p));
        for (a, p) in expected.pressure.iter().enumerate() {
            let (i, k) = at(a);
            let off = (found.pressure[i][k] - p).abs();
            assert!(off < 1e-9 * scale, "{off:e} at {k} of {i}, case {case}");
        }

        // and linearised they follow gaps as differences do
        let active: Vec<&[usize]> = found.active.iter().map(Vec::as_slice).collect();
        let linear = JointLinearised::new(&problem, Some(&ties), &active).unwrap();
        let h = 1e-7;
        let moved: Vec<Vec<f64>> = (gaps.iter().enumerate())
            .map(|(i, gap)| gap.iter().map(|g| g + h * (1.0 + i as f64)).collect())
            .collect();
        let after = JointProblem {
            gaps: &moved,
            ..problem
        };
        let (after, _) = solve_tied(&after, &ties, &found.active).unwrap();
        if after.active != found.active {
            continue;
        }
        let right = (active.iter().enumerate())
            .map(|(i, set)| DVector::from_element(set.len(), -(1.0 + i as f64)));
        let (x, psi) = linear.solve(right.collect(), 0.0);
        let slope = (after.approach - found.approach) / h;
        assert!((slope - psi).abs() < 1e-5 * psi.abs());
        for (i, set) in active.iter().enumerate() {
            for (j, &k) in set.iter().enumerate() {
                let slope = (after.pressure[i][k] - found.pressure[i][k]) / h;
                assert!((slope - x[i][j]).abs() < 1e-4 * slope.abs().max(1.0));
            }
        }
    }
}

#[test]
fn without_a_wave_a_prism_is_in_plane_strain() {
    let steel = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };
    let map = |s, t| Vec2::new(10.0 * s, 2.0 * (t - 0.5));
    let patch = Patch::new(20, 4, Order::Quadratic, map).unwrap();
    let load = [(patch.right[4], Vec2::new(0.3, 1.0))];
    let body = Body::new(&patch.mesh, steel, &patch.left, &[]).unwrap();
    let prism = Prism::new(&patch.mesh, steel, &patch.left).unwrap();
    let moved = body.solve(&load).unwrap();
    let nodes: Vec<u32> = (0..patch.mesh.points.len() as u32).collect();
    let waved = prism.wave(0.0).unwrap().solve(&load, &nodes);
    let scale = moved.iter().fold(0.0, |m: f64, u| m.max(u.norm()));
    for (a, b) in moved.iter().zip(&waved) {
        assert!((a - b).norm() < 1e-9 * scale);
    }
}

/// The stiffness that ties slices against Kirchhoff's plate, and slices on springs against their closed forms.
#[test]
fn the_validation_family_of_slices_passes() {
    let figures = face_slices::all(Effort::Quick).unwrap();
    assert_eq!(figures.len(), 11);
    for figure in &figures {
        assert!(figure.passed(), "{figure}");
    }
}
