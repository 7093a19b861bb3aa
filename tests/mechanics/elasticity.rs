//! Claim: the elastic solver is right: elements, supports, factor, condensation, stresses, and its refusals.
//!
//! ```text
//! A1..A9   verification cases of the library (closed forms, NAFEMS LE1, Cook), each with its own target and tolerance
//! body     compliance against a dense inverse assembled here and against one solution per load; refactor; same bits
//! errors   every input that has no answer gives the error that names it
//! ```
//! Sources stand at the case functions in `verify::elasticity`. Tolerances of the body tests: 1e-12 relative, rounding of
//! a solution of some hundred unknowns with condition numbers up to 1e4; identical routes must agree to the last bit.

use faer::Par;
use gearwear::fem::structured::{Diagonals, Order, Patch};
use gearwear::fem::{
    Axis, Body, Compliance, FemError, RESIDUAL_LIMIT, edge_traction, element_stiffness, elements,
    internal_forces, nodal_stress, strain_energy,
};
use gearwear::material::Elastic;
use gearwear::mesh::{Cells, Mesh};
use gearwear::numeric::Vec2;
use gearwear::verify::{Measured, elasticity};

const STEEL: Elastic = Elastic {
    youngs_modulus: 2.1e5,
    poisson_ratio: 0.3,
};

fn assert_passes(figures: Result<Vec<Measured>, FemError>) {
    let figures = figures.expect("the case runs");
    assert!(!figures.is_empty());
    for figure in figures {
        assert!(figure.passed(), "{figure:#?}");
    }
}

#[test]
fn a1_patch_test_of_every_triangle() {
    assert_passes(elasticity::a1_patch());
}

#[test]
fn a2_rigid_motions_cost_nothing_and_nothing_else_does() {
    assert_passes(elasticity::a2_rigid_motion());
}

#[test]
fn a3_manufactured_solution_converges_at_the_full_order() {
    assert_passes(elasticity::a3_manufactured());
}

#[test]
fn a4_thick_ring_matches_lame() {
    assert_passes(elasticity::a4_thick_ring());
}

#[test]
fn a5_quadratic_triangles_do_not_lock() {
    assert_passes(elasticity::a5_nearly_incompressible());
}

/// What linear triangles do instead: half the flexibility is gone at nu 0.4999 when all diagonals are parallel, nothing at
/// 0.3; a checkerboard of diagonals happens to escape (its constraints are linearly dependent).
#[test]
fn a5_linear_triangles_lock_unless_the_mesh_is_special() {
    let left = |nu, diagonals| elasticity::linear_triangle_locking(nu, diagonals).unwrap();
    assert!(left(0.3, Diagonals::Parallel) > 0.98);
    assert!(left(0.4999, Diagonals::Parallel) < 0.6);
    assert!(left(0.4999, Diagonals::Alternating) > 0.98);
}

#[test]
fn a6_nafems_elliptic_membrane() {
    assert_passes(elasticity::a6_elliptic_membrane());
}

#[test]
fn a7_cantilever_tip_and_energy() {
    assert_passes(elasticity::a7_cantilever());
}

#[test]
fn a8_cooks_membrane() {
    assert_passes(elasticity::a8_cook());
}

#[test]
fn a9_residuals_are_small() {
    assert_passes(elasticity::a9_residual());
}

/// The comparison itself must be able to fail: 1 % off is not within 0.5 %, and NaN never passes.
#[test]
fn a_wrong_figure_fails() {
    for mut figure in elasticity::a4_thick_ring().unwrap() {
        figure = Measured::relative(
            figure.id,
            figure.quantity,
            figure.value * 1.01,
            figure.target,
            figure.tolerance,
        );
        assert!(!figure.passed(), "{figure:?}");
    }
    assert!(!Measured::relative("-", "-", f64::NAN, 1.0, 1.0).passed());
}

/// A block 2 x 1 mm with a wavy top, held at the bottom.
fn block(nx: usize, ny: usize, order: Order, wave: f64) -> Patch {
    Patch::new(nx, ny, order, |s, t| {
        Vec2::new(2.0 * s, t + wave * t * (7.0 * s).sin())
    })
    .unwrap()
}

