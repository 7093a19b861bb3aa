//! The checkpoint of the new parts among those of a header: `neu; 40000; 100000` begins at 0.

use super::numbers::number_words;
use super::wide::is_aside;
use super::{Sheet, cell_name};
use crate::measure::names::{self, When};

/// The sheet with 0 instead of such a word, and what is said of it.
pub(super) fn as_zero(sheet: &Sheet) -> (Sheet, Option<String>) {
    let found = (0..sheet.rows.len()).find_map(|row| Some((row, word(&sheet.rows[row])?)));
    let Some((row, column)) = found else {
        return (sheet.clone(), None);
    };
    let mut own = sheet.clone();
    let written = std::mem::replace(&mut own.rows[row][column], "0".to_owned());
    let said = format!("{}, `{written}`: 0 cycles", cell_name(row, column));
    (own, Some(said))
}

/// The column of the word in a row that is a header with it.
fn word(cells: &[String]) -> Option<usize> {
    let headers = cells.iter().enumerate().skip(1);
    let headers = headers.filter(|(_, cell)| !cell.is_empty() && !is_aside(cell));
    let is_new = |cell: &str| names::time_alone(cell) == Some(When::Before);
    let (words, numbers): (Vec<_>, Vec<_>) = headers.partition(|(_, cell)| is_new(cell));
    let [(column, _)] = words[..] else {
        return None;
    };
    let is_count = |(_, cell): &(usize, &String)| number_words(cell).len() == 1;
    let names_rows = (cells.first()).is_some_and(|first| number_words(first).is_empty());
    (names_rows && !numbers.is_empty() && numbers.iter().all(is_count)).then_some(column)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_for_new_parts_among_checkpoints_is_0() {
        let zero = |row: &str| as_zero(&Sheet::of_rows(&[row])).0.rows[0].clone();
        assert_eq!(zero("Radius [mm]|neu|40000|1e5")[1], "0");
        assert_eq!(zero("Raggio [mm]|nuovo|40000")[1], "0");
        // what is no header of checkpoints, one with two such words
        for row in [
            "Radius [mm]|new|worn",
            "Radius [mm]|new|start|1e5",
            "26.0|new|3",
            "Radius [mm]|new",
        ] {
            assert!(!zero(row).contains(&"0".to_owned()), "{row}");
        }
    }
}
