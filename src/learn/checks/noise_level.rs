//! Whether measurements scatter more, or much less, than their stated σ.
//!
//! ```text
//! d_i = (x_i − x_{i−1})/(s_i − s_{i−1}) − (x_{i+1} − x_i)/(s_{i+1} − s_i)      x: measured minus model, s: position
//! σ/stated = √(median(d²/var d)/0.4549)
//! ```
//! Whatever is smooth along a trace drops out of such differences (Rice, Ann. Statist. 12, 1984; with positions as Gasser, Sroka &
//! Jennen-Steinmetz, Biometrika 73, 1986); 0.4549 is the median of χ² with one degree of freedom. Evidence knows only the stated σ: if that
//! is too small by two, noise is four times as discrimination, and something seems to be missing.

use std::collections::BTreeMap;

use crate::learn::likelihood::Likelihood;

/// Differences needed for an estimate.
const LEAST: usize = 100;
/// Median of χ² with one degree of freedom.
const MEDIAN: f64 = 0.454_936;
/// Scatter over stated σ below which the stated σ stands: three standard errors of some hundred differences.
const TOLERATED: f64 = 1.2;

/// Scatter over stated σ below which neighbours are too smooth to be independent, or σ is overstated.
const SMOOTH: f64 = 0.67;

/// The factor on the stated σ that the scatter along traces calls for: 1 or above [`TOLERATED`].
pub(in crate::learn) fn sigma_factor(likelihood: &Likelihood<'_>, model: &[f64]) -> f64 {
    scatter(likelihood, model)
        .filter(|found| *found > TOLERATED)
        .unwrap_or(1.0)
}

/// Scatter over stated σ where that is far too little for independent points.
pub(in crate::learn) fn too_smooth(likelihood: &Likelihood<'_>, model: &[f64]) -> Option<f64> {
    scatter(likelihood, model).filter(|found| *found < SMOOTH)
}

/// Scatter along traces over stated σ; None if there is too little to tell.
pub(in crate::learn) fn scatter(likelihood: &Likelihood<'_>, model: &[f64]) -> Option<f64> {
    let residual = likelihood.residual(model);
    let mut curves: BTreeMap<_, Vec<[f64; 3]>> = BTreeMap::new();
    for (i, x) in residual.iter().enumerate() {
        let o = likelihood.observation(i);
        if let Some(position) = o.position {
            let curve = (o.test, o.member, o.quantity, o.cycles.to_bits(), o.trace);
            let points = curves.entry(curve).or_default();
            points.push([position, *x, o.sigma]);
        }
    }
    over_stated(curves.into_values().collect())
}

/// Of curves of (position, residual, stated σ).
fn over_stated(curves: Vec<Vec<[f64; 3]>>) -> Option<f64> {
    let mut squares = Vec::new();
    for mut curve in curves {
        curve.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for three in curve.windows(3) {
            let [a, b, c] = [three[0], three[1], three[2]];
            let (before, after) = (b[0] - a[0], c[0] - b[0]);
            if before <= 0.0 || after <= 0.0 {
                continue;
            }
            let weights = [
                -before.recip(),
                before.recip() + after.recip(),
                -after.recip(),
            ];
            let points = [a, b, c];
            let sum = |of: &dyn Fn(usize) -> f64| (0..3).map(of).sum::<f64>();
            let difference = sum(&|i| weights[i] * points[i][1]);
            squares.push(difference.powi(2) / sum(&|i| (weights[i] * points[i][2]).powi(2)));
        }
    }
    if squares.len() < LEAST {
        return None;
    }
    squares.sort_by(f64::total_cmp);
    Some((squares[squares.len() / 2] / MEDIAN).sqrt())
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    use super::over_stated;

    /// Eight traces, unevenly spaced, with a smooth misfit of 30 stated sigmas and normal noise of `level` of them.
    fn curves(level: f64) -> Vec<Vec<[f64; 3]>> {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut uniform = || 1.0 - (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let mut point = |i: u8| {
            let s = (f64::from(i) + 0.3 * f64::from(i % 2)) / 50.0;
            [s, 0.1 * (30.0 * (4.0 * s).sin() + level * normal()), 0.1]
        };
        (0..8).map(|_| (0..50).map(&mut point).collect()).collect()
    }

    #[test]
    fn noise_counts_and_a_smooth_misfit_does_not() {
        // 384 differences: a standard error of some 5 %
        for level in [0.3, 1.0, 2.0] {
            let found = over_stated(curves(level)).unwrap();
            assert!((found / level - 1.0).abs() < 0.15, "{found} of {level}");
        }
    }

    #[test]
    fn few_points_say_nothing() {
        let few = curves(3.0).into_iter().take(2).collect();
        assert_eq!(over_stated(few), None);
    }
}
