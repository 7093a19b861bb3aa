//! The scatter of series too short for neighbours: a few weighings of one member in one test, without a sigma.
//!
//! ```text
//! y ≈ a N + b N²          least squares; nothing is lost at the start
//! s² = Σ r²/ν,  ν = n − 2 of n points
//! ```
//! ln s of ν degrees of freedom has the mean ½(ψ(ν/2) − ln(ν/2)) over ln σ and the variance ¼ψ'(ν/2) (moments of the logarithm of χ²; Johnson,
//! Kotz & Balakrishnan, Continuous Univariate Distributions 1, 1994, ch. 18). A law of wear that bends more than a parabola counts as scatter.

use super::pooled_scatter::CurveScatter;

/// Bias and variance of ln s with 1, 2, 3 and 4 degrees of freedom.
const MOMENTS: [[f64; 2]; 4] = [
    [-0.635, 1.234],
    [-0.289, 0.411],
    [-0.184, 0.234],
    [-0.135, 0.161],
];

/// Scatter of a series of (cycles, value); None of fewer than three points, or where nothing is left of more than four degrees of freedom: such a
/// series has neighbours. No less than `least` of its largest value.
pub(super) fn scatter(points: &[[f64; 2]], least: f64) -> Option<CurveScatter> {
    let freedom = points.len().checked_sub(2)?;
    let [bias, variance] = *MOMENTS.get(freedom.checked_sub(1)?)?;
    let last = points.iter().map(|[x, _]| *x).fold(0.0, f64::max);
    let largest = points.iter().map(|[_, y]| y.abs()).fold(0.0, f64::max);
    let sum =
        |f: &dyn Fn(f64, f64) -> f64| points.iter().map(|[x, y]| f(x / last, *y)).sum::<f64>();
    let [xx, xxx, xxxx] = [2, 3, 4].map(|power| sum(&|x, _| x.powi(power)));
    let [xy, xxy] = [1, 2].map(|power| sum(&|x, y| x.powi(power) * y));
    let determinant = xx * xxxx - xxx * xxx;
    if !(last > 0.0 && largest > 0.0 && determinant > f64::EPSILON * xx * xxxx) {
        return None;
    }
    let a = (xy * xxxx - xxy * xxx) / determinant;
    let b = (xxy * xx - xy * xxx) / determinant;
    let left = sum(&|x, y| (y - a * x - b * x * x).powi(2));
    let scatter = (left / freedom as f64).sqrt() * (-bias).exp();
    Some(CurveScatter {
        scatter: scatter.max(least * largest),
        largest,
        points: points.len(),
        variance,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_from_nothing_has_no_scatter() {
        let points = [1.0, 2.0, 3.0, 5.0].map(|x| [1e5 * x, 3.0 * x - 0.2 * x * x]);
        let found = scatter(&points, 1e-3).unwrap();
        assert!((found.scatter - 1e-3 * found.largest).abs() < 1e-12);
        assert!(scatter(&points[..2], 1e-3).is_none());
        assert!(scatter(&[[0.0, 1.0]; 4], 1e-3).is_none());
    }

    /// Median over many series of ln s is ln σ, and ln s has the stated variance: noise of known quantiles in all orders.
    #[test]
    fn scatter_has_no_bias_in_the_logarithm() {
        let mut state = 7u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((state >> 11) as f64 + 0.5) / (1u64 << 53) as f64
        };
        let mut normal =
            || (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos();
        for (count, [_, variance]) in (3..).zip(MOMENTS) {
            let logs: Vec<f64> = (0..4000)
                .map(|_| {
                    let points: Vec<[f64; 2]> = (1..=count)
                        .map(|i| [f64::from(i), 5.0 * f64::from(i) + 0.3 * normal()])
                        .collect();
                    (scatter(&points, 0.0).unwrap().scatter / 0.3).ln()
                })
                .collect();
            let mean = logs.iter().sum::<f64>() / logs.len() as f64;
            let spread = logs.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / logs.len() as f64;
            assert!(mean.abs() < 0.06, "{count}: {mean}");
            assert!((spread / variance - 1.0).abs() < 0.15, "{count}: {spread}");
        }
    }
}
