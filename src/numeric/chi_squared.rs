//! The tail of χ².

/// The standard normal variable that as large a χ² corresponds to, of its mean over `count` degrees of freedom: (χ²/N)^(1/3) is nearly normal with the
/// mean 1 − 2/(9N) and the variance 2/(9N), also for few (Wilson & Hilferty, Proc. Natl. Acad. Sci. 17, 1931).
pub fn normal_deviate(mean: f64, count: f64) -> f64 {
    let variance = 2.0 / (9.0 * count);
    (mean.cbrt() - (1.0 - variance)) / variance.sqrt()
}

/// P(χ² ≥ `mean` · `count`) by [`normal_deviate`]: right to a tenth of itself from 10 degrees of freedom on.
pub fn upper_tail(mean: f64, count: f64) -> f64 {
    0.5 * libm::erfc(normal_deviate(mean, count) / std::f64::consts::SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tail_is_that_of_tables() {
        // quantiles of χ²: 18.307 (10, 0.05), 29.588 (10, 0.001), 124.342 (100, 0.05), 149.449 (100, 0.001)
        for (chi2, count, tail) in [
            (18.307, 10.0, 0.05),
            (29.588, 10.0, 1e-3),
            (124.342, 100.0, 0.05),
            (149.449, 100.0, 1e-3),
        ] {
            let found = upper_tail(chi2 / count, count);
            assert!((found / tail - 1.0).abs() < 0.1, "{found} for {tail}");
        }
    }

    /// 10.828 and 13.816 are the quantiles of 0.999 of one and of two degrees of freedom, 3.0902 that of the normal.
    #[test]
    fn few_points_have_the_deviate_of_tables_to_a_fiftieth() {
        for (chi2, count) in [(10.828, 1.0), (13.816, 2.0)] {
            let found = normal_deviate(chi2 / count, count);
            assert!((found / 3.0902 - 1.0).abs() < 0.02, "{found}");
        }
    }
}
