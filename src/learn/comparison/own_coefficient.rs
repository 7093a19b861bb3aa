//! The wear coefficient that a test has of its own, and when two of them differ.

/// Quantile of the normal distribution beyond which a difference is no chance: 0.005 on one side.
pub(super) const NO_CHANCE: f64 = 2.576;
/// Factor between two k from which it is worth telling.
const FACTOR: f64 = 1.25;
/// Least relative error of a k.
const LEAST_ERROR: f64 = 1e-6;

/// One test's own k.
pub(super) struct OwnK<'a> {
    /// Its id.
    pub(super) test: &'a str,
    /// ln k.
    pub(super) log: f64,
    /// Standard deviation of `log`.
    pub(super) sigma: f64,
}

impl<'a> OwnK<'a> {
    /// Of a test with k in mm²/N and its relative error.
    pub(super) fn new(test: &'a str, k: f64, error: f64) -> Self {
        Self {
            test,
            log: k.ln(),
            sigma: error.max(LEAST_ERROR),
        }
    }

    /// Whether two k differ by more than their errors, and by enough to matter.
    pub(super) fn is_unlike(&self, other: &OwnK<'_>) -> bool {
        let far = (self.log - other.log).abs();
        far > FACTOR.ln() && far > NO_CHANCE * self.sigma.hypot(other.sigma)
    }
}
