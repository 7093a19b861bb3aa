//! Deviations from the new profile before and after: their difference is what was worn.

use super::has;
use super::pairs::Pair;
use crate::measure::import::columns::{Column, What};
use crate::measure::import::{ImportError, Sheet, Wanted};

/// Puts the depth in the place of the deviation after, where deviations are the values of a table; whether they are.
pub(super) fn as_depths(
    sheet: &mut Sheet,
    head: usize,
    columns: &[Column],
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) -> Result<bool, ImportError> {
    if has(columns, "value") {
        return Ok(false);
    }
    let Some(pair) = Pair::of(columns, What::Profile) else {
        return Ok(false);
    };
    pair.in_one_unit(head)?;
    let readings = pair.readings(sheet, head, wanted)?;
    let lost = readings.into_iter().map(|reading| {
        let depth = reading.before - reading.after;
        (reading, depth)
    });
    let lost: Vec<_> = lost.collect();
    said.push(format!(
        "wear depth: `{}` less `{}`, for a deviation is positive where there is more material",
        pair.before.written, pair.after.written
    ));
    pair.put_losses(sheet, head, "wear depth", &lost, wanted);
    Ok(true)
}
