//! One row and one cell of it: their values, and the messages about them.

use std::ops::Range;

use csv::StringRecord;

use super::dialect::Dialect;
use super::table::field_spans;
use crate::source_text::{Diagnostic, Fault, list, nearest};

/// Longest piece of a cell that a message repeats, characters.
const SHOWN: usize = 40;

/// One record with its place.
pub(super) struct Row<'r> {
    pub(super) text: &'r str,
    /// How the text is written.
    pub(super) dialect: Dialect,
    pub(super) record: &'r StringRecord,
    /// Its bytes in the text.
    pub(super) span: Range<usize>,
    /// Its line, counted from 1.
    pub(super) line: usize,
}

impl<'r> Row<'r> {
    /// Whether nothing stands in any field: a line of separators alone, as spreadsheets write below a table.
    pub(super) fn is_blank(&self) -> bool {
        self.record.iter().all(str::is_empty)
    }

    /// Number of fields.
    pub(super) fn len(&self) -> usize {
        self.record.len()
    }

    /// The field in `column` under the header `key`; an empty one if the row has no such column.
    pub(super) fn cell(&self, key: &'static str, column: Option<usize>) -> Cell<'_, 'r> {
        Cell {
            row: self,
            key,
            column,
        }
    }

    /// Where the field of a column stands; the row's end if there is none.
    pub(super) fn span_of(&self, column: usize) -> Range<usize> {
        let spans = field_spans(self.text, self.span.clone(), self.dialect.separator);
        match spans.get(column) {
            Some(span) => span.clone(),
            None => self.span.end..self.span.end,
        }
    }

    /// A fault of the row as a whole.
    pub(super) fn fault(&self, fault: Fault, message: impl Into<String>) -> Diagnostic {
        let lines = &self.text[self.span.clone()];
        let first = lines.lines().next().unwrap_or_default().len();
        Diagnostic::new(fault, "", message).with_span(self.span.start..self.span.start + first)
    }
}

/// One field of a row.
#[derive(Clone, Copy)]
pub(super) struct Cell<'c, 'r> {
    row: &'c Row<'r>,
    key: &'static str,
    column: Option<usize>,
}

impl<'c> Cell<'c, '_> {
    /// Its text without blanks around it.
    pub(super) fn text(self) -> &'c str {
        let column = self.column.unwrap_or(usize::MAX);
        self.row.record.get(column).unwrap_or_default()
    }

    /// True if nothing stands in it.
    pub(super) fn is_empty(self) -> bool {
        self.text().is_empty()
    }

    /// A finite number.
    pub(super) fn number(self, allowed: &str) -> Result<f64, Box<Diagnostic>> {
        let key = self.key;
        if self.is_empty() {
            return Err(self
                .fault(Fault::MissingKey, format!("{key} is missing"), allowed)
                .into());
        }
        match self.row.dialect.plain(self.key, self.text()).parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(self
                .fault(
                    Fault::BadValue,
                    format!("{key} is not a finite number"),
                    allowed,
                )
                .into()),
            Err(_) => {
                let hint = if self.text().contains(',') {
                    "decimals are written with a point"
                } else {
                    ""
                };
                let message = format!("{key} is not a number");
                let fault = self.fault(Fault::WrongType, message, allowed);
                Err(fault.with_hint(hint).into())
            }
        }
    }

    /// The one of `choices` that is named here.
    pub(super) fn choice<T: Copy>(
        self,
        what: &str,
        choices: &[T],
        name: impl Fn(T) -> &'static str,
    ) -> Result<T, Box<Diagnostic>> {
        let same = |c: &&T| name(**c).eq_ignore_ascii_case(self.text());
        if let Some(found) = choices.iter().find(same) {
            return Ok(*found);
        }
        let names: Vec<&str> = choices.iter().map(|c| name(*c)).collect();
        let message = format!("there is no {what} {}", shown(self.text()));
        let message = if self.is_empty() {
            format!("{} is missing", self.key)
        } else {
            message
        };
        let fault = self.fault(Fault::BadValue, message, &list(names.iter().copied()));
        Err(fault.with_hint(self.nearest_of(names)).into())
    }

    /// The hint that names the candidate nearest to what stands here, if anything does.
    pub(super) fn nearest_of<'a>(self, candidates: impl IntoIterator<Item = &'a str>) -> String {
        match nearest(self.text(), candidates) {
            Some(near) if !self.is_empty() => format!("the nearest is `{near}`"),
            _ => String::new(),
        }
    }

    /// A fault of this cell.
    pub(super) fn fault(
        self,
        fault: Fault,
        message: impl Into<String>,
        allowed: &str,
    ) -> Diagnostic {
        let end = self.row.span.end..self.row.span.end;
        let span = self.column.map_or(end, |column| self.row.span_of(column));
        Diagnostic::new(fault, self.key, message)
            .with_values(shown(self.text()), allowed)
            .with_span(span)
    }
}

/// A cell's text as messages repeat it.
pub(super) fn shown(text: &str) -> String {
    if text.is_empty() {
        return "nothing".to_owned();
    }
    let visible: String = text.chars().take(SHOWN).collect();
    let rest = if text.chars().nth(SHOWN).is_some() {
        "..."
    } else {
        ""
    };
    format!("`{}{rest}`", visible.escape_debug())
}
