//! Tables that are no measurement file yet: a column for each checkpoint or for each radius, from a spreadsheet or a text, as rows of one.
//!
//! ```text
//! .xlsx or text -> sheets of cells (cells) -> which cell is what (wide; rows where it is a measurement file) -> measurements.csv
//! ```

mod cells;
mod numbers;
mod rows;
mod units;
mod wide;
mod xlsx;

pub use cells::{Sheet, sheets};
pub use numbers::Decimal;
pub use rows::as_measurements;
pub use units::factor;
pub use wide::{Across, Mapping, PositionKind, Wanted, map};

/// Why a table cannot be read as measurements: what is wrong, where, and what to do.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ImportError(pub String);

/// The name of a cell as spreadsheets write it, of a row and a column counted from 0: `B3`.
fn cell_name(row: usize, column: usize) -> String {
    let mut letters = Vec::new();
    let mut rest = column + 1;
    while rest > 0 {
        letters.push(char::from(b'A' + ((rest - 1) % 26) as u8));
        rest = (rest - 1) / 26;
    }
    let letters: String = letters.into_iter().rev().collect();
    format!("{letters}{}", row + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_named_as_in_a_spreadsheet() {
        for (row, column, name) in [
            (0, 0, "A1"),
            (2, 25, "Z3"),
            (9, 26, "AA10"),
            (0, 701, "ZZ1"),
        ] {
            assert_eq!(cell_name(row, column), name);
        }
    }
}
