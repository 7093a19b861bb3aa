//! Which mark a table has in its numbers: decimal points, or the decimal commas of a spreadsheet.

use std::ops::Range;

use crate::source_text::{Diagnostic, Fault};

/// The first number with a point and the first with a comma.
#[derive(Debug, Default)]
pub(super) struct Marks([Option<Range<usize>>; 2]);

impl Marks {
    /// Learns from the number with which the cell at `place` of `text` begins.
    pub(super) fn see(&mut self, text: &str, place: &Range<usize>) {
        let number = number(&text[place.clone()]);
        for (mark, first) in ['.', ','].into_iter().zip(&mut self.0) {
            if first.is_none() && number.contains(mark) {
                *first = Some(place.clone());
            }
        }
    }

    /// Whether decimals are written with a comma.
    ///
    /// # Errors
    /// Where both marks stand in numbers.
    pub(super) fn decimal_comma(self, text: &str) -> Result<bool, Box<Diagnostic>> {
        let [Some(point), Some(comma)] = self.0 else {
            return Ok(self.0[1].is_some());
        };
        let later = if point.start > comma.start {
            point
        } else {
            comma
        };
        let says = "decimal points and decimal commas stand in one file";
        Err(Box::new(
            Diagnostic::new(Fault::Inconsistent, "", says)
                .with_values(
                    format!("`{}`", &text[later.clone()]),
                    "one of the two in all numbers",
                )
                .with_hint("marks between thousands are not read: 1000, not 1.000")
                .with_span(later),
        ))
    }
}

/// The number with which a cell begins.
pub(super) fn number(cell: &str) -> &str {
    let is_part = |c: char| c.is_ascii_digit() || "+-.,".contains(c);
    let end = cell.find(|c| !is_part(c)).unwrap_or(cell.len());
    &cell[..end]
}
