//! Smooth functions at given places, drawn from a Gaussian process, as sums of few independent parts.
//!
//! ```text
//! C(x, x') = s² exp(−(x − x')²/(2 ℓ²)),   C = Σ λ_i e_i e_iᵀ,   f = Σ z_i √λ_i e_i,   z_i ~ N(0, 1)
//! ```
//! (the discrete Karhunen-Loève expansion; Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, sections 4.3 and 8.1).
//! With the mean over the places taken out, C becomes P C P with P = I − 1 1ᵀ/n, and no part holds a constant.

use nalgebra::{DMatrix, SymmetricEigen};

/// Share of the largest part's standard deviation below which parts are left out.
const LEAST: f64 = 1e-2;

/// The leading parts √λ_i e_i as columns, the largest first, at most `most`; each with its largest value positive.
///
/// `size` is s in the unit of the function, `length` ℓ in that of the places.
///
/// # Panics
/// Never for finite places and positive size and length.
pub fn leading(
    places: &[f64],
    size: f64,
    length: f64,
    without_mean: bool,
    most: usize,
) -> DMatrix<f64> {
    let n = places.len();
    let mut covariance = DMatrix::from_fn(n, n, |i, j| {
        let apart = (places[i] - places[j]) / length;
        size * size * (-0.5 * apart * apart).exp()
    });
    if without_mean {
        let rows: Vec<f64> = covariance.row_iter().map(|row| row.mean()).collect();
        let all = rows.iter().sum::<f64>() / n as f64;
        covariance = DMatrix::from_fn(n, n, |i, j| covariance[(i, j)] - rows[i] - rows[j] + all);
    }
    let eigen = SymmetricEigen::new(covariance);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let largest = order.first().map_or(0.0, |&i| eigen.eigenvalues[i]);
    order.retain(|&i| eigen.eigenvalues[i] > LEAST * LEAST * largest);
    order.truncate(most);
    let mut parts = DMatrix::zeros(n, order.len());
    for (column, &i) in order.iter().enumerate() {
        let vector = eigen.eigenvectors.column(i);
        let sign = vector[vector.iamax()].signum();
        let scaled = vector * (sign * eigen.eigenvalues[i].sqrt());
        parts.set_column(column, &scaled);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> Vec<f64> {
        (0..24).map(f64::from).collect()
    }

    /// Mercer: the parts' outer products are the covariance again.
    #[test]
    fn all_parts_together_are_the_process() {
        let parts = leading(&places(), 0.7, 6.0, false, 24);
        let covariance = &parts * parts.transpose();
        for i in 0..24 {
            for j in 0..24 {
                let apart = (i as f64 - j as f64) / 6.0;
                let exact = 0.49 * (-0.5 * apart * apart).exp();
                assert!((covariance[(i, j)] - exact).abs() < 1e-3);
            }
        }
        assert!(parts.ncols() < 14, "{}", parts.ncols());
    }

    #[test]
    fn no_part_holds_a_constant_where_the_mean_is_taken_out() {
        let parts = leading(&places(), 1.0, 3.0, true, 10);
        assert_eq!(parts.ncols(), 10);
        for part in parts.column_iter() {
            assert!(part.sum().abs() < 1e-10);
        }
        // orthogonal, and falling
        let products = parts.transpose() * &parts;
        for i in 1..10 {
            assert!(products[(i, i)] <= products[(i - 1, i - 1)]);
            assert!(products[(i, 0)].abs() < 1e-10);
        }
    }
}
