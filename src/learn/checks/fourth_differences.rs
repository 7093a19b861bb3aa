//! Fourth divided differences along curves: less of what bends between coarse points is left in them than in second ones.
//!
//! ```text
//! D_i = Σ_j w_j x_j,  w_j = Π_(k≠j) 1/(s_j − s_k)      five neighbours j; x: measured minus model, s: position
//! σ/stated = √(median(D²/var D)/0.4549)
//! ```

use crate::measure::Observation;
use crate::measure::neighbours::curves;

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