/// Part of the top in a scrambled order, and a node inside.
fn interface(patch: &Patch) -> Vec<u32> {
    let mut nodes: Vec<u32> = patch.top.iter().copied().step_by(2).collect();
    nodes.reverse();
    nodes.swap(0, 3);
    nodes.push(patch.node(3, 2));
    nodes
}

fn largest_difference(a: &Compliance, b: &Compliance) -> f64 {
    let scale = a.column(0).iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    (0..a.size())
        .flat_map(|j| {
            a.column(j)
                .iter()
                .zip(b.column(j))
                .map(|(a, b)| (a - b).abs())
        })
        .fold(0.0, f64::max)
        / scale
}

#[test]
fn compliance_is_the_interface_block_of_the_inverse_stiffness() {
    for order in [Order::Linear, Order::Quadratic] {
        let patch = block(6, 4, order, 0.1);
        let interface = interface(&patch);
        let compliance = Body::new(&patch.mesh, STEEL, &patch.bottom, &interface)
            .unwrap()
            .compliance();

        let n = 2 * patch.mesh.points.len();
        let mut stiffness = nalgebra::DMatrix::<f64>::zeros(n, n);
        for (number, element) in elements(&patch.mesh).enumerate() {
            let k = element_stiffness(&element, STEEL, number).unwrap();
            let dofs: Vec<usize> = element
                .nodes()
                .iter()
                .flat_map(|&n| [2 * n as usize, 2 * n as usize + 1])
                .collect();
            for (i, &row) in dofs.iter().enumerate() {
                for (j, &column) in dofs.iter().enumerate() {
                    stiffness[(row, column)] += k[i][j];
                }
            }
        }
        for &node in &patch.bottom {
            for dof in [2 * node as usize, 2 * node as usize + 1] {
                stiffness.row_mut(dof).fill(0.0);
                stiffness.column_mut(dof).fill(0.0);
                stiffness[(dof, dof)] = 1.0;
            }
        }
        let inverse = stiffness.try_inverse().unwrap();
        let dof = |i: usize| 2 * interface[i / 2] as usize + i % 2;
        let scale = inverse[(dof(0), dof(0))];
        for i in 0..compliance.size() {
            for j in 0..compliance.size() {
                let error = (compliance.get(i, j) - inverse[(dof(i), dof(j))]).abs() / scale;
                assert!(error < 1e-12, "{order:?} ({i}, {j}): {error:e}");
            }
        }
    }
}

#[test]
fn trailing_block_route_equals_one_solution_per_load() {
    // Large enough for several supernodes on both sides of the cut.
    let patch = block(40, 20, Order::Quadratic, 0.05);
    let interface = interface(&patch);
    let body = Body::new(&patch.mesh, STEEL, &patch.bottom, &interface).unwrap();
    let compliance = body.compliance();
    assert_eq!(compliance.nodes(), interface);
    for (j, unit) in [Vec2::x(), Vec2::y()]
        .into_iter()
        .cycle()
        .take(compliance.size())
        .enumerate()
    {
        let u = body.solve(&[(interface[j / 2], unit)]).unwrap();
        for i in 0..compliance.size() {
            let error = (compliance.get(i, j) - u[interface[i / 2] as usize][i % 2]).abs()
                / compliance.get(j, j);
            assert!(error < 1e-12, "({i}, {j}): {error:e}");
        }
    }
}

#[test]
fn compliance_is_symmetric_to_the_bit_and_positive_definite() {
    let patch = block(12, 6, Order::Quadratic, 0.1);
    let compliance = Body::new(&patch.mesh, STEEL, &patch.bottom, &interface(&patch))
        .unwrap()
        .compliance();
    let n = compliance.size();
    for i in 0..n {
        for j in 0..n {
            assert_eq!(
                compliance.get(i, j).to_bits(),
                compliance.get(j, i).to_bits()
            );
            assert_eq!(compliance.get(i, j), compliance.matrix()[(i, j)]);
        }
    }
    let matrix = nalgebra::DMatrix::from_fn(n, n, |i, j| compliance.get(i, j));
    assert!(matrix.cholesky().is_some());
}

