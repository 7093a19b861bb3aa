//! What the neighbours of a point along a measured curve say of it, without any model of wear.
//!
//! A parabola by weighted least squares through the nearest points on both sides, the point itself left out (local polynomial
//! regression: Fan & Gijbels, Local Polynomial Modelling and Its Applications, 1996, ch. 2).

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use super::{FacePlace, Observation};

/// Points on each side, where a curve has enough.
pub(super) const SIDE: usize = 4;
/// Fewest points of a curve that a parabola is laid through.
const FEWEST: usize = 7;

/// What the neighbours of a point say of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbours {
    /// The value that they lead one to expect, in its unit.
    pub expected: f64,
    /// Standard deviation of the point's own value minus that, where all σ are right.
    pub sigma: f64,
    /// Slope of the curve there, in the value's unit per mm.
    pub slope: f64,
}

/// Rows of one curve (test, member, quantity, cycles, trace, place across the face and tooth) by ascending position.
pub fn curves(rows: &[&Observation]) -> Vec<Vec<usize>> {
    let mut curves: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (i, o) in rows.iter().enumerate() {
        if o.position.is_some() {
            let cut = (o.trace, o.face.map(FacePlace::key), o.tooth.as_deref());
            let key = (o.test, o.member, o.quantity, o.cycles.to_bits(), cut);
            curves.entry(key).or_default().push(i);
        }
    }
    let place = |i: &usize| rows[*i].position.unwrap_or(0.0);
    let mut curves: Vec<Vec<usize>> = curves.into_values().collect();
    for curve in &mut curves {
        curve.sort_by(|a, b| place(a).total_cmp(&place(b)));
    }
    curves
}

/// What the other points of a curve say of the one at `at`: points are (position, value, σ) by ascending position, those `passed_over` not
/// asked. None where there are too few.
pub fn around(points: &[[f64; 3]], at: usize, passed_over: &[bool]) -> Option<Neighbours> {
    around_within(points, at, passed_over, SIDE)
}

/// The same of so many points on each side: fewer follow a curve that bends within a few points.
pub(super) fn around_within(
    points: &[[f64; 3]],
    at: usize,
    passed_over: &[bool],
    side: usize,
) -> Option<Neighbours> {
    if points.len() < FEWEST {
        return None;
    }
    let asked = |i: &usize| !passed_over[*i];
    let before = (0..at).rev().filter(asked).take(side);
    let after = (at + 1..points.len()).filter(asked).take(side);
    let near: Vec<usize> = before.chain(after).collect();
    if near.len() < 4 {
        return None;
    }
    let [place, _, own] = points[at];
    let width = (near.iter().map(|&i| (points[i][0] - place).abs())).fold(0.0, f64::max);
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for &i in &near {
        let [x, y, sigma] = points[i];
        let x = (x - place) / width;
        let row = Vector3::new(1.0, x, x * x);
        normal += row * row.transpose() / (sigma * sigma);
        right += row * (y / (sigma * sigma));
    }
    let covariance = normal.try_inverse()?;
    let parabola = covariance * right;
    let found = Neighbours {
        expected: parabola[0],
        sigma: (own * own + covariance[(0, 0)]).sqrt(),
        slope: parabola[1] / width,
    };
    (found.expected.is_finite() && found.sigma.is_finite() && found.slope.is_finite())
        .then_some(found)
}

/// Slope of its curve at each row, in its unit per mm; 0 where there are too few points.
pub fn slopes(rows: &[&Observation]) -> Vec<f64> {
    let mut slopes = vec![0.0; rows.len()];
    for curve in curves(rows) {
        let points = points(rows, &curve);
        let none = vec![false; points.len()];
        for (at, &row) in curve.iter().enumerate() {
            slopes[row] = around(&points, at, &none).map_or(0.0, |found| found.slope);
        }
    }
    slopes
}

/// (position, value, σ) of a curve's rows.
pub(super) fn points(rows: &[&Observation], curve: &[usize]) -> Vec<[f64; 3]> {
    let point = |&i: &usize| {
        [
            rows[i].position.unwrap_or(0.0),
            rows[i].value,
            rows[i].sigma,
        ]
    };
    curve.iter().map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola is met exactly, value and slope, wherever its points stand; the σ of the difference is that of the linear estimator.
    #[test]
    fn a_parabola_is_met_exactly() {
        let h = |x: f64| 3.0 - 2.0 * x + 0.7 * x * x;
        let points: Vec<[f64; 3]> = [0.0, 0.1, 0.25, 0.3, 0.5, 0.55, 0.8, 0.9, 1.2]
            .map(|x| [x, h(x), 0.1])
            .into();
        let none = [false; 9];
        for at in 0..points.len() {
            let found = around(&points, at, &none).unwrap();
            let x = points[at][0];
            assert!((found.expected - h(x)).abs() < 1e-10);
            assert!((found.slope - (1.4 * x - 2.0)).abs() < 1e-9);
            assert!(found.sigma > 0.1);
        }
        assert!(around(&points[..5], 2, &none[..5]).is_none());
    }
}
