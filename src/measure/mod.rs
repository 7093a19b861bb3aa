//! Floor 6: the measurement file. `measurements.csv` becomes a [`Dataset`] whose every row has been checked, or one
//! [`TextError`] that shows the place, what was found, what is allowed and a way out. No row is dropped silently.
//!
//! ```text
//! text -> how it is written (dialect) -> csv records with places (table) -> columns (header) -> cells -> Observation -> units of the whole (units)
//! ```
//!
//! Knows the study by [`Known`] only: ids and lengths of the tests, the flanks' radii, the face width.

mod cell;
mod checkpoints;
mod curve_scatter;
mod dialect;
mod face_places;
mod header;
pub mod import;
mod known;
mod names;
pub mod neighbours;
mod observation;
pub mod outliers;
mod pooled_scatter;
mod quantity;
mod row_reader;
mod short_series;
mod sigma;
mod surface;
mod table;
mod thousands;
mod units;

use std::path::Path;

use crate::source_text::{self, Diagnostic, Fault, Source, TextError, Wanted};

pub use checkpoints::checkpoints;
pub use header::COLUMNS;
pub use known::{Known, KnownTest};
pub use observation::{FacePlace, Observation};
pub use outliers::Outlier;
pub use quantity::{Place, Quantity, Subject};
pub use surface::{Surface, surfaces};

pub(crate) use thousands::{CountMarks, both_readings, without_certain};

use dialect::Dialect;
use header::Columns;
use row_reader::{LEAST_SIGMA, Reader};
use table::Table;

/// Every measurement of a file, in its order.
#[derive(Debug, Clone, PartialEq)]
pub struct Dataset {
    /// The file's name as the user gave it.
    pub name: String,
    /// Ids of the study's tests; [`Observation::test`] counts in them.
    pub tests: Vec<String>,
    /// The rows.
    pub observations: Vec<Observation>,
    /// The traces by first appearance; [`Observation::trace`] counts in them.
    pub traces: Vec<Trace>,
    /// How the file was read where it is not written in the format's own way, in one line; empty otherwise.
    pub reading: String,
    /// Rows that stand apart from their neighbours, in their order.
    pub outliers: Vec<Outlier>,
    /// Rows without a stated sigma, which is estimated.
    pub estimated_sigmas: usize,
}

/// Points that share one unknown constant datum offset.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trace {
    /// Its name in the file.
    pub name: String,
    /// What all its points measure.
    pub quantity: Quantity,
    /// Line of its first point.
    pub line: usize,
}

/// The measurement file, to whoever cannot read it.
const WANTED: Wanted = Wanted {
    what: "measurement file",
    ending: "csv",
    format: "CSV",
    header: &["test", "quantity"],
    hint: "[measurements] file in the study names it, relative to the study file",
};

const READ_BY_IMPORT: &str = "a table in another form: `gearwear import FILE --study STUDY -o measurements.csv` converts it as it stands";

impl Dataset {
    /// Reads and checks a measurement file.
    ///
    /// # Errors
    /// A [`TextError`] for the first fault: unreadable, not UTF-8, columns, rows, values, units.
    pub fn load(path: &Path, known: &Known) -> Result<Self, TextError> {
        let source =
            source_text::read(path, &WANTED).map_err(|error| match error.diagnostic().fault {
                Fault::NotUtf8 | Fault::Unreadable => error.with_hint(READ_BY_IMPORT),
                _ => error,
            })?;
        Self::read(source, known)
    }

    /// Checks a measurement file's text; `name` stands in messages.
    ///
    /// # Errors
    /// As [`Dataset::load`].
    pub fn parse(text: &str, name: &str, known: &Known) -> Result<Self, TextError> {
        let source = Source {
            name: name.to_owned(),
            text: text.strip_prefix('\u{feff}').unwrap_or(text).to_owned(),
        };
        Self::read(source, known)
    }

    /// Whether most sigmas are estimated.
    pub fn estimates_sigmas(&self) -> bool {
        2 * self.estimated_sigmas > self.observations.len()
    }

