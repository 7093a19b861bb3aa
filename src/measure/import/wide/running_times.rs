//! Checkpoints of a wide table that are told as running times: `20 h` in each header, or `running time [h]` above the first column.

use crate::measure::import::columns::Column;
use crate::measure::import::numbers::{number, number_words, pointed};
use crate::measure::import::wanted::Wanted;
use crate::measure::import::wide::is_aside;
use crate::measure::import::{ImportError, Sheet, cell_name, units};
use crate::measure::names;

/// The sheet with pinion revolutions in place of running times, by the speed of the test in the study, and what is said of them; none where no
/// checkpoint is told as a time.
///
/// # Errors
/// [`ImportError`] where some headers of a row are times and others are not, and for times that are no numbers.
pub(super) fn as_revolutions(
    sheet: &Sheet,
    head: usize,
    wanted: &Wanted<'_>,
    test: &str,
) -> Result<Option<(Sheet, String)>, ImportError> {
    let across = in_headers(sheet, head)?;
    let down = if across.is_empty() {
        in_first_column(sheet, head)?
    } else {
        Vec::new()
    };
    let mut own = sheet.clone();
    let mut first = None;
    for time in across.iter().chain(&down) {
        let revolutions = wanted.revolutions_after(test, &time.number, time.value, time.hours);
        let cell = &mut own.rows[time.row][time.column];
        first.get_or_insert_with(|| (cell.clone(), revolutions));
        *cell = time.beside.replace("{}", &revolutions.to_string());
    }
    if !down.is_empty() {
        "cycles".clone_into(&mut own.rows[head][0]);
    }
    Ok(first.map(|(time, revolutions)| {
        let speed = wanted.run(test).map_or(0.0, |[rpm, _]| rpm);
        let said = format!(
            "checkpoints are running times, turned into pinion revolutions by the {speed} rpm of test {test} in the study: `{time}` is {revolutions}"
        );
        (own, said)
    }))
}

/// A running time in a cell.
struct Time {
    row: usize,
    column: usize,
    /// As it is written.
    number: String,
    value: f64,
    /// Hours of its unit.
    hours: f64,
    /// The cell with `{}` in place of the time.
    beside: String,
}

fn in_headers(sheet: &Sheet, head: usize) -> Result<Vec<Time>, ImportError> {
    let cells = sheet.rows[head].iter().enumerate().skip(1);
    let counts = cells.filter(|(_, text)| !text.is_empty() && !is_aside(text));
    let counts: Vec<(usize, &String)> = counts.collect();
    let of = |&(column, text): &(usize, &String)| time_in(text, head, column);
    let times: Vec<Time> = counts.iter().filter_map(of).collect();
    let is_time = |column: usize| times.iter().any(|time| time.column == column);
    let other = counts.iter().find(|(column, _)| !is_time(*column));
    match (times.first(), other) {
        (Some(time), Some((column, other))) => Err(ImportError(format!(
            "the header {} `{}` is a running time, {} `{other}` is not: write all checkpoints in one of the two",
            cell_name(head, time.column),
            sheet.rows[head][time.column],
            cell_name(head, *column),
        ))),
        _ => Ok(times),
    }
}

/// The running time that a header tells: `20 h`, `after 20,5 [h]`.
fn time_in(text: &str, row: usize, column: usize) -> Option<Time> {
    let [written] = number_words(text)[..] else {
        return None;
    };
    let value: f64 = pointed(written).parse().ok()?;
    let (before, behind) = text.split_once(written)?;
    let unit_end = |rest: &str| {
        rest.find(|c: char| !c.is_alphabetic())
            .unwrap_or(rest.len())
    };
    let unit = behind.trim_start_matches([' ', '[', '(', '\u{a0}']);
    let (unit, rest) = unit.split_at(unit_end(unit));
    let hours = hours_on_the_rig(unit)?;
    let rest = rest.trim_start_matches([')', ']', '.']);
    Some(Time {
        row,
        column,
        number: written.to_owned(),
        value,
        hours,
        beside: format!("{before}{{}}{rest}"),
    })
}

fn in_first_column(sheet: &Sheet, head: usize) -> Result<Vec<Time>, ImportError> {
    let corner = Column::of(0, &sheet.rows[head][0]);
    let stated = units::bracketed(&sheet.rows[head][0]);
    let unit = stated.map_or(corner.hours, |unit| {
        corner.hours.and_then(|_| hours_on_the_rig(unit))
    });
    let Some(hours) = unit else {
        return Ok(Vec::new());
    };
    let rows = sheet.rows.iter().enumerate().skip(head + 1);
    let filled = rows.filter_map(|(row, cells)| Some((row, cells.first()?)));
    filled
        .filter(|(_, text)| !text.is_empty())
        .map(|(row, text)| {
            Ok(Time {
                row,
                column: 0,
                number: text.clone(),
                value: number(text, row, 0)?,
                hours,
                beside: "{}".to_owned(),
            })
        })
        .collect()
}

/// Hours of a unit in which the running time of a rig is told: days and weeks may be those of the calendar.
fn hours_on_the_rig(unit: &str) -> Option<f64> {
    names::hours_of_unit(unit).filter(|&hours| hours <= 1.0)
}
