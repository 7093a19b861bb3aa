//! Segment-to-segment coupling of two flanks with a multiplier space of its own.
//!
//! The pressure is piecewise linear on a grid `xi` laid along the tangent of the contact; it acts along one direction n on
//! both bodies, so action equals reaction exactly. Each multiplier hat N_k is integrated against the traces of both
//! displacement fields on the common refinement of all grids, so constant pressure passes the patch test on any meshes:
//!
//! ```text
//! g_k  = ∫ N_k gap dξ           D_ki = ∫ N_k φ_i(s(ξ)) dξ         L_k = ∫ N_k dξ          M_k = ∫ N_k ξ dξ
//! ```
//! The same integrals against the piecewise linear worn depth tell how wear opens the gap. Wohlmuth, Acta Numerica 20
//! (2011), sections 3-4, for the method; the multiplier grid travels with the contact instead of sitting on one flank.

use crate::numeric::sparse::{SparseRows, accumulate};

/// What faces what at one place of the contact's tangent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facing {
    /// Arc coordinate on the first and the second flank, mm.
    pub arc: [f64; 2],
    /// Distance between the unworn flanks along n, mm.
    pub gap: f64,
}

/// A trace space along a flank: nodes with ascending arc coordinates, quadratic (2m + 1 nodes) or linear edges.
#[derive(Debug, Clone, Copy)]
pub struct Trace<'a> {
    /// Which flank it lies on: 0 or 1.
    pub side: usize,
    /// Arc coordinate of each node, mm.
    pub arc: &'a [f64],
    /// 2 for quadratic edges (corner, mid-side, corner, ...), 1 for linear.
    pub order: usize,
}

impl Trace<'_> {
    /// First node of the edge that holds `s`, or is next to it.
    fn edge(&self, s: f64) -> usize {
        let edges = (self.arc.len() - 1) / self.order;
        // corners are every `order`-th node
        let (mut low, mut high) = (0, edges);
        while high - low > 1 {
            let mid = usize::midpoint(low, high);
            if self.arc[mid * self.order] <= s {
                low = mid
            } else {
                high = mid
            }
        }
        low * self.order
    }
}

/// Integrals of the multiplier hats of one contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupling {
    /// Weighted gap g_k of the unworn flanks, mm².
    pub gap: Vec<f64>,
    /// L_k, mm.
    pub length: Vec<f64>,
    /// M_k, mm².
    pub moment: Vec<f64>,
    /// D for each trace in the order given: rows are hats, columns nodes of the trace.
    pub traces: Vec<SparseRows>,
}

/// Three-point Gauss rule on (0, 1): exact to degree five, one above hat times quadratic times linear variation.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// Integrates the hats on the nodes `xi` (ascending, mm) against `traces`.
pub fn couple(xi: &[f64], facing: impl Fn(f64) -> Facing, traces: &[Trace]) -> Coupling {
    let n = xi.len();
    let mut out = Coupling {
        gap: vec![0.0; n],
        length: vec![0.0; n],
        moment: vec![0.0; n],
        traces: Vec::new(),
    };
    let mut rows: Vec<Vec<Vec<(u32, f64)>>> = traces.iter().map(|_| vec![Vec::new(); n]).collect();
    let mut cuts = Vec::new();
    let ends: Vec<Facing> = xi.iter().map(|&x| facing(x)).collect();
    for k in 0..n.saturating_sub(1) {
        let (a, b) = (xi[k], xi[k + 1]);
        common_refinement([a, b], [ends[k], ends[k + 1]], traces, &mut cuts);
        for cut in cuts.windows(2) {
            let width = cut[1] - cut[0];
            let place = |u: f64| cut[0] + u * width;
            let facings = GAUSS.map(|(u, _)| facing(place(u)));
            let middle = facings[GAUSS.len() / 2];
            let edges: Vec<usize> = traces.iter().map(|t| t.edge(middle.arc[t.side])).collect();
            for ((u, weight), at) in GAUSS.into_iter().zip(facings) {
                let x = place(u);
                let hat = (x - a) / (b - a);
                for (node, value) in [(k, 1.0 - hat), (k + 1, hat)] {
                    let w = value * weight * width;
                    out.gap[node] += w * at.gap;
                    out.length[node] += w;
                    out.moment[node] += w * x;
                    for ((trace, edge), rows) in traces.iter().zip(&edges).zip(&mut rows) {
                        let (shapes, count) = edge_shapes(trace, *edge, at.arc[trace.side]);
                        for (i, shape) in shapes.iter().enumerate().take(count) {
                            accumulate(&mut rows[node], (edge + i) as u32, w * shape);
                        }
                    }
                }
            }
        }
    }
    out.traces = rows.into_iter().map(SparseRows::from_rows).collect();
    out
}