    /// File and line of an observation, for messages: `measurements.csv:7`.
    pub fn place(&self, observation: &Observation) -> String {
        format!("{}:{}", self.name, observation.line)
    }

    fn read(mut source: Source, known: &Known) -> Result<Self, TextError> {
        // line ends of old Macs: places are counted by the other kind
        if !source.text.contains('\n') {
            source.text = source.text.replace('\r', "\n");
        }
        match Self::rows(&source, known) {
            Ok(dataset) => Ok(dataset),
            Err(diagnostic) => Err(TextError::new(*diagnostic, source)),
        }
    }

    fn rows(source: &Source, known: &Known) -> Result<Self, Box<Diagnostic>> {
        let dialect = Dialect::of(&source.text);
        let columns = Columns::read(&mut Table::new(source, dialect))?;
        let dialect = dialect.with_decimals(source, &columns)?;
        let mut table = Table::new(source, dialect);
        table.next()?;
        let mut reader = Reader::new(&columns, known);
        let mut observations = Vec::new();
        let mut blank = 0;
        while let Some(row) = table.next()? {
            if row.is_blank() && row.len() > 1 {
                blank += 1;
                continue;
            }
            let observation = reader.observation(&row)?;
            observations.push(observation);
        }
        if observations.is_empty() {
            let end = source.text.trim_end().len();
            return Err(Box::new(
                Diagnostic::new(Fault::MissingKey, "", "the file holds no measurement")
                    .with_values("no row after the header", "one row per measured value")
                    .with_span(end..end),
            ));
        }
        let estimated = match sigma::estimate(&mut observations) {
            Ok(estimated) => estimated,
            Err(row) => {
                let o = &observations[row];
                return Err(Box::new(without_sigma(source, dialect, &columns, o)?));
            }
        };
        units::check(source, (&columns, dialect.separator), &observations)?;
        Ok(Self {
            name: source.name.clone(),
            tests: known.tests.iter().map(|test| test.id.clone()).collect(),
            observations,
            traces: reader.into_traces(),
            reading: reading(dialect, &columns, blank, estimated.in_words()),
            outliers: Vec::new(),
            estimated_sigmas: estimated.rows(),
        })
    }
}

/// How a file was read that is not written in the format's own way.
fn reading(dialect: Dialect, columns: &Columns, blank: usize, estimated: Option<String>) -> String {
    let mut said: Vec<String> = dialect.in_words().into_iter().collect();
    let mut passed_over: Vec<String> = Vec::new();
    match columns.passed_over.as_slice() {
        [] => {}
        [one] => passed_over.push(format!("the column `{one}`")),
        more => passed_over.push(format!("the columns `{}`", more.join("`, `"))),
    }
    let count = |number: usize, one: &str| match number {
        0 => None,
        1 => Some(format!("1 {one}")),
        n => Some(format!("{n} {one}s")),
    };
    passed_over.extend(count(columns.nameless, "empty column"));
    passed_over.extend(count(blank, "empty row"));
    if !passed_over.is_empty() {
        said.push(format!("passed over: {}", passed_over.join(", ")));
    }
    said.extend(estimated);
    said.join("; ")
}

/// What is to be said of a row of whose sigma nothing tells.
fn without_sigma(
    source: &Source,
    dialect: Dialect,
    columns: &Columns,
    observation: &Observation,
) -> Result<Diagnostic, Box<Diagnostic>> {
    let mut table = Table::new(source, dialect);
    while let Some(row) = table.next()? {
        if row.line == observation.line {
            let cell = row.cell("sigma", columns.of("sigma"));
            let unit = observation.quantity.shown_unit();
            let allowed = format!("one standard deviation, at least {LEAST_SIGMA:e}, {unit}");
            let fault = cell.fault(Fault::MissingKey, "sigma is missing", &allowed);
            return Ok(fault.with_hint(
                "it is estimated where points along a trace, several times of a test, repeated measurements or other rows of the quantity show it; here none does: state it (`gearwear import` by --sigma or --relative-sigma)",
            ));
        }
    }
    unreachable!("the row was read from this text")
}
