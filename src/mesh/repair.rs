//! Mends the worst triangles: moves the points around them, merges points that are too close, adds points where they lack.

use super::quality::{smallest_angle, worst_triangle};
use super::{MeshError, Triangles};
use crate::numeric::{Vec2, cross};

/// Largest number of rounds.
const ROUNDS: usize = 10;

/// Repairs until no angle is below `good` degrees or the rounds are used up; returns the best mesh met.
/// `delaunay` makes the triangles of a set of points.
pub(super) fn repair(
    mesh: Triangles,
    size: &dyn Fn(Vec2) -> f64,
    good: f64,
    delaunay: impl Fn(&[Vec2]) -> Result<Vec<[u32; 3]>, MeshError>,
) -> Result<Triangles, MeshError> {
    let mut best = (worst_triangle(&mesh).0, mesh.clone());
    let mut mesh = mesh;
    for round in 0..ROUNDS {
        if best.0 >= good {
            break;
        }
        if round % 2 == 1 && !edit_points(&mut mesh, size, good) {
            break;
        } else if round % 2 == 1 {
            mesh.corners = delaunay(&mesh.points)?;
        }
        improve_stars(&mut mesh, good + 2.0);
        mesh.corners = delaunay(&mesh.points)?;
        let angle = worst_triangle(&mesh).0;
        if angle > best.0 {
            best = (angle, mesh.clone());
        }
    }
    Ok(best.1)
}

/// Changes the number of points at triangles thinner than `good` degrees: an interior end of a short edge goes, a long edge gets a
/// point in its middle. At most one change at a point a call. The triangles must be made anew afterwards.
fn edit_points(mesh: &mut Triangles, size: &dyn Fn(Vec2) -> f64, good: f64) -> bool {
    let mut touched = vec![false; mesh.points.len()];
    let mut gone = vec![false; mesh.points.len()];
    let mut new = Vec::new();
    for t in &mesh.corners {
        let p = t.map(|k| mesh.points[k as usize]);
        if smallest_angle(p[0], p[1], p[2]) >= good.to_radians()
            || t.iter().any(|k| touched[*k as usize])
        {
            continue;
        }
        let mut sides: Vec<(f64, usize, usize)> = [(0, 1), (1, 2), (2, 0)]
            .iter()
            .map(|&(i, j)| ((p[i] - p[j]).norm(), t[i] as usize, t[j] as usize))
            .collect();
        sides.sort_by(|a, b| a.0.total_cmp(&b.0));
        let h = size((p[0] + p[1] + p[2]) / 3.0);
        let (short, a, b) = sides[0];
        let (long, c, d) = sides[2];
        let inner = |k: usize| k >= mesh.boundary;
        let drop = [a, b].into_iter().filter(|k| inner(*k)).max();
        if let Some(k) = drop.filter(|_| short < 0.75 * h) {
            gone[k] = true;
            let other = a + b - k;
            if inner(other) {
                mesh.points[other] = 0.5 * (mesh.points[a] + mesh.points[b]);
            }
        } else if inner(c) || inner(d) || long > 1.2 * h {
            new.push(0.5 * (mesh.points[c] + mesh.points[d]));
        } else {
            continue;
        }
        t.iter().for_each(|k| touched[*k as usize] = true);
    }
    let changed = !new.is_empty() || gone.contains(&true);
    let mut keep = gone.iter().map(|g| !g);
    mesh.points.retain(|_| keep.next().unwrap_or(true));
    mesh.points.extend(new);
    changed
}

/// Moves the points around triangles thinner than `good` degrees so that the worst triangle of each star becomes better.
/// Returns how many points moved.
fn improve_stars(mesh: &mut Triangles, good: f64) -> usize {
    let stars = Stars::new(mesh);
    let mut marked = vec![false; mesh.points.len()];
    for t in &mesh.corners {
        let [a, b, c] = t.map(|k| mesh.points[k as usize]);
        if smallest_angle(a, b, c) < good.to_radians() {
            for near in t.iter().flat_map(|k| stars.of(*k as usize)) {
                for k in mesh.corners[*near as usize] {
                    marked[k as usize] = k as usize >= mesh.boundary;
                }
            }
        }
    }
    let mut moved = 0;
    for _ in 0..4 {
        for k in 0..mesh.points.len() {
            if marked[k] && move_to_best(mesh, k, stars.of(k)) {
                moved += 1;
            }
        }
    }
    moved
}

/// Pattern search for the place of point `k` that makes the smallest angle of its star largest.
fn move_to_best(mesh: &mut Triangles, k: usize, star: &[u32]) -> bool {
    let start = mesh.points[k];
    let worst = |points: &[Vec2], p: Vec2| {
        star.iter().fold(f64::INFINITY, |worst, t| {
            let [a, b, c] = mesh.corners[*t as usize].map(|i| {
                if i as usize == k {
                    p
                } else {
                    points[i as usize]
                }
            });
            worst.min(if cross(b - a, c - a) > 0.0 {
                smallest_angle(a, b, c)
            } else {
                -1.0
            })
        })
    };
    let reach = star
        .iter()
        .flat_map(|t| mesh.corners[*t as usize])
        .filter(|i| *i as usize != k)
        .fold(f64::INFINITY, |r, i| {
            r.min((mesh.points[i as usize] - start).norm())
        });
    let (mut best, mut place) = (worst(&mesh.points, start), start);
    let before = best;
    let mut step = 0.3 * reach;
    while step > 0.01 * reach {
        let centre = place;
        for i in 0..8 {
            let angle = std::f64::consts::FRAC_PI_4 * f64::from(i);
            let p = centre + step * Vec2::new(angle.cos(), angle.sin());
            let q = worst(&mesh.points, p);
            if q > best {
                (best, place) = (q, p);
            }
        }
        if place == centre {
            step *= 0.5;
        }
    }
    mesh.points[k] = place;
    best > before + 1e-4
}

/// The triangles around each point.
struct Stars {
    first: Vec<u32>,
    triangles: Vec<u32>,
}

impl Stars {
    fn new(mesh: &Triangles) -> Stars {
        let mut first = vec![0u32; mesh.points.len() + 1];
        for k in mesh.corners.iter().flatten() {
            first[*k as usize + 1] += 1;
        }
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        let mut next = first.clone();
        let mut triangles = vec![0; 3 * mesh.corners.len()];
        for (t, corners) in mesh.corners.iter().enumerate() {
            for k in corners {
                triangles[next[*k as usize] as usize] = t as u32;
                next[*k as usize] += 1;
            }
        }
        Stars { first, triangles }
    }

    fn of(&self, k: usize) -> &[u32] {
        &self.triangles[self.first[k] as usize..self.first[k + 1] as usize]
    }
}
