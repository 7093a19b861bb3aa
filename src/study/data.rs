//! The measurements that belong to a study.

use super::{Outliers, Role, Study};
use crate::measure::{Dataset, Known, Observation};
use crate::source_text::{Diagnostic, Fault, TextError, list};

/// How to come by the file.
const FROM_A_TABLE: &str = "a table of yours becomes that file by `gearwear import TABLE --study STUDY -o measurements.csv`, which shows first how it reads it";
/// What to do before anything is measured.
const PLAN_FIRST: &str =
    "where nothing is measured yet, `gearwear plan STUDY` proposes the first tests";

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
            )
            .map_err(|error| error.with_hint(FROM_A_TABLE).with_hint(PLAN_FIRST));
        };
        if self.tests.is_empty() {
            return missing(
                "test",
                "the study has measurements and no [[test]]",
                "a [[test]] with the id by which the measurements call it",
                "each test states under which conditions its measurements were made",
            );
        }
        let mut data =
            Dataset::load(path, &self.known()).map_err(|error| self.named_here(error))?;
        data.find_outliers(self.noise.outliers == Outliers::Robust);
        self.check_places_across_the_face(&data, self.effect_model())?;
        self.check_teeth_of_rows(&data)?;
        Ok(data)
    }

    /// A measurement file that cannot be read, with the place of the key that names it; other faults have places in the file itself.
    fn named_here(&self, error: TextError) -> TextError {
        const KEY: &str = "measurements.file";
        let span = self.spans.get(KEY);
        match span.filter(|_| error.diagnostic().fault == Fault::Unreadable) {
            Some(span) => {
                let mut diagnostic = error.diagnostic().clone();
                KEY.clone_into(&mut diagnostic.key);
                self.error_at(diagnostic, span.clone())
            }
            None => error,
        }
    }

    /// Whether there is any wear to measure or to fit.
    ///
    /// # Errors
    /// A [`TextError`] for a wear coefficient of 0.
    pub fn check_wears(&self) -> Result<(), TextError> {
        if self.wear.coefficient > 0.0 {
            return Ok(());
        }
        Err(self.refuse(
            "wear.coefficient",
            "without wear there is nothing to measure or to fit",
            "above 0 mm2/N",
            "a rough guess will do, 1e-10 for mild wear of steel: a fit finds its own",
        ))
    }

    /// The measurements for a fit, which takes wear and a row of a fit test at least.
    ///
    /// # Errors
    /// As [`Study::dataset`] and [`Study::check_wears`]; a [`TextError`] if no fit test has a row.
    pub fn dataset_to_fit(&self) -> Result<Dataset, TextError> {
        self.check_wears()?;
        let data = self.dataset()?;
        let fits = |o: &Observation| self.tests[o.test].role == Role::Fit;
        if !data.observations.iter().any(fits) {
            let fit: Vec<&str> = (self.tests.iter().filter(|test| test.role == Role::Fit))
                .map(|test| test.id.as_str())
                .collect();
            return Err(self.refuse(
                "measurements.file",
                "no test with role \"fit\" has a measurement",
                &if fit.is_empty() {
                    "a study with a [[test]] of role \"fit\"".to_owned()
                } else {
                    format!("rows of a test with role \"fit\": {}", list(fit))
                },
                "held-out tests judge a fit and take no part in it",
            ));
        }
        Ok(data)
    }
}
