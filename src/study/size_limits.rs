//! What a study file holds at most: texts and lists beyond any use are refused before they are looked up, compared or drawn.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::reader::Result;
use crate::source_text::{Diagnostic, Fault};

/// Characters of one text, a formula among them.
const TEXT: usize = 10_000;
/// Characters of a key.
const KEY: usize = 200;
/// Entries of a list: tests, effects, knots.
const ENTRIES: usize = 10_000;

/// Refuses a table that holds more than that.
///
/// # Errors
/// The first fault, with its place.
pub(super) fn check(table: &DeTable<'_>, path: &str) -> Result<()> {
    for (key, value) in table.iter() {
        let name = key.get_ref();
        let length = name.chars().count();
        if length > KEY {
            let start: String = name.chars().take(30).collect();
            return Err(fault(
                &format!("{path}{start}..."),
                "a key",
                length,
                "characters",
                KEY,
                key.span(),
            ));
        }
        value_fits(value.get_ref(), value.span(), &format!("{path}{name}"))?;
    }
    Ok(())
}

fn value_fits(value: &DeValue<'_>, span: Range<usize>, path: &str) -> Result<()> {
    match value {
        DeValue::String(text) => match text.chars().count() {
            length if length > TEXT => Err(fault(path, "a text", length, "characters", TEXT, span)),
            _ => Ok(()),
        },
        DeValue::Array(items) if items.len() > ENTRIES => {
            Err(fault(path, "a list", items.len(), "entries", ENTRIES, span))
        }
        DeValue::Array(items) => (items.iter().enumerate()).try_for_each(|(i, item)| {
            value_fits(item.get_ref(), item.span(), &format!("{path}[{i}]"))
        }),
        DeValue::Table(table) => check(table, &format!("{path}.")),
        _ => Ok(()),
    }
}

/// `what` at `path` has `found` characters or entries, `most` are allowed; only the beginning of it is shown.
fn fault(
    path: &str,
    what: &str,
    found: usize,
    unit: &str,
    most: usize,
    span: Range<usize>,
) -> Box<Diagnostic> {
    let message = format!("{path}: {what} of {found} {unit}");
    Diagnostic::new(Fault::BadValue, path.to_owned(), message)
        .with_span(span.start..span.end.min(span.start + 1))
        .with_values(format!("{found} {unit}"), format!("at most {most}"))
        .into()
}