#[test]
fn fixed_directions_of_the_interface_have_zero_rows() {
    let patch = block(6, 4, Order::Quadratic, 0.0);
    // Symmetry line on the left, whose upper end is part of the interface.
    let fixed: Vec<_> = patch
        .left
        .iter()
        .map(|&n| (n, Axis::X))
        .chain(patch.bottom.iter().map(|&n| (n, Axis::Y)))
        .collect();
    let corner = patch.top.len() - 1;
    let body = Body::with_fixed_dofs(&patch.mesh, STEEL, &fixed, &patch.top).unwrap();
    let compliance = body.compliance();
    assert!(compliance.column(2 * corner).iter().all(|&v| v == 0.0));
    assert!((0..compliance.size()).all(|j| compliance.get(2 * corner, j) == 0.0));
    let u = body
        .solve(&[(patch.top[corner], Vec2::new(5.0, 1.0))])
        .unwrap();
    // The load along the fixed direction goes into the support; the rest is column 2 corner + 1.
    let scale = u[patch.top[corner] as usize].y;
    for (i, value) in compliance.column(2 * corner + 1).iter().enumerate() {
        assert!((u[patch.top[i / 2] as usize][i % 2] - value).abs() < 1e-12 * scale);
    }
}

#[test]
fn refactor_gives_the_bits_of_a_new_body() {
    let (old, new) = (
        block(12, 6, Order::Quadratic, 0.0),
        block(12, 6, Order::Quadratic, 0.1),
    );
    let interface = interface(&old);
    let mut body = Body::new(&old.mesh, STEEL, &old.bottom, &interface).unwrap();
    let before = body.compliance();
    body.refactor(&new.mesh).unwrap();
    let fresh = Body::new(&new.mesh, STEEL, &new.bottom, &interface).unwrap();
    assert_eq!(body.compliance(), fresh.compliance());
    assert!(
        largest_difference(&before, &body.compliance()) > 1e-3,
        "the move must matter"
    );
    let other = block(12, 5, Order::Quadratic, 0.0);
    assert_eq!(body.refactor(&other.mesh), Err(FemError::TopologyChanged));
}

#[test]
fn same_bits_on_any_number_of_threads() {
    let patch = block(30, 20, Order::Quadratic, 0.1);
    let interface = interface(&patch);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let make = || {
                Body::new(&patch.mesh, STEEL, &patch.bottom, &interface)
                    .unwrap()
                    .compliance()
            };
            rayon::join(make, make)
        })
    };
    let (first, second) = run(1);
    assert_eq!(first, second);
    assert_eq!(run(2), (first.clone(), second));
    let threaded = Body::new(&patch.mesh, STEEL, &patch.bottom, &interface)
        .unwrap()
        .compliance_on(Par::rayon(2));
    assert!(largest_difference(&first, &threaded) < 1e-13);
}

#[test]
fn reactions_balance_the_load_and_work_is_energy() {
    let patch = block(10, 6, Order::Quadratic, 0.1);
    let body = Body::new(&patch.mesh, STEEL, &patch.bottom, &[]).unwrap();
    let loads = edge_traction(&patch.mesh, &patch.top, |p, normal| {
        -20.0 * normal + Vec2::new(3.0 * p.x, 0.0)
    });
    let solution = body.solve_with(&loads, &[]).unwrap();
    assert!(solution.residual < RESIDUAL_LIMIT);
    let u = &solution.displacement;

    let force = internal_forces(&patch.mesh, STEEL, u).unwrap();
    let reaction: Vec2 = patch.bottom.iter().map(|&n| force[n as usize]).sum();
    let bottom: std::collections::BTreeSet<_> = patch.bottom.iter().collect();
    let applied: Vec2 = loads
        .iter()
        .filter(|(n, _)| !bottom.contains(n))
        .map(|l| l.1)
        .sum();
    assert!((reaction + applied).norm() < 1e-10 * applied.norm());

    let work: f64 = loads
        .iter()
        .map(|(n, f)| 0.5 * f.dot(&u[*n as usize]))
        .sum();
    let energy = strain_energy(&patch.mesh, STEEL, u).unwrap();
    assert!((work / energy - 1.0).abs() < 1e-10);
}

