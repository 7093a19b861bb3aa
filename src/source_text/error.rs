//! A message and its text as an error.

use std::fmt;

use super::{Diagnostic, Source};

/// A diagnostic together with the text it speaks of: an error that prints itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextError(Box<(Diagnostic, Source)>);

impl TextError {
    /// Joins a message and its text.
    pub fn new(diagnostic: Diagnostic, source: Source) -> Self {
        Self(Box::new((diagnostic, source)))
    }

    /// The same with one more hint.
    #[must_use]
    pub fn with_hint(self, hint: &str) -> Self {
        let (diagnostic, source) = *self.0;
        Self::new(diagnostic.with_hint(hint), source)
    }

    /// Without its hints, for others that know better.
    #[must_use]
    pub fn without_hints(self) -> Self {
        let (mut diagnostic, source) = *self.0;
        diagnostic.hints.clear();
        Self::new(diagnostic, source)
    }

    /// The fault itself.
    pub fn diagnostic(&self) -> &Diagnostic {
        &self.0.0
    }

    /// Name of the file as the user gave it.
    pub fn file(&self) -> &str {
        &self.0.1.name
    }

    /// Line and column of the fault, counted from 1; `None` if it concerns the file as a whole.
    pub fn position(&self) -> Option<(usize, usize)> {
        let (diagnostic, source) = &*self.0;
        diagnostic
            .span
            .as_ref()
            .map(|span| source.position(span.start))
    }

    /// The whole message, in colour if `coloured`.
    pub fn render(&self, coloured: bool) -> String {
        self.0.0.render(&self.0.1, coloured)
    }
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for TextError {}
