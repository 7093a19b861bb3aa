//! A row between the header of a table and its values: units of the columns, or, of a wide table, the dates of measurement.

use super::numbers::{is_date, pointed};
use super::{ImportError, Sheet, cell_name, units};

/// What stands below the header of a column without a unit.
const NONE: &str = "-";

/// The sheet without such rows, units put into the headers above them, and what is said of each.
///
/// # Errors
/// [`ImportError`] where a header states one unit and the row below it another.
pub(super) fn merged(sheet: &Sheet) -> Result<(Sheet, Vec<String>), ImportError> {
    let mut sheet = sheet.clone();
    let mut said = Vec::new();
    let filled: Vec<usize> = (0..sheet.rows.len())
        .filter(|&row| sheet.rows[row].iter().any(|cell| !cell.is_empty()))
        .collect();
    for rows in filled.windows(3) {
        let [head, between, first] = [rows[0], rows[1], rows[2]];
        let begins_with_number =
            |row: usize| sheet.rows[row].first().is_some_and(|cell| is_number(cell));
        // the values of a long table begin with words
        let holds_number = sheet.rows[first].iter().any(|cell| is_number(cell));
        if !holds_number || begins_with_number(between) || begins_with_number(head) {
            continue;
        }
        if begins_with_number(first) && is_of_dates(&sheet.rows[between]) {
            said.push(format!("row {} holds dates: passed over", between + 1));
            sheet.rows[between].clear();
        } else if is_of_units(&sheet.rows[between]) {
            put_into_headers(&mut sheet, head, between)?;
            said.push(format!("row {} holds the columns' units", between + 1));
            sheet.rows[between].clear();
        }
    }
    Ok((sheet, said))
}

fn is_number(cell: &str) -> bool {
    pointed(cell).parse::<f64>().is_ok()
}

/// Whether all but the first cell are dates or empty.
fn is_of_dates(cells: &[String]) -> bool {
    let mut dates = cells.iter().skip(1).filter(|cell| !cell.is_empty());
    dates.clone().next().is_some() && dates.all(|cell| is_date(cell))
}

fn is_of_units(cells: &[String]) -> bool {
    let mut named = cells.iter().filter(|cell| !cell.is_empty());
    named.clone().count() > 1
        && named.clone().any(|cell| unit(cell) != NONE)
        && named.all(|cell| unit(cell) == NONE || units::is_unit(unit(cell)))
}

/// Without brackets around it.
fn unit(cell: &str) -> &str {
    let cell = cell.trim();
    let is_bracketed = cell.starts_with(['[', '(']);
    units::bracketed(cell)
        .filter(|_| is_bracketed)
        .unwrap_or(cell)
}

fn put_into_headers(sheet: &mut Sheet, head: usize, between: usize) -> Result<(), ImportError> {
    for (column, below) in sheet.rows[between].clone().iter().enumerate() {
        let Some(header) = sheet.rows[head].get_mut(column) else {
            continue;
        };
        if below.is_empty() || header.is_empty() {
            continue;
        }
        let below = unit(below);
        if below == NONE {
            continue;
        }
        match units::bracketed(header).filter(|stated| units::is_unit(stated)) {
            None => *header = format!("{header} [{below}]"),
            Some(stated) if units::are_same(stated, below) => {}
            Some(stated) => {
                return Err(ImportError(format!(
                    "{}: `{header}` is in {stated}, and `{below}` stands below it: leave the wrong one out",
                    cell_name(head, column)
                )));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_below_a_header_go_into_it_and_dates_are_passed_over() {
        let merged = |rows: &[&str]| merged(&Sheet::of_rows(rows)).map(|(sheet, _)| sheet.rows);
        let units = merged(&["Radius|80000|200000", "mm|\u{b5}m|\u{b5}m", "26.0|1.5|3.2"]).unwrap();
        assert_eq!(
            units[0],
            ["Radius [mm]", "80000 [\u{b5}m]", "200000 [\u{b5}m]"]
        );
        assert!(units[1].is_empty());
        let dates = [
            "Radius [mm]|1e5|2e5",
            "on|2025-03-01|2025-03-04",
            "26.0|1.5|3.2",
        ];
        assert!(merged(&dates).unwrap()[1].is_empty());
        let long = ["Run|Revs|Radius|Depth", "|-|mm|\u{b5}m", "A|80000|26.0|1.5"];
        assert_eq!(
            merged(&long).unwrap()[0],
            ["Run", "Revs", "Radius [mm]", "Depth [\u{b5}m]"]
        );
        // what the header states too; another one; words
        assert!(merged(&["Radius [mm]|1e5 [um]", "mm|um", "26|1.5"]).is_ok());
        assert!(merged(&["Radius [mm]|1e5 [mm]", "mm|um", "26|1.5"]).is_err());
        let words = ["Radius|80000", "mean of|three", "26.0|1.5"];
        assert_eq!(merged(&words).unwrap()[1], ["mean of", "three"]);
    }
}
