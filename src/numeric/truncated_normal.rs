//! Normal distributions cut by bounds: logarithms that stay finite far in the tails.

use std::f64::consts::{LN_2, PI, SQRT_2};

/// ln Φ(x), the logarithm of the standard normal distribution function.
///
/// ```text
/// x > −20: ln(erfc(−x/√2)/2)      below: −x²/2 − ln(−x √(2π)) + ln(1 − 1/x² + 3/x⁴ − 15/x⁶ + 105/x⁸)
/// ```
/// Abramowitz and Stegun (1964), Eqs. 26.2.29 and 26.2.12; the series is good to 2e-10 there.
pub(crate) fn log_cdf(x: f64) -> f64 {
    if x == f64::NEG_INFINITY {
        return x;
    }
    if x > -20.0 {
        return libm::erfc(-x / SQRT_2).ln() - LN_2;
    }
    let q = 1.0 / (x * x);
    let series = -q * (1.0 - q * (3.0 - q * (15.0 - q * 105.0)));
    -0.5 * x * x - (-x * (2.0 * PI).sqrt()).ln() + series.ln_1p()
}

/// ln(Φ(b) − Φ(a)) for a < b; minus infinity if nothing lies between.
pub(crate) fn log_mass(a: f64, b: f64) -> f64 {
    if a >= b {
        return f64::NEG_INFINITY;
    }
    if a > 0.0 {
        return log_mass(-b, -a);
    }
    let (low, high) = (log_cdf(a), log_cdf(b));
    if low == f64::NEG_INFINITY {
        return high;
    }
    // Neighbours closer than rounding: density times width.
    if high - low < 1e-12 {
        return (b - a).ln() - 0.5 * a * a - 0.5 * (2.0 * PI).ln();
    }
    high + (-(low - high).exp()).ln_1p()
}

/// The normal distribution of `mean` and `sd` between `lower` and `upper`: the value below which the share `p` lies.
pub(crate) fn quantile(p: f64, mean: f64, sd: f64, lower: f64, upper: f64) -> f64 {
    let (a, b) = ((lower - mean) / sd, (upper - mean) / sd);
    let whole = log_mass(a, b);
    if !whole.is_finite() {
        return mean.clamp(lower, upper);
    }
    let mut low = a.max(a.min(b).max(0.0).min(b) - 40.0);
    let mut high = b.min(a.max(0.0) + 40.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if log_mass(a, middle) - whole < p.ln() {
            low = middle;
        } else {
            high = middle;
        }
    }
    mean + sd * 0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::{log_cdf, log_mass, quantile};

    // Values of Φ: Abramowitz and Stegun (1964), Tables 26.1 and 26.2 (−log10 Q(x) for large x).
    #[test]
    fn distribution_function_agrees_with_tables() {
        for (x, phi) in [
            (0.0, 0.5),
            (1.0, 0.841_344_746_068_543),
            (-2.0, 0.022_750_131_948_179),
        ] {
            assert!((log_cdf(x) - f64::ln(phi)).abs() < 1e-12, "{x}");
        }
        for (x, log10) in [(10.0, 23.11805), (20.0, 88.56010), (40.0, 349.43701)] {
            let found = -log_cdf(-x) / 10f64.ln();
            assert!((found - log10).abs() < 1e-5, "{x}: {found}");
        }
        assert!((log_cdf(-19.999_999_9) - log_cdf(-20.000_000_1)).abs() < 1e-5);
    }

    #[test]
    fn masses_and_quantiles() {
        let middle = log_mass(-1.959_963_984_540_054, 1.959_963_984_540_054).exp();
        assert!((middle - 0.95).abs() < 1e-14);
        assert!((log_mass(-3.0, -1.0) - log_mass(1.0, 3.0)).abs() < 1e-15);
        let inf = f64::INFINITY;
        assert!(
            (quantile(0.975, 2.0, 3.0, -inf, inf) - (2.0 + 3.0 * 1.959_963_984_540_054)).abs()
                < 1e-9
        );
        // Half of a normal: the median of |z| is 0.674490.
        assert!((quantile(0.5, 0.0, 1.0, 0.0, inf) - 0.674_489_750_196_082).abs() < 1e-9);
        // Far in the tail the distribution is exponential with rate 30: median near ln 2/30.
        let tail = quantile(0.5, -30.0, 1.0, 0.0, inf);
        assert!((tail - 2f64.ln() / 30.0).abs() < 5e-5, "{tail}");
        let flat = quantile(0.25, 0.0, 1e6, 1.0, 2.0);
        assert!((flat - 1.25).abs() < 1e-6, "{flat}");
    }
}
