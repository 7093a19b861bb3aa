//! Standard deviations of single values of a wide table: in the values' own cells, `3.08 ± 0.11`, or in a column beside that of each checkpoint.

use std::collections::HashMap;

use super::columns::Column;
use super::entry::Entry;
use super::numbers::{number, number_words, pointed, rounded};
use super::wanted::Wanted;
use super::{ImportError, Sheet, cell_name, row_sigmas, sigma_unit, units};
use crate::measure::Quantity;
use crate::numeric::written;

type Result<T> = std::result::Result<T, ImportError>;

/// Signs between a value and its standard deviation.
const SIGNS: [&str; 3] = ["\u{b1}", "+/-", "+-"];

/// Such standard deviations, out of their table.
pub(super) struct CellSigmas {
    /// As written, with where they stand, by the cell of the value.
    of: HashMap<(usize, usize), (String, (usize, usize))>,
    /// Row of the header.
    head: usize,
    /// The columns beside those of the values, if they stand there.
    columns: Vec<Column>,
    said: String,
}

/// Whether a header is nothing but the sign.
pub(super) fn is_sign(header: &str) -> bool {
    SIGNS.contains(&header.trim())
}

/// A value and its standard deviation in one cell.
pub(super) fn in_one_cell(cell: &str) -> Option<(&str, &str)> {
    let (value, sigma) = SIGNS.iter().find_map(|sign| cell.split_once(sign))?;
    let (value, sigma) = (value.trim(), sigma.trim());
    let is_number = |text: &str| pointed(text).parse::<f64>().is_ok();
    (is_number(value) && is_number(sigma)).then_some((value, sigma))
}

impl CellSigmas {
    /// Those of a sheet, which keeps the values alone; none where there are none.
    ///
    /// # Errors
    /// [`ImportError`] where the user states a standard deviation too.
    pub(super) fn taken(
        sheet: &mut Sheet,
        head: usize,
        wanted: &Wanted<'_>,
    ) -> Result<Option<Self>> {
        let found = in_cells(sheet, head).or_else(|| in_columns(sheet, head));
        let Some(found) = found else {
            return Ok(None);
        };
        if wanted.states_sigma() && !wanted.sigma_of_others {
            return Err(ImportError(format!(
                "--sigma or --relative-sigma: the table states them, {}; leave the option out",
                found.said
            )));
        }
        Ok(Some(found))
    }

    /// Gives them to the entries of their cells, where the values are in `unit`, and says so.
    pub(super) fn state(
        &self,
        entries: &mut [Entry],
        (quantity, unit): (Quantity, &str),
        wanted: &Wanted<'_>,
    ) -> Result<String> {
        let of_values = units::factor(unit, quantity)?;
        let factor = |at: usize| {
            let column = self.columns.iter().find(|column| column.at == at);
            match column.filter(|column| !is_sign(&column.written)) {
                Some(column) => {
                    sigma_unit::factor(column, Some(unit), (self.head, quantity), wanted)
                }
                None => Ok(of_values),
            }
        };
        for entry in entries {
            if let Some((text, (row, column))) = self.of.get(&entry.cell) {
                entry.sigma = Some(rounded(factor(*column)? * number(text, *row, *column)?));
            }
        }
        let first = self.columns.first();
        let own = first.and_then(|column| column.unit.as_deref());
        let unit = written::unit(own.unwrap_or(unit));
        let coverage = first.and_then(|column| column.coverage);
        Ok(match coverage.filter(|k| *k != 1.0) {
            Some(k) => format!(
                "{}: an expanded uncertainty, over k = {k}, in {unit}",
                self.said
            ),
            None => format!("{}: one standard deviation, in {unit}", self.said),
        })
    }
}

/// Those behind a sign in the values' own cells.
fn in_cells(sheet: &mut Sheet, head: usize) -> Option<CellSigmas> {
    let mut of = HashMap::new();
    let mut said = None;
    for (row, cells) in sheet.rows.iter_mut().enumerate().skip(head + 1) {
        for (column, cell) in cells.iter_mut().enumerate().skip(1) {
            let Some((value, sigma)) = in_one_cell(cell) else {
                continue;
            };
            let place = (row, column);
            said.get_or_insert_with(|| {
                format!("{}: `{cell}`, behind the sign", cell_name(row, column))
            });
            of.insert(place, (sigma.to_owned(), place));
            *cell = value.to_owned();
        }
    }
    said.map(|said| CellSigmas {
        of,
        head,
        columns: Vec::new(),
        said,
    })
}

