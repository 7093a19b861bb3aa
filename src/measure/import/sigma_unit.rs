//! The unit of a column of standard deviations.

use super::columns::Column;
use super::wanted::Wanted;
use super::{ImportError, units};
use crate::measure::Quantity;

/// From the column's unit to the quantity's own. Beside values in another unit the column has to state its own.
pub(super) fn factor(
    sigma: &Column,
    value: &Column,
    (head, quantity): (usize, Quantity),
    wanted: &Wanted<'_>,
) -> Result<f64, ImportError> {
    let refuse = |why: String| Err(ImportError(format!("{}: {why}", sigma.cell(head))));
    let text = sigma.written.to_lowercase().replace(' ', "");
    let covering = text.split_once("k=").map(|(_, rest)| {
        let number: String = rest
            .chars()
            .take_while(|c| c.is_ascii_digit() || *c == '.')
            .collect();
        number.parse::<f64>()
    });
    if covering.is_some_and(|k| k != Ok(1.0)) {
        return refuse(
            "sigma is one standard deviation: divide the expanded uncertainty by its k".to_owned(),
        );
    }
    // what stands in brackets may be the k alone
    let unit = sigma
        .unit
        .as_deref()
        .filter(|unit| !unit.to_lowercase().starts_with('k'));
    match (unit, value.unit.as_deref(), wanted.unit) {
        (Some("%"), _, _) if quantity != Quantity::LoadShare => refuse(format!(
            "a share of each value is no sigma; write it in {}, or leave the column out and say --sigma and --relative-sigma 0.03",
            quantity.unit()
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
    }
}
