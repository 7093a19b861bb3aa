//! How much of a header is understood, and what is said of the rest.

use super::{Column, What, has, known_by_content, with_sides};
use crate::measure::import::arrange::{hint, side};
use crate::measure::import::numbers::pointed;
use crate::measure::import::wanted::Wanted;
use crate::measure::import::{ImportError, Sheet};
use crate::measure::names::When;
use crate::measure::{Place, Quantity, Subject, names};

/// What was understood of the row that looks most like a long table's header, and what is missing there; none if no row does.
pub(in crate::measure::import) fn best_header(sheet: &Sheet) -> Option<String> {
    let known = |columns: &[Column]| columns.iter().filter_map(in_words).count();
    let rows = sheet
        .rows
        .iter()
        .enumerate()
        .map(|(row, cells)| (row, with_sides(cells)));
    // the first of those with the most
    let (row, columns) = rows.rev().max_by_key(|(_, columns)| known(columns))?;
    (known(&columns) > 0).then(|| said(row, &columns, &missing(&columns)))
}

/// Whether a header has two measurements of something, one of the new part and one of the worn.
pub(in crate::measure::import) fn has_pair(columns: &[Column]) -> bool {
    let is_there = |what: What| columns.iter().any(|column| column.what == what);
    let is_pair = |of: fn(When) -> What| {
        let mut times = [When::Before, When::After].into_iter();
        times.all(|when| is_there(of(when)))
    };
    let kinds = [What::Weighing, What::Profile, What::Span, What::Chord];
    kinds.into_iter().any(is_pair)
}

/// What a long table needs and a header lacks.
fn missing(columns: &[Column]) -> Vec<&'static str> {
    let is_whole = |column: &Column| match column.what {
        What::Weighing(_) => true,
        What::Values(quantity) => quantity.place() == Place::Whole,
        _ => false,
    };
    let has_pair = has_pair(columns);
    let of_members = |column: &Column| names::one_member(&column.written).is_some();
    let needed = ["test", "member", "cycles", "position", "value"].into_iter();
    let missing = needed.filter(|name| match *name {
        "position" if columns.iter().any(is_whole) => false,
        "member" if columns.iter().any(of_members) => false,
        "value" if has_pair => false,
        name => !has(columns, name),
    });
    missing.collect()
}

/// Refuses a table with a column of tests, or with two measurements of something, that lacks what it needs to be a long one: none of its rows is the
/// header of a wide one.
pub(in crate::measure::import) fn refuse(
    sheet: &Sheet,
    wanted: &Wanted<'_>,
) -> Result<(), ImportError> {
    let is_number = |cell: &String| pointed(cell).parse::<f64>().is_ok();
    for (row, cells) in sheet.rows.iter().enumerate() {
        let is_entry = |cell: &String| is_number(cell) || wanted.test_of(cell).is_some();
        if cells.iter().any(is_entry) {
            continue;
        }
        let mut columns = with_sides(cells);
        known_by_content(&mut columns, sheet, row, wanted);
        let is_known = columns.iter().filter_map(in_words).count() > 1;
        let has_tests = columns.iter().find(|c| c.is("test")).is_some_and(|test| {
            let below = sheet.rows[row + 1..].iter();
            let mut names = below
                .filter_map(|cells| cells.get(test.at))
                .filter(|name| !name.is_empty());
            match is_known {
                true => names.next().is_some(),
                false => columns.len() > 2 && names.any(|name| wanted.test_of(name).is_some()),
            }
        });
        if !has_tests && !has_pair(&columns) {
            continue;
        }
        let mut missing = missing(&columns);
        let member = wanted.stated_member(sheet, Quantity::WearDepth);
        missing.retain(|name| match *name {
            "test" => wanted.one_test(sheet).is_err(),
            "member" => !matches!(member, Ok(Some(_))),
            _ => true,
        });
        let of_intervals = match hint(sheet) {
            Some(hint) if missing.contains(&"cycles") || missing.contains(&"value") => {
                format!("; {hint}")
            }
            _ => String::new(),
        };
        return Err(ImportError(format!(
            "it looks like a table with a row for each value, of which not enough is understood: {}{of_intervals}",
            said(row, &columns, &missing)
        )));
    }
    Ok(())
}