/// Those of a column beside that of each checkpoint or place.
fn in_columns(sheet: &mut Sheet, head: usize) -> Option<CellSigmas> {
    let header = sheet.rows[head].clone();
    let is_sigma = |at: usize| header.get(at).is_some_and(|cell| row_sigmas::is_one(cell));
    let is_value = |at: usize| {
        let cell = &header[at];
        !is_sigma(at) && number_words(cell).len() == 1
    };
    let values: Vec<usize> = (1..header.len()).filter(|at| is_value(*at)).collect();
    if values.len() < 2 || !values.iter().all(|at| is_sigma(at + 1)) {
        return None;
    }
    let mut of = HashMap::new();
    for (row, cells) in sheet.rows.iter_mut().enumerate().skip(head) {
        for &at in &values {
            let taken = cells.get_mut(at + 1).map(std::mem::take);
            let taken = taken.filter(|text| row > head && !text.is_empty());
            if let Some(text) = taken {
                of.insert((row, at), (text, (row, at + 1)));
            }
        }
    }
    let first = cell_name(head, values[0] + 1);
    let beside = values.iter().map(|at| at + 1);
    Some(CellSigmas {
        of,
        head,
        columns: beside.map(|at| Column::of(at, &header[at])).collect(),
        said: format!("{first}: `{}`, a column beside each", header[values[0] + 1]),
    })
}

/// Makes a column of those behind a sign in the cells of the one column of a long table that has any, and says so.
pub(super) fn as_column(sheet: &mut Sheet, head: usize) -> Option<String> {
    let rows = sheet.rows.iter().enumerate().skip(head + 1);
    let cells = rows.flat_map(|(row, cells)| {
        let cells = cells.iter().enumerate();
        cells.map(move |(at, cell)| ((row, at), cell))
    });
    let mut found: Vec<((usize, usize), String, String)> = Vec::new();
    for (place, cell) in cells {
        if let Some((value, sigma)) = in_one_cell(cell) {
            found.push((place, value.to_owned(), sigma.to_owned()));
        }
    }
    let &((row, at), ..) = found.first()?;
    let header = &sheet.rows[head];
    let name = header.get(at).filter(|name| !name.is_empty())?;
    let is_stated = header.iter().any(|name| row_sigmas::is_one(name));
    if is_stated || found.iter().any(|((_, other), ..)| *other != at) {
        return None;
    }
    let sigma = match units::name_and_unit(name).1 {
        Some(unit) => format!("sigma [{unit}]"),
        None => "sigma".to_owned(),
    };
    let said = format!(
        "{}: `{}`, behind the sign: one standard deviation",
        cell_name(row, at),
        sheet.rows[row][at]
    );
    let width = sheet.rows.iter().map(Vec::len).max().unwrap_or(0);
    for ((row, at), value, sigma) in found {
        sheet.rows[row][at] = value;
        sheet.rows[row].resize(width, String::new());
        sheet.rows[row].push(sigma);
    }
    sheet.rows[head].resize(width, String::new());
    sheet.rows[head].push(sigma);
    Some(said)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behind_a_sign_or_in_a_column_beside_each_value() {
        let mut signs = Sheet::of_rows(&["r|1e5|2e5", "26|3,08 \u{b1} 0,11|4.1+/-0.2", "27|3|"]);
        let found = in_cells(&mut signs, 0).unwrap();
        assert_eq!(signs.rows[1], ["26", "3,08", "4.1"]);
        assert_eq!(found.of[&(1, 1)].0, "0,11");
        assert_eq!(found.of[&(1, 2)].0, "0.2");
        assert_eq!(found.of.len(), 2);
        let mut columns = Sheet::of_rows(&["r|1e5|\u{b1}|2e5|\u{b1}", "26|3|0.1|4|0.2"]);
        assert!(in_cells(&mut columns, 0).is_none());
        let found = in_columns(&mut columns, 0).unwrap();
        assert_eq!(columns.rows[0], ["r", "1e5", "", "2e5", ""]);
        assert_eq!(found.of[&(1, 3)].0, "0.2");
        let mut long = Sheet::of_rows(&["radius|depth [um]|note", "26|3.1\u{b1}0.1|", "27|3|late"]);
        assert!(as_column(&mut long, 0).is_some());
        assert_eq!(long.rows[0][3], "sigma [um]");
        assert_eq!(long.rows[1], ["26", "3.1", "", "0.1"]);
        // one for all values of a row; a range; a name
        assert!(in_columns(&mut Sheet::of_rows(&["r|1e5|2e5|std", "26|3|4|0.2"]), 0).is_none());
        assert!(in_cells(&mut Sheet::of_rows(&["r|1e5", "26|3 - 4"]), 0).is_none());
        assert!(in_cells(&mut Sheet::of_rows(&["r|1e5", "26|a \u{b1} b"]), 0).is_none());
    }
}
