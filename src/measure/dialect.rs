//! In which of the forms that spreadsheets write a table stands: what separates its columns, and how decimals are written.

use super::cell::shown;
use super::header::{Columns, column_named};
use super::table::{Table, field_spans, first_row};
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
        if self.separator == b',' {
            return Ok(self);
        }
        let mut table = Table::new(source, self);
        table.next()?;
        // the first number with a point and the first with a comma: line, written, place
        let mut first: [Option<(String, std::ops::Range<usize>)>; 2] = [None, None];
        while let Some(row) = table.next()? {
            for name in NUMBERS {
                let Some(column) = columns.of(name) else {
                    continue;
                };
                let text = row.record.get(column).unwrap_or_default();
                if !text.starts_with(|c: char| c.is_ascii_digit() || "+-.,".contains(c)) {
                    continue;
                }
                if name == "cycles" && in_thousands(text) {
                    return Err(Box::new(
                        Diagnostic::new(Fault::BadValue, name, "cycles in thousands or in parts?")
                            .with_values(shown(text), "a number without marks between thousands")
                            .with_hint("write 250000 or 2.5e5 for a quarter of a million")
                            .with_span(row.span_of(column)),
                    ));
                }
                for (mark, first) in ['.', ','].into_iter().zip(&mut first) {
                    if first.is_none() && text.contains(mark) {
                        *first = Some((text.to_owned(), row.span_of(column)));
                    }
                }
            }
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

    /// A number as it stands, with a point for its decimals.
    pub(super) fn point(self, text: &str) -> std::borrow::Cow<'_, str> {
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

/// Whether a number looks like one with marks between its thousands: `250.000`.
pub(crate) fn in_thousands(text: &str) -> bool {
    let mut groups = text.split(['.', ',']);
    let digits = |group: &str| group.bytes().all(|b| b.is_ascii_digit());
    let first = groups.next().unwrap_or_default();
    let mut rest = groups.peekable();
    rest.peek().is_some()
        && digits(first)
        && (1..=3).contains(&first.len())
        && !first.starts_with('0')
        && rest.all(|group| group.len() == 3 && digits(group))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_told_from_decimals() {
        for text in ["250.000", "1.000.000", "250,000"] {
            assert!(in_thousands(text), "{text}");
        }
        for text in ["250000", "250000.000", "0.000", "2.5", "2.5e5", ""] {
            assert!(!in_thousands(text), "{text}");
        }
    }

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
