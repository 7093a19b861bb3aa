//! Long tables: a row for each value, with columns that say of which test, member, time and place it is.

mod checkpoints;
mod flanks;
mod line;
mod off_flank;
mod read_columns;
mod repeats;
mod stops;
mod traces;
mod weights;

use super::arrange::{Arranged, arranged, speed_passed_over};
use super::columns::{Column, What, columns, known_by_content, with_sides};
use super::entry::{Entry, state_face, state_sigma};
use super::flank::can_be_on_a_flank;
use super::numbers::{counts_without_thousands, with_points};
use super::titles::Titles;
use super::wanted::{UnitFrom, Wanted};
use super::{
    ImportError, Sheet, cell_name, conditions_above, counts, decimal_commas, deviations, multiples,
    nameless, no_values, second_header, teeth_across,
};
use crate::measure::{Quantity, names};
use line::Line;
use read_columns::{Read, single_quantity};

pub(super) use checkpoints::SAME;
pub(super) use weights::from_start;

/// What was understood of a long table, and its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Long {
    /// Row of the header, counted from 1.
    pub row: usize,
    /// What was made of the table before it was read, in words.
    pub arranged: Vec<String>,
    /// What is said of checkpoints that are those of rows that are there already.
    pub joined: Vec<String>,
    /// The columns that are read, as written, each with what it is.
    pub columns: Vec<(String, String)>,
    /// The columns that are passed over, each with the reason.
    pub passed_over: Vec<(String, String)>,
    /// The rows that are left out because the flank does not reach there, in words.
    pub left_out: Vec<String>,
    /// Unit of the values in the table, and what states it; none where a column says what each value is.
    pub unit: Option<(String, UnitFrom)>,
    /// What the rows above the header say.
    pub titles: Titles,
    /// Whether the signs of losses are turned.
    pub turned: bool,
    /// The flank on which the values were measured, if the table says it.
    pub flank: Option<String>,
    /// Where the names of traces come from.
    pub traces: &'static str,
    /// Rows without a value.
    pub empty: usize,
    /// Whether a column states the standard deviations.
    pub has_sigma: bool,
    /// Rows of a measurement file.
    pub entries: Vec<Entry>,
}

type Result<T> = std::result::Result<T, ImportError>;

/// The mapping of a long table; none for other tables.
///
/// # Errors
/// [`ImportError`] where a column is missing or stands twice, or a cell says nothing that can be read.
pub fn long(sheet: &Sheet, wanted: &Wanted<'_>) -> Result<Option<Long>> {
    if let Some(cell) = &sheet.without_result {
        return Err(ImportError(format!(
            "{cell}: a formula without a stored result: open the table in the spreadsheet program and save it, then its results stand in the file"
        )));
    }
    let before = sheet.said.clone();
    let (sheet, between) = second_header::merged(sheet)?;
    let (sheets, teeth) = match teeth_across::apart(&sheet) {
        Some((sheets, said)) => (sheets, Some(said)),
        None => (vec![sheet], None),
    };
    let tables = sheets.iter().map(|sheet| of_sheet(sheet, wanted));
    let tables: Option<Vec<Long>> = tables.collect::<Result<_>>()?;
    let joined = tables.and_then(|tables| tables.into_iter().reduce(Long::joined));
    Ok(joined.map(|long| Long {
        arranged: [before, between, teeth.into_iter().collect(), long.arranged].concat(),
        ..long
    }))
}

/// The mapping of a sheet with one header; none for other tables.
fn of_sheet(sheet: &Sheet, wanted: &Wanted<'_>) -> Result<Option<Long>> {
    let Some(Arranged {
        head,
        sheets,
        said,
        left_out,
        differences,
        weighed,
        stops,
    }) = arranged(sheet, wanted)?
    else {
        return Ok(None);
    };
    if wanted.across.is_some() {
        return Err(ImportError(format!(
            "--columns is for tables with a column for each checkpoint or place; row {} is the header of a table with a row for each value",
            head + 1
        )));
    }
    decimal_commas::refuse(sheet, head)?;
    let tables: Vec<Long> = sheets
        .iter()
        .zip(&stops)
        .map(|(own, stops)| of_columns((own, sheet, head), (differences, weighed, stops), wanted))
        .collect::<Result<_>>()?;
    let Some(joined) = tables.into_iter().reduce(Long::joined) else {
        return Ok(None);
    };
    let long = agreeing(joined, (sheet, head), wanted)?;
    Ok(Some(Long {
        arranged: [said, long.arranged].concat(),
        left_out: [left_out, long.left_out].concat(),
        ..long
    }))
}

