//! Moves interior points to better places; the triangles stay as they are.

use super::Triangles;
use crate::numeric::{Vec2, cross};

/// One sweep towards optimal Delaunay places: each interior point goes to the weighted mean of the circumcentres around it.
///
/// ```text
/// x_i <- Σ w_T c_T / Σ w_T     w_T = A_T / h_T³   (Chen & Holst, Comput. Methods Appl. Mech. Engrg. 200 (2011) 967, graded form)
/// ```
/// Circumcentres of obtuse triangles are drawn towards the centroid so that no point leaves its star.
pub(super) fn smooth(mesh: &mut Triangles, size: &dyn Fn(Vec2) -> f64) {
    let n = mesh.points.len();
    let mut sum = vec![(Vec2::zeros(), 0.0); n];
    for t in &mesh.corners {
        let [a, b, c] = t.map(|k| mesh.points[k as usize]);
        let g = (a + b + c) / 3.0;
        let area = 0.5 * cross(b - a, c - a);
        let h = size(g);
        let w = area / (h * h * h);
        let centre = circumcentre(a, b, c, g);
        for k in t {
            let s = &mut sum[*k as usize];
            s.0 += w * centre;
            s.1 += w;
        }
    }
    for (p, (s, w)) in mesh.points.iter_mut().zip(sum).skip(mesh.boundary) {
        if w > 0.0 {
            *p = s / w;
        }
    }
}

fn circumcentre(a: Vec2, b: Vec2, c: Vec2, g: Vec2) -> Vec2 {
    let (u, v) = (b - a, c - a);
    let d = 2.0 * cross(u, v);
    let (uu, vv) = (u.norm_squared(), v.norm_squared());
    let o = a + Vec2::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / d;
    let r = o - g;
    let limit = 0.35 * uu.max(vv).sqrt();
    let length = r.norm();
    if length > limit {
        g + r * (limit / length)
    } else {
        o
    }
}

/// Moves the points around triangles thinner than `good` degrees so that the worst triangle of each star becomes better.
/// Returns how many points moved.
pub(super) fn improve_stars(mesh: &mut Triangles, good: f64) -> usize {
    let stars = Stars::new(mesh);
    let mut marked = vec![false; mesh.points.len()];
    for t in &mesh.corners {
        let [a, b, c] = t.map(|k| mesh.points[k as usize]);
        if super::quality::smallest_angle(a, b, c) < good.to_radians() {
            for k in t {
                marked[*k as usize] = *k as usize >= mesh.boundary;
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
                super::quality::smallest_angle(a, b, c)
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
