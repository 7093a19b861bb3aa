//! The header line: which column stands where, and in which unit it says its numbers are.

use super::cell::{Row, shown};
use super::names;
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
#[derive(Debug, Clone)]
pub(super) struct Columns {
    /// Place of each of [`COLUMNS`].
    at: [Option<usize>; COLUMNS.len()],
    /// The unit that the header states for each of them.
    units: [Option<String>; COLUMNS.len()],
    /// Number of fields in the header.
    pub(super) count: usize,
    /// How many of these, at its end, have no name.
    pub(super) nameless: usize,
    /// Names of the columns that are passed over, as written.
    pub(super) passed_over: Vec<String>,
}

/// Which of [`COLUMNS`] a header's field names, whatever its letters, with a unit in brackets behind it or without.
pub(super) fn column_named(field: &str) -> Option<usize> {
    let (name, _) = name_and_unit(field);
    COLUMNS.iter().position(|(known, _)| *known == name)
}

/// `Position [mm]` as `position` and `mm`.
fn name_and_unit(field: &str) -> (String, Option<String>) {
    let field = field.trim();
    let opening = field
        .find(['[', '('])
        .filter(|_| field.ends_with([']', ')']));
    let (name, unit) = match opening {
        Some(at) => (&field[..at], Some(&field[at + 1..field.len() - 1])),
        None => (field, None),
    };
    let unit = unit.map(|unit| unit.trim().replace(['µ', 'μ'], "u"));
    (
        name.trim().to_lowercase(),
        unit.filter(|unit| !unit.is_empty()),
    )
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
                        format!("a first line with the columns {}", columns()),
                    )
                    .with_span(0..0),
            ));
        };
        let mut at = [None; COLUMNS.len()];
        let mut units = [const { None }; COLUMNS.len()];
        let named =
            (0..row.len()).rfind(|at| row.record.get(*at).is_some_and(|name| !name.is_empty()));
        let named = named.map_or(row.len(), |last| last + 1);
        let mut passed_over = Vec::new();
        for column in 0..named {
            let written = row.record.get(column).unwrap_or_default();
            let (name, unit) = name_and_unit(written);
            if names::is_for_people(&name) {
                passed_over.push(written.to_owned());
                continue;
            }
            let Some(which) = column_named(written) else {
                return Err(unknown(&row, column, written));
            };
            units[which] = unit;
            if at[which].replace(column).is_some() {
                return Err(Box::new(
                    Diagnostic::new(
                        Fault::Syntax,
                        name.as_str(),
                        format!("the column `{name}` stands twice"),
                    )
                    .with_values(shown(written), "each column once")
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
                .with_values("this header", columns())
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
            units,
            count: row.len(),
            nameless: row.len() - named,
            passed_over,
        })
    }

    /// The unit that the header states for a column, if it states one.
    pub(super) fn unit_of(&self, name: &str) -> Option<&str> {
        let which = COLUMNS.iter().position(|(known, _)| *known == name)?;
        self.units[which].as_deref()
    }

    /// Place of a column by its name in [`COLUMNS`].
    pub(super) fn of(&self, name: &str) -> Option<usize> {
        let which = COLUMNS.iter().position(|(known, _)| *known == name)?;
        self.at[which]
    }
}

/// The columns as a list for messages, those in brackets may be left out.
fn columns() -> String {
    let must = COLUMNS.iter().filter(|c| c.1).map(|c| c.0);
    let may = COLUMNS.iter().filter(|c| !c.1).map(|c| c.0);
    format!("{}; optional {}", list(must), list(may))
}

fn unknown(row: &Row<'_>, column: usize, name: &str) -> Box<Diagnostic> {
    let (plain, _) = name_and_unit(name);
    let known = || COLUMNS.iter().map(|c| c.0);
    let near = names::near_column(&plain)
        .or_else(|| known().find(|column| abbreviates(&plain, column)))
        .unwrap_or_else(|| nearest(name, known()).unwrap_or_default());
    let hint = if row.len() == 1 && name.contains([';', '\t', '|']) {
        "columns are separated by commas, semicolons or tabs".to_owned()
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
        .with_values(shown(name), columns())
        .with_hint(hint)
        .with_span(row.span_of(column)),
    )
}

/// Whether a name has some of a word's letters in their order, its first one first: `qty`.
fn abbreviates(name: &str, word: &str) -> bool {
    let name = name.to_lowercase();
    let mut letters = word.chars();
    name.chars().count() > 1
        && name.chars().next() == word.chars().next()
        && name.chars().all(|c| letters.any(|letter| letter == c))
}

fn is_column(name: &str) -> bool {
    column_named(name).is_some()
}
