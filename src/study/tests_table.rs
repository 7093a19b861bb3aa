//! `[measurements] tests`: a table of tests as a spreadsheet writes it, beside or instead of `[[test]]`.
//!
//! ```text
//! id,role,torque,bulk_temperature        the keys of [[test]] are the columns; # starts a comment line
//! A,fit,6.0,40
//! B,holdout,8.0,                          an empty cell: as in [operation]
//! ```
//! Each row is read as the `[[test]]` that it stands for, by the reader of those; what it finds is told at the cell in the table.

mod decimals;

use std::ops::Range;
use std::path::Path;

use super::edit::quoted;
use super::operation::TEST_KEYS;
use super::profile::trimmed;
use crate::source_text::{self, Diagnostic, Fault, Source, TextError, Wanted, list};
use decimals::Decimals;

const WANTED: Wanted = Wanted {
    what: "table of tests",
    ending: "csv",
    format: "CSV",
    header: &[],
    hint: "`tests` in [measurements] names it, relative to the study file",
};

/// Columns for people, passed over.
const FOR_PEOPLE: [&str; 3] = ["comment", "note", "remark"];

/// A table of tests and the text that stands for it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TestsTable {
    source: Source,
    /// `[[test]]` tables, to stand behind a study's own text.
    text: String,
    /// Where each part of that text stands in the table.
    places: Vec<(Range<usize>, Range<usize>)>,
}

impl TestsTable {
    /// Reads the table at `path`.
    ///
    /// # Errors
    /// A [`TextError`] if it cannot be read, has no rows, or its columns are not to be told apart. Values are left to the reader of tests.
    pub(super) fn load(path: &Path) -> Result<Self, TextError> {
        let source = source_text::read(path, &WANTED)?;
        let mut table = Self {
            text: "\n".to_owned(),
            places: Vec::new(),
            source,
        };
        match table.translate() {
            Ok(()) => Ok(table),
            Err(diagnostic) => Err(TextError::new(*diagnostic, table.source)),
        }
    }

    /// The study's text with the tests behind it.
    pub(super) fn behind(&self, study: &Source) -> Source {
        Source {
            name: study.name.clone(),
            text: format!("{}{}", study.text, self.text),
        }
    }

    /// Where a span of [`TestsTable::behind`] stands: in the study of so many bytes, or in the table.
    pub(super) fn place(&self, span: Range<usize>, study: &Source) -> (Source, Range<usize>) {
        let Some(start) = span.start.checked_sub(study.text.len()) else {
            return (study.clone(), span);
        };
        let holds = |(own, _): &&(Range<usize>, Range<usize>)| own.contains(&start);
        let place = self.places.iter().find(holds).or(self.places.last());
        let end = self.source.text.trim_end().len();
        let place = place.map_or(end..end, |(_, place)| place.clone());
        (self.source.clone(), place)
    }

    fn translate(&mut self) -> Result<(), Box<Diagnostic>> {
        let whole = self.source.text.clone();
        let mut lines = super::profile::lines(&whole);
        let end = whole.trim_end().len();
        let empty = |what: &str| {
            Diagnostic::new(Fault::MissingKey, "", what)
                .with_values(
                    "nothing",
                    format!("a header of {} and rows", TEST_KEYS.join(",")),
                )
                .with_span(end..end)
        };
        let Some(header) = lines.next() else {
            return Err(empty("the table of tests is empty").into());
        };
        let separator = separator(&whole[header.clone()]);
        let columns = columns(&whole, header, separator)?;
        let below = super::profile::lines(&whole).skip(1);
        let decimals = Decimals::of(&whole, below, &columns, separator)?;
        let mut rows = 0;
        for line in lines {
            let cells = cells(&whole, line.clone(), separator);
            if cells.iter().all(|cell| cell.is_empty()) {
                continue;
            }
            if let Some(extra) = cells.get(columns.len()..).filter(|extra| {
                // spreadsheets leave separators behind the last column
                extra.iter().any(|cell| !cell.is_empty())
            }) {
                let message = format!("{} cells under {} columns", cells.len(), columns.len());
                return Err(Diagnostic::new(Fault::BadValue, "", message)
                    .with_values("", format!("{} cells", columns.len()))
                    .with_span(extra[0].clone())
                    .into());
            }
            self.put("[[test]]\n", line);
            for (column, cell) in columns.iter().zip(cells) {
                let (Some(column), false) = (column, cell.is_empty()) else {
                    continue;
                };
                let value = column.value(&whole[cell.clone()], &decimals);
                self.put(&column.key, column.place.clone());
                self.text.push_str(" = ");
                self.put(&value, cell);
                self.text.push('\n');
            }
            rows += 1;
        }
        if rows == 0 {
            return Err(empty("the table of tests has no rows").into());
        }
        Ok(())
    }

