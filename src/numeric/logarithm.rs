//! Sums and means of what is known by its logarithm, without overflow or underflow.

/// ln Σ exp(x); −∞ of nothing.
///
/// ```
/// # use gearwear::numeric::logarithm::log_sum_exp;
/// assert!((log_sum_exp(&[-1e4, -1e4]) - (2f64.ln() - 1e4)).abs() < 1e-9);
/// ```
pub fn log_sum_exp(logs: &[f64]) -> f64 {
    let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if !top.is_finite() {
        return top;
    }
    top + logs.iter().map(|log| (log - top).exp()).sum::<f64>().ln()
}

/// ln of the mean of exp(x).
pub fn log_mean_exp(logs: &[f64]) -> f64 {
    log_sum_exp(logs) - (logs.len() as f64).ln()
}

/// ln(1 + eˣ).
pub fn softplus(x: f64) -> f64 {
    x.max(0.0) + (-x.abs()).exp().ln_1p()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_beyond_what_exp_can_hold() {
        assert_eq!(log_sum_exp(&[]), f64::NEG_INFINITY);
        assert_eq!(log_sum_exp(&[f64::NEG_INFINITY; 2]), f64::NEG_INFINITY);
        assert!((log_mean_exp(&[3e5, 3e5, 3e5]) - 3e5).abs() < 1e-9);
        assert!((log_sum_exp(&[0.0, 1.0]) - (1.0 + 1f64.exp()).ln()).abs() < 1e-15);
        for x in [-800.0, -3.0, 0.0, 2.0, 800.0] {
            // S(x) + S(−x) = 1
            let both = (-softplus(x)).exp() + (-softplus(-x)).exp();
            assert!((both - 1.0).abs() < 1e-15, "{x}");
        }
    }
}
