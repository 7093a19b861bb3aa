//! A mass before and a mass after: their difference is what was lost.

use crate::measure::import::columns::{Column, What};
use crate::measure::import::numbers::{number, pointed};
use crate::measure::import::{Decimal, ImportError, Sheet, cell_name};
use crate::measure::{Quantity, names};

/// Puts the loss in the place of the mass after.
pub(super) fn as_losses(
    sheet: &mut Sheet,
    head: usize,
    decimal: Option<Decimal>,
    said: &mut Vec<String>,
) -> Result<(), ImportError> {
    let header = sheet.rows[head].clone();
    let at = |when: names::Weighed| {
        let mut found = (0..header.len()).filter(|&at| weighed(&header[at]) == Some(when));
        let first = found.next();
        first.filter(|_| found.next().is_none())
    };
    let (before, after) = match (at(names::Weighed::Before), at(names::Weighed::After)) {
        (Some(before), Some(after)) => (before, after),
        (None, None) => return Ok(()),
        (one, other) => {
            let at = one.or(other).unwrap_or_default();
            return Err(ImportError(format!(
                "{}: `{}` is a mass and no loss: name the column of the other weighing `mass before` or `mass after`, or write what was lost as \
                 `mass loss [mg]`",
                cell_name(head, at),
                header[at]
            )));
        }
    };
    let units = [before, after].map(|at| Column::of(at, &header[at]).unit);
    if units[0] != units[1] {
        return Err(ImportError(format!(
            "{} and {}: `{}` and `{}` are in two units",
            cell_name(head, before),
            cell_name(head, after),
            header[before],
            header[after]
        )));
    }
    for row in head + 1..sheet.rows.len() {
        let cells = &sheet.rows[row];
        let texts = [before, after].map(|at| cells.get(at).cloned().unwrap_or_default());
        if texts.iter().any(String::is_empty) {
            if let Some(cell) = sheet.rows[row].get_mut(after) {
                cell.clear();
            }
            continue;
        }
        let plain = |text: &str| match decimal {
            Some(Decimal::Comma) => text.replace('.', "").replace(',', "."),
            Some(Decimal::Point) => text.replace(',', ""),
            None => pointed(text),
        };
        let [whole, left] = texts.map(|text| plain(&text));
        let digits = |text: &str| text.split_once('.').map_or(0, |(_, digits)| digits.len());
        let digits = digits(&whole).max(digits(&left)).max(1);
        let lost = number(&whole, row, before)? - number(&left, row, after)?;
        // one more digit than was read keeps `1.234` from looking like thousands
        let lost = format!("{lost:.digits$}", digits = digits + 1);
        sheet.rows[row][after] = match decimal {
            Some(Decimal::Comma) => lost.replace('.', ","),
            _ => lost,
        };
    }
    let unit = units[0]
        .as_ref()
        .map_or_else(String::new, |unit| format!(" [{unit}]"));
    said.push(format!(
        "mass loss: `{}` less `{}`",
        header[before], header[after]
    ));
    sheet.rows[head][after] = format!("mass loss{unit}");
    for row in sheet.rows.iter_mut().skip(head) {
        if let Some(cell) = row.get_mut(before) {
            cell.clear();
        }
    }
    Ok(())
}

/// Which weighing a header names.
fn weighed(header: &str) -> Option<names::Weighed> {
    let (name, _) = crate::measure::import::units::name_and_unit(header);
    let (when, rest) = names::weighed(&name)?;
    (Column::of(0, &rest).what == What::Values(Quantity::MassLoss)).then_some(when)
}
