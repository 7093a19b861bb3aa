//! Torques that a table states: another one than the study's is of another test, or the study's is wrong.

use super::super::columns::{Column, What, columns, known_by_content};
use super::super::entry::four_digits;
use super::super::{ImportError, Sheet, Wanted, cell_name};
use super::speeds::{leading_number, readings};
use crate::measure::{Subject, names};

/// Part of a torque by which a stated one may differ from the study's: a rig under control, or a rounded number.
const SAME_TORQUE: f64 = 0.01;

/// Refuses torques that are not those of the tests; says of which columns they are the gear's.
pub(super) fn agree(
    sheet: &Sheet,
    head: usize,
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) -> Result<(), ImportError> {
    let mut columns = columns(&sheet.rows[head]);
    known_by_content(&mut columns, sheet, head, wanted);
    let tests = (columns.iter()).find(|column| column.what.own() == Some("test"));
    let one = wanted.one_test(sheet).ok().map(|(test, _)| test);
    for column in &columns {
        let What::Torque { of } = column.what else {
            continue;
        };
        let mut is_gears = false;
        for (row, cells) in sheet.rows.iter().enumerate().skip(head + 1) {
            let text = |column: &Column| cells.get(column.at).map_or("", String::as_str);
            let test = match tests {
                Some(column) => wanted.test_of(text(column)),
                None => one.as_deref(),
            };
            let own = test.and_then(|test| Some((test, wanted.torque(test)?)));
            if let Some((test, own)) = own {
                let place = cell_name(row, column.at);
                let place = format!("{place}: `{}` below `{}`", text(column), column.written);
                let stated = (text(column), column.newton_metres());
                let way_out = "call the column `comment`, which is passed over";
                is_gears |= is_of_gear(stated, (of, own), (test, &place, way_out), wanted)?;
            }
        }
        if is_gears && of.is_none() {
            said.push(format!(
                "`{}`: the gear's torque, which is that of the test times the ratio of the numbers of teeth",
                column.written
            ));
        }
    }
    Ok(())
}

/// Refuses the torque that a row above a table of one test states, `of` a member if it says so, unless it is that of the test.
pub(in crate::measure::import) fn refuse_another(
    (number, unit, of): (&str, Option<&str>, Option<Subject>),
    test: &str,
    place: &str,
    wanted: &Wanted<'_>,
) -> Result<(), ImportError> {
    let newton_metres = unit.and_then(names::newton_metres).unwrap_or(1.0);
    match wanted.torque(test) {
        Some(own) => is_of_gear(
            (number, newton_metres),
            (of, own),
            (test, place, "take the row out"),
            wanted,
        )
        .map(drop),
        None => Ok(()),
    }
}

/// Whether the torque of a cell, `of` a member, is the gear's where `own` is the pinion's in the test.
fn is_of_gear(
    (number, newton_metres): (&str, f64),
    (of, own): (Option<Subject>, f64),
    (test, place, way_out): (&str, &str, &str),
    wanted: &Wanted<'_>,
) -> Result<bool, ImportError> {
    let ratio = wanted.ratio();
    let stated: Vec<f64> = match number.trim().parse() {
        // a rig that stands still
        Ok(0.0) => return Ok(false),
        Ok(plain) if number.contains(['e', 'E']) => vec![plain],
        _ => readings(leading_number(number).0).collect(),
    };
    let is = |torque: f64| {
        let is_same =
            |stated: &f64| (newton_metres * stated - torque).abs() <= SAME_TORQUE * torque;
        stated.iter().any(is_same)
    };
    let (of_gear, of_pinion) = (is(own * ratio), is(own));
    if stated.is_empty() || of_pinion && of != Some(Subject::Gear) {
        return Ok(false);
    }
    if of_gear && of != Some(Subject::Pinion) {
        return Ok(true);
    }
    let (whose, own_there) = match of {
        Some(Subject::Gear) => (" on the gear", own * ratio),
        _ => ("", own),
    };
    let others = wanted.tests.iter().zip(&wanted.torques);
    let mut others = others.filter(|(id, own)| {
        **id != test && is(own_there / wanted.torque(test).unwrap_or(own_there) * **own)
    });
    let hint = if let Some((other, _)) = others.next() {
        format!(". It is that of test {other}: are these values of that test?")
    } else if is(own / ratio) {
        ". It is that over the ratio of the numbers of teeth: does the study state the gear's torque? `torque` is the pinion's".to_owned()
    } else if of_pinion || of_gear {
        ". The two are exchanged by the ratio of the numbers of teeth: is it the other member's?"
            .to_owned()
    } else {
        String::new()
    };
    Err(ImportError(format!(
        "{place} is another torque than that of test {test} in the study, {} N m{whose}: correct the one that is wrong, or {way_out}{hint}",
        four_digits(own_there),
    )))
}