/// A closed outline under constant pressure has no resultant; an open one has that of its chord.
#[test]
fn pressure_on_a_curved_edge_has_the_resultant_of_its_chord() {
    for order in [Order::Linear, Order::Quadratic] {
        let patch = block(9, 3, order, 0.2);
        let total: Vec2 = edge_traction(&patch.mesh, &patch.top, |_, n| -10.0 * n)
            .iter()
            .map(|l| l.1)
            .sum();
        let end = |n: u32| patch.mesh.points[n as usize];
        let chord = end(patch.top[patch.top.len() - 1]) - end(patch.top[0]);
        assert!(
            (total - 10.0 * Vec2::new(-chord.y, chord.x)).norm() < 1e-12,
            "{order:?} {total}"
        );
    }
}

#[test]
fn prescribed_displacements_stretch_a_bar() {
    // u_x = 0.001 x with free sides: σ_xx = E/(1 − nu²) 0.001 and σ_zz = nu σ_xx.
    let patch = block(4, 2, Order::Quadratic, 0.0);
    let ends = patch.left.iter().chain(&patch.right).map(|&n| (n, Axis::X));
    let fixed: Vec<_> = ends.chain([(patch.node(0, 0), Axis::Y)]).collect();
    let body = Body::with_fixed_dofs(&patch.mesh, STEEL, &fixed, &[]).unwrap();
    let prescribed: Vec<_> = patch.right.iter().map(|&n| (n, Axis::X, 0.002)).collect();
    let u = body.solve_with(&[], &prescribed).unwrap().displacement;
    let target = 0.001 * STEEL.plane_strain_modulus();
    for s in nodal_stress(&patch.mesh, STEEL, &u).unwrap() {
        assert!(
            (s.xx / target - 1.0).abs() < 1e-10
                && s.yy.abs() < 1e-10 * target
                && s.xy.abs() < 1e-10 * target
        );
        assert!((s.zz / (0.3 * target) - 1.0).abs() < 1e-10);
    }
    let free = body.solve_with(&[], &[(patch.node(1, 1), Axis::Y, 0.1)]);
    assert_eq!(
        free.unwrap_err(),
        FemError::PrescribedFree {
            node: patch.node(1, 1),
            axis: Axis::Y
        }
    );
}

#[test]
fn a_body_that_can_move_is_refused() {
    let patch = block(4, 2, Order::Quadratic, 0.0);
    let free = |fixed: &[(u32, Axis)]| {
        Body::with_fixed_dofs(&patch.mesh, STEEL, fixed, &[])
            .map(|_| ())
            .unwrap_err()
    };
    assert_eq!(free(&[]), FemError::MissingSupport { node: 0, free: 3 });
    assert_eq!(
        free(&[(5, Axis::X), (5, Axis::Y)]),
        FemError::MissingSupport { node: 0, free: 1 }
    );
    let rollers: Vec<_> = patch.bottom.iter().map(|&n| (n, Axis::Y)).collect();
    assert_eq!(
        free(&rollers),
        FemError::MissingSupport { node: 0, free: 1 }
    );
    // Supports whose lines all pass through one corner leave the turn about it.
    let through_corner: Vec<_> = patch
        .left
        .iter()
        .map(|&n| (n, Axis::Y))
        .chain([(0, Axis::X)])
        .collect();
    assert_eq!(
        free(&through_corner),
        FemError::MissingSupport { node: 0, free: 1 }
    );
}

fn triangles(points: &[(f64, f64)], cells: &[[u32; 3]]) -> Mesh {
    Mesh {
        points: points.iter().map(|&(x, y)| Vec2::new(x, y)).collect(),
        cells: Cells::T3(cells.to_vec()),
        flanks: Vec::new(),
        bore: Vec::new(),
    }
}

