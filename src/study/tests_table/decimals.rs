//! How decimals are written in a table of tests.

use std::ops::Range;

use super::{Column, cells};
use crate::measure::in_thousands;
use crate::source_text::{Diagnostic, Fault};
use crate::study::marks::{Marks, number};

/// Numbers that are counted rather than measured: three digits behind one mark are likelier thousands than decimals.
const COUNTED: [&str; 2] = ["cycles", "speed"];

/// Whether decimals are written with a comma; never where commas stand between columns.
///
/// # Errors
/// Where both marks stand in numbers, and where a number has or may have marks between thousands.
pub(super) fn decimal_comma(
    text: &str,
    lines: impl Iterator<Item = Range<usize>>,
    columns: &[Option<Column>],
    separator: u8,
) -> Result<bool, Box<Diagnostic>> {
    let mut marks = Marks::default();
    for line in lines {
        for (column, cell) in columns.iter().zip(cells(text, line, separator)) {
            let Some(column) = column.as_ref().filter(|column| column.is_of_numbers()) else {
                continue;
            };
            let number = number(&text[cell.clone()]);
            let written = number.trim_start_matches(['+', '-']);
            let counted = separator != b',' && COUNTED.contains(&column.key.as_str());
            if has_thousands(written) {
                return Err(marked(column, text, cell, "has thousands marks"));
            }
            if counted && in_thousands(written) {
                return Err(marked(column, text, cell, "may have a thousands mark"));
            }
            marks.see(text, &cell);
        }
    }
    marks.decimal_comma(text)
}

/// Whether a number has several marks, as only thousands do: `1.000.000`, `1.000,5`.
fn has_thousands(number: &str) -> bool {
    let digits = |group: &str| !group.is_empty() && group.bytes().all(|b| b.is_ascii_digit());
    let groups: Vec<&str> = number.split(['.', ',']).collect();
    let inner = groups.len().saturating_sub(1);
    groups.len() > 2
        && groups.iter().all(|group| digits(group))
        && groups[0].len() <= 3
        && groups[1..inner].iter().all(|group| group.len() == 3)
}

fn marked(column: &Column, text: &str, cell: Range<usize>, says: &str) -> Box<Diagnostic> {
    let written = &text[cell.clone()];
    let key = format!("test.{}", column.key);
    let message = format!("{key} = {written} {says}");
    Box::new(
        Diagnostic::new(Fault::BadValue, key, message)
            .with_values(
                format!("`{written}`"),
                "a number without marks between thousands",
            )
            .with_hint("write 250000 or 2.5e5 for a quarter of a million, 1000 for a thousand")
            .with_span(cell),
    )
}
