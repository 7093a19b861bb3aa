//! Where involutes with smooth profile deviations touch, for the analytic contact model.
//!
//! ```text
//! g(ξ) = ξ²/(2R) + e(ξ),   e(ξ) ≈ e₀ + e₁ ξ + ½ e₂ ξ²  (least squares over the pair's nodes)
//! touch at ξ₀ = −e₁/κ,   g(ξ₀) = e₀ − e₁²/(2κ),   κ = 1/R + e₂
//! ```
//! A slope of the deviation moves the contact along the flanks, and a curvature changes how fast it passes over them: next to a base
//! circle, where flanks are short, a wave of 3 µm changes the wear of a place by a fifth although the load of the pair changes by a twentieth.

use nalgebra::{Matrix3, Vector3};

use crate::contact::cycle::{Cycle, PairContact};
use crate::numeric::interpolate;

/// Where a tooth pair touches, unworn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Along the tangent from the line of action, mm.
    pub centre: f64,
    /// What separates the flanks there, mm.
    pub gap: f64,
    /// Relative radius of curvature there, mm.
    pub radius: f64,
}

/// Least curvature of the gap, as a share of that of the involutes; a contact that is hollow touches at two places.
const LEAST_CURVATURE: f64 = 0.2;
/// Farthest centre, as a share of the pair's farthest node.
const FARTHEST: f64 = 0.5;

impl ContactPoint {
    /// The contact points of all pairs of a cycle, by position and pair: with the deviations that the gears are made with, and what their
    /// flanks lack besides of `profile` (mm at the stations of pinion and gear).
    pub fn all(cycle: &Cycle, profile: Option<&[Vec<f64>; 2]>) -> Vec<Vec<Self>> {
        let gears = [&cycle.pair.pinion, &cycle.pair.gear];
        let lacks = |side: usize, arc: f64| {
            let made = gears[side].relief(gears[side].rho_at_arc(arc));
            let besides = profile.map(|p| interpolate(&cycle.stations.arc[side], &p[side], arc));
            made + besides.unwrap_or(0.0)
        };
        let positions = cycle.positions.iter();
        positions
            .map(|position| {
                let pairs = position.pairs.iter();
                pairs.map(|pair| Self::of(cycle, pair, &lacks)).collect()
            })
            .collect()
    }

    /// (`after` − self)/`step`, number by number.
    pub fn slope_to(&self, after: &Self, step: f64) -> Self {
        Self {
            centre: (after.centre - self.centre) / step,
            gap: (after.gap - self.gap) / step,
            radius: (after.radius - self.radius) / step,
        }
    }

    /// The contact point of a pair whose flanks lack `lacks` (mm) of involutes, by side and arc.
    fn of(cycle: &Cycle, pair: &PairContact, lacks: &impl Fn(usize, f64) -> f64) -> Self {
        let deviation = |k: usize| (0..2).map(|side| lacks(side, pair.arc[side][k])).sum();
        let [e0, e1, e2] = parabola(&pair.xi, deviation);
        let radius = cycle.pair.relative_radius(pair.path);
        // without a deviation the involutes' own radius, to the bit
        let bend = (1.0 + radius * e2).max(LEAST_CURVATURE);
        let curvature = bend / radius;
        let reach = pair.xi.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let centre = (-e1 / curvature).clamp(-FARTHEST * reach, FARTHEST * reach);
        Self {
            centre,
            gap: e0 + e1 * centre + 0.5 * curvature * centre * centre,
            radius: radius / bend,
        }
    }
}

/// Value, slope and curvature at 0 of the parabola nearest to `f` at the nodes `x`; fewer than three nodes: the mean.
fn parabola(x: &[f64], f: impl Fn(usize) -> f64) -> [f64; 3] {
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (k, x) in x.iter().enumerate() {
        let row = Vector3::new(1.0, *x, 0.5 * x * x);
        matrix += row * row.transpose();
        right += row * f(k);
    }
    match matrix.cholesky() {
        Some(factor) if x.len() >= 3 => factor.solve(&right).into(),
        _ => [right[0] / x.len().max(1) as f64, 0.0, 0.0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::cycle::{CycleSpec, Stations};
    use crate::contact::frame::tests::reference;
    use crate::gear::Pair;

    #[test]
    fn a_parabola_is_found_on_any_nodes() {
        let x = [-0.21, -0.1, 0.02, 0.11, 0.13, 0.3];
        let f = |k: usize| 2e-3 - 0.01 * x[k] + 0.5 * 0.04 * x[k] * x[k];
        let found = parabola(&x, f);
        for (found, wanted) in found.iter().zip([2e-3, -0.01, 0.04]) {
            assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        }
        assert_eq!(parabola(&[0.1, 0.2], |k| k as f64), [0.5, 0.0, 0.0]);
    }

    /// A flank tilted by θ about the point on the line of action touches θR beside it, θ²R/2 nearer; one whose curvature changes by c
    /// touches where it did, with the radius 1/(1/R + c).
    #[test]
    fn tilted_and_bent_flanks_touch_as_circles_do() {
        let Pair { pinion, gear, .. } = reference();
        let pair = Pair::new(pinion, gear, 80.0, 0.0).unwrap();
        let spec = CycleSpec {
            positions: 10,
            spacing: 0.01,
            window: 0.2,
            reach: 0.02,
        };
        let cycle = Cycle::new(&pair, &Stations::new(&pair, 0.002), spec);
        let mut looked_at = 0;
        for met in cycle.positions.iter().flat_map(|p| &p.pairs) {
            let radius = pair.relative_radius(met.path);
            if met.path.abs() > 4.0 || met.xi.len() < 10 {
                continue;
            }
            looked_at += 1;
            // the arc of the pinion from the line of action, which ξ follows but for the flank's own curvature
            let touch = |f: &dyn Fn(f64) -> f64| {
                let lacks = |side: usize, arc: f64| match side {
                    0 => f(arc - met.facing.arc[0]),
                    _ => 0.0,
                };
                ContactPoint::of(&cycle, met, &lacks)
            };
            let sign = (met.arc[0][1] - met.arc[0][0]).signum();
            let tilted = touch(&|s| 5e-4 * s);
            assert!((tilted.centre + sign * 5e-4 * radius).abs() < 0.02 * 5e-4 * radius);
            assert!((tilted.gap + 0.5 * 25e-8 * radius).abs() < 0.05 * 25e-8 * radius);
            let bent = touch(&|s| 0.5 * 0.02 * s * s);
            assert!(bent.centre.abs() < 1e-3, "{}", bent.centre);
            let wanted = 1.0 / (1.0 / radius + 0.02);
            assert!((bent.radius / wanted - 1.0).abs() < 0.01, "{}", bent.radius);
        }
        assert!(looked_at > 5, "{looked_at}");
    }
}