#[test]
fn loose_parts_and_hinges_are_refused() {
    // Two triangles apart, only the first held.
    let points = [
        (0.0, 0.0),
        (1.0, 0.0),
        (0.0, 1.0),
        (2.0, 0.0),
        (3.0, 0.0),
        (2.0, 1.0),
    ];
    let apart = triangles(&points, &[[0, 1, 2], [3, 4, 5]]);
    let error = Body::new(&apart, STEEL, &[0, 1], &[]).unwrap_err();
    assert_eq!(error, FemError::MissingSupport { node: 3, free: 3 });
    // The second hangs on the first by one node and can turn about it.
    let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (2.0, 0.0), (2.0, 1.0)];
    let hinged = triangles(&points, &[[0, 1, 2], [1, 3, 4]]);
    let error = Body::new(&hinged, STEEL, &[0, 2], &[]).unwrap_err();
    assert!(
        matches!(error, FemError::NotPositiveDefinite { ratio, .. } if ratio < 1e-12),
        "{error:?}"
    );
    // A node of no triangle.
    let loose = triangles(
        &[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (5.0, 5.0)],
        &[[0, 1, 2]],
    );
    assert_eq!(
        Body::new(&loose, STEEL, &[0, 1], &[]).unwrap_err(),
        FemError::UnusedNode { node: 3 }
    );
    assert!(Body::new(&loose, STEEL, &[0, 1, 3], &[]).is_ok());
}

#[test]
fn nan_and_nonsense_are_refused_by_name() {
    let patch = block(4, 2, Order::Quadratic, 0.0);
    let build = |mesh: &Mesh, material, fixed: &[u32], interface: &[u32]| {
        Body::new(mesh, material, fixed, interface)
            .map(|_| ())
            .unwrap_err()
    };
    let mut broken = patch.mesh.clone();
    broken.points[7].y = f64::NAN;
    assert!(matches!(
        build(&broken, STEEL, &patch.bottom, &[]),
        FemError::NotFinite { node: 7, .. }
    ));
    let mut body = Body::new(&patch.mesh, STEEL, &patch.bottom, &[]).unwrap();
    assert!(matches!(
        body.refactor(&broken),
        Err(FemError::NotFinite { node: 7, .. })
    ));

    let mut folded = patch.mesh.clone();
    let node = patch.node(4, 2) as usize;
    folded.points[node].y += 0.9;
    assert!(
        matches!(build(&folded, STEEL, &patch.bottom, &[]), FemError::Inverted { jacobian, .. } if jacobian <= 0.0)
    );

    for poisson_ratio in [0.5, -1.0, f64::NAN] {
        let material = Elastic {
            poisson_ratio,
            ..STEEL
        };
        assert!(matches!(
            build(&patch.mesh, material, &patch.bottom, &[]),
            FemError::Material { .. }
        ));
    }
    let none = triangles(&[], &[]);
    assert_eq!(build(&none, STEEL, &[], &[]), FemError::Empty);
    let count = patch.mesh.points.len();
    assert!(matches!(
        build(&patch.mesh, STEEL, &[9999], &[]),
        FemError::UnknownNode { node: 9999, .. }
    ));
    assert!(matches!(
        build(&patch.mesh, STEEL, &patch.bottom, &[count as u32]),
        FemError::UnknownNode { .. }
    ));
    let wild = triangles(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], &[[0, 1, 3]]);
    assert!(matches!(
        build(&wild, STEEL, &[0, 1], &[]),
        FemError::UnknownNode {
            node: 3,
            count: 3,
            ..
        }
    ));
    let repeated = [patch.top[0], patch.top[1], patch.top[0]];
    assert_eq!(
        build(&patch.mesh, STEEL, &patch.bottom, &repeated),
        FemError::RepeatedInterfaceNode { node: patch.top[0] }
    );

    let load = |node, value| body.solve(&[(node, value)]).unwrap_err();
    assert!(matches!(
        load(3, Vec2::new(f64::NAN, 0.0)),
        FemError::NotFinite { node: 3, .. }
    ));
    assert!(matches!(
        load(count as u32, Vec2::x()),
        FemError::UnknownNode { .. }
    ));
    assert!(matches!(
        nodal_stress(&patch.mesh, STEEL, &[]),
        Err(FemError::FieldLength { found: 0, .. })
    ));
    assert!(matches!(
        internal_forces(&patch.mesh, STEEL, &[]),
        Err(FemError::FieldLength { found: 0, .. })
    ));
    assert_eq!(body.solve(&[]).unwrap(), vec![Vec2::zeros(); count]);
}
