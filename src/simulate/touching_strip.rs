//! Where a tooth pair touches and how hard, as results state it.
//!
//! Under a sharp corner of an elastic body the pressure has no bound, and where a tip corner has worn a ledge it changes within a hundredth of a module:
//! its largest value on a grid says more about the grid than about the teeth. Near the end of a flank the peak is therefore the largest mean over
//! 0.02 modules, which converges as the grid is refined (`validation/cases/corner.md`). Elsewhere it is the largest value. Of the analytic model it is that of
//! Hertz's ellipse itself, wherever the nodes lie.

use std::f64::consts::PI;

use crate::contact::cycle::{Cycle, PairContact};
use crate::contact::frame::Touch;
use crate::numeric::average::average;
use crate::simulate::forward::ContactKind;

/// Length over which the pressure near a flank's end is averaged, modules: between the 0.04 and 0.15 mm over which corner and ledge of the paper's pair wear round
/// and the spacing of the grid, 0.018 mm there.
const LENGTH: f64 = 0.02;

/// How near to the end of a flank a contact is where corners wear it, modules: the ledge of the mate's tip corner and the corner's own rounding.
const NEAR: f64 = 0.1;

/// The strip in which one tooth pair touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchingStrip {
    /// Half its width, mm.
    pub half_width: f64,
    /// Whether the pressure reaches the tip corner or form circle of a flank, or the pair touches outside the line of action.
    pub at_corner: bool,
    /// Largest pressure, MPa; by finite elements the largest mean over 0.02 modules near the end of a flank.
    pub peak_pressure: f64,
}

impl TouchingStrip {
    /// The strip of `pair` under the pressures (MPa) at its unknowns.
    pub fn of(kind: ContactKind, cycle: &Cycle, pair: &PairContact, pressure: &[f64]) -> Self {
        let at_corner =
            pair.frame.touch != Touch::Flanks || ends_loaded(pair, pressure, cycle.spec.window);
        if kind == ContactKind::Hertz
            && !at_corner
            && let Some((peak_pressure, half_width)) =
                hertz_ellipse(&pair.xi, &pair.length, pressure)
        {
            return Self {
                half_width,
                at_corner,
                peak_pressure,
            };
        }
        let half_width = half_width(&pair.xi, pressure);
        let length = LENGTH * cycle.pair.pinion.rack.module;
        let near = NEAR * cycle.pair.pinion.rack.module;
        let peak_pressure = if kind == ContactKind::Hertz {
            largest(pressure)
        } else if at_corner {
            // no less than the mean over the whole strip
            largest_mean(&pair.xi, pressure, length.min(2.0 * half_width))
        } else if gap_to_an_end(pair, pressure, cycle.spec.window) < near {
            // that takes at most 4 % off a Hertz contact; the whole length would level narrower ones
            largest_mean(&pair.xi, pressure, half_width.min(length))
        } else {
            largest(pressure)
        };
        Self {
            half_width,
            at_corner,
            peak_pressure,
        }
    }
}

/// Largest pressure, MPa, and half width, mm, of a Hertz pressure that is known at nodes and carries its load on their `lengths` (mm); none where it
/// stands on fewer than three of them.
///
/// The squares of an ellipse's heights lie on a parabola, whose zeros are the edges. The heights themselves are scaled so that their sum carries the load, and
/// so depend on where the nodes lie; 2w/(πb) does not.
fn hertz_ellipse(xi: &[f64], lengths: &[f64], pressure: &[f64]) -> Option<(f64, f64)> {
    let loaded: Vec<usize> = (0..xi.len()).filter(|&k| pressure[k] > 0.0).collect();
    let [first, .., last] = loaded[..] else {
        return None;
    };
    let middle = loaded[loaded.len() / 2];
    if middle == first || middle == last {
        return None;
    }
    let [a, b, c] = [first, middle, last].map(|k| (xi[k] - xi[middle], pressure[k].powi(2)));
    let (before, after) = ((a.1 - b.1) / a.0, (c.1 - b.1) / c.0);
    let bend = (after - before) / (c.0 - a.0);
    let slope = before - bend * a.0;
    let half_width = (slope * slope - 4.0 * bend * b.1).sqrt() / (2.0 * bend.abs());
    let load: f64 = pressure.iter().zip(lengths).map(|(p, l)| p * l).sum();
    let peak = 2.0 * load / (PI * half_width);
    (bend < 0.0 && peak.is_finite()).then_some((peak, half_width))
}

fn largest(pressure: &[f64]) -> f64 {
    pressure.iter().fold(0.0, |m: f64, p| m.max(*p))
}

/// Whether there is pressure where a flank ends: at the first or last node, if that is the end of a flank (tip or form circle)
/// and not of the strip ±`window` (mm) in which contact is looked for.
fn ends_loaded(pair: &PairContact, pressure: &[f64], window: f64) -> bool {
    let (low, high) = pair.frame.extent(window);
    let loaded = |node: Option<&f64>| node.is_some_and(|p| *p > 0.0);
    (low > -window && loaded(pressure.first())) || (high < window && loaded(pressure.last()))
}

