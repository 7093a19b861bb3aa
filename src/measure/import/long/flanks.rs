//! The flank of a table's values: a model wears the loaded one, so two in one table are not one curve.

use std::collections::HashMap;

use crate::measure::import::arrange::flank_above;
use crate::measure::import::columns::{Column, What};
use crate::measure::import::entry::Entry;
use crate::measure::import::{ImportError, Sheet, cell_name};
use crate::measure::{Subject, names};

/// The one flank that a column or a row above the header says; none if nothing says one.
///
/// # Errors
/// [`ImportError`] where both flanks of one member of a test stand in the table.
pub(super) fn only(
    sheet: &Sheet,
    head: usize,
    columns: &[Column],
    entries: &[Entry],
) -> Result<Option<String>, ImportError> {
    let above = flank_above(sheet, head)?;
    let Some(column) = columns.iter().find(|column| column.what == What::Flank) else {
        return Ok(above);
    };
    let mut said: HashMap<(&str, Subject), (usize, &str)> = HashMap::new();
    for entry in entries {
        let row = entry.cell.0;
        let flank = sheet.rows[row].get(column.at).map_or("", String::as_str);
        if flank.is_empty() {
            continue;
        }
        let (first, other) = *said
            .entry((&entry.test, entry.member))
            .or_insert((row, flank));
        if names::folded(other) != names::folded(flank) {
            return Err(ImportError(format!(
                "{}: `{}` says `{flank}`, {} says `{other}`, both of the {} in test {}: {LOADED}",
                cell_name(row, column.at),
                column.written,
                cell_name(first, column.at),
                entry.member.name(),
                entry.test
            )));
        }
    }
    let mut flanks: Vec<&str> = said.values().map(|(_, flank)| *flank).collect();
    flanks.sort_unstable();
    flanks.dedup();
    // of several members each has its own
    Ok(match flanks[..] {
        [one] => Some(one.to_owned()),
        _ => above,
    })
}

/// What is to be done about two flanks.
pub(super) const LOADED: &str =
    "wear is that of the loaded flank, so keep the rows of that one and take the others out";
