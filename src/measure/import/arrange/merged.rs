//! Merged cells of a long table: the test or the member stands in the first row of a block alone, and the rows below it are of the same.

use super::super::columns::{Column, columns, known_by_content};
use super::super::{Sheet, Wanted};

/// Fills the empty cells of the columns of tests and members below a header with what stands above them, and says of which columns.
pub(super) fn fill(sheet: &mut Sheet, head: usize, wanted: &Wanted<'_>) -> Vec<String> {
    let mut header = columns(&sheet.rows[head]);
    known_by_content(&mut header, sheet, head, wanted);
    let place = |name: &str| header.iter().find(|column| column.what.own() == Some(name));
    let mut said = Vec::new();
    // a block of one member lies within one test, so the tests come first
    for (name, within) in [("test", None), ("member", place("test"))] {
        let Some(column) = place(name) else {
            continue;
        };
        let within = within.map(|column| column.at);
        let Some(filled) = with_values_above(sheet, head, column.at, within) else {
            continue;
        };
        for (row, value) in filled {
            put(sheet, row, column.at, value);
        }
        said.push(said_of(column));
    }
    said
}

/// The same of the tests of a table in which each row will become several, of which all state their test.
pub(in crate::measure::import) fn with_tests_filled(sheet: &Sheet, head: usize) -> Sheet {
    let mut filled = sheet.clone();
    for column in columns(&sheet.rows[head]) {
        let of_tests = Some(column.at).filter(|_| column.what.own() == Some("test"));
        let Some(values) = of_tests.and_then(|at| with_values_above(sheet, head, at, None)) else {
            continue;
        };
        for (row, value) in values {
            put(&mut filled, row, column.at, value);
        }
        filled.said.push(said_of(&column));
    }
    filled
}

/// That a column's cells were filled, in words.
fn said_of(column: &Column) -> String {
    format!(
        "`{}`: empty cells hold the value above them",
        column.written
    )
}

fn put(sheet: &mut Sheet, row: usize, at: usize, value: String) {
    let cells = &mut sheet.rows[row];
    if cells.len() <= at {
        cells.resize(at + 1, String::new());
    }
    cells[at] = value;
}

/// The rows with an empty cell in a column, each with the value above it. None where there are none, and where the cells do not look merged: nothing
/// stands above one in its own block of rows and test (the column `within`), or two rows on end state the same, so that each row states its own.
fn with_values_above(
    sheet: &Sheet,
    head: usize,
    at: usize,
    within: Option<usize>,
) -> Option<Vec<(usize, String)>> {
    let mut filled = Vec::new();
    // value, test, and whether the row above states the value itself
    let mut above: Option<(&str, &str, bool)> = None;
    for (row, cells) in sheet.rows.iter().enumerate().skip(head + 1) {
        if cells.iter().all(String::is_empty) {
            above = None;
            continue;
        }
        let cell = |at: usize| cells.get(at).map_or("", String::as_str);
        let (own, test) = (cell(at), within.map_or("", cell));
        let same = above.filter(|(_, before, _)| *before == test);
        match (own, same) {
            ("", None) => return None,
            ("", Some((value, _, _))) => {
                filled.push((row, value.to_owned()));
                above = Some((value, test, false));
            }
            (own, Some((value, _, true))) if own == value => return None,
            (own, _) => above = Some((own, test, true)),
        }
    }
    (!filled.is_empty()).then_some(filled)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_filled_where_they_look_merged() {
        let filled = |rows: &[[&str; 2]], within: bool| {
            let rows = rows.iter().map(|row| {
                let cells = row.iter().chain(&["1"]);
                match row {
                    ["-", _] => Vec::new(),
                    _ => cells.map(|&cell| cell.to_owned()).collect(),
                }
            });
            let sheet = Sheet {
                name: String::new(),
                rows: std::iter::once(Vec::new()).chain(rows).collect(),
                without_result: None,
                plain_decimals: true,
                said: Vec::new(),
            };
            let filled = with_values_above(&sheet, 0, usize::from(within), within.then_some(0));
            filled.map(|filled| filled.iter().map(|(row, _)| *row).collect::<Vec<_>>())
        };
        let tests = |cells: &[&'static str]| {
            let rows: Vec<[&str; 2]> = cells.iter().map(|cell| [*cell, ""]).collect();
            filled(&rows, false)
        };
        assert_eq!(tests(&["A", "", "", "B", ""]), Some(vec![2, 3, 5]));
        assert_eq!(tests(&["A", "A", "B"]), None);
        // the first row, a gap, a cell forgotten among those that state it each
        assert_eq!(tests(&["", "A", "B"]), None);
        assert_eq!(tests(&["A", "", "-", ""]), None);
        assert_eq!(tests(&["A", "A", "", "B"]), None);
        // members within tests
        let members = [
            ["A", "pinion"],
            ["A", ""],
            ["A", "gear"],
            ["B", "gear"],
            ["B", ""],
        ];
        assert_eq!(filled(&members, true), Some(vec![2, 5]));
        assert_eq!(filled(&[["A", "pinion"], ["B", ""]], true), None);
    }
}
