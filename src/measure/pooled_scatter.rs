//! The scatter of curves of one quantity, pooled: what twenty points tell of their own noise is uncertain by a third, what all curves
//! together tell is not.
//!
//! A gauge's noise over the curves is σ = a + b L, L the curve's largest value (a least reading and a share of it). Each curve's own
//! scatter is then drawn towards that law by as much as it is uncertain itself (empirical Bayes on ln σ; between-curve variance by
//! DerSimonian & Laird, Controlled Clinical Trials 7, 1986):
//!
//! ```text
//! ln σ = (ln s/v + ln(a + b L)/τ²)/(1/v + 1/τ²),   v: variance of ln s
//! τ² = max(0, (Σ w r² − (N − p))/(Σ w − Σ w²/Σ w)),   w = 1/v, r = ln s − ln(a + b L), p = 2 terms
//! ```
//! Where curves differ by more than chance τ² is large and each keeps its own. Of few curves the law has one term, the better of the two.

/// Fewest curves that a law of two terms is laid through.
const FEWEST: usize = 4;
/// Steps over the law's shapes, from all noise in the floor to all of it in the share.
const SHAPES: usize = 40;

/// How a curve scatters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CurveScatter {
    /// Of its points about what their neighbours lead one to expect, in the quantity's unit.
    pub(super) scatter: f64,
    /// Its largest absolute value, in the same unit.
    pub(super) largest: f64,
    /// Number of its points.
    pub(super) points: usize,
    /// Variance of the logarithm of `scatter`.
    pub(super) variance: f64,
}

/// The common law of curves, and how far they are from it by more than chance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ScatterLaw {
    floor: f64,
    share: f64,
    /// Least of the curves' largest values: below it the law is not known.
    least: f64,
    /// Variance of ln σ between curves.
    between: f64,
}

impl ScatterLaw {
    /// Through `curves`; None where there is none.
    pub(super) fn through(curves: &[CurveScatter]) -> Option<Self> {
        let unit = curves.iter().fold(0.0, |most: f64, c| most.max(c.largest));
        if curves.is_empty() {
            return None;
        }
        let (steps, terms) = if curves.len() < FEWEST {
            (1, 1)
        } else {
            (SHAPES, 2)
        };
        let shapes = (0..=steps).map(|i| {
            let part = i as f64 / steps as f64;
            // of the largest curve's σ; closer where the share is most, since there the small curves' σ changes fast
            let share = 1.0 - (1.0 - part).powi(2);
            (1.0 - share, share / unit)
        });
        let weights: Vec<f64> = curves.iter().map(|c| c.variance.recip()).collect();
        let total: f64 = weights.iter().sum();
        let (misfit, floor, share) = shapes
            .map(|(floor, share)| {
                let apart = |c: &CurveScatter| (c.scatter / (floor + share * c.largest)).ln();
                let apart: Vec<f64> = curves.iter().map(apart).collect();
                let mean = apart.iter().zip(&weights).map(|(r, w)| r * w).sum::<f64>() / total;
                let squares = apart
                    .iter()
                    .zip(&weights)
                    .map(|(r, w)| w * (r - mean).powi(2));
                (squares.sum::<f64>(), floor * mean.exp(), share * mean.exp())
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        let squared = weights.iter().map(|w| w * w).sum::<f64>();
        let freedom = curves.len() as f64 - terms as f64;
        Some(Self {
            floor,
            share,
            least: curves
                .iter()
                .fold(f64::INFINITY, |least, c| least.min(c.largest)),
            // of one curve neither is more than nothing
            between: ((misfit - freedom) / (total - squared / total)).max(0.0),
        })
    }

    /// σ of a curve of that largest value by the law alone; of less than the least of the curves the same as of that.
    pub(super) fn at(&self, largest: f64) -> f64 {
        self.floor + self.share * largest.max(self.least)
    }

    /// σ of a curve: its own scatter drawn towards the law.
    pub(super) fn of(&self, curve: &CurveScatter) -> f64 {
        let weight = self.between / (self.between + curve.variance);
        (weight * curve.scatter.ln() + (1.0 - weight) * self.at(curve.largest).ln()).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Scatters of `count` curves of `points` points that follow 0.05 + 0.02 L, with the error that so many points leave (a van der Corput
    /// sequence through the normal quantile, so that it has no chance in it), times `factor` for every second one.
    fn curves(count: usize, points: usize, factor: f64) -> Vec<CurveScatter> {
        let quantile = |p: f64| {
            // Tukey's lambda form of the normal quantile, within 0.01 for 0.01 < p < 0.99
            4.91 * (p.powf(0.14) - (1.0 - p).powf(0.14))
        };
        let corput = |mut i: usize| {
            let (mut value, mut step) = (0.0, 0.5);
            while i > 0 {
                value += step * (i % 2) as f64;
                (i, step) = (i / 2, step / 2.0);
            }
            value
        };
        (0..count)
            .map(|i| {
                let largest = 1.0 + i as f64;
                let variance = 2.0 / points as f64;
                let error = variance.sqrt() * quantile(corput(i + 1));
                let own = if i % 2 == 0 { 1.0 } else { factor };
                CurveScatter {
                    scatter: own * (0.05 + 0.02 * largest) * error.exp(),
                    largest,
                    points,
                    variance,
                }
            })
            .collect()
    }

    #[test]
    fn chance_between_curves_is_taken_out() {
        let curves = curves(31, 22, 1.0);
        let law = ScatterLaw::through(&curves).unwrap();
        let worst = |sigma: &dyn Fn(&CurveScatter) -> f64| {
            let off = |c: &CurveScatter| (sigma(c) / (0.05 + 0.02 * c.largest)).ln().abs();
            curves.iter().map(off).fold(0.0, f64::max)
        };
        assert!(worst(&|c| c.scatter) > 0.4, "{}", worst(&|c| c.scatter));
        assert!(worst(&|c| law.of(c)) < 0.15, "{}", worst(&|c| law.of(c)));
        assert!((law.at(1.0) - 0.07).abs() < 0.03, "{law:?}");
        assert!((law.at(30.0) - 0.65).abs() < 0.08, "{law:?}");
    }

    #[test]
    fn curves_that_differ_by_more_than_chance_keep_their_own() {
        let curves = curves(31, 40, 4.0);
        let law = ScatterLaw::through(&curves).unwrap();
        for curve in &curves {
            assert!(
                (law.of(curve) / curve.scatter).ln().abs() < 0.15,
                "{curve:?} {law:?}"
            );
        }
    }

    #[test]
    fn of_few_curves_one_term_is_enough() {
        let proportional = [(1.0, 0.03), (10.0, 0.3), (3.0, 0.09)];
        let alike = [(1.0, 0.1), (10.0, 0.1), (3.0, 0.1)];
        for (curves, at_largest, at_small) in [(proportional, 0.3, 0.03), (alike, 0.1, 0.1)] {
            let curves = curves.map(|(largest, scatter)| CurveScatter {
                scatter,
                largest,
                points: 20,
                variance: 0.1,
            });
            let law = ScatterLaw::through(&curves).unwrap();
            assert!((law.at(10.0) / at_largest - 1.0).abs() < 1e-9);
            assert!((law.of(&curves[0]) / at_small - 1.0).abs() < 1e-9);
        }
        assert!(ScatterLaw::through(&[]).is_none());
    }
}
