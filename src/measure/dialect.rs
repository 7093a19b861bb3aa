//! In which of the forms that spreadsheets write a table stands: what separates its columns, and how decimals are written.

use super::cell::shown;
use super::header::{Columns, column_named};
use super::table::{Table, field_spans, first_row};
use super::thousands::{CountMarks, both_readings, without_certain};
use crate::source_text::{Diagnostic, Fault, Source};

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Dialect {
    /// Between columns.
    pub(super) separator: u8,
    /// Whether decimals are written with a comma.
    pub(super) decimal_comma: bool,
    /// Bytes before the header that are no rows: the line `sep=;` of a spreadsheet program.
    pub(super) skipped: usize,
    /// What is known of marks in counts of cycles.
    counts: CountMarks,
}

/// The columns that hold numbers.
const NUMBERS: [&str; 5] = ["cycles", "position", "value", "sigma", "face"];

impl Dialect {
    /// What the first row tells: of all separators the one by which most of its fields are columns' names.
    pub(super) fn of(text: &str) -> Self {
        let mut found = Self {
            separator: b',',
            decimal_comma: false,
            skipped: 0,
            counts: CountMarks::default(),
        };
        let line = first_row(text, 0);
        let written = text[line.clone()].trim_matches(['"', ' ', '\t']);
        if let Some(separator) = stated(written) {
            found.separator = separator;
            found.skipped = line.end;
            return found;
        }
        let names = |separator: u8| {
            let fields = field_spans(text, line.clone(), separator);
            let known = fields
                .into_iter()
                .filter(|field| column_named(text[field.clone()].trim_matches('"')).is_some());
            known.count()
        };
        for separator in [b';', b'\t'] {
            if names(separator) > names(found.separator) {
                found.separator = separator;
            }
        }
        found
    }

    /// Learns from the numbers how decimals are written. A comma between columns leaves the point alone.
    ///
    /// # Errors
    /// Where both marks stand in numbers, and where a count of cycles may be meant in thousands.
    pub(super) fn with_decimals(
        mut self,
        source: &Source,
        columns: &Columns,
    ) -> Result<Self, Box<Diagnostic>> {
        self.counts = self.marks_of_counts(source, columns)?;
        // the first number with a point and the first with a comma: line, written, place
        let mut first: [Option<(String, std::ops::Range<usize>)>; 2] = [None, None];
        let mut table = Table::new(source, self);
        table.next()?;
        while let Some(row) = table.next()? {
            for (name, column) in numbers(columns) {
                let text = row.record.get(column).unwrap_or_default();
                if name == "cycles" && self.is_unclear_count(text) {
                    let says = format!("cycles {text}: {}", both_readings(text));
                    return Err(Box::new(
                        Diagnostic::new(Fault::BadValue, name, says)
                            .with_values(shown(text), "a number without marks between thousands")
                            .with_hint("write 250000 or 2.5e5 for a quarter of a million")
                            .with_span(row.span_of(column)),
                    ));
                }
                if !begins_a_number(text) || self.without_thousands(name, text).is_some() {
                    continue;
                }
                for (mark, first) in ['.', ','].into_iter().zip(&mut first) {
                    if first.is_none() && text.contains(mark) {
                        *first = Some((text.to_owned(), row.span_of(column)));
                    }
                }
            }
        }
        if self.separator == b',' {
            return Ok(self);
        }
        match first {
            [Some((point, at_point)), Some((comma, at_comma))] => {
                let (later, span) = if at_point.start > at_comma.start {
                    (point, at_point)
                } else {
                    (comma, at_comma)
                };
                Err(Box::new(
                    Diagnostic::new(
                        Fault::Inconsistent,
                        "",
                        "decimal points and decimal commas stand in one file",
                    )
                    .with_values(shown(&later), "one of the two in all numbers")
                    .with_hint("marks between thousands are not read: 250000, not 250.000")
                    .with_span(span),
                ))
            }
            [_, comma] => {
                self.decimal_comma = comma.is_some();
                Ok(self)
            }
        }
    }

    /// What the numbers tell of marks in counts of cycles.
    fn marks_of_counts(
        self,
        source: &Source,
        columns: &Columns,
    ) -> Result<CountMarks, Box<Diagnostic>> {
        let mut marks = CountMarks::default();
        let mut table = Table::new(source, self);
        table.next()?;
        while let Some(row) = table.next()? {
            for (name, column) in numbers(columns) {
                let text = row.record.get(column).unwrap_or_default();
                match name {
                    _ if !begins_a_number(text) => {}
                    "cycles" => marks.see(text),
                    _ => marks.see_elsewhere(text),
                }
            }
        }
        Ok(marks)
    }

    /// Whether a count of cycles may have marks between its thousands. Where commas stand between columns a point is a decimal one, but
    /// nobody counts 18 revolutions as `18.000`.
    fn is_unclear_count(self, text: &str) -> bool {
        let is_decimal = self.separator == b',' && !text.contains(',') && !text.ends_with('0');
        self.counts.is_unclear(text) && !is_decimal
    }

    /// A number of a column without the marks that are known to stand between its thousands; none if it has none.
    fn without_thousands(self, column: &str, text: &str) -> Option<String> {
        match column {
            "cycles" => self.counts.plain(text),
            _ => without_certain(text),
        }
    }

    /// A number of a column without marks between thousands, with a point for its decimals.
    pub(super) fn plain<'t>(self, column: &str, text: &'t str) -> std::borrow::Cow<'t, str> {
        if let Some(plain) = self.without_thousands(column, text) {
            return plain.into();
        }
        if self.decimal_comma && text.matches(',').count() == 1 {
            text.replace(',', ".").into()
        } else {
            text.into()
        }
    }

    /// What is said where the file is not written in the format's own way.
    pub(super) fn in_words(self) -> Option<String> {
        let between = match self.separator {
            b',' => return None,
            b'\t' => "tabs between columns".to_owned(),
            other => format!(
                "{} between columns",
                match other {
                    b';' => "semicolons".to_owned(),
                    other => format!("`{}`", char::from(other)),
                }
            ),
        };
        let decimals = if self.decimal_comma {
            "commas"
        } else {
            "points"
        };
        Some(format!("{between}, decimal {decimals}"))
    }
}

/// The columns that hold numbers, with their places.
fn numbers(columns: &Columns) -> impl Iterator<Item = (&'static str, usize)> {
    NUMBERS
        .into_iter()
        .filter_map(|name| Some((name, columns.of(name)?)))
}

fn begins_a_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || "+-.,".contains(c))
}

/// The separator that a line `sep=;` states.
fn stated(line: &str) -> Option<u8> {
    line.get(..4).filter(|s| s.eq_ignore_ascii_case("sep="))?;
    match &line.as_bytes()[4..] {
        // trimmed away with the blanks around it
        [] => Some(b'\t'),
        [separator] => Some(*separator).filter(|c| b",;\t|".contains(c)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_are_found_by_the_header() {
        let of = |text| char::from(Dialect::of(text).separator);
        assert_eq!(of("test,member,cycles\n"), ',');
        assert_eq!(of("# a; b; c\n\nTest;Member;Cycles\n"), ';');
        assert_eq!(of("test\tposition [mm]\tvalue\n"), '\t');
        assert_eq!(of("sep=;\na,b\n"), ';');
        assert_eq!(of("nothing;known\n"), ',');
    }
}
