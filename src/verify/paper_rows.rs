//! Every printed number of the published model as a case: its verdict must be the one of the independent reconstruction.
//!
//! ```text
//! reproduced, with or without quirk    target: the print          tolerance: its rounding (a whole digit if it was cut)
//! not reproduced                       target: the reconstruction, which misses the print in the same way
//! contradicts theory                   target: the print          value: what theory gives; shown, not met
//! ```
//! A row fails if its verdict is not the one the table file states.

use crate::paper::reference::{self, ReferenceError, Row as Printed, Verdict as Fate};
use crate::verify::runner::{Row, Verdict};

/// Beginning of the rows' ids.
pub const ID: &str = "paper";

/// Where the numbers come from.
pub const SOURCE: &str = "published: Kumar, Hirani, Agrawal 2018";

/// Agreement of two programs whose values are stated with six digits.
const SIX_DIGITS: f64 = 1e-5;

/// All rows.
///
/// # Errors
/// [`ReferenceError`] if the published model does not run or its table cannot be read.
pub fn all() -> Result<Vec<Row>, ReferenceError> {
    Ok(reference::rows()?.iter().map(row).collect())
}

/// One printed number as a case.
pub fn row(printed: &Printed) -> Row {
    let half = printed.rounding_half_width.unwrap_or(0.0);
    let ours = printed.ours.unwrap_or(f64::NAN);
    let rounds = printed.rounds_to_print(ours);
    let (target, value, tolerance, source) = match printed.verdict {
        Fate::NotReproduced => {
            let stated = printed.stated.reconstruction.unwrap_or(f64::NAN);
            let tolerance = SIX_DIGITS * stated.abs();
            (
                stated,
                ours,
                tolerance,
                "independent program: reconstruction of the published model",
            )
        }
        Fate::ContradictsTheory => (printed.paper, printed.theory, half, SOURCE),
        // rounding of the numbers themselves: a hit on the edge of the window is one
        _ if rounds => (
            printed.paper,
            ours,
            half + 1e-9 * printed.paper.abs(),
            SOURCE,
        ),
        _ => (printed.paper, ours, 2.0 * half, SOURCE),
    };
    let error = (value - target).abs();
    let agrees = printed.verdict == printed.stated.verdict;
    let verdict = match printed.verdict {
        Fate::ContradictsTheory if agrees => Verdict::ContradictsTheory,
        _ if agrees && error <= tolerance => Verdict::Pass,
        _ => Verdict::Fail,
    };
    Row {
        id: format!("{ID}.{}", printed.id),
        group: "Published paper",
        quantity: text(printed),
        target: Some(target),
        source: source.to_owned(),
        value: Some(value),
        error: Some(error),
        tolerance: Some(tolerance),
        relative: false,
        verdict,
        reason: reason(printed, agrees),
        seconds: 0.0,
    }
}

fn text(printed: &Printed) -> String {
    let unit = match printed.unit.as_str() {
        "-" => "",
        unit => unit,
    };
    let fate = match printed.verdict {
        Fate::Quirk => " (reproduced with a quirk)",
        Fate::NotReproduced => " (not reproduced)",
        Fate::ContradictsTheory => " (contradicts theory)",
        Fate::Input | Fate::Reproduced => "",
    };
    let ours = printed.ours.map_or("none".to_owned(), short);
    format!(
        "{}, {}: paper {}{fate}, ours {ours}, theory {} {unit}",
        printed.quantity,
        printed.condition,
        short(printed.paper),
        short(printed.theory),
    )
    .trim_end()
    .to_owned()
}

fn reason(printed: &Printed, agrees: bool) -> String {
    let fate = printed.verdict.to_string().replace('_', " ");
    let mut parts = Vec::new();
    if !agrees {
        let stated = printed.stated.verdict.to_string().replace('_', " ");
        parts.push(format!("verdict {fate}, the reconstruction says {stated}"));
    } else if !matches!(printed.verdict, Fate::Input | Fate::Reproduced) {
        parts.push(fate);
    }
    if !printed.note.is_empty() {
        parts.push(printed.note.to_owned());
    }
    parts.join(": ")
}

/// Six significant digits, without trailing zeros.
fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = 5 - value.abs().log10().floor() as i32;
    if (0..=9).contains(&digits) {
        let text = format!("{value:.*}", digits as usize);
        match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        }
    } else {
        format!("{value:e}")
    }
}
