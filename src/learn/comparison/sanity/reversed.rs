//! Curves of one flank that run opposite ways: radii upside down at one checkpoint.
//!
//! ```text
//! r(a, b) = Σ a_i b_i/√(Σ a_i² Σ b_i²)      of two checkpoints' depths at the same places, each less its mean
//! r(a, b) < 0.5 and r(a, b reversed) > 0.9: wear that goes on in between keeps its pattern
//! ```

use super::super::residual_statistics::FittedRow;
use super::flank_curves::{Curve, flank_curves};
use crate::study::Study;

/// Fewest points of a curve.
const FEWEST: usize = 6;
/// Correlation below which two curves do not run alike, and from which one runs as the other does upside down.
const UNLIKE: f64 = 0.5;
const ALIKE: f64 = 0.9;
/// Standard deviation of a curve's values over their sigma from which it has a pattern.
const PATTERN: f64 = 5.0;

/// Tests in which two checkpoints that follow each other run opposite ways along a flank.
pub(super) fn reversed(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let mut said = Vec::new();
    for ((test, member, _), of_flank) in flank_curves(rows.iter().map(|(o, _)| *o)) {
        if let Some(pair) = of_flank
            .windows(2)
            .find(|pair| opposite(&pair[0], &pair[1]))
        {
            said.push(format!(
                "in test {} wear_depth of the {} runs the other way along the flank after {} cycles than after {}: are the places of one of these \
                 curves upside down?",
                study.tests[test].id,
                member.name(),
                pair[1].cycles,
                pair[0].cycles
            ));
        }
    }
    said
}

/// Whether two curves at the same places, both with a pattern, are alike only with one of them upside down.
fn opposite(one: &Curve, other: &Curve) -> bool {
    let same_places = one.points.len() == other.points.len()
        && (one.points.iter().zip(&other.points)).all(|(a, b)| a[0] == b[0]);
    if !same_places || one.points.len() < FEWEST {
        return false;
    }
    let [a, b] = [one, other].map(centred);
    let has_pattern = |values: &[f64], sigma: f64| {
        let mean_square = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
        mean_square.sqrt() > PATTERN * sigma
    };
    let turned: Vec<f64> = b.iter().rev().copied().collect();
    has_pattern(&a, one.sigma)
        && has_pattern(&b, other.sigma)
        && correlation(&a, &b) < UNLIKE
        && correlation(&a, &turned) > ALIKE
}

fn centred(curve: &Curve) -> Vec<f64> {
    let mean = curve.points.iter().map(|p| p[1]).sum::<f64>() / curve.points.len() as f64;
    curve.points.iter().map(|p| p[1] - mean).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_upside_down_runs_the_other_way() {
        let curve = |cycles: f64, values: [f64; 7]| Curve {
            cycles,
            points: (values.iter().enumerate())
                .map(|(i, v)| [26.0 + 0.3 * i as f64, *v])
                .collect(),
            sigma: 0.1,
        };
        let early = [6.0, 4.5, 3.0, 1.5, 0.2, 1.0, 2.0];
        let later = early.map(|v| 1.8 * v + 0.3);
        let mut turned = later;
        turned.reverse();
        let opposite = |values| opposite(&curve(1e5, early), &curve(2e5, values));
        assert!(opposite(turned));
        assert!(!opposite(later));
        // noise has no pattern
        assert!(!opposite([0.05, 0.0, 0.1, 0.0, 0.05, 0.1, 0.0]));
    }
}
