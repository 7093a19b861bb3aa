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
