//! Is a mesh fit for use: angles, aspect ratios, Jacobians, gradation.

use std::f64::consts::PI;

use super::order::edge_list;
use super::{Cells, Mesh, MeshError, Triangles};
use crate::numeric::{Vec2, cross};

/// Measures of a mesh; angles and aspects are those of the corner triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of triangles.
    pub elements: usize,
    /// Smallest corner angle, degrees.
    pub min_angle_deg: f64,
    /// The angle below which 1 % of the triangles have their smallest angle, degrees.
    pub angle_1pct: f64,
    /// Largest aspect ratio: longest edge over 2·√3 inscribed radii; 1 for an equilateral triangle.
    pub max_aspect: f64,
    /// Smallest Jacobian determinant over the checked points, divided by the element's mean one; 1 for straight elements.
    pub min_scaled_jacobian: f64,
    /// Largest ratio of the sizes (square roots of the areas) of two triangles with a common edge.
    pub max_gradation: f64,
}

impl Quality {
    /// Measures `mesh`.
    pub fn of(mesh: &Mesh) -> Quality {
        let corners = mesh.corners();
        let at = |t: &[u32; 3]| t.map(|k| mesh.points[k as usize]);
        let mut angles: Vec<f64> = corners
            .iter()
            .map(|t| {
                let [a, b, c] = at(t);
                smallest_angle(a, b, c).to_degrees()
            })
            .collect();
        angles.sort_by(f64::total_cmp);
        let sizes: Vec<f64> = corners
            .iter()
            .map(|t| {
                let [a, b, c] = at(t);
                (0.5 * cross(b - a, c - a)).max(0.0).sqrt()
            })
            .collect();
        let mut max_gradation = 1.0f64;
        for pair in edge_list(&corners).windows(2) {
            if pair[0].ends == pair[1].ends {
                let (p, q) = (sizes[pair[0].cell as usize], sizes[pair[1].cell as usize]);
                max_gradation = max_gradation.max(p / q).max(q / p);
            }
        }
        Quality {
            nodes: mesh.points.len(),
            elements: corners.len(),
            min_angle_deg: angles.first().copied().unwrap_or(0.0),
            angle_1pct: angles.get(angles.len() / 100).copied().unwrap_or(0.0),
            max_aspect: corners.iter().map(|t| aspect(at(t))).fold(1.0, f64::max),
            min_scaled_jacobian: (0..corners.len())
                .map(|e| scaled_jacobian(mesh, e).0)
                .fold(1.0, f64::min),
            max_gradation,
        }
    }
}

/// Refuses a mesh with an element turned inside out at any checked point (T6: nodes and quadrature points).
pub fn check_jacobians(mesh: &Mesh) -> Result<(), MeshError> {
    for element in 0..mesh.cells.len() {
        let (scaled, jacobian) = scaled_jacobian(mesh, element);
        if !(scaled > 0.0 && jacobian > 0.0) {
            let c = mesh.cells.corners(element).map(|k| mesh.points[k as usize]);
            let centre = (c[0] + c[1] + c[2]) / 3.0;
            return Err(MeshError::Inverted {
                element,
                jacobian,
                x: centre.x,
                y: centre.y,
            });
        }
    }
    Ok(())
}

/// Reference coordinates (r, s) at which Jacobians are looked at: six nodes, the centre, Dunavant's degree-4 points.
const CHECKED: [(f64, f64); 13] = [
    (0.0, 0.0),
    (1.0, 0.0),
    (0.0, 1.0),
    (0.5, 0.0),
    (0.5, 0.5),
    (0.0, 0.5),
    (1.0 / 3.0, 1.0 / 3.0),
    (0.445948490915965, 0.445948490915965),
    (0.10810301816807, 0.445948490915965),
    (0.445948490915965, 0.10810301816807),
    (0.091576213509771, 0.091576213509771),
    (0.816847572980459, 0.091576213509771),
    (0.091576213509771, 0.816847572980459),
];

/// Smallest Jacobian determinant of an element, relative to the mean one and in mm².
fn scaled_jacobian(mesh: &Mesh, element: usize) -> (f64, f64) {
    match &mesh.cells {
        Cells::T3(t) => {
            let [a, b, c] = t[element].map(|k| mesh.points[k as usize]);
            let j = cross(b - a, c - a);
            (j.signum(), j)
        }
        Cells::T6(t) => {
            let x = t[element].map(|k| mesh.points[k as usize]);
            let straight = [(0, 1), (1, 2), (2, 0)]
                .iter()
                .enumerate()
                .all(|(i, (a, b))| {
                    let bow = x[3 + i] - 0.5 * (x[*a] + x[*b]);
                    bow.norm_squared() <= 1e-20 * (x[*b] - x[*a]).norm_squared()
                });
            if straight {
                let j = cross(x[1] - x[0], x[2] - x[0]);
                return (j.signum(), j);
            }
            let smallest = CHECKED
                .iter()
                .map(|(r, s)| jacobian_t6(&x, *r, *s))
                .fold(f64::INFINITY, f64::min);
            let area: f64 = [(0, 1), (1, 2), (2, 0)]
                .iter()
                .enumerate()
                .map(|(i, (a, b))| super::outline::edge_area(x[*a], x[3 + i], x[*b]))
                .sum();
            (
                if area > 0.0 {
                    smallest / (2.0 * area)
                } else {
                    -1.0
                },
                smallest,
            )
        }
    }
}

/// Jacobian determinant of the quadratic map at (r, s), mm².
fn jacobian_t6(x: &[Vec2; 6], r: f64, s: f64) -> f64 {
    let t = 1.0 - r - s;
    let by_r = [
        1.0 - 4.0 * t,
        4.0 * r - 1.0,
        0.0,
        4.0 * (t - r),
        4.0 * s,
        -4.0 * s,
    ];
    let by_s = [
        1.0 - 4.0 * t,
        0.0,
        4.0 * s - 1.0,
        -4.0 * r,
        4.0 * r,
        4.0 * (t - s),
    ];
    let sum = |d: &[f64; 6]| x.iter().zip(d).fold(Vec2::zeros(), |u, (p, d)| u + *d * p);
    cross(sum(&by_r), sum(&by_s))
}

/// Smallest angle of a triangle, rad.
pub(super) fn smallest_angle(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let (ab, bc, ca) = (
        (b - a).norm_squared(),
        (c - b).norm_squared(),
        (a - c).norm_squared(),
    );
    // The smallest angle lies opposite the shortest side.
    let (apex, p, q) = if ab <= bc && ab <= ca {
        (c, a, b)
    } else if bc <= ca {
        (a, b, c)
    } else {
        (b, c, a)
    };
    let (u, v) = (p - apex, q - apex);
    cross(u, v).atan2(u.dot(&v))
}

fn aspect([a, b, c]: [Vec2; 3]) -> f64 {
    let (ab, bc, ca) = ((b - a).norm(), (c - b).norm(), (a - c).norm());
    let inradius = cross(b - a, c - a).max(0.0) / (ab + bc + ca);
    ab.max(bc).max(ca) / (2.0 * 3.0f64.sqrt() * inradius)
}

/// Smallest angle of all triangles, degrees, and the centre of that triangle.
pub(super) fn worst_triangle(mesh: &Triangles) -> (f64, Vec2) {
    let mut worst = (PI, Vec2::zeros());
    for t in &mesh.corners {
        let [a, b, c] = t.map(|k| mesh.points[k as usize]);
        let angle = smallest_angle(a, b, c);
        if angle < worst.0 {
            worst = (angle, (a + b + c) / 3.0);
        }
    }
    (worst.0.to_degrees(), worst.1)
}
