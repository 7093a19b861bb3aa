//! How large elements may be at a place: small at sources, growing with the distance from them.

use crate::numeric::Vec2;

/// The size field.
///
/// ```text
/// h(x) = min( cap, min_i h_i + growth · |x − x_i| )
/// ```
/// Sizes are edge lengths, mm. `growth` is the slope; 0.3 makes neighbouring edges differ by about a third.
#[derive(Debug, Clone)]
pub struct SizeField {
    growth: f64,
    cap: f64,
    sources: Vec<(Vec2, f64)>,
    nodes: Vec<Node>,
}

/// A box of the search tree: sources `start..end`; children at `left` and `left + 1` unless it is a leaf.
#[derive(Debug, Clone, Copy)]
struct Node {
    low: Vec2,
    high: Vec2,
    smallest: f64,
    start: u32,
    end: u32,
    left: u32,
}

const LEAF: usize = 6;

impl SizeField {
    /// A field from sources (place, size there).
    pub fn new(mut sources: Vec<(Vec2, f64)>, growth: f64, cap: f64) -> SizeField {
        let mut nodes = Vec::new();
        if !sources.is_empty() {
            let n = sources.len();
            nodes.push(bound(&sources, 0, n));
            let mut next = 0;
            while next < nodes.len() {
                split(&mut sources, &mut nodes, next);
                next += 1;
            }
        }
        SizeField {
            growth,
            cap,
            sources,
            nodes,
        }
    }

    /// The field of an outline's own edges: each edge's length at both its ends.
    pub fn of_outline(outline: &super::Outline, growth: f64, cap: f64) -> SizeField {
        let points = outline.points();
        let mut sources: Vec<(Vec2, f64)> = points.iter().map(|p| (*p, cap)).collect();
        for [a, b] in outline.edges() {
            let (a, b) = (a as usize, b as usize);
            let length = (points[a] - points[b]).norm();
            sources[a].1 = sources[a].1.min(length);
            sources[b].1 = sources[b].1.min(length);
        }
        SizeField::new(sources, growth, cap)
    }

    /// Edge length wanted at `x`, mm.
    pub fn size(&self, x: Vec2) -> f64 {
        let mut best = self.cap;
        if self.nodes.is_empty() || self.lower_bound(0, x) >= best {
            return best;
        }
        let mut stack = [(0u32, 0.0f64); 64];
        stack[0] = (0, self.lower_bound(0, x));
        let mut top = 1;
        while top > 0 {
            top -= 1;
            let (at, low) = stack[top];
            if low >= best {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.left == 0 {
                for (p, h) in &self.sources[node.start as usize..node.end as usize] {
                    best = best.min(h + self.growth * (x - p).norm());
                }
                continue;
            }
            let (a, b) = (node.left, node.left + 1);
            let (la, lb) = (self.lower_bound(a, x), self.lower_bound(b, x));
            let (near, far) = if la <= lb {
                ((a, la), (b, lb))
            } else {
                ((b, lb), (a, la))
            };
            for child in [far, near] {
                if child.1 < best {
                    stack[top] = child;
                    top += 1;
                }
            }
        }
        best
    }

    fn lower_bound(&self, node: u32, x: Vec2) -> f64 {
        let n = &self.nodes[node as usize];
        let dx = (n.low.x - x.x).max(x.x - n.high.x).max(0.0);
        let dy = (n.low.y - x.y).max(x.y - n.high.y).max(0.0);
        n.smallest + self.growth * (dx * dx + dy * dy).sqrt()
    }
}

fn bound(sources: &[(Vec2, f64)], start: usize, end: usize) -> Node {
    let mut low = sources[start].0;
    let mut high = low;
    let mut smallest = f64::INFINITY;
    for (p, h) in &sources[start..end] {
        low = low.inf(p);
        high = high.sup(p);
        smallest = smallest.min(*h);
    }
    Node {
        low,
        high,
        smallest,
        start: start as u32,
        end: end as u32,
        left: 0,
    }
}

/// Halves a box across its longer side.
fn split(sources: &mut [(Vec2, f64)], nodes: &mut Vec<Node>, at: usize) {
    let Node {
        low,
        high,
        start,
        end,
        ..
    } = nodes[at];
    let (start, end) = (start as usize, end as usize);
    if end - start <= LEAF {
        return;
    }
    let axis = if high.x - low.x >= high.y - low.y {
        0
    } else {
        1
    };
    let part = &mut sources[start..end];
    let half = part.len() / 2;
    part.select_nth_unstable_by(half, |a, b| {
        a.0[axis]
            .total_cmp(&b.0[axis])
            .then(a.0[1 - axis].total_cmp(&b.0[1 - axis]))
            .then(a.1.total_cmp(&b.1))
    });
    let middle = start + half;
    nodes[at].left = nodes.len() as u32;
    let pair = [bound(sources, start, middle), bound(sources, middle, end)];
    nodes.extend(pair);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_the_minimum_over_all_sources() {
        let sources: Vec<_> = (0..500)
            .map(|i| {
                let t = f64::from(i) * 0.7;
                (
                    Vec2::new(t.sin() * 3.0 + 0.01 * t, (1.7 * t).cos() * 2.0),
                    0.02 + 0.05 * (3.1 * t).sin().abs(),
                )
            })
            .collect();
        let field = SizeField::new(sources.clone(), 0.3, 1.1);
        for i in 0..400 {
            let x = Vec2::new(f64::from(i % 20) * 0.5 - 5.0, f64::from(i / 20) * 0.4 - 4.0);
            let direct = sources
                .iter()
                .map(|(p, h)| h + 0.3 * (x - p).norm())
                .fold(1.1, f64::min);
            assert!((field.size(x) - direct).abs() < 1e-15);
        }
    }
}
