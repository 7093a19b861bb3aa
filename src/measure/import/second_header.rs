//! A row between the header of a wide table and its values: units of the columns, or the dates of measurement.

use super::numbers::{is_date, pointed};
use super::{ImportError, Sheet, cell_name, units};

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
        let begins_with_number = |row: usize| {
            let first = sheet.rows[row].first();
            first.is_some_and(|cell| pointed(cell).parse::<f64>().is_ok())
        };
        if !begins_with_number(first) || begins_with_number(between) || begins_with_number(head) {
            continue;
        }
        if is_of_dates(&sheet.rows[between]) {
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

/// Whether all but the first cell are dates or empty.
fn is_of_dates(cells: &[String]) -> bool {
    let mut dates = cells.iter().skip(1).filter(|cell| !cell.is_empty());
    dates.clone().next().is_some() && dates.all(|cell| is_date(cell))
}

fn is_of_units(cells: &[String]) -> bool {
    let mut named = cells.iter().filter(|cell| !cell.is_empty());
    named.clone().count() > 1 && named.all(|cell| units::is_unit(unit(cell)))
}

/// Without brackets.
fn unit(cell: &str) -> &str {
    units::bracketed(cell).unwrap_or(cell).trim()
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

    fn sheet(rows: &[&str]) -> Sheet {
        let cells = |row: &&str| row.split('|').map(str::to_owned).collect();
        Sheet {
            name: String::new(),
            rows: rows.iter().map(cells).collect(),
            without_result: None,
            plain_decimals: true,
        }
    }

    #[test]
    fn units_below_a_header_go_into_it_and_dates_are_passed_over() {
        let merged = |rows: &[&str]| merged(&sheet(rows)).map(|(sheet, _)| sheet.rows);
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
        // what the header states too; another one; words
        assert!(merged(&["Radius [mm]|1e5 [um]", "mm|um", "26|1.5"]).is_ok());
        assert!(merged(&["Radius [mm]|1e5 [mm]", "mm|um", "26|1.5"]).is_err());
        let words = ["Radius|80000", "mean of|three", "26.0|1.5"];
        assert_eq!(merged(&words).unwrap()[1], ["mean of", "three"]);
    }
}
