//! Headers by which a table counts cycles in multiples: `Lastwechsel [1E6]`.

use super::{ImportError, Sheet, cell_name, units};
use crate::measure::names;

/// More revolutions than any test has: a factor that was multiplied in already.
const MOST: f64 = 1e10;

/// The revolutions that a count below such a header stands for.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Multiple {
    factor: f64,
    /// The header as it is written, and its cell.
    written: String,
    cell: String,
}

impl Multiple {
    /// Of the header in a row and column; none if it does not name cycles with a power of ten in brackets.
    pub(super) fn of(written: &str, row: usize, column: usize) -> Option<Self> {
        Some(Self {
            factor: factor(written)?,
            written: written.to_owned(),
            cell: cell_name(row, column),
        })
    }

    /// The sheet without the power of ten of the header in row `head` or above it, and what it was.
    pub(super) fn taken(sheet: &Sheet, head: usize) -> Option<(Sheet, Self)> {
        let rows = sheet.rows.iter().enumerate().take(head + 1);
        let mut cells = rows.flat_map(|(row, cells)| {
            cells
                .iter()
                .enumerate()
                .map(move |(column, text)| (row, column, text))
        });
        let (row, column, multiple) = cells
            .find_map(|(row, column, text)| Some((row, column, Self::of(text, row, column)?)))?;
        let mut sheet = sheet.clone();
        let text = &mut sheet.rows[row][column];
        let open = text.rfind(['[', '('])?;
        // above the header it names what stands below in the header itself
        text.truncate(if row < head { 0 } else { open });
        text.truncate(text.trim_end().len());
        Some((sheet, multiple))
    }

    /// The revolutions that a count stands for.
    ///
    /// # Errors
    /// [`ImportError`] if no test has so many.
    pub(super) fn revolutions(&self, count: f64) -> Result<f64, ImportError> {
        let revolutions = super::numbers::rounded(self.factor * count);
        if revolutions <= MOST {
            return Ok(revolutions);
        }
        Err(ImportError(format!(
            "{}: `{}`: {count} would be {revolutions:e} revolutions: are they written in full below it? Then take the power of ten out",
            self.cell, self.written
        )))
    }

    /// Whether it counts revolutions of the gear.
    pub(super) fn is_of_gear(&self) -> bool {
        names::counts_gear_revolutions(&self.written)
    }

    /// How it is read.
    pub(super) fn said(&self) -> String {
        format!(
            "`{}`: each 1 stands for {} revolutions",
            self.written, self.factor
        )
    }
}

/// The factor of a header that names cycles with a power of ten, or a word for one, in its last brackets.
pub(super) fn factor(header: &str) -> Option<f64> {
    let unit: String = units::bracketed(header)?.split_whitespace().collect();
    let (name, _) = units::name_and_unit(header);
    let names_cycles = names::words(&name)
        .iter()
        .any(|word| names::revolutions(word).is_some());
    names_cycles.then(|| of_unit(&unit)).flatten()
}

/// The factor of `1E6`, `10^6`, `x10^6`, `10⁶`, `Mio.`
fn of_unit(unit: &str) -> Option<f64> {
    let unit = unit.to_lowercase();
    let unit = unit
        .trim_start_matches(['x', '*', '\u{d7}', '\u{b7}'])
        .trim_end_matches('.');
    if let "mio" | "million" | "millions" | "millionen" = unit {
        return Some(1e6);
    }
    if let "tsd" | "thousand" | "thousands" | "tausend" = unit {
        return Some(1e3);
    }
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| match RAISED.iter().position(|raised| *raised == c) {
        Some(digit) => char::from_digit(digit as u32, 10).unwrap_or(c),
        None => c,
    };
    let raised = (unit.strip_prefix("10")).filter(|rest| rest.starts_with(RAISED));
    let power = match raised {
        Some(rest) => rest.chars().map(digit).collect(),
        None => {
            let starts = ["10^", "10**", "1e"];
            starts
                .iter()
                .find_map(|start| unit.strip_prefix(start))?
                .to_owned()
        }
    };
    let power: i32 = power.trim_start_matches('+').parse().ok()?;
    (1..=9).contains(&power).then(|| 10f64.powi(power))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_in_brackets_are_factors_of_cycles() {
        for (header, expected) in [
            ("Lastwechsel [1E6]", Some(1e6)),
            ("Lastwechsel [10^6]", Some(1e6)),
            ("load cycles (x 10^3)", Some(1e3)),
            ("cycles [10\u{2076}]", Some(1e6)),
            ("Lastspiele [Mio.]", Some(1e6)),
            ("cycles [thousand]", Some(1e3)),
            ("Lastwechsel", None),
            ("Lastwechsel [-]", None),
            ("radius [1e6]", None),
            ("Lastwechsel [1E60]", None),
            ("Lastwechsel 1E6", None),
        ] {
            assert_eq!(factor(header), expected, "{header}");
        }
    }
}
