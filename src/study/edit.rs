//! Changes a study's text at the places concerned and nowhere else: comments, order, blanks and line ends stay as they are.
//!
//! ```text
//! Study (text and places) -> Edit: replacements and additions -> text -> Study::parse
//! ```
//! A replaced value stands exactly where the old one stood; a new effect and a new `[fit]` stand at the end of the file, or
//! inside the list if the study writes its effects as one.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;
use std::path::Path;

use super::learned::{LearnedLaw, numbers};
use super::{EffectSpec, FreeParameter, Law, Study, relative};
use crate::source_text::TextError;

/// Changes of one study's text, made by [`Edit::finish`].
#[derive(Debug)]
pub struct Edit<'a> {
    study: &'a Study,
    changes: Vec<(Range<usize>, String)>,
    /// Coefficients of learned laws, by the place of the effect: made into values at the end.
    coefficients: BTreeMap<usize, Vec<f64>>,
    /// Added at the end, each a table with its lines.
    tables: Vec<Vec<String>>,
}

impl Study {
    /// Begins to change the study's text.
    pub fn edit(&self) -> Edit<'_> {
        Edit {
            study: self,
            changes: Vec::new(),
            coefficients: BTreeMap::new(),
            tables: Vec::new(),
        }
    }
}

/// `value` with six significant digits: what a fit writes into a study.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// The shortest decimal number that reads back as exactly this one.
fn number(value: f64) -> String {
    format!("{value:?}")
}

