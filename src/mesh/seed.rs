//! First places of the interior points: centres of quadtree cells no larger than the wanted size.

use super::grading::SizeField;
use super::{MeshError, Outline};
use crate::numeric::Vec2;

/// Cell side over wanted edge length; smoothed triangles then have edges near the wanted length.
const CELL: f64 = 1.1;
/// Points nearer to the outline than this fraction of the wanted edge length are dropped.
const CLEARANCE: f64 = 0.6;

/// Interior points for an outline; at most `cap` of them.
pub(super) fn interior_points(
    outline: &Outline,
    size: &dyn Fn(Vec2) -> f64,
    cap: usize,
) -> Result<Vec<Vec2>, MeshError> {
    let points = outline.points();
    let (mut low, mut high) = (points[0], points[0]);
    for p in &points {
        low = low.inf(p);
        high = high.sup(p);
    }
    let inside = Inside::new(outline, low.y, high.y);
    let near = distance_field(outline);
    let half = 0.5 * (high - low).max();
    let mut stack = vec![(0.5 * (low + high), half)];
    let mut kept = Vec::new();
    while let Some((centre, half)) = stack.pop() {
        let wanted = size(centre);
        if 2.0 * half > CELL * wanted {
            // A cell wholly off the body (its centre is, and no outline cuts it) needs no division.
            if near.size(centre) > half * std::f64::consts::SQRT_2 && !inside.contains(centre) {
                continue;
            }
            let q = 0.5 * half;
            for (sx, sy) in [(q, q), (-q, q), (q, -q), (-q, -q)] {
                stack.push((centre + Vec2::new(sx, sy), q));
            }
            if stack.len() + kept.len() > 4 * cap {
                return Err(MeshError::TooManyPoints { cap });
            }
        } else if near.size(centre) > CLEARANCE * wanted && inside.contains(centre) {
            kept.push(centre);
            if kept.len() > cap {
                return Err(MeshError::TooManyPoints { cap });
            }
        }
    }
    Ok(kept)
}

/// Distance to the outline, mm, taken to its corners and chord middles (off by less than half a chord in the plane of the edge).
fn distance_field(outline: &Outline) -> SizeField {
    let points = outline.points();
    let mut samples: Vec<(Vec2, f64)> = points.iter().map(|p| (*p, 0.0)).collect();
    for [a, b] in outline.edges() {
        samples.push((0.5 * (points[a as usize] + points[b as usize]), 0.0));
    }
    SizeField::new(samples, 1.0, f64::INFINITY)
}

/// Point-in-polygon test by ray casting, edges sorted into horizontal bands.
struct Inside {
    low: f64,
    per_mm: f64,
    bands: Vec<Vec<(Vec2, Vec2)>>,
}

impl Inside {
    fn new(outline: &Outline, low: f64, high: f64) -> Inside {
        let points = outline.points();
        let count = points.len().clamp(8, 4096);
        let per_mm = count as f64 / (high - low).max(f64::MIN_POSITIVE);
        let mut inside = Inside {
            low,
            per_mm,
            bands: vec![Vec::new(); count],
        };
        for [a, b] in outline.edges() {
            let (a, b) = (points[a as usize], points[b as usize]);
            let (first, last) = (inside.band(a.y.min(b.y)), inside.band(a.y.max(b.y)));
            for band in &mut inside.bands[first..=last] {
                band.push((a, b));
            }
        }
        inside
    }

    fn band(&self, y: f64) -> usize {
        (((y - self.low) * self.per_mm).max(0.0) as usize).min(self.bands.len() - 1)
    }

    fn contains(&self, p: Vec2) -> bool {
        self.bands[self.band(p.y)]
            .iter()
            .filter(|(a, b)| (a.y > p.y) != (b.y > p.y))
            .filter(|(a, b)| p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            .count()
            % 2
            == 1
    }
}
