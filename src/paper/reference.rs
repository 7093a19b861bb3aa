//! Every number the paper prints, beside ours and the theory's, with a verdict that is computed, not stated.
//!
//! The printed numbers, their rounding and an independent reconstruction stand in `validation/paper/reference.csv`.
//! Verdicts, from three facts per row (ours inside the rounding window, ours equal to correct theory, a law that the
//! printed number breaks):
//!
//! ```text
//! reproduced                           ours rounds to the print and is what correct theory gives
//! reproduced_with_quirk                ours rounds to the print but is not correct theory, or gives it only by cutting digits
//! not_reproduced                       ours misses the print
//! not_reproduced_contradicts_theory    the same, and a law of gearing rules the print out
//! ```

mod notes;
mod values;

use std::fmt;

use super::{Error, csv};

const TABLE: &str = include_str!("../../validation/paper/reference.csv");

/// How a printed number fares.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Table 1 and the text: given, not computed.
    Input,
    /// Reproduced by correct theory.
    Reproduced,
    /// Reproduced only with a stated quirk of the paper.
    Quirk,
    /// Not reproduced.
    NotReproduced,
    /// Not reproduced, and ruled out by theory.
    ContradictsTheory,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Input => "input",
            Self::Reproduced => "reproduced",
            Self::Quirk => "reproduced_with_quirk",
            Self::NotReproduced => "not_reproduced",
            Self::ContradictsTheory => "not_reproduced_contradicts_theory",
        })
    }
}

impl Verdict {
    fn parse(text: &str) -> Option<Self> {
        [
            Self::Input,
            Self::Reproduced,
            Self::Quirk,
            Self::NotReproduced,
            Self::ContradictsTheory,
        ]
        .into_iter()
        .find(|v| v.to_string() == text)
    }
}

/// One printed number with everything known about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Short name, as in the table file.
    pub id: String,
    /// What it is.
    pub quantity: String,
    /// Where it holds (misalignment RM, cycles).
    pub condition: String,
    /// Unit of all values of the row.
    pub unit: String,
    /// The printed number.
    pub paper: f64,
    /// Half of the last printed digit; `None` for counts and inputs, which must agree exactly.
    pub rounding_half_width: Option<f64>,
    /// Computed by this module's run of the published model; `None` where no formula of the paper leads to it.
    pub ours: Option<f64>,
    /// Computed from correct theory.
    pub theory: f64,
    /// Computed from the three columns above.
    pub verdict: Verdict,
    /// Why, for everything but inputs and plain agreement; empty otherwise.
    pub note: &'static str,
    /// What the table file states, from an independent reconstruction.
    pub stated: Stated,
}

/// The independent reconstruction's columns of the table file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stated {
    /// Its verdict.
    pub verdict: Verdict,
    /// Its theory value.
    pub theory: f64,
    /// Its value of the published model.
    pub reconstruction: Option<f64>,
}

impl Row {
    /// Is `value` inside the rounding window of the printed number?
    pub fn rounds_to_print(&self, value: f64) -> bool {
        let half = self.rounding_half_width.unwrap_or(0.0);
        (value - self.paper).abs() <= half * (1.0 + 1e-9) + 1e-12 * self.paper.abs()
    }

    /// Does `value` give the printed number when further digits are cut off?
    pub fn cut_gives_print(&self, value: f64) -> bool {
        let unit = 2.0 * self.rounding_half_width.unwrap_or(0.0);
        let beyond = (value - self.paper) * self.paper.signum();
        beyond > -1e-9 * unit && beyond < unit * (1.0 - 1e-9)
    }
}

/// All rows, in the order of the table file. Runs the published model and the corrected one at the three misalignments.
pub fn rows() -> Result<Vec<Row>, ReferenceError> {
    let values = values::Values::compute()?;
    TABLE
        .lines()
        .enumerate()
        .skip(1)
        .filter(|(_, line)| !line.trim().is_empty())
        .map(|(i, line)| row(i + 1, line, &values))
        .collect()
}

/// Why the table could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// The published model did not run.
    #[error(transparent)]
    Model(#[from] Error),
    /// A line of the table file cannot be read.
    #[error("reference.csv:{line}: {text:?} is not a valid {column}")]
    Table {
        /// Line number.
        line: usize,
        /// Column name.
        column: &'static str,
        /// What stands there.
        text: String,
    },
    /// A row that this program computes nothing for.
    #[error("reference.csv:{line}: no value is computed for row {id}")]
    Unknown {
        /// Line number.
        line: usize,
        /// The row's short name.
        id: String,
    },
}

fn row(line: usize, text: &str, values: &values::Values) -> Result<Row, ReferenceError> {
    let cells = csv::fields(text);
    let cell = |i: usize| cells.get(i).map_or("", String::as_str);
    let bad = |i: usize, column: &'static str| ReferenceError::Table {
        line,
        column,
        text: cell(i).to_owned(),
    };
    let number = |i: usize, column| cell(i).parse::<f64>().map_err(|_| bad(i, column));
    let optional = |i: usize, column| match cell(i) {
        "" => Ok(None),
        _ => number(i, column).map(Some),
    };
    let id = cell(0);
    let computed = values.of(id).ok_or_else(|| ReferenceError::Unknown {
        line,
        id: id.to_owned(),
    })?;
    let note = notes::of(id);
    let mut row = Row {
        id: id.to_owned(),
        quantity: cell(1).to_owned(),
        condition: cell(2).to_owned(),
        paper: number(3, "paper_value")?,
        unit: cell(4).to_owned(),
        rounding_half_width: optional(5, "rounding_half_width")?,
        ours: computed.ours,
        theory: computed.theory,
        verdict: Verdict::Input,
        note: note.map_or("", |n| n.text),
        stated: Stated {
            verdict: Verdict::parse(cell(6)).ok_or_else(|| bad(6, "verdict"))?,
            theory: number(7, "theory_value")?,
            reconstruction: optional(8, "reconstruction_value")?,
        },
    };
    row.verdict = judge(&row, computed.kind, note.is_some_and(|n| n.law));
    Ok(row)
}

/// What sort of number a row holds; decides how it is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Input,
    /// A point number; its theory is the fractional position.
    Count,
    Quantity,
}

fn judge(row: &Row, kind: Kind, breaks_a_law: bool) -> Verdict {
    let ours = row.ours.unwrap_or(f64::NAN);
    let rounds = row.rounds_to_print(ours);
    let cut = kind == Kind::Quantity && row.cut_gives_print(ours);
    let is_theory = match kind {
        Kind::Input => true,
        Kind::Count => (ours - row.theory).abs() < 1.0,
        Kind::Quantity => (ours - row.theory).abs() <= 1e-6 * row.theory.abs(),
    };
    match kind {
        Kind::Input if rounds => Verdict::Input,
        _ if rounds && is_theory => Verdict::Reproduced,
        _ if rounds || cut => Verdict::Quirk,
        _ if breaks_a_law && !row.rounds_to_print(row.theory) => Verdict::ContradictsTheory,
        _ => Verdict::NotReproduced,
    }
}