    /// Adds a text that stands at `place` in the table.
    fn put(&mut self, text: &str, place: Range<usize>) {
        let start = self.text.len();
        self.text.push_str(text);
        self.places.push((start..self.text.len(), place));
    }
}

/// A column with its key.
struct Column {
    key: String,
    unit: Option<String>,
    place: Range<usize>,
}

impl Column {
    /// Whether numbers stand in it, with or without a unit.
    fn is_of_numbers(&self) -> bool {
        !["id", "role", "reversed"].contains(&self.key.as_str())
    }

    /// A cell as it stands in a study file.
    fn value(&self, cell: &str, decimals: &Decimals) -> String {
        if ["id", "role"].contains(&self.key.as_str()) {
            return quoted(cell);
        }
        let word = cell.to_lowercase();
        if ["true", "false"].contains(&word.as_str()) {
            return word;
        }
        let point = decimals.plain(self, cell);
        match (point.parse::<f64>(), &self.unit) {
            (Ok(value), None) if value.is_finite() => format!("{value:?}"),
            (Ok(_), Some(unit)) => quoted(&format!("{point} {unit}")),
            // what it should be the reader of tests knows
            _ => quoted(&point),
        }
    }
}

/// What stands between the header's cells: that by which most of them are keys.
fn separator(header: &str) -> u8 {
    let known = |separator: &u8| {
        let cells = header.split(char::from(*separator));
        let key = |cell: &str| name_and_unit(cell.trim().trim_matches('"')).0;
        let keys = cells.clone();
        let keys = keys.filter(|cell| TEST_KEYS.contains(&key(cell).as_str()));
        // where no name is known, more columns
        (keys.count(), cells.count())
    };
    // of equals the last
    [b'\t', b';', b',']
        .into_iter()
        .max_by_key(known)
        .unwrap_or(b',')
}

/// The key of each column; none for one that is for people or has no name and nothing in it.
fn columns(
    text: &str,
    header: Range<usize>,
    separator: u8,
) -> Result<Vec<Option<Column>>, Box<Diagnostic>> {
    let mut seen: Vec<String> = Vec::new();
    let mut columns = Vec::new();
    for place in cells(text, header, separator) {
        let written = &text[place.clone()];
        let (key, unit) = name_and_unit(written);
        let refuse = |message: String| {
            Diagnostic::new(Fault::UnknownKey, key.clone(), message)
                .with_values(format!("`{written}`"), list(TEST_KEYS.iter().copied()))
                .with_span(place.clone())
        };
        if key.is_empty() || FOR_PEOPLE.contains(&key.trim_end_matches('s')) {
            columns.push(None);
            continue;
        }
        if !TEST_KEYS.contains(&key.as_str()) {
            let near = source_text::nearest(&key, TEST_KEYS.iter().copied());
            let near = near.filter(|near| {
                source_text::begins(&key, near) || source_text::is_misspelt(&key, near)
            });
            let hint = near.map_or(String::new(), |near| format!("the nearest is `{near}`"));
            let unknown = refuse(format!("no test has a `{key}`"));
            return Err(unknown.with_hint(hint).into());
        }
        if seen.contains(&key) {
            return Err(refuse(format!("the column {key} stands twice")).into());
        }
        seen.push(key.clone());
        columns.push(Some(Column { key, unit, place }));
    }
    Ok(columns)
}

/// `Torque [N m]` as `torque` and `N m`.
fn name_and_unit(written: &str) -> (String, Option<String>) {
    let closed = written.ends_with([']', ')']);
    match written.find(['[', '(']).filter(|_| closed) {
        Some(at) => {
            let unit = written[at + 1..written.len() - 1].trim();
            let unit = (!unit.is_empty() && unit != "-").then(|| unit.to_owned());
            (written[..at].trim().to_lowercase(), unit)
        }
        None => (written.trim().to_lowercase(), None),
    }
}

/// The cells of a line without blanks and quotation marks around them.
fn cells(text: &str, line: Range<usize>, separator: u8) -> Vec<Range<usize>> {
    let mut at = line.start;
    text[line]
        .split(char::from(separator))
        .map(|cell| {
            let start = at;
            at += cell.len() + 1;
            let cell = trimmed(text, start..start + cell.len());
            let inside = &text[cell.clone()];
            let is_quoted = inside.len() > 1 && inside.starts_with('"') && inside.ends_with('"');
            if is_quoted {
                trimmed(text, cell.start + 1..cell.end - 1)
            } else {
                cell
            }
        })
        .collect()
}
