//! Two columns of one part, one of the new state and one of the worn: what is taken from what.

use super::intervals::{self, Weighed};
use crate::measure::import::columns::{Column, What};
use crate::measure::import::numbers::{has_decimal_commas, number, pointed, with_points};
use crate::measure::import::{Decimal, ImportError, Sheet, Wanted};
use crate::measure::names::When;

/// Decimals that are written at least: with three `1.234` could be a thousand.
const DECIMALS: usize = 4;

/// The two columns.
pub(super) struct Pair {
    pub(super) before: Column,
    pub(super) after: Column,
}

/// What stands in both of them in a row.
pub(super) struct Reading {
    pub(super) row: usize,
    pub(super) before: f64,
    pub(super) after: f64,
    /// Decimals as written, of the one that has more.
    pub(super) decimals: usize,
}

/// What was lost since the new state.
pub(super) struct Losses {
    /// Of each row in which both stand.
    pub(super) lost: Vec<(Reading, f64)>,
    /// The rows of each group that was measured before and after each interval, in the order of the stops.
    pub(super) stops: Vec<Vec<usize>>,
    /// Whether some were measured since the new state.
    pub(super) since_new: bool,
}

/// How a group of readings was measured; may put it in order.
type How = fn(&mut Vec<usize>, &[Reading], &Pair) -> Result<Weighed, ImportError>;

/// The one column that is something; none where several are.
pub(super) fn only(columns: &[Column], what: What) -> Option<&Column> {
    let mut found = columns.iter().filter(|column| column.what == what);
    let first = found.next();
    first.filter(|_| found.next().is_none())
}

impl Pair {
    /// The columns of the two measurements, each of which `what` tells; none unless there is one of each.
    pub(super) fn of(columns: &[Column], what: impl Fn(When) -> What) -> Option<Self> {
        Some(Self {
            before: only(columns, what(When::Before))?.clone(),
            after: only(columns, what(When::After))?.clone(),
        })
    }

    /// Refuses two units.
    pub(super) fn in_one_unit(&self, head: usize) -> Result<(), ImportError> {
        if self.before.unit == self.after.unit {
            return Ok(());
        }
        Err(ImportError(format!(
            "{} and {} are in two units",
            self.before.cell(head),
            self.after.cell(head)
        )))
    }

    /// What the rows have lost, each group of those that agree in some columns by itself.
    pub(super) fn losses(
        &self,
        sheet: &Sheet,
        head: usize,
        by: (&[&str], &Wanted<'_>),
        how: How,
    ) -> Result<Losses, ImportError> {
        self.in_one_unit(head)?;
        let readings = self.readings(sheet, head, by.1)?;
        let mut lost: Vec<f64> = readings.iter().map(|r| r.before - r.after).collect();
        let mut stops = Vec::new();
        let mut since_new = false;
        for mut group in intervals::groups(sheet, head, &readings, by) {
            match how(&mut group, &readings, self)? {
                Weighed::SinceNew => since_new = true,
                Weighed::AtEachStop => {
                    let first = readings[group[0]].before;
                    for &n in &group {
                        lost[n] = first - readings[n].after;
                    }
                    stops.push(group.iter().map(|&n| readings[n].row).collect());
                }
            }
        }
        Ok(Losses {
            lost: readings.into_iter().zip(lost).collect(),
            stops,
            since_new,
        })
    }

    /// The rows in which both stand.
    pub(super) fn readings(
        &self,
        sheet: &Sheet,
        head: usize,
        wanted: &Wanted<'_>,
    ) -> Result<Vec<Reading>, ImportError> {
        let places = [self.before.at, self.after.at];
        let counts = |row, column| row > head && places.contains(&column);
        let read = with_points(sheet, wanted.decimal, counts, |_, _, _| false)?;
        let text = |sheet: &Sheet, row: usize, at: usize| -> String {
            sheet.rows[row].get(at).cloned().unwrap_or_default()
        };
        let mut readings = Vec::new();
        for row in head + 1..sheet.rows.len() {
            let written = places.map(|at| text(sheet, row, at));
            if written.iter().any(String::is_empty) {
                continue;
            }
            let [before, after] = places.map(|at| pointed(&text(&read, row, at)));
            let decimals = |text: &str| text.split_once('.').map_or(0, |(_, d)| d.len());
            readings.push(Reading {
                row,
                decimals: decimals(&before).max(decimals(&after)),
                before: number(&before, row, self.before.at)?,
                after: number(&after, row, self.after.at)?,
            });
        }
        Ok(readings)
    }

    /// Puts what was lost in the place of the worn state, under another name; rows that lack one of the two lose the other.
    pub(super) fn put_losses(
        &self,
        sheet: &mut Sheet,
        head: usize,
        name: &str,
        lost: &[(Reading, f64)],
        wanted: &Wanted<'_>,
    ) {
        // with the mark of the others, by which all numbers of the table are read
        let has_commas = match wanted.decimal {
            Some(decimal) => decimal == Decimal::Comma,
            None => has_decimal_commas(sheet, head),
        };
        for row in sheet.rows.iter_mut().skip(head) {
            for at in [self.before.at, self.after.at] {
                if let Some(cell) = row.get_mut(at) {
                    cell.clear();
                }
            }
        }
        for (reading, lost) in lost {
            let decimals = reading.decimals.max(DECIMALS);
            let text = format!("{lost:.decimals$}");
            sheet.rows[reading.row][self.after.at] = match has_commas {
                true => text.replace('.', ","),
                false => text,
            };
        }
        sheet.rows[head][self.after.at] = match &self.after.unit {
            Some(unit) => format!("{name} [{unit}]"),
            None => name.to_owned(),
        };
    }
}
