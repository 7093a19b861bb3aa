//! The unit of a column of standard deviations, or of expanded uncertainties.

use super::columns::Column;
use super::wanted::Wanted;
use super::{ImportError, units};
use crate::measure::Quantity;

/// Least and largest coverage factor that is believed.
const COVERAGE: [f64; 2] = [1.0, 5.0];

/// From the column's unit to the quantity's own beside values in a unit that is stated, and from an expanded uncertainty to one standard deviation. Beside values in another unit
/// the column has to state its own.
pub(super) fn factor(
    sigma: &Column,
    of_values: Option<&str>,
    (head, quantity): (usize, Quantity),
    wanted: &Wanted<'_>,
) -> Result<f64, ImportError> {
    let refuse = |why: String| Err(ImportError(format!("{}: {why}", sigma.cell(head))));
    let coverage = sigma.coverage.unwrap_or(1.0);
    let [least, largest] = COVERAGE;
    if !(least..=largest).contains(&coverage) {
        return refuse(format!(
            "k = {coverage} is no coverage factor, which is {least} to {largest}; write `U (k=2)` above two standard deviations"
        ));
    }
    let unit = sigma.unit.as_deref();
    let to_own = match (unit, of_values, wanted.unit) {
        (Some("%"), _, _) if quantity != Quantity::LoadShare => refuse(format!(
            "a share of each value is no sigma; write it in {}, or leave the column out and say --sigma and --relative-sigma 0.03",
            quantity.shown_unit()
        )),
        (Some(unit), _, _) => match units::factor(unit, quantity) {
            Ok(factor) => Ok(factor),
            Err(error) => refuse(error.to_string()),
        },
        (None, Some(of_values), _) if units::factor(of_values, quantity) != Ok(1.0) => refuse(
            format!("write its unit in the header too: the values are in {of_values}"),
        ),
        (None, None, Some(stated)) => units::factor(stated, quantity),
        (None, _, _) => Ok(1.0),
    }?;
    Ok(to_own / coverage)
}
