//! How decimals are written in a table of tests.

use std::ops::Range;

use super::{Column, cells};
use crate::measure::{CountMarks, both_readings, without_certain};
use crate::source_text::{Diagnostic, Fault};
use crate::study::marks::{Marks, number};

/// Numbers that are counted rather than measured: three digits behind one mark are likelier thousands than decimals.
const COUNTED: [&str; 2] = ["cycles", "speed"];

/// How the numbers of a table are written.
pub(super) struct Decimals {
    /// Whether decimals are written with a comma; never where commas stand between columns.
    comma: bool,
    /// What is known of marks in each column of counts.
    counts: Vec<(String, CountMarks)>,
}

impl Decimals {
    /// What the numbers below the header tell.
    ///
    /// # Errors
    /// Where both marks stand in numbers, and where a number may have marks between thousands.
    pub(super) fn of(
        text: &str,
        lines: impl Iterator<Item = Range<usize>>,
        columns: &[Option<Column>],
        separator: u8,
    ) -> Result<Self, Box<Diagnostic>> {
        let numbers: Vec<(&Column, Range<usize>)> = lines
            .flat_map(|line| columns.iter().zip(cells(text, line, separator)))
            .filter_map(|(column, cell)| Some((column.as_ref()?, cell)))
            .filter(|(column, _)| column.is_of_numbers())
            .collect();
        let mut decimals = Self {
            comma: false,
            counts: counts(text, &numbers),
        };
        let mut marks = Marks::default();
        for (column, cell) in numbers {
            let number = number(&text[cell.clone()]);
            if decimals.without_thousands(column, number).is_some() {
                continue;
            }
            // where commas stand between columns a point is a decimal one, but nobody writes 18 revolutions as `18.000`
            let may_be_decimal = separator == b',' && !number.ends_with('0');
            if decimals.is_unclear(column, number) && !may_be_decimal {
                return Err(marked(column, text, cell, &both_readings(number)));
            }
            if has_thousands(number.trim_start_matches(['+', '-'])) {
                return Err(marked(column, text, cell, "has thousands marks"));
            }
            marks.see(text, &cell);
        }
        decimals.comma = marks.decimal_comma(text)?;
        Ok(decimals)
    }

    /// A cell with a point for its decimals, and without marks that are known to stand between thousands.
    pub(super) fn plain(&self, column: &Column, cell: &str) -> String {
        let number = number(cell);
        if let Some(plain) = self.without_thousands(column, number) {
            return plain + &cell[number.len()..];
        }
        if self.comma && cell.matches(',').count() == 1 {
            cell.replace(',', ".")
        } else {
            cell.to_owned()
        }
    }

    fn marks_of(&self, column: &Column) -> Option<CountMarks> {
        let own = self.counts.iter().find(|(key, _)| *key == column.key);
        own.map(|(_, marks)| *marks)
    }

    fn without_thousands(&self, column: &Column, number: &str) -> Option<String> {
        match self.marks_of(column) {
            Some(marks) => marks.plain(number),
            None => without_certain(number),
        }
    }

    fn is_unclear(&self, column: &Column, number: &str) -> bool {
        self.marks_of(column)
            .is_some_and(|marks| marks.is_unclear(number))
    }
}

/// What the numbers of a table tell of the marks in each column of counts.
fn counts(text: &str, numbers: &[(&Column, Range<usize>)]) -> Vec<(String, CountMarks)> {
    let of = |key: &str| {
        let mut marks = CountMarks::default();
        for (column, cell) in numbers {
            let number = number(&text[cell.clone()]);
            if column.key == key {
                marks.see(number);
            } else if !COUNTED.contains(&column.key.as_str()) {
                marks.see_elsewhere(number);
            }
        }
        (key.to_owned(), marks)
    };
    COUNTED.map(of).into()
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
    let message = format!("{key} = {written}: {says}");
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
