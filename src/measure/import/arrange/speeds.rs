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

/// Part of a speed by which that of a row above the header may differ from the study's where nothing becomes revolutions by it.
const ABOUT_THE_SAME: f64 = 0.05;

/// Refuses the speed that a row above a table of one test states, `of` a member if it says so, where it is neither member's in the test.
pub(in crate::measure::import) fn refuse_another(
    (number, of): (&str, Option<Subject>),
    test: &str,
    place: &str,
    wanted: &Wanted<'_>,
) -> Result<(), ImportError> {
    let ratio = wanted.ratio();
    let is_about = |own: f64| {
        let is_it = |speed: f64| (speed - own).abs() <= ABOUT_THE_SAME * own;
        readings(number).any(is_it)
    };
    let is_of = |rpm: f64| match of {
        Some(Subject::Gear) => is_about(rpm / ratio),
        Some(_) => is_about(rpm),
        None => is_about(rpm) || is_about(rpm / ratio),
    };
    let Some([own, _]) = wanted.run(test).filter(|[rpm, _]| !is_of(*rpm)) else {
        return Ok(());
    };
    let others = wanted.tests.iter().zip(&wanted.runs);
    let mut others = others.filter(|(_, [rpm, _])| is_of(*rpm));
    let hint = match others.next() {
        Some((other, _)) => format!(". It is that of test {other}: are these values of that test?"),
        None => String::new(),
    };
    let (own, whose) = match of {
        Some(Subject::Gear) => (own / ratio, "gear"),
        _ => (own, "pinion"),
    };
    Err(ImportError(format!(
        "{place} is another speed than that of test {test} in the study, {own:.0} rpm of the {whose}: correct the one that is wrong, or take the row out{hint}"
    )))
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

/// Refuses speeds that are not those of the tests, where times become revolutions by these; says of which columns they are the gear's.
pub(super) fn agree(
    sheet: &Sheet,
    head: usize,
    above: &[Stated],
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) -> Result<(), ImportError> {
    let mut columns = columns(&sheet.rows[head]);
    known_by_content(&mut columns, sheet, head, wanted);
    if !are_needed(&columns) {
        return Ok(());
    }
    let refused = |place: String, test: &str, own: f64| {
        Err(ImportError(format!(
            "{place} is another speed than that of test {test} in the study, {own:.0} rpm: running times become revolutions by the speed of the \
             test; correct the one that is wrong, or write revolutions in place of times"
        )))
    };
    for (_, test, rpm) in runs(sheet, head, &columns, wanted) {
        for line in above {
            let of = if line.of_gear {
                Subject::Gear
            } else {
                Subject::Pinion
            };
            if let Some(Is::Another(own)) = is(&line.number, Some(of), rpm, wanted.ratio()) {
                let place = format!("row {}: `{}`", line.row + 1, line.written);
                return refused(place, test, own);
            }
        }
    }
    for column in &columns {
        let What::Speed { of } = column.what else {
            continue;
        };
        let told = told(sheet, head, (&columns, column, of), wanted);
        match told {
            Told::Another { place, test, own } => return refused(place, &test, own),
            Told::OfGear if of.is_none() => said.push(format!("`{}`: {OF_GEAR}", column.written)),
            _ => {}
        }
    }
    Ok(())
}

/// Why a column of speeds that nothing needs is passed over: whether they are those of the tests.
pub(in crate::measure::import) fn passed_over(
    sheet: &Sheet,
    head: usize,
    (columns, column, of): (&[Column], &Column, Option<Subject>),
    wanted: &Wanted<'_>,
) -> String {
    match told(sheet, head, (columns, column, of), wanted) {
        Told::Nothing => "a speed, which could not be compared with the study's".to_owned(),
        Told::Own => "a speed, which is the study's".to_owned(),
        Told::OfGear => OF_GEAR.to_owned(),
        Told::Another { place, test, own } => format!(
            "a speed, which is not the study's: {place} is another one than that of test {test}, {own:.0} rpm; correct the one that is wrong"
        ),
    }
}

const OF_GEAR: &str =
    "the gear's speed, which is that of the test over the ratio of the numbers of teeth";

/// What a column of speeds says beside the study.
enum Told {
    /// No number, or of no test.
    Nothing,
    /// The speeds of the tests.
    Own,
    /// Those of the gear in the tests.
    OfGear,
    /// Another speed than that of a test, where it stands and that of the test.
    Another {
        place: String,
        test: String,
        own: f64,
    },
}

/// What a column says whose name says `of` which member it is.
fn told(
    sheet: &Sheet,
    head: usize,
    (columns, column, of): (&[Column], &Column, Option<Subject>),
    wanted: &Wanted<'_>,
) -> Told {
    let mut told = Told::Nothing;
    for (row, test, rpm) in runs(sheet, head, columns, wanted) {
        let number = sheet.rows[row].get(column.at).map_or("", String::as_str);
        // a column is of one member throughout
        let of = match told {
            Told::OfGear => Some(Subject::Gear),
            Told::Own => Some(Subject::Pinion),
            _ => of,
        };
        told = match is(number, of, rpm, wanted.ratio()) {
            None => continue,
            Some(Is::Pinions) => Told::Own,
            Some(Is::Gears) => Told::OfGear,
            Some(Is::Another(own)) => {
                let cell = cell_name(row, column.at);
                return Told::Another {
                    place: format!("{cell}: `{number}` below `{}`", column.written),
                    test: test.to_owned(),
                    own,
                };
            }
        };
    }
    told
}

/// The rows below a header that hold something, each with its test and the speed of that.
fn runs<'s>(
    sheet: &'s Sheet,
    head: usize,
    columns: &[Column],
    wanted: &'s Wanted<'_>,
) -> Vec<(usize, &'s str, f64)> {
    let tests = columns
        .iter()
        .find(|column| column.what.own() == Some("test"));
    let one = wanted.one_test(sheet).ok();
    let one = one.and_then(|(id, _)| wanted.tests.iter().copied().find(|test| *test == id));
    let rows = sheet.rows.iter().enumerate().skip(head + 1);
    let filled = rows.filter(|(_, cells)| cells.iter().any(|cell| !cell.is_empty()));
    filled
        .filter_map(|(row, cells)| {
            let test = match tests {
                Some(column) => wanted.test_of(cells.get(column.at)?),
                None => one,
            }?;
            let [rpm, _] = wanted.run(test)?;
            Some((row, test, rpm))
        })
        .collect()
}

/// Whose speed a number is.
enum Is {
    Pinions,
    Gears,
    /// Another one than this of the test.
    Another(f64),
}

/// Whose speed a text states where the pinion of the test has `rpm`, if its column says `of` whom it is; none if it states no number.
fn is(text: &str, of: Option<Subject>, rpm: f64, ratio: f64) -> Option<Is> {
    let speeds: Vec<f64> = readings(leading_number(text).0).collect();
    if speeds.is_empty() {
        return None;
    }
    let is = |own: f64| {
        let is_same = |speed: &f64| (speed - own).abs() <= SAME_SPEED * own;
        speeds.iter().any(is_same)
    };
    let of_gear = rpm / ratio;
    Some(match of {
        Some(Subject::Gear) if is(of_gear) => Is::Gears,
        Some(Subject::Gear) => Is::Another(of_gear),
        _ if is(rpm) => Is::Pinions,
        None if is(of_gear) => Is::Gears,
        _ => Is::Another(rpm),
    })
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
