//! A column of standard deviations beside the checkpoints or places of a wide table: each is that of all values of its row.

use super::columns::{Column, What};
use super::entry::Entry;
use super::numbers::{number, pointed, rounded};
use super::wanted::Wanted;
use super::{ImportError, Sheet, sigma_unit, wide};
use crate::measure::{Quantity, names};
use crate::numeric::written;

type Result<T> = std::result::Result<T, ImportError>;

/// Such a column, out of its table.
pub(super) struct RowSigmas {
    column: Column,
    head: usize,
    /// What stands in it, of each row of the sheet.
    cells: Vec<String>,
}

/// Whether a header is that of a column of standard deviations.
pub(super) fn is_one(header: &str) -> bool {
    Column::of(0, header).what == What::Own("sigma")
}

impl RowSigmas {
    /// The column of a sheet, which is emptied; none where no header names one, or where it is a statistic of the other columns.
    ///
    /// # Errors
    /// [`ImportError`] where two columns name one, or the user states a standard deviation too.
    pub(super) fn taken(
        sheet: &mut Sheet,
        head: usize,
        wanted: &Wanted<'_>,
    ) -> Result<Option<Self>> {
        let headers = sheet.rows[head].iter().enumerate().skip(1);
        let columns = headers.map(|(at, header)| Column::of(at, header));
        let mut columns = columns.filter(|column| column.what == What::Own("sigma"));
        let Some(column) = columns.next() else {
            return Ok(None);
        };
        if let Some(other) = columns.next() {
            return Err(ImportError(format!(
                "{} and {} both look like the standard deviation of the values of a row: call one `comment`, by which it is passed over",
                column.cell(head),
                other.cell(head)
            )));
        }
        if sums_up(sheet, head, column.at) {
            return Ok(None);
        }
        if wanted.states_sigma() && !wanted.sigma_of_others {
            return Err(ImportError(format!(
                "--sigma or --relative-sigma: the table has a column of sigma, {}; leave the option out, or call the column `comment`, by which it is \
                 passed over",
                column.cell(head)
            )));
        }
        let take = |row: &mut Vec<String>| row.get_mut(column.at).map(std::mem::take);
        let cells = sheet.rows.iter_mut().enumerate().map(|(row, cells)| {
            let own = (row >= head).then(|| take(cells)).flatten();
            own.unwrap_or_default()
        });
        Ok(Some(Self {
            cells: cells.collect(),
            column,
            head,
        }))
    }

    /// Gives the entries those of their rows, where the values are in `unit`, and says so.
    pub(super) fn state(
        &self,
        entries: &mut [Entry],
        (quantity, unit): (Quantity, &str),
        wanted: &Wanted<'_>,
    ) -> Result<String> {
        let at = (self.head, quantity);
        let factor = sigma_unit::factor(&self.column, Some(unit), at, wanted)?;
        for entry in entries {
            let (row, _) = entry.cell;
            let text = self.cells[row].as_str();
            if !text.is_empty() {
                entry.sigma = Some(rounded(factor * number(text, row, self.column.at)?));
            }
        }
        let own = self.column.unit.as_deref().unwrap_or(unit);
        let over = match self.column.coverage.filter(|k| *k != 1.0) {
            Some(k) => format!("an expanded uncertainty, over k = {k} "),
            None => String::new(),
        };
        Ok(format!(
            "`{}`: {over}the standard deviation of all values of its row, in {}",
            self.column.written,
            written::unit(own)
        ))
    }
}

/// Whether a column stands among means and extremes, or holds the standard deviations of the numbers of its rows: a statistic of the other columns.
fn sums_up(sheet: &Sheet, head: usize, at: usize) -> bool {
    let others = || (1..sheet.rows[head].len()).filter(|other| *other != at);
    let is_aside = |column: &usize| wide::is_aside(&sheet.rows[head][*column]);
    let is_statistic = |column: usize| names::is_statistic(&sheet.rows[head][column]);
    if others().any(is_statistic) {
        return true;
    }
    let parsed = |row: &[String], column: usize| pointed(row.get(column)?).parse::<f64>().ok();
    let mut rows = sheet.rows[head + 1..].iter().filter_map(|row| {
        let values = others().filter(|column| !is_aside(column));
        let values: Vec<f64> = values.filter_map(|column| parsed(row, column)).collect();
        let own = parsed(row, at)?;
        (values.len() > 1).then(|| is_deviation_of(&values, own, &row[at]))
    });
    rows.next()
        .is_some_and(|first| first && rows.all(|is_one| is_one))
}

/// Whether a number is the standard deviation of others to within its rounding, of a sample or of all.
fn is_deviation_of(values: &[f64], own: f64, text: &str) -> bool {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let decimals = pointed(text)
        .rsplit_once('.')
        .map_or(0, |(_, digits)| digits.len());
    let rounding = 0.5 * 10f64.powi(-(decimals as i32));
    [count - 1.0, count].iter().any(|by| {
        let deviation = (squares / by).sqrt();
        (deviation - own).abs() <= rounding + 1e-6 * deviation
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn standard_deviations_of_the_other_columns_are_a_statistic() {
        let sheet = |rows: [[&str; 4]; 3]| Sheet {
            name: String::new(),
            rows: rows.map(|row| row.map(str::to_owned).to_vec()).to_vec(),
            without_result: None,
            plain_decimals: true,
            said: Vec::new(),
        };
        let header = ["r", "1e5", "2e5", "std"];
        // 1 and 3: 1.414 of a sample, 1 of all
        let of_sample = [header, ["26", "1", "3", "1.41"], ["27", "2", "4", "1.41"]];
        let of_all = [header, ["26", "1", "3", "1"], ["27", "2", "4", "1"]];
        let stated = [header, ["26", "1", "3", "0.15"], ["27", "2", "4", "0.2"]];
        let beside_mean = [
            ["r", "1e5", "mean", "std"],
            ["26", "1", "3", "0.15"],
            ["27", "2", "4", "0.2"],
        ];
        for (rows, expected) in [
            (of_sample, true),
            (of_all, true),
            (stated, false),
            (beside_mean, true),
        ] {
            assert_eq!(sums_up(&sheet(rows), 0, 3), expected, "{rows:?}");
        }
    }
}
