//! A loss beside the two weighings that it was taken from: these are read, for the loss may be that of one interval or of all so far.

use super::pairs::{Pair, Reading};
use crate::measure::Quantity;
use crate::measure::import::columns::{Column, What};
use crate::measure::import::numbers::{number, with_points};
use crate::measure::import::{ImportError, Sheet, Wanted, cell_name, units};

/// Part of a loss by which it may differ from that of the weighings, beside their last two digits.
const ROUNDED: f64 = 0.01;

/// Empties the column of losses of a table that has both weighings too.
///
/// # Errors
/// [`ImportError`] where a loss is neither that between its weighings nor that from a weighing of the column before.
pub(super) fn pass_over(
    sheet: &mut Sheet,
    head: usize,
    columns: &[Column],
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) -> Result<(), ImportError> {
    let is_loss = |column: &&Column| column.what == What::Values(Quantity::MassLoss);
    let (Some(pair), Some(loss)) = (
        Pair::of(columns, What::Weighing),
        columns.iter().find(is_loss),
    ) else {
        return Ok(());
    };
    // without both units nothing can be held against anything
    let (Some(unit), Some(of_loss)) = (&pair.before.unit, &loss.unit) else {
        return Ok(());
    };
    let [of_masses, of_loss] = [
        units::factor(unit, Quantity::MassLoss)?,
        units::factor(of_loss, Quantity::MassLoss)?,
    ];
    let is_number = |row, column| row > head && column == loss.at;
    let read = with_points(sheet, wanted.decimal, is_number, |_, _, _| false)?;
    let readings = pair.readings(sheet, head, wanted)?;
    for reading in &readings {
        let text = read.rows[reading.row]
            .get(loss.at)
            .map_or("", String::as_str);
        if text.is_empty() {
            continue;
        }
        let stated = of_loss * number(text, reading.row, loss.at)?;
        let is_it = |from: &Reading| {
            let weighed = of_masses * (from.before - reading.after);
            let digit = of_masses * 0.1_f64.powi(reading.decimals as i32);
            (stated - weighed).abs() <= 2.0 * digit + ROUNDED * weighed.abs()
        };
        if !is_it(reading) && !readings.iter().any(is_it) {
            return Err(ImportError(format!(
                "{}: `{}` says {text}, and it is not what lies between `{}` and `{}` in its row: correct the one that is wrong, or take the column out",
                cell_name(reading.row, loss.at),
                loss.written,
                pair.before.written,
                pair.after.written
            )));
        }
    }
    said.push(format!(
        "`{}` passed over: it is what lies between `{}` and `{}`, which are read",
        loss.written, pair.before.written, pair.after.written
    ));
    for cells in sheet.rows.iter_mut().skip(head) {
        if let Some(cell) = cells.get_mut(loss.at) {
            cell.clear();
        }
    }
    Ok(())
}
