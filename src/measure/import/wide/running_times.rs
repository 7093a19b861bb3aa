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
    let (of_rows, of_columns) = in_the_corner(&sheet.rows[head][0]);
    let across = in_headers(sheet, head, of_columns.and_then(hours_of))?;
    let down = if across.is_empty() {
        in_first_column(sheet, head, of_rows)?
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
        own.rows[head][0] = match of_columns {
            Some(places) => format!("cycles / {places}"),
            None => "cycles".to_owned(),
        };
    } else if let Some(places) = of_columns.and(Some(of_rows)).filter(|_| !across.is_empty()) {
        places.clone_into(&mut own.rows[head][0]);
    }
    Ok(first.map(|(time, revolutions)| {
        let speed = wanted.run(test).map_or(0.0, |[rpm, _]| rpm);
        let said = format!(
            "checkpoints are running times, turned into pinion revolutions by the {speed} rpm of test {test} in the study: `{time}` is {revolutions}"
        );
        (own, said)
    }))
}

/// What the first cell of a table calls its rows, and its columns where it names both: `running time [h] / radius [mm]`.
fn in_the_corner(text: &str) -> (&str, Option<&str>) {
    let both = [" / ", " \\ ", "\\"]
        .into_iter()
        .find_map(|between| text.split_once(between));
    match both {
        Some((rows, columns)) if !rows.trim().is_empty() && !columns.trim().is_empty() => {
            (rows.trim(), Some(columns.trim()))
        }
        _ => (text, None),
    }
}

/// Hours of the unit of what is called a running time.
fn hours_of(header: &str) -> Option<f64> {
    let column = Column::of(0, header);
    units::bracketed(header).map_or(column.hours, |unit| {
        column.hours.and_then(|_| hours_on_the_rig(unit))
    })
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

/// `hours`: those of the unit that the first cell gives all columns.
fn in_headers(sheet: &Sheet, head: usize, hours: Option<f64>) -> Result<Vec<Time>, ImportError> {
    let cells = sheet.rows[head].iter().enumerate().skip(1);
    let counts = cells.filter(|(_, text)| !text.is_empty() && !is_aside(text));
    let counts: Vec<(usize, &String)> = counts.collect();
    let of = |&(column, text): &(usize, &String)| match hours {
        Some(hours) => bare_time(text, hours, head, column),
        None => time_in(text, head, column),
    };
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

/// The running time that a header without a unit tells.
fn bare_time(text: &str, hours: f64, row: usize, column: usize) -> Option<Time> {
    let [written] = number_words(text)[..] else {
        return None;
    };
    Some(Time {
        row,
        column,
        number: written.to_owned(),
        value: pointed(written).parse().ok()?,
        hours,
        beside: text.replacen(written, "{}", 1),
    })
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

fn in_first_column(sheet: &Sheet, head: usize, name: &str) -> Result<Vec<Time>, ImportError> {
    let Some(hours) = hours_of(name) else {
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
