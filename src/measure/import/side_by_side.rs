//! Several wide tables side by side on one sheet, `Radius [mm]; 1e5; 2e5; ; Radius [mm]; 1e5; 2e5`: of the pinion and the gear, or of several tests.

use super::arrange::side;
use super::numbers::has_one_number;
use super::{Sheet, cell_name, units};
use crate::measure::names;

/// A sheet of each, beginning in its first column, with what its columns are called in the whole; none for other sheets.
///
/// A row above the header that says something at the first table alone is said of all.
pub fn side_by_side(sheet: &Sheet) -> Option<Vec<(String, Sheet)>> {
    let (head, starts) =
        (sheet.rows.iter().enumerate()).find_map(|(row, cells)| Some((row, starts(cells)?)))?;
    let width = sheet.rows.iter().map(Vec::len).max()?;
    let ends = starts.iter().copied().skip(1).chain([width]);
    let parts = starts.iter().zip(ends).map(|(&start, end)| {
        let rows = sheet.rows.iter().enumerate().map(|(row, cells)| {
            let is_of_all = row < head && last_filled(cells).is_none_or(|last| last < starts[1]);
            let from = if is_of_all { 0 } else { start };
            let to = from + end - start;
            cells[from.min(cells.len())..to.min(cells.len())].to_vec()
        });
        let own = Sheet {
            rows: rows.collect(),
            ..sheet.clone()
        };
        let last = own.rows[head..]
            .iter()
            .filter_map(|cells| last_filled(cells));
        let last = last.max().unwrap_or(0);
        let columns = format!("columns {} to {}", letters(start), letters(start + last));
        let columns = match start {
            0 => columns,
            _ => format!("{columns}, counted from A"),
        };
        (columns, own)
    });
    Some(parts.collect())
}

/// The letters of a column.
pub(super) fn letters(column: usize) -> String {
    cell_name(0, column).trim_end_matches('1').to_owned()
}

fn last_filled(cells: &[String]) -> Option<usize> {
    cells.iter().rposition(|cell| !cell.is_empty())
}

/// The columns of a header that name places, from the first on, where there are several with one number or more behind each.
fn starts(cells: &[String]) -> Option<Vec<usize>> {
    let is_of_places =
        |cell: &str| names::column(&units::name_and_unit(cell).0) == Some("position");
    // `Radius pinion [mm]` too
    let names_places = |cell: &String| {
        is_of_places(cell) || side(cell).is_some_and(|(_, rest)| is_of_places(&rest))
    };
    if !names_places(cells.first()?) {
        return None;
    }
    let places = (0..cells.len()).filter(|at| names_places(&cells[*at]));
    let places: Vec<usize> = places.collect();
    let ends = places.iter().copied().skip(1).chain([cells.len()]);
    let is_table = |(start, end): (&usize, usize)| {
        let behind = cells[start + 1..end].iter();
        let mut filled = behind.filter(|cell| !cell.is_empty()).peekable();
        filled.peek().is_some() && filled.all(|cell| has_one_number(cell))
    };
    (places.len() > 1 && places.iter().zip(ends).all(is_table)).then_some(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_table_has_its_own_rows_and_what_is_said_of_all() {
        let both = Sheet::of_rows(&[
            "Run A",
            "Pinion||||Gear",
            "Radius [mm]|1e5|2e5||Radius [mm]|1e5",
            "26|3|4||52|1",
            "27|2|3",
        ]);
        let parts = side_by_side(&both).unwrap();
        let [(first, pinion), (second, gear)] = &parts[..] else {
            panic!("{parts:?}")
        };
        assert_eq!(first, "columns A to C");
        assert_eq!(second, "columns E to F, counted from A");
        assert_eq!(pinion.rows[0], ["Run A"]);
        assert_eq!(pinion.rows[1], ["Pinion", "", "", ""]);
        assert_eq!(pinion.rows[3], ["26", "3", "4", ""]);
        assert_eq!(gear.rows[0], ["Run A"]);
        assert_eq!(gear.rows[1], ["Gear"]);
        assert_eq!(gear.rows[2], ["Radius [mm]", "1e5"]);
        assert!(gear.rows[4].is_empty());
        let named = "Diametro pignone [mm]|1e5|2e5||Radius gear [mm]|1e5";
        let parts = side_by_side(&Sheet::of_rows(&[named])).unwrap();
        assert_eq!(parts[1].1.rows[0], ["Radius gear [mm]", "1e5"]);
        let blanks = "Rayon pignon (mm)|60 000|300 000 tours|Rayon roue (mm)|60 000|300 000 tours";
        assert!(side_by_side(&Sheet::of_rows(&[blanks])).is_some());
        for other in [
            "Radius [mm]|1e5|2e5",
            "Radius [mm]|depth pinion|Radius [mm]|depth gear",
            "Radius [mm]|Roll angle|1e5",
        ] {
            assert!(side_by_side(&Sheet::of_rows(&[other])).is_none(), "{other}");
        }
    }
}
