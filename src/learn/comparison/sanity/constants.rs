//! Zeros of an instrument that change from curve to curve.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::rounded;
use crate::measure::Quantity;

/// Misfit beyond the noise, in its standard deviations, and share of it that constants must explain to be told.
const REAL: f64 = 10.0;
const CONSTANTS: f64 = 0.85;
/// How much of what constants leave a factor on each curve may leave at least: a law of wear changes a curve in proportion.
const BETTER_THAN_FACTORS: f64 = 0.5;

/// Curves without a named trace that a constant each would bring to the model.
pub(super) fn constants(rows: &[FittedRow<'_>]) -> Option<String> {
    let mut curves: BTreeMap<_, Vec<(f64, f64, f64)>> = BTreeMap::new();
    for (o, row) in rows {
        if o.trace.is_none() && o.quantity == Quantity::WearDepth {
            let key = (o.test, o.member, o.cycles.to_bits());
            let entry = (row.model / o.sigma, row.standardised, o.sigma);
            curves.entry(key).or_default().push(entry);
        }
    }
    let curves: Vec<_> = curves
        .into_values()
        .filter(|curve| curve.len() > 3)
        .collect();
    let count: usize = curves.iter().map(Vec::len).sum();
    let (mut all, mut by_constants, mut by_factors) = (0.0, 0.0, 0.0);
    let mut largest = 0.0f64;
    for curve in &curves {
        let sum = |f: &dyn Fn(&(f64, f64, f64)) -> f64| curve.iter().map(f).sum::<f64>();
        let (ones, of_model) = (sum(&|r| r.2.powi(-2)), sum(&|r| r.0 * r.0));
        let shift = sum(&|r| r.1 / r.2);
        all += sum(&|r| r.1 * r.1);
        by_constants += shift * shift / ones;
        by_factors += sum(&|r| r.1 * r.0).powi(2) / of_model.max(f64::MIN_POSITIVE);
        largest = largest.max((shift / ones).abs());
    }
    let excess = all - count as f64;
    let left = |explained: f64| (excess - explained).max(0.0);
    (curves.len() > 2
        && excess > REAL * (2.0 * count as f64).sqrt()
        && by_constants > CONSTANTS * excess
        && left(by_constants) < BETTER_THAN_FACTORS * left(by_factors))
    .then(|| {
        format!(
            "a constant of its own brings each depth curve to the model (up to {} µm): if the instrument's zero changes between traces, name each \
             curve in the column trace, and a datum is fitted to each",
            rounded(largest)
        )
    })
}
