//! Models of which no wear comes at any row, though wear was measured: a formula that is 0, say. The other checks hold shapes and sizes against
//! the model's and find nothing where it has none.

use super::super::residual_statistics::FittedRow;
use super::rounded;
use crate::measure::Quantity;
use crate::numeric::written;
use crate::study::Study;

/// Standard deviations from which a row shows wear.
const SHOWN: f64 = 5.0;
/// Part of a row's sigma below which a computed depth or mass is none.
const NOTHING: f64 = 1e-6;

/// The line on a model without wear, where some measured row shows wear.
pub(super) fn no_wear(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let wears = |quantity| matches!(quantity, Quantity::WearDepth | Quantity::MassLoss);
    let own = rows.iter().filter(|(o, _)| wears(o.quantity));
    let own: Vec<&FittedRow<'_>> = own.filter(|(o, _)| o.cycles > 0.0).collect();
    let is_nothing = |(o, row): &&FittedRow<'_>| row.model.abs() < NOTHING * o.sigma;
    let above = |(o, _): &FittedRow<'_>| o.value / o.sigma;
    let most = own
        .iter()
        .max_by(|a, b| above(a).total_cmp(&above(b)))
        .filter(|row| above(row) > SHOWN)?;
    own.iter().all(is_nothing).then(|| {
        let (o, _) = most;
        format!(
            "no wear comes of this study at any measured row, whatever k is, though {} of test {} goes up to {} {}: does an effect or its formula make \
             the wear 0, or do all these places lie outside the contact?",
            o.quantity.name(),
            study.tests[o.test].id,
            rounded(o.value),
            written::unit(o.quantity.unit())
        )
    })
}
