//! The boundary of a body as closed loops of exact points.

use super::MeshError;
use crate::numeric::{Vec2, cross};

/// A closed loop; edge `i` runs from point `i` to point `i + 1` (the last one to point 0).
#[derive(Debug, Clone, PartialEq)]
pub struct Loop {
    /// Corner points, mm; the body lies to the left of each edge.
    pub points: Vec<Vec2>,
    /// The point of the true boundary half-way along each edge, mm: the place of its mid-side node.
    pub mids: Vec<Vec2>,
}

impl Loop {
    /// A loop of straight edges.
    pub fn polygon(points: Vec<Vec2>) -> Loop {
        let n = points.len();
        let mids = (0..n)
            .map(|i| 0.5 * (points[i] + points[(i + 1) % n]))
            .collect();
        Loop { points, mids }
    }

    /// A circle of `n` equal curved edges about the origin; clockwise if it bounds a hole.
    pub fn circle(radius: f64, n: usize, hole: bool) -> Loop {
        let step = std::f64::consts::TAU / n as f64 * if hole { -1.0 } else { 1.0 };
        let at = |k: f64| radius * Vec2::new((k * step).cos(), (k * step).sin());
        Loop {
            points: (0..n).map(|i| at(i as f64)).collect(),
            mids: (0..n).map(|i| at(i as f64 + 0.5)).collect(),
        }
    }

    /// Area inside, mm², positive for a counter-clockwise loop; each edge is a parabola through its mid-side point.
    ///
    /// ```text
    /// A = Σ ½ a×b + ⅔ d×(b − a)      d: mid-side point minus middle of the chord; exact for quadratic edges
    /// ```
    pub fn area(&self) -> f64 {
        let n = self.points.len();
        (0..n)
            .map(|i| edge_area(self.points[i], self.mids[i], self.points[(i + 1) % n]))
            .sum()
    }
}

/// The body's boundary: the outer loop (counter-clockwise) first, then holes (clockwise).
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// The loops.
    pub loops: Vec<Loop>,
}

impl Outline {
    /// Area of the body, mm², with quadratic edges.
    pub fn area(&self) -> f64 {
        self.loops.iter().map(Loop::area).sum()
    }

    /// All corner points, loop after loop.
    pub fn points(&self) -> Vec<Vec2> {
        self.loops
            .iter()
            .flat_map(|l| l.points.iter().copied())
            .collect()
    }

    /// All mid-side points, in the order of [`Outline::edges`].
    pub fn mids(&self) -> Vec<Vec2> {
        self.loops
            .iter()
            .flat_map(|l| l.mids.iter().copied())
            .collect()
    }

    /// All edges as pairs of indices into [`Outline::points`].
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let mut edges = Vec::new();
        let mut first = 0u32;
        for l in &self.loops {
            let n = l.points.len() as u32;
            edges.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
            first += n;
        }
        edges
    }

    /// Refuses loops that are too short, turned the wrong way round or hold a number that is not finite.
    pub(super) fn check(&self) -> Result<(), MeshError> {
        let wrong = |what, p: Vec2| MeshError::Outline {
            what,
            x: p.x,
            y: p.y,
        };
        if self.loops.is_empty() {
            return Err(wrong("no loop", Vec2::zeros()));
        }
        for (k, l) in self.loops.iter().enumerate() {
            let at = l.points.first().copied().unwrap_or_else(Vec2::zeros);
            if l.points.len() < 3 || l.mids.len() != l.points.len() {
                return Err(wrong(
                    "a loop needs three points and one mid-side point an edge",
                    at,
                ));
            }
            if let Some(p) = l
                .points
                .iter()
                .chain(&l.mids)
                .find(|p| !(p.x + p.y).is_finite())
            {
                return Err(wrong("a coordinate is not finite", *p));
            }
            if (l.area() > 0.0) != (k == 0) {
                return Err(wrong("outer loop clockwise or hole counter-clockwise", at));
            }
        }
        Ok(())
    }
}

/// Signed area between the origin and a quadratic edge from `a` over `mid` to `b`.
pub(super) fn edge_area(a: Vec2, mid: Vec2, b: Vec2) -> f64 {
    0.5 * cross(a, b) + 2.0 / 3.0 * cross(mid - 0.5 * (a + b), b - a)
}
