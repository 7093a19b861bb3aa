//! The measurements that belong to a study.

use super::Study;
use crate::measure::{Dataset, Known};
use crate::source_text::{Diagnostic, Fault, TextError};

impl Study {
    /// What measurements of this study may refer to: its tests, flanks and face width.
    pub fn known(&self) -> Known {
        let tests = self
            .tests
            .iter()
            .map(|test| (test.id.as_str(), test.conditions.cycles));
        Known::new(
            tests,
            [&self.gears.pinion, &self.gears.gear],
            self.gears.face_width,
        )
    }

    /// Reads the file that `[measurements]` names.
    ///
    /// # Errors
    /// A [`TextError`] if the study names no file or has no test, or for the first fault of the file.
    pub fn dataset(&self) -> Result<Dataset, TextError> {
        let missing = |key: &str, message: &str, allowed: &str, hint: &str| {
            let end = self.source.text.trim_end().len();
            let diagnostic = Diagnostic::new(Fault::MissingKey, key, message)
                .with_values("nothing", allowed)
                .with_hint(hint)
                .with_span(end..end);
            Err(TextError::new(diagnostic, self.source.clone()))
        };
        let Some(path) = &self.measurements else {
            return missing(
                "measurements.file",
                "the study names no measurements",
                "[measurements] with file = \"...\"",
                "without measurements there is nothing to compare with; `gearwear synthesize` makes some to try",
            );
        };
        if self.tests.is_empty() {
            return missing(
                "test",
                "the study has measurements and no [[test]]",
                "a [[test]] with the id by which the measurements call it",
                "each test states under which conditions its measurements were made",
            );
        }
        Dataset::load(path, &self.known())
    }
}
