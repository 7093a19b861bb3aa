//! A1 patch test and A2 rigid motion.

use super::STEEL;
use crate::fem::{
    Axis, Body, Element, FemError, element_count, element_stiffness, element_stress, elements,
};
use crate::mesh::{Cells, Mesh};
use crate::numeric::Vec2;
use crate::verify::Measured;

/// A1: a linear displacement on the rim of a distorted patch gives the exact linear field and constant stress.
///
/// The patch of five quadrilaterals of MacNeal & Harder (Finite Elements in Analysis and Design 1 (1985) 3), each cut
/// into two triangles: T3, T6 with straight edges, T6 with bent inner edges. Rounding is the only error allowed.
pub fn a1_patch() -> Result<Vec<Measured>, FemError> {
    let mut figures = Vec::new();
    for (name, mesh) in patches() {
        let exact = |p: Vec2| 1e-3 * Vec2::new(p.x + 0.5 * p.y, p.y + 0.5 * p.x);
        let rim: Vec<u32> = (0..mesh.points.len() as u32)
            .filter(|&n| on_rim(mesh.points[n as usize]))
            .collect();
        let prescribed: Vec<_> = rim
            .iter()
            .flat_map(|&n| {
                let u = exact(mesh.points[n as usize]);
                [(n, Axis::X, u.x), (n, Axis::Y, u.y)]
            })
            .collect();
        let body = Body::new(&mesh, STEEL, &rim, &[])?;
        let u = body.solve_with(&[], &prescribed)?.displacement;

        let scale = exact(Vec2::new(0.24, 0.12)).norm();
        let worst = mesh
            .points
            .iter()
            .zip(&u)
            .map(|(p, u)| (u - exact(*p)).norm() / scale)
            .fold(0.0, f64::max);
        figures.push(Measured::bound(
            "A1",
            format!("{name}: displacement defect (-)"),
            worst,
            1e-10,
        ));

        // ε_xx = ε_yy = γ_xy = 1e-3
        let (e, nu) = (STEEL.youngs_modulus, STEEL.poisson_ratio);
        let direct = 1e-3 * e / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let target = [
            direct,
            direct,
            1e-3 * e / (2.0 * (1.0 + nu)),
            2.0 * nu * direct,
        ];
        let mut worst: f64 = 0.0;
        for element in elements(&mesh) {
            for s in &element_stress(&element, STEEL, &u)[..element.len] {
                for (value, target) in [s.xx, s.yy, s.xy, s.zz].iter().zip(target) {
                    worst = worst.max((value / target - 1.0).abs());
                }
            }
        }
        figures.push(Measured::bound(
            "A1",
            format!("{name}: stress defect (-)"),
            worst,
            1e-10,
        ));
    }
    Ok(figures)
}

/// A2: translations and a small rotation cause no nodal force, and a free element has exactly three zero eigenvalues.
pub fn a2_rigid_motion() -> Result<Vec<Measured>, FemError> {
    let mut figures = Vec::new();
    for (name, mesh) in patches() {
        let (mut force, mut fewest, mut most): (f64, usize, usize) = (0.0, usize::MAX, 0);
        for index in 0..element_count(&mesh.cells) {
            let element = Element::of(&mesh, index);
            let size = 2 * element.len;
            let k = element_stiffness(&element, STEEL, index)?;
            let matrix =
                nalgebra::DMatrix::from_fn(size, size, |i, j| k[i][j] / STEEL.youngs_modulus);
            let motions: [fn(Vec2) -> Vec2; 3] = [
                |_| Vec2::new(1.0, 0.0),
                |_| Vec2::new(0.0, 1.0),
                |p| Vec2::new(-p.y, p.x),
            ];
            for motion in motions {
                let u =
                    nalgebra::DVector::from_fn(size, |i, _| motion(element.points[i / 2])[i % 2]);
                force = force.max((&matrix * u).amax());
            }
            let zeros = matrix
                .symmetric_eigenvalues()
                .iter()
                .filter(|v| v.abs() < 1e-9)
                .count();
            (fewest, most) = (fewest.min(zeros), most.max(zeros));
        }
        figures.push(Measured::bound(
            "A2",
            format!("{name}: force of rigid motions over E (mm)"),
            force,
            1e-9,
        ));
        figures.push(Measured::relative(
            "A2",
            format!("{name}: fewest zero eigenvalues"),
            fewest as f64,
            3.0,
            0.0,
        ));
        figures.push(Measured::relative(
            "A2",
            format!("{name}: most zero eigenvalues"),
            most as f64,
            3.0,
            0.0,
        ));
    }
    Ok(figures)
}

/// The patch with each kind of triangle.
fn patches() -> [(&'static str, Mesh); 3] {
    [
        ("T3", patch(false, 0.0)),
        ("T6 straight", patch(true, 0.0)),
        ("T6 curved", patch(true, 0.02)),
    ]
}

fn on_rim(p: Vec2) -> bool {
    p.x < 1e-9 || p.x > 0.24 - 1e-9 || p.y < 1e-9 || p.y > 0.12 - 1e-9
}

/// Ten triangles in five quadrilaterals; `bend` moves inner mid-sides by that fraction of their chord.
fn patch(quadratic: bool, bend: f64) -> Mesh {
    let corners = [
        (0.0, 0.0),
        (0.24, 0.0),
        (0.24, 0.12),
        (0.0, 0.12),
        (0.04, 0.02),
        (0.18, 0.03),
        (0.16, 0.08),
        (0.08, 0.08),
    ];
    let quadrilaterals = [
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
        [4, 5, 6, 7],
    ];
    let mut points: Vec<Vec2> = corners.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
    let triangles: Vec<[u32; 3]> = quadrilaterals
        .iter()
        .flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, d], [b, c, d]])
        .collect();
    if !quadratic {
        return Mesh {
            points,
            cells: Cells::T3(triangles),
            flanks: Vec::new(),
            bore: Vec::new(),
        };
    }
    let mut middles = std::collections::BTreeMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let (p, q) = (points[a.min(b) as usize], points[a.max(b) as usize]);
            let chord = q - p;
            let straight = 0.5 * (p + q);
            let shift = if on_rim(straight) { 0.0 } else { bend };
            points.push(straight + shift * Vec2::new(-chord.y, chord.x));
            points.len() as u32 - 1
        })
    };
    let cells = triangles
        .iter()
        .map(|&[a, b, c]| [a, b, c, middle(a, b), middle(b, c), middle(c, a)])
        .collect();
    Mesh {
        points,
        cells: Cells::T6(cells),
        flanks: Vec::new(),
        bore: Vec::new(),
    }
}
