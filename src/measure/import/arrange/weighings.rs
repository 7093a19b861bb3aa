//! A mass before and a mass after: their difference is what was lost.

use super::has;
use crate::measure::import::columns::{Column, What};
use crate::measure::import::numbers::{number, pointed, with_points};
use crate::measure::import::{Decimal, ImportError, Sheet, cell_name};
use crate::measure::names::Weighed;

/// Decimals that are written at least: with three `1.234` could be a thousand.
const DECIMALS: usize = 4;

/// Whether weighings are the values of a table: nothing else is.
pub(super) fn could_be(columns: &[Column]) -> bool {
    let weighings = columns
        .iter()
        .filter(|c| matches!(c.what, What::Weighing(_)));
    let count = weighings.count();
    // one alone may be a word of a title
    let is_header = count > 1 || count == 1 && has(columns, "member");
    is_header && !has(columns, "value")
}

/// Puts the loss in the place of the mass after.
pub(super) fn as_losses(
    sheet: &mut Sheet,
    head: usize,
    decimal: Option<Decimal>,
    said: &mut Vec<String>,
) -> Result<(), ImportError> {
    let header = sheet.rows[head].clone();
    let columns = crate::measure::import::columns::columns(&header);
    let of = |when: Weighed| {
        let mut found = columns.iter().filter(|c| c.what == What::Weighing(when));
        let first = found.next();
        first.filter(|_| found.next().is_none())
    };
    let (before, after) = match (of(Weighed::Before), of(Weighed::After)) {
        (Some(before), Some(after)) => (before, after),
        (one, other) => {
            let at = one.or(other).map_or(0, |column| column.at);
            return Err(ImportError(format!(
                "{}: `{}` is a mass and no loss: name the columns of the two weighings `mass before` and `mass after`, or write what was lost as \
                 `mass loss [mg]`",
                cell_name(head, at),
                header[at]
            )));
        }
    };
    if before.unit != after.unit {
        return Err(ImportError(format!(
            "{} and {} are in two units",
            before.cell(head),
            after.cell(head)
        )));
    }
    let (before_at, after_at) = (before.at, after.at);
    let read = with_points(sheet, decimal, |row, column| {
        row > head && (column == before_at || column == after_at)
    })?;
    for row in head + 1..sheet.rows.len() {
        let text = |sheet: &Sheet, at: usize| sheet.rows[row].get(at).cloned().unwrap_or_default();
        let written = [before_at, after_at].map(|at| text(sheet, at));
        if written.iter().any(String::is_empty) {
            if let Some(cell) = sheet.rows[row].get_mut(after_at) {
                cell.clear();
            }
            continue;
        }
        let [whole, left] = [before_at, after_at].map(|at| pointed(&text(&read, at)));
        let digits = |text: &str| text.split_once('.').map_or(0, |(_, digits)| digits.len());
        let digits = digits(&whole).max(digits(&left)).max(DECIMALS);
        let lost = number(&whole, row, before_at)? - number(&left, row, after_at)?;
        let lost = format!("{lost:.digits$}");
        // with the mark of the others, by which all numbers of the table are read
        let has_commas = match decimal {
            Some(decimal) => decimal == Decimal::Comma,
            None => written.iter().any(|text| text.contains(',')),
        };
        sheet.rows[row][after_at] = if has_commas {
            lost.replace('.', ",")
        } else {
            lost
        };
    }
    said.push(format!(
        "mass loss: `{}` less `{}`",
        header[before_at], header[after_at]
    ));
    let unit = (after.unit.as_ref()).map_or_else(String::new, |unit| format!(" [{unit}]"));
    sheet.rows[head][after_at] = format!("mass loss{unit}");
    for row in sheet.rows.iter_mut().skip(head) {
        if let Some(cell) = row.get_mut(before_at) {
            cell.clear();
        }
    }
    Ok(())
}
