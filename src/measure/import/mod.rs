//! Tables that are no measurement file yet, from a spreadsheet or a text, as rows of one: a row for each value, or a column for each
//! checkpoint or place.
//!
//! ```text
//! .xlsx or text -> sheets of cells (cells) -> a row for each value (arrange, long, columns), or a column for each checkpoint or place (wide, whole, tests_in_headers, counts)
//!               -> entries (entry) -> measurements.csv
//! ```

mod append;
mod arrange;
mod cell_sigmas;
mod cells;
mod checkpoints_above;
mod checkpoints_across;
mod columns;
mod conditions_above;
mod counts;
mod coverage;
mod decimal_commas;
mod deviations;
mod entry;
mod exchanged;
mod flank;
mod footers;
mod header_points;
mod labelled_blocks;
mod long;
mod means;
mod multiples;
mod nameless;
mod new_parts;
mod no_value_words;
mod no_values;
mod numbers;
mod other_values;
mod per_interval;
mod place;
mod repeats;
mod row_sigmas;
mod second_header;
mod side_by_side;
mod sigma_unit;
mod sigmas;
mod teeth_across;
mod tests_in_headers;
mod there;
mod titles;
mod units;
mod wanted;
mod weighings_across;
mod whole;
mod wide;
mod xlsx;

pub use append::appended;
pub use cells::{Sheet, sheets};
pub use checkpoints_above::checkpoints_above;
pub use checkpoints_across::checkpoints_across;
pub use entry::{Entry, lines};
pub use labelled_blocks::labelled_blocks;
pub use long::{Long, long};
pub use no_value_words::without_words;
pub use numbers::Decimal;
pub use per_interval::PerInterval;
pub use place::PositionKind;
pub use repeats::doubtful;
pub use side_by_side::side_by_side;
pub use tests_in_headers::wide;
pub use there::There;
pub use titles::Titles;
pub use units::factor;
pub use wanted::{ShareOf, UnitFrom, Wanted};
pub use weighings_across::weighings_across;
pub use wide::{Across, Wide};

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
