//! The mapping of a table in words: which cell is taken for what.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::{ImportArgs, ShareOf};
use crate::measure::import::{Across, Entry, Long, Titles, UnitFrom, Wide};
use crate::measure::{Quantity, Subject};
use crate::numeric::written;

/// Rows that are shown of the mapping.
const SHOWN: usize = 3;

/// Checkpoints that are named one by one.
const NAMED: usize = 8;

/// What is said of the standard deviation where nothing states it.
const LEFT_EMPTY: &str = "left empty: estimated from the scatter of the values wherever the file is read (--sigma states it)";

/// A mapping where the standard deviation cannot be estimated either.
pub(super) fn without_sigma(shown: &str) -> String {
    shown.replace(LEFT_EMPTY, "none: nothing states it")
}

/// A line of the mapping.
fn line(text: &mut String, key: &str, words: &str) {
    let _ = writeln!(text, "{key:<8} {words}");
}

/// A table with a column for each checkpoint or place.
pub(super) fn wide(args: &ImportArgs, table: &str, wide: &Wide) -> String {
    let (corner, words) = &wide.corner;
    let words = if words.is_empty() {
        String::new()
    } else {
        format!(" `{words}`")
    };
    let places = match wide.position {
        Some((kind, [from, to])) => format!("{}, {from} to {to}", kind.name()),
        None => format!("members, {}", members(&wide.members)),
    };
    let times: Vec<String> = wide.checkpoints.iter().map(f64::to_string).collect();
    let from_gear = if wide.of_gear {
        " (from revolutions of the gear, by the numbers of teeth)"
    } else {
        ""
    };
    let times = format!("pinion revolutions, {}{from_gear}", times.join(" "));
    let (down, across) = match wide.across {
        Across::Checkpoints => (places, times),
        Across::Positions => (times, places),
    };
    let shown = match wide.unit.0.as_str() {
        "in" => "inches".to_owned(),
        unit => written::unit(unit),
    };
    let unit = match wide.unit.1 {
        UnitFrom::Header => format!("{shown} (the header says so)"),
        UnitFrom::Title => format!("{shown} (the title says so)"),
        _ => shown,
    };
    let tests = of_tests(&wide.entries);
    let tests = match wide.test.1 {
        Some(says) => format!("{tests} ({says})"),
        None => tests,
    };
    let mut text = String::new();
    line(&mut text, "table", table);
    line(&mut text, "header", &format!("row of {corner}{words}"));
    titles(&mut text, &wide.titles);
    for words in &wide.arranged {
        line(&mut text, "layout", words);
    }
    line(&mut text, "down", &down);
    line(&mut text, "across", &across);
    let sign = sign(wide.turned, args.turn_sign);
    let of = members(&wide.members).replace(' ', " and ");
    let values = format!(
        "{} of the {of} in {tests}, in {unit}{sign}",
        wide.quantity.name()
    );
    line(&mut text, "values", &values);
    let unit = wide.quantity.shown_unit();
    line(
        &mut text,
        "sigma",
        &sigma(args, wide.has_sigma, &wide.entries, &unit),
    );
    face(&mut text, args);
    let traces = match (args.no_traces, wide.position) {
        (_, None) => "none: there are no curves",
        (false, _) => {
            "one for each checkpoint: the instrument's zero is not known (--no-traces: it is the same for all)"
        }
        (true, _) => "none: the instrument's zero is the same for all checkpoints",
    };
    line(&mut text, "traces", traces);
    if !wide.passed_over.is_empty() {
        let plural = if wide.passed_over.len() > 1 { "s" } else { "" };
        let columns = format!(
            "the comment column{plural} `{}`",
            wide.passed_over.join("`, `")
        );
        line(&mut text, "passed over", &columns);
    }
    text += &left_out(&wide.left_out);
    match wide.empty {
        0 => {}
        1 => line(&mut text, "empty", "1 cell without a value passed over"),
        n => line(
            &mut text,
            "empty",
            &format!("{n} cells without a value passed over"),
        ),
    }
    text
}

/// A table with a row for each value.
pub(super) fn long(args: &ImportArgs, table: &str, long: &Long) -> String {
    let mut text = String::new();
    line(&mut text, "table", table);
    line(
        &mut text,
        "header",
        &format!("row {}, a row for each value below it", long.row),
    );
    titles(&mut text, &long.titles);
    for words in &long.arranged {
        line(&mut text, "layout", words);
    }
    for (written, what) in &long.columns {
        line(&mut text, "column", &format!("`{written}`: {what}"));
    }
    for (written, why) in &long.passed_over {
        line(
            &mut text,
            "passed over",
            &format!("the column `{written}`: {why}"),
        );
    }
    let entries = &long.entries;
    let of = |name: fn(&Entry) -> &str| {
        let names: BTreeSet<&str> = entries.iter().map(name).collect();
        names.into_iter().collect::<Vec<_>>().join(", ")
    };
    let values = format!(
        "{} of {} in {}{}",
        of(|entry| entry.quantity.name()),
        of(|entry| entry.member.name()),
        of_tests(entries),
        sign(long.turned, args.turn_sign)
    );
    line(&mut text, "values", &values);
    let mut times: Vec<f64> = entries.iter().map(|entry| entry.cycles).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let times = match times[..] {
        [first, .., last] if times.len() > NAMED => {
            format!("{} checkpoints, {first} to {last}", times.len())
        }
        _ => times
            .iter()
            .map(f64::to_string)
            .collect::<Vec<_>>()
            .join(" "),
    };
    line(&mut text, "cycles", &format!("pinion revolutions, {times}"));
    let unit = entries
        .first()
        .map_or(Quantity::WearDepth, |entry| entry.quantity)
        .shown_unit();
    let sigma = sigma(args, long.has_sigma, entries, &unit);
    line(&mut text, "sigma", &sigma);
    face(&mut text, args);
    line(&mut text, "traces", long.traces);
    text += &left_out(&long.left_out);
    match long.empty {
        0 => {}
        1 => line(&mut text, "empty", "1 row without a value passed over"),
        n => line(
            &mut text,
            "empty",
            &format!("{n} rows without a value passed over"),
        ),
    }
    text
}

