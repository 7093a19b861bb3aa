//! The header line: which column stands where.

use super::cell::{Row, shown};
use super::table::Table;
use crate::source_text::{Diagnostic, Fault, list, nearest};

/// The columns: name, and whether each file must have it.
pub const COLUMNS: [(&str, bool); 10] = [
    ("test", true),
    ("member", true),
    ("cycles", true),
    ("quantity", true),
    ("position", true),
    ("value", true),
    ("sigma", true),
    ("trace", false),
    ("face", false),
    ("tooth", false),
];

/// Where the columns stand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Columns {
    /// Place of each of [`COLUMNS`].
    at: [Option<usize>; COLUMNS.len()],
    /// Number of fields in the header.
    pub(super) count: usize,
}

impl Columns {
    /// From the first record.
    pub(super) fn read(table: &mut Table<'_>) -> Result<Self, Box<Diagnostic>> {
        let source = table.source();
        let Some(row) = table.next()? else {
            let empty = source.text.trim().is_empty();
            let what = if empty {
                "the file is empty"
            } else {
                "the file has no header line"
            };
            return Err(Box::new(
                Diagnostic::new(Fault::MissingKey, "", what)
                    .with_values(
                        if empty { "nothing" } else { "comments only" },
                        format!("a first line with the columns {}", names()),
                    )
                    .with_span(0..0),
            ));
        };
        let mut at = [None; COLUMNS.len()];
        for column in 0..row.len() {
            let name = row.record.get(column).unwrap_or_default();
            let Some(which) = COLUMNS.iter().position(|(known, _)| *known == name) else {
                return Err(unknown(&row, column, name));
            };
            if at[which].replace(column).is_some() {
                return Err(Box::new(
                    Diagnostic::new(
                        Fault::Syntax,
                        name,
                        format!("the column `{name}` stands twice"),
                    )
                    .with_values(shown(name), "each column once")
                    .with_span(row.span_of(column)),
                ));
            }
        }
        let missing = COLUMNS
            .iter()
            .zip(at)
            .find(|((_, must), at)| *must && at.is_none());
        if let Some(((name, _), _)) = missing {
            let mut diagnostic = row
                .fault(Fault::MissingKey, format!("there is no column `{name}`"))
                .with_values("this header", names())
                .with_hint(if *name == "position" {
                    "it stays empty in rows of mass_loss"
                } else {
                    ""
                });
            diagnostic.key = (*name).to_owned();
            return Err(Box::new(diagnostic));
        }
        Ok(Self {
            at,
            count: row.len(),
        })
    }

    /// Place of a column by its name in [`COLUMNS`].
    pub(super) fn of(&self, name: &str) -> Option<usize> {
        let which = COLUMNS.iter().position(|(known, _)| *known == name)?;
        self.at[which]
    }
}

/// The columns as a list for messages, those in brackets may be left out.
fn names() -> String {
    let must = COLUMNS.iter().filter(|c| c.1).map(|c| c.0);
    let may = COLUMNS.iter().filter(|c| !c.1).map(|c| c.0);
    format!("{}; optional {}", list(must), list(may))
}

fn unknown(row: &Row<'_>, column: usize, name: &str) -> Box<Diagnostic> {
    let near = nearest(name, COLUMNS.iter().map(|c| c.0)).unwrap_or_default();
    let hint = if row.len() == 1 && name.contains([';', '\t']) {
        "columns are separated by commas, decimals are written with a point".to_owned()
    } else if name.parse::<f64>().is_ok() || row.record.iter().all(|f| !is_column(f)) {
        "the first line that is no comment names the columns".to_owned()
    } else if name.is_empty() {
        "every column has a name; look for a comma too many".to_owned()
    } else {
        format!("the nearest column is `{near}`")
    };
    Box::new(
        Diagnostic::new(
            Fault::UnknownKey,
            name,
            if name.is_empty() {
                "a column has no name".to_owned()
            } else {
                format!("there is no column {}", shown(name))
            },
        )
        .with_values(shown(name), names())
        .with_hint(hint)
        .with_span(row.span_of(column)),
    )
}

fn is_column(name: &str) -> bool {
    COLUMNS.iter().any(|(known, _)| *known == name)
}