impl Edit<'_> {
    /// Adds an effect of the catalogue with its values, in this order.
    ///
    /// # Errors
    /// A [`TextError`] if the study has it already.
    pub fn add_effect(&mut self, kind: &str, values: &[(String, f64)]) -> Result<(), TextError> {
        let mut keys = vec![format!("kind = {}", quoted(kind))];
        keys.extend(
            values
                .iter()
                .map(|(name, value)| format!("{name} = {}", number(*value))),
        );
        self.add_entry(kind, keys)
    }

    /// Adds a learned law.
    ///
    /// # Errors
    /// As [`Edit::add_effect`].
    pub fn add_learned(&mut self, learned: &LearnedLaw) -> Result<(), TextError> {
        self.add_entry(&learned.law.name(), learned.lines())
    }

    /// Adds a formula with its values, [`EffectSpec::of_formula`].
    ///
    /// # Errors
    /// As [`Edit::add_effect`].
    pub fn add_formula(&mut self, formula: &EffectSpec) -> Result<(), TextError> {
        self.add_entry(&formula.name, formula.formula_lines())
    }

    /// Adds an effect of this name with its keys.
    fn add_entry(&mut self, kind: &str, mut keys: Vec<String>) -> Result<(), TextError> {
        let study = self.study;
        if let Some(place) = study.effects().iter().position(|spec| spec.name == kind) {
            let key = format!("effect[{place}].kind");
            return Err(study.refuse(
                &key,
                &format!("the study has the effect {kind} already"),
                "an effect that is not there",
                "its parameters are fitted again if they stand in [fit] free",
            ));
        }
        match self.span("effect") {
            Some(span) if !self.text(&span).starts_with("[[") => {
                let entry = format!("{{ {} }}", keys.join(", "));
                let last = study.effects().last().map(|spec| spec.span.clone());
                self.append(span, last, entry);
            }
            _ => {
                keys.insert(0, "[[effect]]".to_owned());
                self.tables.push(keys);
            }
        }
        Ok(())
    }

    /// Sets a parameter: `wear.coefficient`, or one of an effect by its name (`running_in.amplitude`). A parameter that the
    /// study does not state is written behind the effect's kind. An unknown name changes nothing.
    pub fn set(&mut self, name: &str, value: f64) {
        if name == super::WEAR_COEFFICIENT {
            // members' own keep their proportion to the common one
            let wear = &self.study.wear;
            for (member, factor) in ["pinion", "gear"].into_iter().zip(wear.members) {
                let key = format!("wear.{member}.coefficient");
                if self.span(&key).is_some()
                    || self.span(&format!("wear.{member}.material")).is_some()
                {
                    self.put(&key, &number(factor * value));
                }
            }
            // beside a pair of materials none need be stated
            self.put(name, &number(value));
            return;
        }
        let number = number(value);
        let effects = self.study.effects().iter().enumerate();
        for (place, spec) in effects {
            let Some(n) = spec.parameters.iter().position(|p| p.name == name) else {
                continue;
            };
            if matches!(spec.law, Law::Learned(_)) {
                let stated = spec.parameters.iter().map(|p| p.value);
                let all = self.coefficients.entry(place);
                all.or_insert_with(|| stated.collect())[n] = value;
            } else {
                self.set_in(place, spec, spec.parameters[n].short(), number);
            }
            return;
        }
    }

    /// Sets any key by its path (`operation.misalignment`, not of an effect or a test) to `value` as TOML writes it. A key that
    /// the study does not state is written behind its table's header, a missing table at the end. False, and nothing is changed,
    /// if the table is written in another form.
    pub fn put(&mut self, path: &str, value: &str) -> bool {
        if let Some(span) = self.span(path) {
            self.changes.push((span, value.to_owned()));
            return true;
        }
        let Some((table, key)) = path.rsplit_once('.') else {
            return false;
        };
        let line = format!("{key} = {value}");
        match self.span(table) {
            Some(span) if self.text(&span).starts_with('{') => {
                let at = span.start + 1;
                self.changes.push((at..at, format!(" {line},")));
            }
            Some(span) if self.text(&span).starts_with('[') => {
                let at = self.line_end(span.start);
                let text = format!("{}{line}", self.line_break());
                self.changes.push((at..at, text));
            }
            Some(_) => return false,
            None => match self
                .tables
                .iter_mut()
                .find(|t| t[0] == format!("[{table}]"))
            {
                Some(added) => added.push(line),
                None => self.tables.push(vec![format!("[{table}]"), line]),
            },
        }
        true
    }

    fn set_in(&mut self, place: usize, spec: &EffectSpec, short: &str, number: String) {
        let inside = match spec.law {
            Law::Card(_) | Law::Learned(_) => "",
            Law::Formula { .. } => ".parameters",
        };
        let path = format!("effect[{place}]{inside}.{short}");
        let stated = self
            .span(&format!("{path}.value"))
            .or_else(|| self.span(&path));
        if let Some(span) = stated {
            self.changes.push((span, number));
        } else if let Some(kind) = self.span(&format!("effect[{place}].kind")) {
            let (at, text) = if self.text(&spec.span).starts_with('{') {
                (kind.end, format!(", {short} = {number}"))
            } else {
                let at = self.line_end(kind.end);
                (at, format!("{}{short} = {number}", self.line_break()))
            };
            self.changes.push((at..at, text));
        }
    }

    /// Adds names to `[fit] free`, those that stand there already left out. A study without it has the wear coefficient there.
    pub fn free(&mut self, names: &[String]) {
        let there = self.study.free();
        let new: Vec<String> = names
            .iter()
            .filter(|name| {
                let own = format!("{name}.");
                let is_there =
                    |free: &FreeParameter| free.name == **name || free.name.starts_with(&own);
                !there.iter().any(is_there)
            })
            .map(|name| quoted(name))
            .collect();
        if new.is_empty() {
            return;
        }
        let new = new.join(", ");
        if let Some(span) = self.span("fit.free") {
            // a learned law is one name and many parameters
            let last = (0..there.len()).map_while(|n| self.span(&format!("fit.free[{n}]")));
            let last = last.last();
            self.append(span, last, new);
            return;
        }
        let line = format!("free = [{}, {new}]", quoted(super::WEAR_COEFFICIENT));
        match self.span("fit") {
            Some(span) if self.text(&span).starts_with('{') => {
                let at = span.start + 1;
                self.changes.push((at..at, format!(" {line} ")));
            }
            Some(span) => {
                let at = self.line_end(span.start);
                let text = format!("{}{line}", self.line_break());
                self.changes.push((at..at, text));
            }
            None => self.tables.insert(0, vec!["[fit]".to_owned(), line]),
        }
    }

    /// Names another measurement file, as it is to stand in the study.
    pub fn measure_from(&mut self, file: &str) {
        if let Some(span) = self.span("measurements.file") {
            // a path that was moved is replaced all the same
            self.changes.retain(|(changed, _)| *changed != span);
            self.changes.push((span, quoted(file)));
        } else {
            let line = format!("file = {}", quoted(file));
            self.tables.push(vec!["[measurements]".to_owned(), line]);
        }
    }

    /// Adds a test at the conditions of `[operation]`.
    pub fn add_test(&mut self, id: &str) {
        let line = format!("id = {}", quoted(id));
        self.tables.push(vec!["[[test]]".to_owned(), line]);
    }

    /// Rewrites relative paths for a study file in the folder `to` that stood in the folder `from`.
    ///
    /// # Errors
    /// A [`TextError`] if a path has no text form.
    pub fn move_between(&mut self, from: &Path, to: &Path) -> Result<(), TextError> {
        let study = self.study;
        let numerics = &study.numerics;
        let paths = [
            (super::named_files::PROFILE_KEYS[0], &study.profiles[0]),
            (super::named_files::PROFILE_KEYS[1], &study.profiles[1]),
            ("measurements.file", &study.measurements),
            ("measurements.tests", &study.tests_file),
            ("numerics.mesh_pinion", &numerics.mesh_pinion),
            ("numerics.mesh_gear", &numerics.mesh_gear),
        ];
        for (key, path) in paths {
            let (Some(path), Some(span)) = (path, self.span(key)) else {
                continue;
            };
            // what the file says, without the study's folder before it
            let written = path.strip_prefix(from).unwrap_or(path);
            let as_it_is = written.is_absolute() || self.text(&span).contains(":\\");
            let Some(moved) = relative::moved(written, from, to).filter(|_| !as_it_is) else {
                continue;
            };
            let Some(moved) = moved.to_str() else {
                return Err(study.refuse(key, "the path is no text", "a path in UTF-8", ""));
            };
            self.changes.push((span, quoted(&moved.replace('\\', "/"))));
        }
        Ok(())
    }

    /// The changed study, under the name of its new file.
    ///
    /// # Errors
    /// A [`TextError`] if what was set makes the study invalid.
    pub fn finish(mut self, name: &str) -> Result<Study, TextError> {
        for (place, coefficients) in std::mem::take(&mut self.coefficients) {
            let span = self.span(&format!("effect[{place}].values"));
            if let (Law::Learned(learned), Some(span)) = (&self.study.effects()[place].law, span) {
                let values = numbers(&learned.values_at(&coefficients));
                self.changes.push((span, values));
            }
        }
        self.changes.sort_by_key(|(span, _)| span.start);
        let mut text = self.study.text().to_owned();
        for (span, new) in self.changes.iter().rev() {
            text.replace_range(span.clone(), new);
        }
        let end = self.line_break();
        for table in &self.tables {
            if !text.is_empty() && !text.ends_with('\n') {
                text.push_str(end);
            }
            for line in std::iter::once("").chain(table.iter().map(String::as_str)) {
                text.push_str(line);
                text.push_str(end);
            }
        }
        Study::parse(&text, name)
    }

    /// Adds `entry` behind the last entry of the list at `span`, or as its first.
    fn append(&mut self, span: Range<usize>, last: Option<Range<usize>>, entry: String) {
        let (at, text) = match last {
            Some(last) => (last.end, format!(", {entry}")),
            None => (span.start + 1, entry),
        };
        self.changes.push((at..at, text));
    }

    fn span(&self, path: &str) -> Option<Range<usize>> {
        let own = |span: &&Range<usize>| span.end <= self.study.text().len();
        self.study.spans.get(path).filter(own).cloned()
    }

    fn text(&self, span: &Range<usize>) -> &str {
        &self.study.text()[span.clone()]
    }

    /// The end of the line in which `at` stands, before its line break.
    fn line_end(&self, at: usize) -> usize {
        let rest = &self.study.text()[at..];
        let line = rest.split('\n').next().unwrap_or_default();
        at + line.trim_end_matches('\r').len()
    }

    /// The line break that the file uses.
    fn line_break(&self) -> &'static str {
        if self.study.text().contains("\r\n") {
            "\r\n"
        } else {
            "\n"
        }
    }
}

/// A text as TOML writes it.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