/// A table that is refused where rows above its header state other gears than the study's, or conditions that are not those of its one test.
fn agreeing(mut long: Long, (sheet, head): (&Sheet, usize), wanted: &Wanted<'_>) -> Result<Long> {
    let test = the_one(long.entries.iter().map(|entry| entry.test.as_str()));
    let member = the_one(long.entries.iter().map(|entry| entry.member));
    let compared = conditions_above::agree(sheet, head, (test, member), wanted)?;
    let agreeing = long.titles.agreeing(&compared);
    long.arranged.extend(agreeing);
    Ok(long)
}

/// What all are, if they are the same.
fn the_one<T: PartialEq>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.all(|other| other == first).then_some(first)
}

/// The mapping of a table with a column for everything, made of a `whole` sheet.
fn of_columns(
    (sheet, whole, head): (&Sheet, &Sheet, usize),
    (differences, weighed, stops): (bool, bool, &[Vec<usize>]),
    wanted: &Wanted<'_>,
) -> Result<Long> {
    nameless::refuse_numbers(sheet, head, 0)?;
    let mut columns = columns(&sheet.rows[head]);
    known_by_content(&mut columns, sheet, head, wanted);
    repeats::by_content(&mut columns, sheet, head, wanted);
    let columns = columns;
    let read = Read::of(&columns, head, wanted)?;
    let numbers = [read.position, Some(read.value), read.sigma, read.face];
    let mut sheet = sheet.clone();
    let is_count = read.cycles.hours.is_none() && multiples::factor(&read.cycles.written).is_none();
    if is_count && wanted.decimal.is_none() {
        let others: Vec<usize> = numbers.iter().flatten().map(|read| read.at).collect();
        counts_without_thousands(&mut sheet, head, read.cycles.at, &others);
    }
    let counts = |row, column| row > head && numbers.iter().flatten().any(|read| read.at == column);
    let is_place = |_, column, number| {
        let quantity = match read.value.what {
            What::Values(quantity) => quantity,
            _ => wanted.quantity.unwrap_or(Quantity::WearDepth),
        };
        (read.position.filter(|position| position.at == column))
            .is_some_and(|position| can_be_on_a_flank(number, &position.written, quantity, wanted))
    };
    let sheet = &with_points(&sheet, wanted.decimal, counts, is_place)?;
    let single = match (read.quantity, read.value.what) {
        (Some(_), _) => None,
        (None, what) => Some(single_quantity(&read, what, wanted)?),
    };
    counts::refuse_multiples_above(sheet, head)?;
    let titles = Titles::of(
        sheet,
        head,
        single.unwrap_or(Quantity::WearDepth),
        &wanted.per_interval,
    )?;
    // what a deviation lost is positive whatever is said of the deviation's own sign, which has to be that of more material
    let stated = wanted.turn_sign || differences;
    let turned = titles.turns_sign(stated)? && !differences;
    let header = match sheet.rows[head] == whole.rows[head] {
        true => &columns,
        false => &with_sides(&whole.rows[head]),
    };
    read.nothing_missing(header, sheet, single, wanted)?;
    let line = |row: usize| Line {
        read: &read,
        sheet,
        row,
        wanted,
    };
    let mut empty = 0;
    let mut without_value = Vec::new();
    let mut entries = Vec::new();
    for (row, cells) in sheet.rows.iter().enumerate().skip(head + 1) {
        if cells.iter().all(String::is_empty) {
            continue;
        }
        if cells.get(read.value.at).is_none_or(String::is_empty) {
            empty += 1;
            without_value.push(row);
            continue;
        }
        entries.push(line(row).entry(single, &titles, turned)?);
    }
    if entries.is_empty() {
        return Err(ImportError(format!(
            "no row with a value below the header in row {}",
            head + 1
        )));
    }
    let (mut left_out, rows) = no_values::leave_out(&mut entries, sheet);
    without_value.extend(rows);
    if !wanted.per_interval.losses.is_empty() {
        read.no_interval_missing(sheet, &without_value, &entries)?;
    }
    let mut arranged: Vec<String> =
        stops::refuse_times_of_each(&entries, sheet, (&read, &columns), stops)?
            .into_iter()
            .filter(|_| !wanted.per_interval.cycles)
            .collect();
    if read.quantity.is_none()
        && let Some(of_masses) = weights::as_losses(&mut entries, &read, wanted)?
    {
        (wanted.per_interval).refuse_differences(&[Quantity::MassLoss])?;
        arranged.push(of_masses);
    }
    left_out.extend(off_flank::leave_out(&mut entries, line)?);
    let joined = wanted.there.join(&mut entries, false);
    arranged.extend(checkpoints::join(&mut entries));
    // of two deviations one has been taken from the other
    let is_depth = single == Some(Quantity::WearDepth) && !differences;
    let deviation = is_depth.then(|| deviations::of_column(read.value, head, wanted));
    if let Some(named) = deviation.flatten() {
        let states_sign = turned || titles.lost_is_negative.is_some();
        arranged.push(named.as_depths(&mut entries, (states_sign, turned), wanted)?);
    }
    let flank = flanks::only(sheet, head, &columns, &entries)?;
    let traces = traces::name(&mut entries, &read, wanted)?;
    if let (Some(column), Some(_)) = (read.face, wanted.face) {
        return Err(ImportError(format!(
            "--face: the table has a column of places across the face, {}; leave one of them out",
            column.cell(head)
        )));
    }
    state_face(&mut entries, wanted)?;
    if read.sigma.is_none() {
        state_sigma(&mut entries, wanted)?;
    }
    arranged.extend(wanted.per_interval.doubt(&entries, weighed));
    arranged.extend(wanted.per_interval.add_up(&mut entries, false)?);
    let unit = single.map(|quantity| {
        wanted.unit_of_values(quantity, read.value.unit.as_deref(), titles.unit.as_deref())
    });
    Ok(Long {
        row: head + 1,
        arranged,
        joined,
        left_out,
        unit: unit.transpose()?,
        columns: read.in_words(&columns, single, &titles, wanted)?,
        passed_over: passed_over(sheet, head, &columns, read.value, wanted),
        titles,
        turned,
        flank,
        traces,
        empty,
        has_sigma: read.sigma.is_some(),
        entries,
    })
}