/// Values of the edge's shape functions at `s`; beyond the ends of the trace those of its end: continued, quadratic ones would pull at nodes.
fn edge_shapes(trace: &Trace, first: usize, s: f64) -> ([f64; 3], usize) {
    let t = (s - trace.arc[first]) / (trace.arc[first + trace.order] - trace.arc[first]);
    let last = trace.arc.len() - 1 - trace.order;
    let t = if first == 0 { t.max(0.0) } else { t };
    let t = if first == last { t.min(1.0) } else { t };
    if trace.order == 1 {
        ([1.0 - t, t, 0.0], 2)
    } else {
        // the mid-side node sits at the middle of the arc, so t is the isoparametric coordinate
        (
            [
                (1.0 - t) * (1.0 - 2.0 * t),
                4.0 * t * (1.0 - t),
                t * (2.0 * t - 1.0),
            ],
            3,
        )
    }
}

/// The ends of the cell and every trace's edge ends inside it, ascending.
///
/// An edge end is carried from arc to ξ by linear interpolation over the cell: exact for straight flanks, and a shift of
/// second order in the cell's size (of a quadrature limit only) for curved ones.
fn common_refinement(
    [a, b]: [f64; 2],
    [at_a, at_b]: [Facing; 2],
    traces: &[Trace],
    cuts: &mut Vec<f64>,
) {
    cuts.clear();
    cuts.extend([a, b]);
    for trace in traces {
        let (from, to) = (at_a.arc[trace.side], at_b.arc[trace.side]);
        let (low, high) = (from.min(to), from.max(to));
        let mut corner = trace.edge(low);
        while corner < trace.arc.len() && trace.arc[corner] < high {
            let s = trace.arc[corner];
            if s > low {
                cuts.push(a + (b - a) * (s - from) / (to - from));
            }
            corner += trace.order;
        }
    }
    cuts.sort_by(f64::total_cmp);
    let least = 1e-9 * (b - a);
    cuts.dedup_by(|x, y| *x - *y < least);
    if let Some(last) = cuts.last_mut() {
        *last = b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A load that reaches beyond the last node goes to that node: none is pulled, and the sum stays.
    #[test]
    fn a_load_beyond_the_end_is_borne_by_the_end() {
        let quadratic: Vec<f64> = (0..=10).map(|i| 0.1 * f64::from(i)).collect();
        let trace = Trace {
            side: 0,
            arc: &quadratic,
            order: 2,
        };
        let facing = |x| Facing {
            arc: [x, x],
            gap: 0.0,
        };
        let c = couple(&[1.05, 1.2, 1.4], facing, &[trace]);
        for k in 0..3 {
            let (columns, values) = c.traces[0].row(k);
            for (&column, &value) in columns.iter().zip(values) {
                assert!(value >= 0.0 && (value == 0.0 || column == 10));
            }
            assert!((values.iter().sum::<f64>() - c.length[k]).abs() < 1e-15);
        }
    }

    #[test]
    fn constants_and_linears_are_integrated_exactly() {
        let quadratic: Vec<f64> = (0..=10).map(|i| 0.1 * f64::from(i)).collect();
        let linear = [0.0, 0.13, 0.42, 0.77, 1.0];
        let traces = [
            Trace {
                side: 0,
                arc: &quadratic,
                order: 2,
            },
            Trace {
                side: 1,
                arc: &linear,
                order: 1,
            },
        ];
        let xi = [0.05, 0.21, 0.4, 0.66, 0.9];
        // the second flank runs backwards
        let c = couple(
            &xi,
            |x| Facing {
                arc: [x, 1.0 - x],
                gap: 2.0 + x,
            },
            &traces,
        );
        let total: f64 = c.length.iter().sum();
        assert!((total - 0.85).abs() < 1e-15);
        for k in 0..xi.len() {
            assert!((c.gap[k] - 2.0 * c.length[k] - c.moment[k]).abs() < 1e-15);
            for (trace, arc, sign) in [(0, &quadratic[..], 1.0), (1, &linear[..], -1.0)] {
                let (_, values) = c.traces[trace].row(k);
                assert!(
                    (values.iter().sum::<f64>() - c.length[k]).abs() < 1e-15,
                    "partition of unity"
                );
                let first = c.traces[trace].dot(k, arc);
                let expected = if sign > 0.0 {
                    c.moment[k]
                } else {
                    c.length[k] - c.moment[k]
                };
                assert!((first - expected).abs() < 1e-15, "linear field");
            }
        }
    }
}
