//! Fourth divided differences along curves: less of what bends between coarse points is left in them than in second ones.
//!
//! ```text
//! D_i = Σ_j w_j x_j,  w_j = Π_(k≠j) 1/(s_j − s_k)      five neighbours j; x: measured minus model, s: position
//! σ/stated = √(median(D²/var D)/0.4549)
//! ```

use crate::measure::Observation;
use crate::measure::neighbours::curves;

/// Median of χ² with one degree of freedom.
pub(super) const MEDIAN: f64 = 0.454_936;
/// Neighbours of one difference.
const POINTS: usize = 5;

/// The squares of all of them over their variances where the rows have these σ.
pub(super) fn standardised_squares(
    rows: &[&Observation],
    residual: &[f64],
    sigma: &[f64],
) -> Vec<f64> {
    let place = |row: usize| rows[row].position.unwrap_or(0.0);
    let mut squares = Vec::new();
    for curve in curves(rows) {
        for near in curve.windows(POINTS) {
            let rises = |two: &[usize]| place(two[0]) < place(two[1]);
            if !near.windows(2).all(rises) {
                continue;
            }
            let (mut value, mut variance) = (0.0, 0.0);
            for &row in near {
                let others = near.iter().filter(|other| **other != row);
                let weight: f64 = others
                    .map(|&other| (place(row) - place(other)).recip())
                    .product();
                value += weight * residual[row];
                variance += (weight * sigma[row]).powi(2);
            }
            squares.push(value * value / variance);
        }
    }
    squares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{Quantity, Subject};

    /// The fourth divided difference of a cubic is 0 and that of x⁴ is 1, wherever its points lie (Milne-Thomson, The Calculus of Finite Differences, ch. 1).
    #[test]
    fn a_cubic_leaves_nothing_and_a_fourth_power_one() {
        let places = [0.0, 0.4, 1.1, 1.5, 2.3];
        let row = |&place: &f64| Observation {
            test: 0,
            member: Subject::Pinion,
            cycles: 1e5,
            quantity: Quantity::WearDepth,
            position: Some(place),
            value: 0.0,
            sigma: 1.0,
            trace: None,
            line: 0,
            face: None,
            tooth: None,
        };
        let rows: Vec<Observation> = places.iter().map(row).collect();
        let rows: Vec<&Observation> = rows.iter().collect();
        let of = |f: &dyn Fn(f64) -> f64, sigma: f64| {
            let residual: Vec<f64> = places.iter().map(|&x| f(x)).collect();
            standardised_squares(&rows, &residual, &[sigma; 5])
        };
        let cubic = of(&|x| 2.0 - x + 3.0 * x.powi(3), 1.0);
        assert!(cubic[0] < 1e-20, "{cubic:?}");
        // its variance is Σ w², w_j = Π 1/(s_j − s_k)
        let product = |j: usize| -> f64 {
            let others = (0..5).filter(|k| *k != j);
            others.map(|k| places[j] - places[k]).product()
        };
        let variance: f64 = (0..5).map(|j| product(j).powi(-2)).sum();
        let fourth = of(&|x| x.powi(4), 1.0)[0];
        assert!((fourth * variance - 1.0).abs() < 1e-10, "{fourth}");
        // twice the σ, a quarter of the square
        assert!((of(&|x| x.powi(4), 2.0)[0] / fourth - 0.25).abs() < 1e-12);
    }
}