impl Long {
    /// With the rows of the other member.
    fn joined(mut self, other: Long) -> Long {
        let new = |known: &[(String, String)], own: &(String, String)| !known.contains(own);
        for column in other.columns {
            if new(&self.columns, &column) {
                self.columns.push(column);
            }
        }
        self.passed_over
            .retain(|column| other.passed_over.contains(column));
        for words in other.arranged {
            if !self.arranged.contains(&words) {
                self.arranged.push(words);
            }
        }
        self.joined.extend(other.joined);
        self.left_out.extend(other.left_out);
        self.empty += other.empty;
        self.has_sigma |= other.has_sigma;
        self.entries.extend(other.entries);
        self
    }
}

/// The columns that are not read, those without a name if something stands below.
fn passed_over(
    sheet: &Sheet,
    head: usize,
    columns: &[Column],
    value: &Column,
    wanted: &Wanted<'_>,
) -> Vec<(String, String)> {
    let numbers_intervals = wanted.per_interval.cycles;
    let uses_speeds = columns
        .iter()
        .any(|column| column.what.own() == Some("cycles") && column.hours.is_some());
    let mut passed_over: Vec<(String, String)> = (columns.iter())
        .filter_map(|column| {
            let why = match column.what {
                What::ForPeople if column.hours.is_some() => {
                    "a running time beside the revolutions, which are read"
                }
                What::ForPeople => "a comment column",
                What::Unknown if names::is_stop(&column.name()) && numbers_intervals => {
                    "the number of the interval, by which the lengths are added up"
                }
                What::Unknown if names::is_stop(&column.name()) => "the number of the stop",
                What::Unknown => "not known",
                What::Weighing(_) => "a weighing",
                What::Profile(_) => "another profile",
                What::Span(_) | What::Chord(_) => "a measurement of the tooth thickness",
                What::Flank => "one flank of each member stands in it, taken for the loaded one",
                What::Speed { of } if !uses_speeds => {
                    let why = speed_passed_over(sheet, head, (columns, column, of), wanted);
                    return Some((column.written.clone(), why));
                }
                What::Torque { .. } => "a torque, which is the study's",
                What::Expanded => {
                    "an expanded uncertainty that does not say its k: call it `U (k=2)` and it is read"
                }
                What::NotOneSigma(says) => says,
                What::Values(_) if column.at != value.at => "another quantity",
                _ => return None,
            };
            Some((column.written.clone(), why.to_owned()))
        })
        .collect();
    let widest = sheet.rows[head..].iter().map(Vec::len).max().unwrap_or(0);
    for at in 0..widest {
        let named = columns
            .get(at)
            .is_some_and(|column| column.what != What::Nameless);
        let filled = sheet.rows[head..]
            .iter()
            .any(|row| row.get(at).is_some_and(|cell| !cell.is_empty()));
        if !named && filled {
            let why = "no name stands in its header".to_owned();
            passed_over.push((cell_name(head, at), why));
        }
    }
    passed_over
}