/// A table that is read as the one before it.
///
/// Of the rows above its header those are named that `first` does not have.
pub(super) fn like_the_first(
    table: &str,
    entries: &[Entry],
    own: &Titles,
    first: &Titles,
) -> String {
    let of = |name: fn(&Entry) -> &str| {
        let names: BTreeSet<&str> = entries.iter().map(name).collect();
        names.into_iter().collect::<Vec<_>>().join(", ")
    };
    let mut times: Vec<f64> = entries.iter().map(|entry| entry.cycles).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let times: Vec<String> = times.iter().map(f64::to_string).collect();
    let mut text = String::new();
    let teeth = of(|entry| &entry.tooth);
    let teeth = match teeth.as_str() {
        "" => String::new(),
        teeth => format!(", tooth {teeth}"),
    };
    let words = format!(
        "{table}, read alike: {}, {} of {} in {} after {}{teeth}",
        match entries.len() {
            1 => "1 row".to_owned(),
            n => format!("{n} rows"),
        },
        of(|entry| entry.quantity.name()),
        of(|entry| entry.member.name()),
        of_tests(entries),
        times.join(", "),
    );
    line(&mut text, "table", &words);
    let new = own
        .passed_over
        .iter()
        .filter(|row| !first.passed_over.contains(row));
    titles(
        &mut text,
        &Titles {
            passed_over: new.cloned().collect(),
            ..Titles::default()
        },
    );
    text
}

/// What is left out of a table.
pub(super) fn left_out(words: &[String]) -> String {
    let mut text = String::new();
    for words in words {
        line(&mut text, "left out", words);
    }
    text
}

/// What the rows that are there already say of these: checkpoints of theirs, and a warning of members that may be swapped.
pub(super) fn of_others(joined: &[String], warnings: &[String]) -> String {
    let mut text = String::new();
    for words in joined {
        line(&mut text, "joined", words);
    }
    for words in warnings {
        line(&mut text, "warning", words);
    }
    text
}

/// The number of rows and the first ones.
pub(super) fn rows(header: &str, rows: &[String]) -> String {
    let mut text = format!("rows     {}, the first:\n  {header}\n", rows.len());
    for row in rows.iter().take(SHOWN) {
        let _ = writeln!(text, "  {row}");
    }
    text
}

/// `test A`, `tests A, B`.
fn of_tests(entries: &[Entry]) -> String {
    let ids: BTreeSet<&str> = entries.iter().map(|entry| entry.test.as_str()).collect();
    let word = if ids.len() > 1 { "tests" } else { "test" };
    let ids: Vec<&str> = ids.into_iter().collect();
    format!("{word} {}", ids.join(", "))
}

/// Where on the face all rows were taken, if the user says it.
fn face(text: &mut String, args: &ImportArgs) {
    if let Some(face) = args.face {
        line(
            text,
            "face",
            &format!("{face} mm from the middle of the face"),
        );
    }
}

fn titles(text: &mut String, titles: &Titles) {
    for (row, words) in &titles.passed_over {
        line(text, "title", &format!("row {row} passed over: {words}"));
    }
}

fn sign(turned: bool, stated: bool) -> &'static str {
    match (turned, stated) {
        (false, _) => "",
        (true, true) => ", their sign turned",
        (true, false) => ", their sign turned (the title says that lost material is negative)",
    }
}

fn members(members: &[Subject]) -> String {
    let names: Vec<&str> = members.iter().map(|member| member.name()).collect();
    names.join(" ")
}

/// What states the standard deviation of the values.
fn sigma(args: &ImportArgs, has_column: bool, entries: &[Entry], unit: &str) -> String {
    let states_sigma = args.sigma.is_some() || args.relative_sigma > 0.0;
    match entries.iter().filter(|entry| entry.sigma.is_none()).count() {
        _ if has_column && states_sigma => {
            "as the column says (what the options say is of the sheets without one)".to_owned()
        }
        _ if states_sigma => stated_sigma(args, unit),
        0 => "as the column says".to_owned(),
        n if n == entries.len() => stated_sigma(args, unit),
        n => format!("as the column says; empty in {n} rows, where it is estimated"),
    }
}

/// What is said of the standard deviation where no column has it.
fn stated_sigma(args: &ImportArgs, unit: &str) -> String {
    let of = match args.relative_to {
        ShareOf::Value => "the value",
        ShareOf::Largest => "the largest value of its curve",
    };
    let share = format!("{} % of {of}", rounded_percent(args.relative_sigma));
    let is_loss = args.per_interval.iter().any(|what| what.loss().is_some());
    let of_each = match is_loss {
        true => " for each interval alone",
        false => "",
    };
    match (args.sigma, args.relative_sigma > 0.0) {
        (None, false) => LEFT_EMPTY.to_owned(),
        (None, true) => format!("{share}{of_each}"),
        (Some(sigma), false) if of_each.is_empty() => format!("{sigma} {unit} for each"),
        (Some(sigma), false) => format!("{sigma} {unit}{of_each}"),
        (Some(sigma), true) => {
            format!("{sigma} {unit} and {share}, as the root of their squares{of_each}")
        }
    }
}

/// A share in percent without a trail of rounding.
fn rounded_percent(share: f64) -> f64 {
    (1e8 * share).round() / 1e6
}
