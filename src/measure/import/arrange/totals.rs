//! Rows of a long table that sum others up: `Summe` or `Mean` in the place of a test, a member or a count.

use super::super::columns::columns;
use super::super::{Sheet, Wanted};
use crate::measure::names;

/// Columns in which such a row says so.
const SAID_IN: [&str; 3] = ["test", "member", "cycles"];

/// Empties these rows below a header, and says which.
pub(super) fn leave_out(sheet: &mut Sheet, head: usize, wanted: &Wanted<'_>) -> Vec<String> {
    let header = columns(&sheet.rows[head]);
    let own = header.iter().filter(|column| {
        let own = column.what.own();
        own.is_some_and(|own| SAID_IN.contains(&own))
    });
    let own: Vec<usize> = own.map(|column| column.at).collect();
    let mut said = Vec::new();
    for (row, cells) in sheet.rows.iter_mut().enumerate().skip(head + 1) {
        let mut texts = own.iter().filter_map(|&at| cells.get(at));
        let Some(total) = texts.find(|text| is_total(text, wanted)) else {
            continue;
        };
        said.push(format!(
            "row {} sums others up (`{total}`): passed over",
            row + 1
        ));
        cells.iter_mut().for_each(String::clear);
    }
    said
}

/// Whether a cell has a word for a sum, a mean or an extreme, and none for anything but what it is of: `Mean`, `Summe V1`.
fn is_total(cell: &str, wanted: &Wanted<'_>) -> bool {
    let says_of_what = |word: &str| {
        names::member(word).is_some() || names::is_filler(word) || wanted.test_of(word).is_some()
    };
    let mut words = cell.split_whitespace();
    wanted.test_of(cell).is_none()
        && words.clone().any(names::is_total)
        && words.all(|word| names::is_total(word) || says_of_what(word))
}
