//! Speeds that a table states beside running times: they have to be those of the study's tests, by which times become revolutions.

use super::super::columns::{Column, What, columns, known_by_content};
use super::super::numbers::pointed;
use super::super::{ImportError, Sheet, Wanted, cell_name, units};
use crate::measure::thousands::in_thousands;
use crate::measure::{Subject, names};

/// Part of a speed by which a stated one may differ from the study's: a motor under load, or a rounded number.
const SAME_SPEED: f64 = 0.005;

/// A speed that a row above the header states.
pub(super) struct Stated {
    /// The row, counted from 0.
    pub(super) row: usize,
    written: String,
    number: String,
    of_gear: bool,
}

/// The speed in revolutions per minute that a line states, of its name and of what stands behind that; none for other lines.
pub(super) fn stated(row: usize, name: &str, text: &str) -> Option<Stated> {
    let (number, behind) = leading_number(text);
    readings(number).next()?;
    let (plain, unit) = units::name_and_unit(name);
    let behind = Some(behind.trim()).filter(|behind| !behind.is_empty());
    let whose = names::speed(&plain, unit.as_deref().or(behind))?;
    Some(Stated {
        row,
        written: format!("{name}: {text}"),
        number: number.to_owned(),
        of_gear: whose == Some(Subject::Gear),
    })
}

/// Whether a table has running times that are to become revolutions.
pub(super) fn are_needed(columns: &[Column]) -> bool {
    let is_time = |column: &Column| column.what.own() == Some("cycles") && column.hours.is_some();
    columns.iter().any(is_time)
}

/// Refuses speeds that are not those of the tests.
pub(super) fn agree(
    sheet: &Sheet,
    head: usize,
    above: &[Stated],
    wanted: &Wanted<'_>,
) -> Result<(), ImportError> {
    let mut columns = columns(&sheet.rows[head]);
    known_by_content(&mut columns, sheet, head, wanted);
    if !are_needed(&columns) {
        return Ok(());
    }
    let tests = columns
        .iter()
        .find(|column| column.what.own() == Some("test"));
    let one = wanted.one_test(sheet).ok().map(|(test, _)| test);
    for (row, cells) in sheet.rows.iter().enumerate().skip(head + 1) {
        let text = |column: &Column| cells.get(column.at).map_or("", String::as_str);
        if cells.iter().all(String::is_empty) {
            continue;
        }
        let test = match tests {
            Some(column) => wanted.test_of(text(column)),
            None => one.as_deref(),
        };
        let Some((test, [rpm, _])) = test.and_then(|test| Some((test, wanted.run(test)?))) else {
            continue;
        };
        let check = |number: &str, of_gear: bool, place: String| {
            let ratio = if of_gear { wanted.ratio() } else { 1.0 };
            let is_same = |speed: f64| (ratio * speed - rpm).abs() <= SAME_SPEED * rpm;
            let mut speeds = readings(leading_number(number).0).peekable();
            if speeds.peek().is_some() && !speeds.any(is_same) {
                return Err(ImportError(format!(
                    "{place} is another speed than that of test {test} in the study, {:.0} rpm: running times become revolutions by the speed of the \
                     test; correct the one that is wrong, or write revolutions in place of times",
                    rpm / ratio
                )));
            }
            Ok(())
        };
        for line in above {
            let place = format!("row {}: `{}`", line.row + 1, line.written);
            check(&line.number, line.of_gear, place)?;
        }
        for column in &columns {
            let What::Speed { of_gear } = column.what else {
                continue;
            };
            let number = text(column);
            if !number.is_empty() {
                let place = format!(
                    "{}: `{number}` below `{}`",
                    cell_name(row, column.at),
                    column.written
                );
                check(number, of_gear, place)?;
            }
        }
    }
    Ok(())
}

/// A text's number and what stands behind it.
pub(super) fn leading_number(text: &str) -> (&str, &str) {
    let is_digit = |c: char| c.is_ascii_digit() || ['.', ','].contains(&c);
    text.split_at(text.find(|c| !is_digit(c)).unwrap_or(text.len()))
}

/// What a number may be: `2.000` is two or two thousand.
pub(super) fn readings(number: &str) -> impl Iterator<Item = f64> {
    let plain = pointed(number).parse::<f64>().ok();
    let thousands = in_thousands(number).then(|| number.replace(['.', ','], ""));
    let thousands = thousands.and_then(|number| number.parse::<f64>().ok());
    plain.into_iter().chain(thousands)
}
