//! Reads one table of a parsed TOML text key by key: types, ranges, unknown and missing keys, each fault with its place.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};

use crate::source_text::{Diagnostic, Fault, Source, begins, list, nearest};

pub(super) type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// Where each key's value stands, by its path (`test[0].torque`); an absent key has no entry.
pub(super) type Spans = BTreeMap<String, Range<usize>>;

/// What users look for and the program does not have, with what there is.
const NOT_MODELLED: [(&str, &str); 2] = [
    (
        "helix_angle",
        "the helix angle stands in [face], and [gears] states the normal section then",
    ),
    (
        "temperature",
        "`bulk_temperature` stands in [thermal], or in a [[test]]",
    ),
];

/// A table of the study file with its path.
#[derive(Debug)]
pub(super) struct Table<'a> {
    source: &'a Source,
    /// `gears.pinion`, `test[0]`; empty for the root.
    path: String,
    header: Range<usize>,
    entries: &'a DeTable<'a>,
    keys: &'a [&'a str],
    elsewhere: &'a [(&'a str, &'a [&'a str])],
    spans: &'a RefCell<Spans>,
}

impl<'a> Table<'a> {
    /// The root table. `keys` are its valid keys, `elsewhere` the keys of other tables (for hints).
    pub(super) fn root(
        source: &'a Source,
        entries: &'a DeTable<'a>,
        keys: &'a [&'a str],
        elsewhere: &'a [(&'a str, &'a [&'a str])],
        spans: &'a RefCell<Spans>,
    ) -> Result<Self> {
        let end = source.text.trim_end().len();
        let table = Table {
            source,
            path: String::new(),
            header: end..end,
            entries,
            keys,
            elsewhere,
            spans,
        };
        table.check_keys()?;
        Ok(table)
    }

    /// A table that may be absent.
    pub(super) fn table(&self, key: &str, keys: &'a [&'a str]) -> Result<Option<Table<'a>>> {
        let Some(table) = self.free_table(key)? else {
            return Ok(None);
        };
        let table = Table { keys, ..table };
        table.check_keys()?;
        Ok(Some(table))
    }

    /// A table with keys of the user's choice that may be absent.
    pub(super) fn free_table(&self, key: &str) -> Result<Option<Table<'a>>> {
        let Some((value, span)) = self.get(key) else {
            return Ok(None);
        };
        match value {
            DeValue::Table(entries) => Ok(Some(self.unchecked(self.path_of(key), span, entries))),
            DeValue::Array(_) if self.source.text[span.clone()].starts_with("[[") => Err(self
                .wrong_type(
                    key,
                    value,
                    span,
                    &format!("one table [{}]", shown(&self.path_of(key))),
                )
                .with_hint("write the header with single brackets")
                .into()),
            _ => Err(self
                .wrong_type(
                    key,
                    value,
                    span,
                    &format!("a table [{}]", shown(&self.path_of(key))),
                )
                .into()),
        }
    }

    /// A table that must be there.
    pub(super) fn required_table(&self, key: &str, keys: &'a [&'a str]) -> Result<Table<'a>> {
        match self.table(key, keys)? {
            Some(table) => Ok(table),
            None => {
                let path = shown(&self.path_of(key));
                Err(Diagnostic::new(
                    Fault::MissingKey,
                    path.clone(),
                    format!("the table [{path}] is missing"),
                )
                .with_span(self.header.clone())
                .with_values(
                    "nothing",
                    format!("[{path}] with the keys {}", list(keys.iter().copied())),
                )
                .into())
            }
        }
    }

    /// An array of tables, `[[key]]`, in the order of the file; empty if absent.
    pub(super) fn tables(&self, key: &str, keys: Option<&'a [&'a str]>) -> Result<Vec<Table<'a>>> {
        let Some((value, span)) = self.get(key) else {
            return Ok(Vec::new());
        };
        let wanted = format!("tables [[{key}]]");
        let DeValue::Array(items) = value else {
            let wrong = self.wrong_type(key, value, span, &wanted);
            return Err(wrong
                .with_hint("write the header with double brackets: there may be several")
                .into());
        };
        items
            .iter()
            .enumerate()
            .map(|(n, item)| match item.get_ref() {
                DeValue::Table(entries) => {
                    let path = format!("{}[{n}]", self.path_of(key));
                    match keys {
                        Some(keys) => self.open(path, item.span(), entries, keys),
                        None => Ok(self.unchecked(path, item.span(), entries)),
                    }
                }
                other => Err(self.wrong_type(key, other, item.span(), &wanted).into()),
            })
            .collect()
    }

    /// The value of a key as parsed, with its place.
    pub(super) fn get(&self, key: &str) -> Option<(&'a DeValue<'a>, Range<usize>)> {
        let value = self.entries.get(key)?;
        let span = value.span();
        self.spans
            .borrow_mut()
            .insert(self.path_of(key), span.clone());
        Some((value.get_ref(), span))
    }

    /// Remembers where a part of a key's value stands.
    pub(super) fn place(&self, part: &str, span: Range<usize>) {
        self.spans.borrow_mut().insert(self.path_of(part), span);
    }

    /// Whether the table states the key.
    pub(super) fn has(&self, key: &str) -> bool {
        self.entries.get(key).is_some()
    }

    /// Whether the key's value is a table, inline or not.
    pub(super) fn holds_table(&self, key: &str) -> bool {
        matches!(
            self.entries.get(key).map(|value| value.get_ref()),
            Some(DeValue::Table(_))
        )
    }

    /// Where the key itself stands.
    pub(super) fn key_span(&self, key: &str) -> Option<Range<usize>> {
        self.entries.get_key_value(key).map(|(key, _)| key.span())
    }

    /// The text at a span as it stands in the file.
    pub(super) fn raw(&self, span: &Range<usize>) -> &'a str {
        &self.source.text[span.clone()]
    }

    /// The table's keys in the order of the file.
    pub(super) fn present(&self) -> Vec<&'a str> {
        let mut keys: Vec<_> = self
            .entries
            .keys()
            .map(|key| (key.span().start, key.get_ref().as_ref()))
            .collect();
        keys.sort_unstable();
        keys.into_iter().map(|(_, key)| key).collect()
    }

    /// Where the table's header stands.
    pub(super) fn header(&self) -> Range<usize> {
        self.header.clone()
    }

    /// A refusal of a present value: `key = value says`.
    pub(super) fn refuse(&self, key: &str, says: &str, allowed: impl Into<String>) -> Diagnostic {
        let path = shown(&self.path_of(key));
        let span = self.get(key).map_or(self.header.clone(), |(_, span)| span);
        let written = self.written(&span);
        Diagnostic::new(
            Fault::BadValue,
            path.clone(),
            format!("{path} = {written} {says}"),
        )
        .with_values(written, allowed)
        .with_span(span)
    }

    /// A required key that is not there.
    pub(super) fn missing(&self, key: &str, allowed: &str) -> Diagnostic {
        let path = shown(&self.path_of(key));
        Diagnostic::new(
            Fault::MissingKey,
            path.clone(),
            format!("{path} is missing"),
        )
        .with_values(format!("no key `{key}` in this table"), allowed)
        .with_span(self.header.clone())
    }

    pub(super) fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.path)
        }
    }

    fn unchecked(&self, path: String, header: Range<usize>, entries: &'a DeTable<'a>) -> Table<'a> {
        self.spans.borrow_mut().insert(path.clone(), header.clone());
        Table {
            source: self.source,
            path,
            header,
            entries,
            keys: &[],
            elsewhere: self.elsewhere,
            spans: self.spans,
        }
    }

    fn open(
        &self,
        path: String,
        header: Range<usize>,
        entries: &'a DeTable<'a>,
        keys: &'a [&'a str],
    ) -> Result<Table<'a>> {
        let table = Table {
            keys,
            ..self.unchecked(path, header, entries)
        };
        table.check_keys()?;
        Ok(table)
    }

    /// Refuses the first key, in the order of the file, that the table does not have.
    fn check_keys(&self) -> Result<()> {
        self.check_known(self.keys)
    }

    /// The same for these keys.
    pub(super) fn check_known(&self, keys: &[&str]) -> Result<()> {
        let unknown = |key: &&str| !keys.contains(key);
        let Some(key) = self.present().into_iter().find(unknown) else {
            return Ok(());
        };
        let path = shown(&self.path_of(key));
        let span = self
            .entries
            .get_key_value(key)
            .map_or(self.header.clone(), |(key, _)| key.span());
        let mut diagnostic = Diagnostic::new(
            Fault::UnknownKey,
            path.clone(),
            format!("unknown key `{path}`"),
        )
        .with_values(format!("`{key}`"), list(keys.iter().copied()))
        .with_span(span);
        if let Some((_, why)) = NOT_MODELLED.iter().find(|(name, _)| *name == key) {
            diagnostic = diagnostic.with_hint(*why);
        } else if let Some((home, near)) = self.begun_elsewhere(key, keys) {
            diagnostic = diagnostic.with_hint(format!("`{near}` stands in [{home}]"));
        } else if let Some(near) = nearest(key, keys.iter().copied()) {
            diagnostic = diagnostic.with_hint(format!("the nearest valid key is `{near}`"));
        }
        if let Some((home, _)) = self.elsewhere.iter().find(|(_, keys)| keys.contains(&key)) {
            let home = if home.is_empty() {
                "before the first table".to_owned()
            } else {
                format!("in [{home}]")
            };
            diagnostic = diagnostic.with_hint(format!("`{key}` stands {home}"));
        }
        Err(diagnostic.into())
    }

    /// A key of another table, and that table, of which a word is the beginning that begins none of `keys` and is no key itself.
    fn begun_elsewhere(&self, word: &str, keys: &[&str]) -> Option<(&'a str, &'a str)> {
        let is_key = |(_, keys): &(&str, &[&str])| keys.contains(&word);
        if keys.iter().any(|key| begins(word, key)) || self.elsewhere.iter().any(is_key) {
            return None;
        }
        self.elsewhere.iter().find_map(|(home, keys)| {
            let key = keys.iter().find(|key| begins(word, key))?;
            (!home.is_empty()).then_some((*home, *key))
        })
    }

    pub(super) fn wrong_type(
        &self,
        key: &str,
        value: &DeValue<'_>,
        span: Range<usize>,
        wanted: &str,
    ) -> Diagnostic {
        let path = shown(&self.path_of(key));
        let kind = kind_of(value);
        let found = match value {
            DeValue::Table(_) | DeValue::Array(_) => kind.to_owned(),
            _ => format!("{kind} {}", self.written(&span)),
        };
        let mut diagnostic = Diagnostic::new(
            Fault::WrongType,
            path.clone(),
            format!("{path} is {found}, not {wanted}"),
        )
        .with_values(found, wanted)
        .with_span(span);
        if let (DeValue::String(text), true) = (value, wanted.starts_with("a number")) {
            if text.trim().parse::<f64>().is_ok() {
                diagnostic = diagnostic.with_hint("write the number without quotes");
            } else if text.trim_start().starts_with(|c: char| c.is_ascii_digit()) {
                diagnostic = diagnostic.with_hint("a number and its unit look like \"2 mm\"");
            }
        }
        diagnostic
    }

    /// The text at a span, cut to one short line.
    pub(super) fn written(&self, span: &Range<usize>) -> String {
        let text = self.source.text[span.clone()]
            .lines()
            .next()
            .unwrap_or_default();
        match text.char_indices().nth(40) {
            Some((cut, _)) => format!("{}...", &text[..cut]),
            None => text.to_owned(),
        }
    }
}

/// A path without the numbers of array entries: `test[0].torque` -> `test.torque`.
pub(super) fn shown(path: &str) -> String {
    let mut inside = false;
    path.chars()
        .filter(|c| {
            match c {
                '[' => inside = true,
                ']' => {
                    inside = false;
                    return false;
                }
                _ => {}
            }
            !inside
        })
        .collect()
}

fn kind_of(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "the text",
        DeValue::Integer(_) => "the whole number",
        DeValue::Float(_) => "the number",
        DeValue::Boolean(_) => "the truth value",
        DeValue::Datetime(_) => "the date or time",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}
