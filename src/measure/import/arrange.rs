//! Long tables as people lay them out, as tables with a column for everything: what stands above the header (`Run: A`) as columns
//! below it, both members' columns side by side one member after the other, a mass before and one after as a loss. Cells keep their
//! places, so messages name them as they stand in the table.

mod labels;
mod sides;
mod weighings;

use std::collections::BTreeSet;

use super::columns::{Column, What, columns};
use super::{ImportError, Sheet, Wanted};

/// A table with a column for everything, or one for each member.
#[derive(Debug)]
pub(super) struct Arranged {
    /// Row of the header, counted from 0.
    pub(super) head: usize,
    /// The tables.
    pub(super) sheets: Vec<Sheet>,
    /// What was made of the table, in words.
    pub(super) said: Vec<String>,
}

/// The table so arranged; none if it is no long table.
///
/// # Errors
/// [`ImportError`] where a mass stands without the other one that makes it a loss.
pub(super) fn arranged(
    sheet: &Sheet,
    wanted: &Wanted<'_>,
) -> Result<Option<Arranged>, ImportError> {
    for head in 0..sheet.rows.len() {
        let mut said = Vec::new();
        let mut table = sheet.clone();
        if columns(&table.rows[head])
            .iter()
            .any(|column| column.what.own() == Some("cycles"))
        {
            weighings::as_losses(&mut table, head, wanted.decimal, &mut said)?;
        }
        let mut sheets = sides::one_by_one(&table, head, &mut said);
        let mut is_long = true;
        for table in &mut sheets {
            labels::as_columns(table, head, wanted, &mut said);
            is_long &= has_cycles_and_values(&columns(&table.rows[head]));
        }
        if is_long {
            let mut met = BTreeSet::new();
            said.retain(|words| met.insert(words.clone()));
            return Ok(Some(Arranged { head, sheets, said }));
        }
    }
    Ok(None)
}

fn has_cycles_and_values(columns: &[Column]) -> bool {
    let has = |name: &str| columns.iter().any(|column| column.what.own() == Some(name));
    has("cycles") && has("value")
}

/// Whether a header has a column of positions and one of depths or the like: a curve.
fn is_curve(columns: &[Column]) -> bool {
    let values = |column: &Column| matches!(column.what, What::Values(_) | What::Own("value"));
    columns.iter().any(values)
        && columns
            .iter()
            .any(|column| column.what.own() == Some("position"))
}

/// Puts a column behind all others, with one text in all rows below the header that hold something.
fn put_column(sheet: &mut Sheet, head: usize, name: &str, text: &str) {
    let width = sheet.rows.iter().map(Vec::len).max().unwrap_or(0);
    for (row, cells) in sheet.rows.iter_mut().enumerate().skip(head) {
        if row == head || cells.iter().any(|cell| !cell.is_empty()) {
            cells.resize(width, String::new());
            cells.push(if row == head { name } else { text }.to_owned());
        }
    }
}
