//! Columns without a name.

use super::numbers::{number_words, pointed};
use super::{ImportError, Sheet, cell_name};

/// Refuses numbers in a column without a name, from one column on: where one name was left out of the header, all others behind it stand above the
/// wrong numbers. The first column may number the rows, as some programs write it.
pub(super) fn refuse_numbers(sheet: &Sheet, head: usize, from: usize) -> Result<(), ImportError> {
    let cell = |row: usize, at: usize| sheet.rows[row].get(at).map_or("", String::as_str);
    let width = sheet.rows[head..].iter().map(Vec::len).max().unwrap_or(0);
    for at in (from..width).filter(|&at| cell(head, at).is_empty()) {
        let mut below = (head + 1..sheet.rows.len()).filter(|&row| is_number(cell(row, at)));
        if let Some(row) = below
            .next()
            .filter(|_| at > 0 || !numbers_the_rows(sheet, head))
        {
            let (number, name) = (cell(row, at), cell_name(head, at));
            return Err(ImportError(format!(
                "{}: `{number}` stands in a column without a name: is a name missing in row {}, so that others stand above the wrong column? Name the \
                 column in {name}, or take it out",
                cell_name(row, at),
                head + 1
            )));
        }
    }
    Ok(())
}

fn is_number(text: &str) -> bool {
    pointed(text).parse::<f64>().is_ok() || number_words(text) == [text]
}

/// Whether the first column holds 0, 1, 2 or 1, 2, 3.
fn numbers_the_rows(sheet: &Sheet, head: usize) -> bool {
    let rows = sheet.rows[head + 1..].iter();
    let filled = rows.filter(|cells| cells.iter().any(|cell| !cell.is_empty()));
    let counts: Option<Vec<usize>> = filled.map(|cells| cells[0].parse().ok()).collect();
    counts.is_some_and(|counts| {
        let first = counts.first().copied().unwrap_or(0);
        first < 2
            && counts
                .iter()
                .enumerate()
                .all(|(n, count)| *count == first + n)
    })
}
