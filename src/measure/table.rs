//! CSV records with the places of their fields in the text.

use std::ops::Range;

use csv::{Reader, ReaderBuilder, StringRecord, Trim};

use super::cell::Row;
use super::dialect::Dialect;
use crate::source_text::{Diagnostic, Fault, Source};

/// The records of a text one by one; comment lines and empty lines are passed over.
pub(super) struct Table<'a> {
    source: &'a Source,
    dialect: Dialect,
    reader: Reader<&'a [u8]>,
    record: StringRecord,
    /// Bytes whose line ends are counted, and the line they end in.
    counted: usize,
    line: usize,
}

impl<'a> Table<'a> {
    /// At the start of the text.
    pub(super) fn new(source: &'a Source, dialect: Dialect) -> Self {
        let reader = ReaderBuilder::new()
            .delimiter(dialect.separator)
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .trim(Trim::All)
            .from_reader(&source.text.as_bytes()[dialect.skipped..]);
        Self {
            source,
            dialect,
            reader,
            record: StringRecord::new(),
            counted: 0,
            line: 1,
        }
    }

    /// The text that is read.
    pub(super) fn source(&self) -> &'a Source {
        self.source
    }

    /// The next record, `None` after the last.
    pub(super) fn next(&mut self) -> Result<Option<Row<'_>>, Box<Diagnostic>> {
        let from = self.dialect.skipped + self.reader.position().byte() as usize;
        let more = self.reader.read_record(&mut self.record);
        let text = self.source.text.as_str();
        let start = record_start(text, from);
        self.line += text[self.counted..start].matches('\n').count();
        self.counted = start;
        match more {
            // a comment without a line end is handed out as an empty record
            Ok(true) if start < text.len() => {
                let end = self.dialect.skipped + self.reader.position().byte() as usize;
                let written = match self.dialect.separator {
                    b'\t' => text[start..end].trim_end_matches(['\r', '\n']),
                    _ => text[start..end].trim_end(),
                };
                Ok(Some(Row {
                    text,
                    dialect: self.dialect,
                    record: &self.record,
                    span: start..start + written.len(),
                    line: self.line,
                }))
            }
            Ok(_) => Ok(None),
            Err(error) => Err(Box::new(
                Diagnostic::new(Fault::Syntax, "", format!("not valid CSV: {error}"))
                    .with_values("this row", "separated values")
                    .with_span(start..start),
            )),
        }
    }
}

/// The first byte at or after `at` that is neither a line end nor in a comment line.
fn record_start(text: &str, mut at: usize) -> usize {
    loop {
        let rest = &text[at..];
        at += rest.len() - rest.trim_start_matches(['\n', '\r']).len();
        if !text[at..].starts_with('#') {
            return at;
        }
        at += text[at..].find('\n').unwrap_or(text.len() - at);
    }
}

/// The first line at or after `at` that is no comment and not empty, without the blanks at its end.
pub(super) fn first_row(text: &str, at: usize) -> Range<usize> {
    let start = record_start(text, at);
    let line = text[start..].lines().next().unwrap_or_default();
    start..start + line.len()
}

/// Where the fields of the record in `span` stand, without the blanks around them.
pub(super) fn field_spans(text: &str, span: Range<usize>, separator: u8) -> Vec<Range<usize>> {
    let mut spans = Vec::new();
    let (mut start, mut quoted) = (span.start, false);
    for (at, c) in text[span.clone()].char_indices() {
        let at = span.start + at;
        match c {
            // A doubled quote inside quotes leaves them and enters them again.
            '"' if quoted || at == start => quoted = !quoted,
            _ if c == char::from(separator) && !quoted => {
                spans.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
    }
    spans.push(start..span.end);
    for field in &mut spans {
        let written = &text[field.clone()];
        let begin = field.start + written.len() - written.trim_start().len();
        *field = begin..begin + written.trim().len();
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_found_where_they_stand() {
        let text = "x\n a ,\"b,\"\"c\" ,,d\r\n";
        let spans = field_spans(text, 2..text.trim_end().len(), b',');
        let found: Vec<&str> = spans.into_iter().map(|s| &text[s]).collect();
        assert_eq!(found, ["a", "\"b,\"\"c\"", "", "d"]);
    }

    #[test]
    fn records_start_after_comments_and_empty_lines() {
        let source = Source {
            name: String::new(),
            text: "# one\r\n\r\na,b\n\n# two\n# three\nc,d\n# end".into(),
        };
        let mut table = Table::new(&source, Dialect::of(&source.text));
        let mut found = Vec::new();
        while let Some(row) = table.next().unwrap() {
            found.push((row.line, source.text[row.span.clone()].to_owned()));
        }
        assert_eq!(found, [(3, "a,b".to_owned()), (7, "c,d".to_owned())]);
    }
}