/// What a column is, for messages; none if it is not known.
fn in_words(column: &Column) -> Option<String> {
    let time = |when: When| match when {
        When::Before => "before the test",
        When::After => "after the test",
    };
    Some(match column.what {
        What::Values(quantity) => format!("value ({})", quantity.name()),
        What::Weighing(when) => format!("the mass {}", time(when)),
        What::Profile(when) => format!("the profile {}", time(when)),
        What::Span(when) => format!("the span {}", time(when)),
        What::Chord(when) => format!("the chord {}", time(when)),
        What::Speed { .. } => "a speed".to_owned(),
        What::Torque { .. } => "a torque".to_owned(),
        What::Flank => "the flank".to_owned(),
        What::Repeat => "the number of a repeat".to_owned(),
        What::Own("cycles") if column.hours.is_some() => "cycles (a running time)".to_owned(),
        What::Own(own) => own.to_owned(),
        What::Expanded
        | What::NotOneSigma(_)
        | What::ForPeople
        | What::Unknown
        | What::Nameless => return None,
    })
}

/// The header, what was understood of it, what is missing, and how to name it.
pub(in crate::measure::import) fn said(
    head: usize,
    columns: &[Column],
    missing: &[&str],
) -> String {
    let written: Vec<&str> = columns
        .iter()
        .map(|column| column.written.as_str())
        .collect();
    let parts = |of: &dyn Fn(&Column) -> Option<String>| {
        let parts: Vec<String> = columns.iter().filter_map(of).collect();
        if parts.is_empty() {
            "nothing".to_owned()
        } else {
            parts.join(", ")
        }
    };
    let understood =
        parts(&|column| Some(format!("`{}` as {}", column.written, in_words(column)?)));
    let not = parts(&|column| {
        let is_unread = matches!(
            column.what,
            What::Unknown | What::Expanded | What::NotOneSigma(_)
        );
        is_unread.then(|| format!("`{}`", column.written))
    });
    format!(
        "the header in row {} is `{}`; understood: {understood}; not understood: {not}; missing: {}. A long table needs columns `test`, \
         `member`, `cycles` (of the pinion), for depths a position (`radius [mm]`, `roll angle [deg]`; for spans `teeth spanned`) and \
         values (`depth [um]`, `mass loss [mg]`), optional `sigma` and `trace`; --test and --member stand for such a column{}{}",
        head + 1,
        written.join("; "),
        match missing {
            [] => nothing_missing(columns),
            some => some.join(", "),
        },
        on_time(columns, missing),
        on_values(columns, missing),
    )
}

/// What is said where every column is there: a member's name in some keeps them from being read.
fn nothing_missing(columns: &[Column]) -> String {
    let sided = columns
        .iter()
        .filter(|column| side(&column.written).is_some());
    let of_both = |column: &&Column| {
        let words = names::words(&column.written);
        let is_of_pair = |word: &String| names::member(word) == Some(Subject::Pair);
        column.what == What::Values(Quantity::MassLoss) && words.iter().any(is_of_pair)
    };
    if let Some(column) = columns.iter().find(of_both) {
        return format!(
            "nothing, but `{}` is of both members together, and the loss of each by itself is wanted",
            column.written
        );
    }
    let sided: Vec<String> = sided
        .map(|column| format!("`{}`", column.written))
        .collect();
    match sided.as_slice() {
        [] => "nothing, but its columns do not make a table together".to_owned(),
        some => format!(
            "nothing, but {} with the name of a member are not read here: leave the name out and let a column `member` or --member say it",
            some.join(", ")
        ),
    }
}

/// What is said of a column that may be the times of intervals, where cycles are missing.
fn on_time(columns: &[Column], missing: &[&str]) -> String {
    let is_time = |column: &&Column| {
        let unit = column.unit.as_deref();
        column.what == What::Unknown && unit.is_some_and(|u| names::hours_of_unit(u).is_some())
    };
    match columns.iter().find(is_time) {
        Some(column) if missing.contains(&"cycles") => format!(
            ". If `{}` is the running time since the start of the test, call it `time [h]`; if it is that of each interval alone, say --per-interval cycles",
            column.written
        ),
        _ => String::new(),
    }
}

/// What is said of one of two measurements, where the other one is missing.
fn on_values(columns: &[Column], missing: &[&str]) -> String {
    if !missing.contains(&"value") {
        return String::new();
    }
    let other = columns.iter().find_map(|column| match column.what {
        What::Weighing(When::Before) => Some("`mass after [g]`"),
        What::Weighing(When::After) => Some("`mass before [g]`"),
        What::Profile(When::Before) => Some("`deviation after [um]`"),
        What::Profile(When::After) => Some("`deviation before [um]`"),
        _ => None,
    });
    if let Some(other) = other {
        return format!(". A loss is the difference of two measurements: {other} is the other one");
    }
    let is_mass = |column: &&Column| {
        let unit = column.unit.as_deref();
        column.what == What::Unknown && matches!(unit, Some("g" | "mg" | "kg"))
    };
    match columns.iter().find(is_mass) {
        Some(column) => format!(
            ". If `{}` holds masses or losses of mass, say --quantity mass_loss",
            column.written
        ),
        None => String::new(),
    }
}
