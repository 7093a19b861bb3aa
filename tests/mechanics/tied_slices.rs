//! Claim: slices that are tied are one contact problem with a full compliance, and a prism under an even load is in plane strain.
//!
//! Sources: the plain contact solver on the full compliance; differences; the plane-strain solver; the closed forms of `gearwear validate S1`. Tolerance:
//! rounding, that of differences, that of the family.

use std::ops::Range;

use gearwear::contact::unilateral::{
    Drive, JointLinearised, JointProblem, Problem, Section, TiedSection, Ties, solve, solve_tied,
};
use gearwear::fem::structured::{Order, Patch};
use gearwear::fem::{Body, FreeEnds, Prism};
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

/// A section as the test makes it.
struct Made {
    w: DMatrix<f64>,
    arm: Vec<f64>,
    length: Vec<f64>,
    groups: Vec<Range<usize>>,
}

impl Made {
    /// Of groups of so many points. Each bends by `common` per load; what is left is random, and definite.
    fn new(sizes: &[usize], common: f64, seed: &mut u64) -> Self {
        let n = sizes.iter().sum();
        let mut first = 0;
        let groups: Vec<Range<usize>> = (sizes.iter())
            .map(|size| {
                first += size;
                first - size..first
            })
            .collect();
        let length: Vec<f64> = (0..n).map(|_| 0.5 + random(seed)).collect();
        let m = DMatrix::from_fn(n, n, |_, _| 0.3 * (random(seed) - 0.5));
        let lengths = DMatrix::from_fn(n, sizes.len(), |k, s| {
            if groups[s].contains(&k) {
                length[k]
            } else {
                0.0
            }
        });
        let bending = &lengths * lengths.transpose() * common;
        Self {
            w: &m * m.transpose() + DMatrix::identity(n, n) * 0.05 + bending,
            arm: (0..n).map(|_| 0.5 + random(seed)).collect(),
            length,
            groups,
        }
    }

    fn group(&self, k: usize) -> usize {
        let of_group = |group: &Range<usize>| group.contains(&k);
        self.groups.iter().position(of_group).unwrap()
    }
}

const SLICES: usize = 4;

/// Slices tied to one another are one contact problem with a full compliance, which the plain solver solves.
#[test]
fn tied_slices_are_one_problem_with_a_full_compliance() {
    let mut seed = 41;
    for case in 0..30 {
        let section = Made::new(&[5, 3], 0.4, &mut seed);
        let same = [0usize; SLICES];
        held_against_one_problem(&[section], same, |_, s| s, 0.4, case, &mut seed);
    }
}

/// So they are at sections that differ in points and tooth pairs, as those of helical gears do: here a tooth leaves the mesh between the slices, and another enters.
#[test]
fn tied_slices_at_several_sections_are_one_problem_too() {
    let mut seed = 43;
    for case in 0..30 {
        let sections = [&[5, 3][..], &[4], &[3, 2, 4]].map(|s| Made::new(s, 0.4, &mut seed));
        let at = [2, 0, 0, 1];
        let tooth = |i: usize, s: usize| s + [0, 1, 1, 2][i];
        held_against_one_problem(&sections, at, tooth, 0.4, case, &mut seed);
    }
}

