//! One message about a text file, in the form of a compiler's: what, where (file, line, column), the line itself with a
//! caret, what was found, what is allowed, and a way out.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use super::Source;

/// What kind of fault a [`Diagnostic`] reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fault {
    /// The file is missing or cannot be read.
    Unreadable,
    /// The file is not UTF-8 text.
    NotUtf8,
    /// The text does not follow the file format (duplicate keys included).
    Syntax,
    /// A key or column that does not exist.
    UnknownKey,
    /// A required key, table or column is missing.
    MissingKey,
    /// A value of the wrong type, for example text instead of a number.
    WrongType,
    /// A value that is not allowed.
    BadValue,
    /// Values that are allowed one by one and impossible together.
    Inconsistent,
    /// Valid, but this version cannot do it.
    NotAvailable,
}

/// One fault in a text file; its [`Display`](std::fmt::Display) writes the whole message without colour.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Kind of fault.
    pub fault: Fault,
    /// The key it concerns, with its tables (`gears.pinion.teeth`), or the column; empty when none is concerned.
    pub key: String,
    /// The fault in one line, with the key and the values.
    pub message: String,
    /// What stands in the file; empty when it is the message's own subject.
    pub found: String,
    /// What may stand there; empty if that cannot be said in general.
    pub allowed: String,
    /// Ways out and reasons, one line each.
    pub hints: Vec<String>,
    /// Where it stands, as bytes of the text; `None` for the file as a whole.
    pub span: Option<Range<usize>>,
}

impl Diagnostic {
    /// A message about a key; the other fields are empty and filled by the `with_` functions.
    pub fn new(fault: Fault, key: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            fault,
            key: key.into(),
            message: message.into(),
            found: String::new(),
            allowed: String::new(),
            hints: Vec::new(),
            span: None,
        }
    }

    /// Where the fault stands.
    pub fn with_span(mut self, span: Range<usize>) -> Self {
        self.span = Some(span);
        self
    }

    /// What was found and what is allowed.
    pub fn with_values(mut self, found: impl Into<String>, allowed: impl Into<String>) -> Self {
        self.found = found.into();
        self.allowed = allowed.into();
        self
    }

    /// One more way out or reason; an empty text adds none.
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        let hint = hint.into();
        if !hint.is_empty() {
            self.hints.push(hint);
        }
        self
    }

    /// The whole message as text, in colour if `coloured`.
    pub fn render(&self, source: &Source, coloured: bool) -> String {
        let label = match (self.found.is_empty(), self.allowed.is_empty()) {
            (true, true) => String::new(),
            (false, true) => format!("found {}", self.found),
            (true, false) => format!("allowed: {}", self.allowed),
            (false, false) => format!("found {}, allowed: {}", self.found, self.allowed),
        };
        let title = Level::ERROR.primary_title(self.message.as_str());
        let mut group: Group<'_> = match &self.span {
            Some(span) => title.element(
                Snippet::source(source.text.as_str())
                    .path(source.name.as_str())
                    .annotation(
                        AnnotationKind::Primary
                            .span(source.visible(span.clone()))
                            .label(label.as_str()),
                    ),
            ),
            None => {
                let group = title.element(Origin::path(source.name.as_str()));
                if label.is_empty() {
                    group
                } else {
                    group.element(Level::NOTE.message(label.as_str()))
                }
            }
        };
        for hint in &self.hints {
            group = group.element(Level::HELP.message(hint.as_str()));
        }
        let renderer = if coloured {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        renderer.render(&[group])
    }
}

/// Letters from which on a word may be the beginning of another one.
const BEGINNING: usize = 4;

/// The candidate that looks most like `word`: one that begins with it, then that of the smallest edit distance (transpositions count once; the
/// first wins a tie).
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let low = word.to_lowercase();
    candidates.into_iter().min_by_key(|candidate| {
        let distance = strsim::damerau_levenshtein(&low, &candidate.to_lowercase());
        (!begins(word, candidate), distance)
    })
}

/// Whether a word is the beginning of another one.
pub fn begins(word: &str, other: &str) -> bool {
    let is_long = word.chars().count() >= BEGINNING;
    is_long && other.to_lowercase().starts_with(&word.to_lowercase())
}

/// Whether a word may be another one misspelt: at most half its letters differ.
pub fn is_misspelt(word: &str, of: &str) -> bool {
    let letters = word.chars().count().max(of.chars().count());
    2 * strsim::damerau_levenshtein(&word.to_lowercase(), &of.to_lowercase()) <= letters
}

/// Words as a list for a sentence: `a, b, c`.
pub fn list<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    words.into_iter().collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_word_wins() {
        assert_eq!(nearest("modul", ["teeth", "module"]), Some("module"));
        assert_eq!(nearest("toruqe", ["speed", "torque"]), Some("torque"));
        assert_eq!(nearest("x", []), None);
        assert_eq!(
            nearest("helix", ["gear", "helix_angle"]),
            Some("helix_angle")
        );
        assert_eq!(nearest("tes", ["test_of_wear", "yes"]), Some("yes"));
    }
}