/// Half the width of the strip with pressure: from the zero beyond its first node to that beyond its last, each taken
/// where a pressure that falls like the root of the distance from the edge would vanish.
fn half_width(xi: &[f64], pressure: &[f64]) -> f64 {
    let loaded = |k: &usize| pressure[*k] > 0.0;
    let (Some(first), Some(last)) = ((0..xi.len()).find(loaded), (0..xi.len()).rev().find(loaded))
    else {
        return 0.0;
    };
    let edge = |at: usize, inner: Option<usize>, outer: Option<usize>| {
        let Some(outer) = outer else { return xi[at] };
        let Some(inner) = inner.filter(|&i| pressure[i] > pressure[at]) else {
            return 0.5 * (xi[at] + xi[outer]);
        };
        // p² falls linearly to the edge
        let (p, q) = (pressure[at].powi(2), pressure[inner].powi(2));
        let beyond = (xi[at] - xi[inner]) * p / (q - p);
        let room = xi[outer] - xi[at];
        xi[at] + beyond.clamp(room.min(0.0), room.max(0.0))
    };
    let low = edge(
        first,
        (first < last).then_some(first + 1),
        first.checked_sub(1),
    );
    let high = edge(
        last,
        (first < last).then(|| last - 1),
        Some(last + 1).filter(|&k| k < xi.len()),
    );
    0.5 * (high - low)
}

/// From the strip with pressure to the nearest end of a flank, mm; infinite where the strip ±`window` (mm) that is searched ends before.
fn gap_to_an_end(pair: &PairContact, pressure: &[f64], window: f64) -> f64 {
    let loaded = |k: &usize| pressure[*k] > 0.0;
    let ends = ((0..pressure.len()).find(loaded)).zip((0..pressure.len()).rev().find(loaded));
    let Some((first, last)) = ends else {
        return f64::INFINITY;
    };
    let (low, high) = pair.frame.extent(window);
    let below = if low > -window {
        pair.xi[first] - low
    } else {
        f64::INFINITY
    };
    let above = if high < window {
        high - pair.xi[last]
    } else {
        f64::INFINITY
    };
    below.min(above)
}

/// The largest mean over `length` of the straight lines through `values` at the ascending `nodes`, around nodes and the middles between them.
/// Beyond the nodes there is nothing.
fn largest_mean(nodes: &[f64], values: &[f64], length: f64) -> f64 {
    let middles = nodes.windows(2).map(|two| 0.5 * (two[0] + two[1]));
    let mean = |at: f64| -> f64 {
        let weights = average(nodes, at - 0.5 * length, at + 0.5 * length);
        weights.iter().map(|&(k, weight)| weight * values[k]).sum()
    };
    (nodes.iter().copied().chain(middles)).fold(0.0, |most, at| mean(at).max(most))
}

#[cfg(test)]
mod tests {
    use super::{hertz_ellipse, largest_mean};

    /// Nodes anywhere under an ellipse of 800 MPa over ±0.08 mm, its heights scaled to carry the load.
    #[test]
    fn an_ellipse_is_the_same_wherever_the_nodes_lie() {
        let (peak, half_width) = (800.0, 0.08);
        let load = 0.5 * std::f64::consts::PI * half_width * peak;
        for (spacing, offset) in [(0.016, 0.0), (0.026, 0.007), (0.04, 0.0199), (0.05, 0.013)] {
            let nodes: Vec<f64> = (-8..=8).map(|i| spacing * f64::from(i) + offset).collect();
            let height = |x: &f64| (1.0 - (x / half_width).powi(2)).max(0.0).sqrt();
            let area = spacing * nodes.iter().map(height).sum::<f64>();
            let pressure: Vec<f64> = nodes.iter().map(|x| load / area * height(x)).collect();
            let (found, width) = hertz_ellipse(&nodes, &[spacing; 17], &pressure).unwrap();
            assert!((found / peak - 1.0).abs() < 1e-12, "{found}");
            assert!((width / half_width - 1.0).abs() < 1e-12, "{width}");
        }
        assert!(hertz_ellipse(&[0.0, 0.1], &[0.1; 2], &[1.0, 2.0]).is_none());
    }

    /// Of a Hertz pressure the mean over half its half width is (a/2) in closed form: (t √(1 − t²) + asin t)/(2 t), t = 1/4.
    #[test]
    fn the_largest_mean_of_a_hertz_pressure_is_that_in_closed_form() {
        let nodes: Vec<f64> = (-200..=200).map(|i| 0.01 * f64::from(i)).collect();
        let hertz = |x: &f64| (1.0 - x * x).max(0.0).sqrt();
        let values: Vec<f64> = nodes.iter().map(hertz).collect();
        let t: f64 = 0.25;
        let expected = (t * (1.0 - t * t).sqrt() + t.asin()) / (2.0 * t);
        let found = largest_mean(&nodes, &values, 0.5);
        assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
    }

    /// A load on the last node's hat alone, spread over a length longer than that: the load over that length, whatever the grid.
    #[test]
    fn a_corner_bears_its_load_over_the_length() {
        for spacing in [0.02, 0.01, 0.005] {
            let nodes: Vec<f64> = (0..10).map(|i| spacing * f64::from(i)).collect();
            let mut values = vec![0.0; 10];
            let load = 20.0;
            values[0] = load / (0.5 * spacing);
            let found = largest_mean(&nodes, &values, 0.06);
            assert!((found / (load / 0.06) - 1.0).abs() < 1e-12, "{found}");
        }
    }
}
