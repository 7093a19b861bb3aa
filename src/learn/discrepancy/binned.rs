//! What the means of bins explain of a residual.
//!
//! ```text
//! η² = Σ_bins n_b (r̄_b − r̄)²/Σ (r − r̄)²,   share = 1 − (1 − η²)(n − 1)/(n − b)      b bins of about equal size
//! ```
//! The share of the variance that the means of b bins explain grows with b even on pure noise; the second formula (ε², Kelley
//! 1935) takes that off: its mean is 0 where r does not depend on the driver, its standard deviation √(2 (b − 1)/((n − b)(n + 1))).

use serde::{Deserialize, Serialize};

/// Most bins of a driver.
pub(in crate::learn) const BINS: usize = 12;
/// Least rows in a bin on average.
const ROWS: usize = 5;

/// How much of a residual one driver explains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Explained {
    /// Share of the residual's variance that depends on the driver alone, not below 0.
    pub share: f64,
    /// Standard deviation of the share where the residual does not depend on the driver.
    pub share_by_chance: f64,
    /// The same part in units of the noise's variance.
    pub variance: f64,
}

/// Mean residual of a bin, in standard deviations of a measured value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BinMean {
    /// Mean of (measured − model − datum)/σ.
    pub mean: f64,
    /// Its standard error, from the scatter in the bin.
    pub error: f64,
}

/// Ends (exclusive) of bins of about equal size of ascending values; equal values share a bin, few different ones have one each.
pub(in crate::learn) fn bins(at: &[f64]) -> Vec<usize> {
    let most = (at.len() / ROWS).clamp(2, BINS);
    let steps: Vec<usize> = (1..at.len()).filter(|&i| at[i] > at[i - 1]).collect();
    let mut ends: Vec<usize> = if steps.len() < most {
        steps
    } else {
        // the step nearest to each equal part
        let nearest = |wanted: usize| {
            let after = steps.partition_point(|s| *s < wanted);
            let around = [after.saturating_sub(1), after.min(steps.len() - 1)];
            around
                .map(|i| steps[i])
                .into_iter()
                .min_by_key(|s| s.abs_diff(wanted))
        };
        (1..most)
            .filter_map(|i| nearest(i * at.len() / most))
            .collect()
    };
    ends.dedup();
    if !at.is_empty() {
        ends.push(at.len());
    }
    ends
}

/// What the means of bins with these ends explain of a residual.
pub(in crate::learn) fn explained(residual: &[f64], ends: &[usize]) -> Explained {
    let (n, b) = (residual.len() as f64, ends.len() as f64);
    let share_by_chance = (2.0 * (b - 1.0) / ((n - b) * (n + 1.0))).sqrt();
    let squares = |of: &[f64]| {
        let mean = mean(of);
        of.iter().map(|r| (r - mean).powi(2)).sum::<f64>()
    };
    let all = squares(residual);
    let mut start = 0;
    let within: f64 = ends
        .iter()
        .map(|&end| {
            let own = squares(&residual[start..end]);
            start = end;
            own
        })
        .sum();
    let share = if all > 0.0 {
        (1.0 - within / all * (n - 1.0) / (n - b)).max(0.0)
    } else {
        0.0
    };
    Explained {
        share,
        share_by_chance,
        variance: share * all / (n - 1.0),
    }
}

pub(in crate::learn) fn bin_mean(residual: &[f64]) -> BinMean {
    let (mean, n) = (mean(residual), residual.len() as f64);
    let squares: f64 = residual.iter().map(|r| (r - mean).powi(2)).sum();
    // a single row's error is its own sigma
    let variance = if n > 1.0 { squares / (n - 1.0) } else { 1.0 };
    BinMean {
        mean,
        error: (variance / n).sqrt(),
    }
}

pub(in crate::learn) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
pub(in crate::learn) use tests::noise;

#[cfg(test)]
mod tests {
    use super::*;

    /// Normal numbers: Knuth's linear congruential generator of MMIX, the sum of twelve uniform ones.
    pub(in crate::learn) fn noise(seed: u64, count: usize) -> Vec<f64> {
        let mut state = seed;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..count)
            .map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0)
            .collect()
    }

    /// Over many sets of noise: mean 0 and the stated spread, where η² alone would have (b − 1)/(n − 1) = 9 %.
    #[test]
    fn the_corrected_share_of_noise_is_zero_on_average() {
        let (n, b, sets) = (120, 12, 400);
        let ends: Vec<usize> = (1..=b).map(|i| i * n / b).collect();
        let shares: Vec<f64> = (0..sets)
            .map(|seed| {
                // both signs: the share before it is kept from falling below 0
                let residual = noise(1000 + seed, n);
                let all = explained(&residual, &[n]).share_by_chance;
                assert_eq!(all, 0.0);
                let mean = mean(&residual);
                let total: f64 = residual.iter().map(|r| (r - mean).powi(2)).sum();
                let within: f64 = residual
                    .chunks(n / b)
                    .map(|own| {
                        let mean = super::mean(own);
                        own.iter().map(|r| (r - mean).powi(2)).sum::<f64>()
                    })
                    .sum();
                let share = 1.0 - within / total * (n as f64 - 1.0) / (n - b) as f64;
                let kept = explained(&residual, &ends).share;
                assert!((kept - share.max(0.0)).abs() < 1e-12);
                share
            })
            .collect();
        let average = mean(&shares);
        let spread =
            (shares.iter().map(|s| (s - average).powi(2)).sum::<f64>() / sets as f64).sqrt();
        let stated = explained(&noise(1, n), &ends).share_by_chance;
        assert!(
            average.abs() < 3.0 * stated / (sets as f64).sqrt(),
            "{average}"
        );
        assert!((spread / stated - 1.0).abs() < 0.12, "{spread} {stated}");
    }

    #[test]
    fn equal_values_are_never_split() {
        let at = [
            1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0,
        ];
        let ends = bins(&at);
        assert_eq!(ends.last(), Some(&at.len()));
        for end in &ends[..ends.len() - 1] {
            assert!(at[*end] > at[end - 1], "{ends:?}");
        }
        assert_eq!(bins(&[2.0; 9]), [9]);
        assert!(bins(&[]).is_empty());
    }
}
