//! Second differences along curves, which show scatter and little else.
//!
//! ```text
//! d_i = (x_i − x_{i−1})/(s_i − s_{i−1}) − (x_{i+1} − x_i)/(s_{i+1} − s_i)      x: measured minus model, s: position
//! ```
//! Whatever is smooth along a trace drops out of them (Rice, Ann. Statist. 12, 1984; with positions as Gasser, Sroka & Jennen-Steinmetz,
//! Biometrika 73, 1986).

use crate::measure::Observation;
use crate::measure::neighbours::curves;

/// A difference of three neighbours' residuals from which whatever is straight drops out.
#[derive(Debug, Clone, Copy)]
pub(super) struct Difference {
    pub(super) rows: [usize; 3],
    pub(super) weights: [f64; 3],
    pub(super) value: f64,
}

impl Difference {
    /// Its standard deviation where the rows have these.
    pub(super) fn sigma(&self, sigma: &[f64]) -> f64 {
        let terms = self.rows.iter().zip(self.weights);
        terms
            .map(|(&row, weight)| (weight * sigma[row]).powi(2))
            .sum::<f64>()
            .sqrt()
    }
}

/// All along the curves of some rows.
pub(super) fn differences(rows: &[&Observation], residual: &[f64]) -> Vec<Difference> {
    let place = |row: usize| rows[row].position.unwrap_or(0.0);
    let mut found = Vec::new();
    for curve in curves(rows) {
        for three in curve.windows(3) {
            let three = [three[0], three[1], three[2]];
            let [a, b, c] = three.map(place);
            let (before, after) = (b - a, c - b);
            if before <= 0.0 || after <= 0.0 {
                continue;
            }
            let weights = [
                -before.recip(),
                before.recip() + after.recip(),
                -after.recip(),
            ];
            let terms = three.iter().zip(weights);
            found.push(Difference {
                rows: three,
                weights,
                value: terms.map(|(&row, weight)| weight * residual[row]).sum(),
            });
        }
    }
    found
}
