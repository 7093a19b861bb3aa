//! Decimal commas in a table that has commas between its columns.

use super::{ImportError, Sheet};

/// Refuses a text with commas between its columns if the rows below its header are longer than it by cells of digits: the commas there are
/// decimal ones, and no reading tells the two kinds apart.
pub(super) fn refuse(sheet: &Sheet, head: usize) -> Result<(), ImportError> {
    let is_text_with_commas = sheet.name.is_empty() && sheet.plain_decimals;
    if !is_text_with_commas {
        return Ok(());
    }
    let width = sheet.rows[head].len();
    let is_digits = |cell: &String| !cell.is_empty() && cell.bytes().all(|b| b.is_ascii_digit());
    let is_longer = |row: &Vec<String>| row.iter().skip(width).any(is_digits);
    let below = || {
        let rows = sheet.rows.iter().enumerate().skip(head + 1);
        rows.filter(|(_, row)| row.iter().any(|cell| !cell.is_empty()))
    };
    let longer = below().filter(|(_, row)| is_longer(row)).count();
    match below().find(|(_, row)| is_longer(row)) {
        Some((at, row)) if 2 * longer > below().count() => Err(ImportError(format!(
            "row {} has {} cells, the header in row {} has {width}: decimal commas (`1,5`) cannot be told from the commas between the columns; \
             export the table with semicolons between its columns, or with decimal points",
            at + 1,
            row.len(),
            head + 1
        ))),
        _ => Ok(()),
    }
}