/// Slices at the sections `at`, group s of slice i a part of `tooth(i, s)`; ties take away what the parts of a tooth would bend apart.
fn held_against_one_problem(
    sections: &[Made],
    at: [usize; SLICES],
    tooth: impl Fn(usize, usize) -> usize,
    common: f64,
    case: usize,
    seed: &mut u64,
) {
    let of_slice = |i: usize| &sections[at[i]];
    let groups: Vec<(usize, usize)> = (0..SLICES)
        .flat_map(|i| (0..of_slice(i).groups.len()).map(move |s| (i, s)))
        .collect();
    let teeth: Vec<usize> = groups.iter().map(|&(i, s)| tooth(i, s)).collect();
    let change = DMatrix::from_fn(groups.len(), groups.len(), |a, b| {
        let parts = teeth.iter().filter(|tooth| **tooth == teeth[a]).count();
        let together = f64::from(u8::from(teeth[a] == teeth[b]));
        -common * (f64::from(u8::from(a == b)) - together / parts as f64)
    });
    let gaps: Vec<Vec<f64>> = (0..SLICES)
        .map(|i| {
            let apart = 0.2 * i as f64 * (case % 4) as f64;
            let points = of_slice(i).arm.iter();
            points.map(|_| random(seed) + apart).collect()
        })
        .collect();
    let weights = [0.1, 0.3, 0.35, 0.25];
    let seen: Vec<Section> = (sections.iter())
        .map(|made| Section {
            w: &made.w,
            arm: &made.arm,
            lever: &made.arm,
        })
        .collect();
    let problem = JointProblem {
        sections: &seen,
        at: &at,
        gaps: &gaps,
        weights: &weights,
        load: 0.7,
        symmetric: true,
    };
    let tied: Vec<TiedSection> = (sections.iter())
        .map(|made| TiedSection {
            groups: &made.groups,
            length: &made.length,
        })
        .collect();
    let ties = Ties {
        change: &change,
        sections: &tied,
    };
    let (found, _) = solve_tied(&problem, &ties, &[]).unwrap();

    let points: Vec<(usize, usize)> = (0..SLICES)
        .flat_map(|i| (0..of_slice(i).arm.len()).map(move |k| (i, k)))
        .collect();
    let row = |(i, k): (usize, usize)| {
        let own = (i, of_slice(i).group(k));
        groups.iter().position(|group| *group == own).unwrap()
    };
    let full = DMatrix::from_fn(points.len(), points.len(), |a, b| {
        let (to, from) = (points[a], points[b]);
        let own = match to.0 == from.0 {
            true => of_slice(to.0).w[(to.1, from.1)],
            false => 0.0,
        };
        let lengths = [to, from].map(|(i, k)| of_slice(i).length[k]);
        own + lengths[0] * lengths[1] * change[(row(to), row(from))]
    });
    let all = |of: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
        points.iter().map(|&(i, k)| of(i, k)).collect()
    };
    let one = Problem {
        w: &full,
        gap: &all(&|i, k| gaps[i][k]),
        arm: &all(&|i, k| of_slice(i).arm[k]),
        lever: &all(&|i, k| weights[i] * of_slice(i).arm[k]),
        drive: Drive::Load(0.7),
        symmetric: false,
    };
    let expected = solve(&one, &[]).unwrap();
    assert!((found.approach / expected.approach - 1.0).abs() < 1e-9);
    let scale = expected.pressure.iter().fold(0.0, |m: f64, p| m.max(*p));
    for (&(i, k), p) in points.iter().zip(&expected.pressure) {
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
        return;
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

/// A beam between free ends that bends by an even load bends the other way across its width, ν times as much: wave 2 of (z − b/2)²/2 is b²/(2π²) (Timoshenko & Goodier
/// 1970, section 102).
#[test]
fn a_bent_beam_has_anticlastic_curvature() {
    let steel = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };
    let (reach, width, height) = (20.0, 2.0, 0.5);
    let map = |s, t| Vec2::new(reach * s, height * (t - 0.5));
    let patch = Patch::new(40, 2, Order::Quadratic, map).unwrap();
    let prism = Prism::new(&patch.mesh, steel, &patch.left).unwrap();
    let up = Vec2::new(0.0, 1.0);
    let node = |x: f64| {
        let apart = |node: &usize| (patch.mesh.points[*node] - Vec2::new(x, 0.0)).norm();
        let all = 0..patch.mesh.points.len();
        all.min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap() as u32
    };
    let loads: Vec<(u32, Vec2)> = (1..=10).map(|i| (node(2.0 * f64::from(i)), up)).collect();
    let answering = [0.3 / reach, 0.5 / height];
    let shapes = prism.end_shapes(width, &loads, &answering, &[]).unwrap();
    let points = vec![(node(reach), up), (node(0.5 * reach), up)];
    let ends = FreeEnds::new(&prism, shapes, points, width).unwrap();
    let answers: Vec<_> = (0..12)
        .map(|n| {
            let number = n as f64 * std::f64::consts::PI / width;
            ends.answer(&prism.wave(number).unwrap(), n)
        })
        .collect();
    let modes = ends.modes(&answers).unwrap();
    let found = modes.between([2, 1], [0, 0]);
    let bent = 0.5 * reach / (steel.youngs_modulus * f64::powi(height, 3) / 12.0);
    let expected = -steel.poisson_ratio * bent * width * width
        / (2.0 * std::f64::consts::PI * std::f64::consts::PI);
    assert!(
        (found / expected - 1.0).abs() < 0.02,
        "{found} for {expected}"
    );
}

/// The stiffness that ties slices against Kirchhoff's plate, and slices on springs against their closed forms.
#[test]
fn the_validation_family_of_slices_passes() {
    let figures = face_slices::all(Effort::Quick).unwrap();
    assert_eq!(figures.len(), 13);
    for figure in &figures {
        assert!(figure.passed(), "{figure}");
    }
}
