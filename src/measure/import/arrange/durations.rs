//! Running times or revolutions of each interval of a test alone: added up along the rows to those since its start.

use std::collections::BTreeMap;

use crate::measure::import::columns::{Column, What, columns, known_by_content, with_sides};
use crate::measure::import::numbers::{
    number, number_words, plain_count, pointed, rounded, with_points,
};
use crate::measure::import::per_interval::one_interval;
use crate::measure::import::{Decimal, ImportError, Sheet, Wanted, cell_name};
use crate::measure::{Quantity, names};

/// Words that make the name of a total one of an interval, beside those for stops.
const OF_EACH: [&str; 9] = [
    "per", "each", "during", "je", "pro", "ogni", "par", "chaque", "por",
];
/// Words that stand between.
const BETWEEN: [&str; 16] = [
    "in", "the", "im", "der", "dem", "nel", "nell", "nella", "dans", "la", "en", "pendant",
    "durante", "within", "wahrend", "le",
];

/// The sheet with the names of totals in place of those of intervals in its header, and the names that were changed, old and new. As it is where
/// the user says nothing of intervals.
pub(super) fn named(sheet: &Sheet, head: usize, wanted: &Wanted<'_>) -> (Sheet, Vec<String>) {
    let mut sheet = sheet.clone();
    let mut said = Vec::new();
    let per_interval = &wanted.per_interval;
    if !per_interval.cycles && per_interval.losses.is_empty() {
        return (sheet, said);
    }
    let is_counted = |header: &[String]| {
        (with_sides(header).iter()).any(|column| column.what.own() == Some("cycles"))
    };
    let has_cycles = is_counted(&sheet.rows[head]);
    for cell in &mut sheet.rows[head] {
        let Some((name, of)) = of_total(cell) else {
            continue;
        };
        let is_asked = match of {
            None => per_interval.cycles && !has_cycles,
            Some(loss) => per_interval.losses.contains(&loss),
        };
        if is_asked {
            said.push(format!("`{cell}`: read as `{name}` of each interval"));
            *cell = name;
        }
    }
    (sheet, said)
}

/// What is said of columns whose names are those of intervals, where nobody asked for them.
pub(in crate::measure::import) fn hint(sheet: &Sheet) -> Option<String> {
    let mut cells = Vec::new();
    let mut words = Vec::new();
    for cell in sheet.rows.iter().flatten() {
        if let Some((_, of)) = of_total(cell) {
            cells.push(format!("`{cell}`"));
            words.push(of.map_or("cycles", Quantity::name));
        }
    }
    words.sort_unstable();
    words.dedup();
    (!cells.is_empty()).then(|| {
        format!(
            "if {} hold what each interval alone gave, say --per-interval {}",
            cells.join(" and "),
            words.join(",")
        )
    })
}

/// The name of a total behind that of an interval, and the loss that it is, none inside for cycles; none for other names.
fn of_total(cell: &str) -> Option<(String, Option<Quantity>)> {
    let only = |text: &str| with_sides(&[text.to_owned()]).pop();
    let own = only(cell)?;
    if own.what != What::Unknown {
        return None;
    }
    let says_each =
        |word: &str| names::is_stop(word) || OF_EACH.contains(&names::folded(word).as_str());
    let stands_between = |word: &str| BETWEEN.contains(&names::folded(word).as_str());
    if !cell.split_whitespace().any(says_each) && own.unit.is_none() {
        return None;
    }
    let mut kept: Vec<&str> = cell.split_whitespace().collect();
    kept.retain(|word| !says_each(word) && !stands_between(word));
    let kept = kept.join(" ");
    match only(&kept)?.what {
        What::Own("cycles") => return Some((kept, None)),
        What::Values(loss) => return Some((kept, Some(loss))),
        _ => {}
    }
    let unit = own.unit.as_deref()?;
    names::hours_of_unit(unit).map(|_| (format!("time [{unit}]"), None))
}

/// Adds up what stands in the column of cycles, and says so; false where the header has none, or no values.
///
/// With a column of numbered stops the intervals are those of its numbers, otherwise each row is one of its part.
///
/// # Errors
/// [`ImportError`] for rows that stand twice or are not in order, and where an interval is missing.
pub(super) fn as_totals(
    sheet: &mut Sheet,
    head: usize,
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) -> Result<bool, ImportError> {
    let mut header = columns(&sheet.rows[head]);
    known_by_content(&mut header, sheet, head, wanted);
    let own = |name: &str| header.iter().find(|c| c.what.own() == Some(name));
    let is_measured = |column: &Column| match column.what {
        What::Weighing(_) | What::Profile(_) | What::Span(_) | What::Chord(_) => true,
        what => what.own() == Some("value"),
    };
    let Some(cycles) = own("cycles").filter(|_| header.iter().any(is_measured)) else {
        return Ok(false);
    };
    let is_stop = |column: &&Column| column.what == What::Unknown && names::is_stop(&column.name());
    let stops = header.iter().find(is_stop);
    if own("position").is_some() && stops.is_none() {
        return Err(ImportError(format!(
            "--per-interval cycles: of values at several places the table has to say which belong to one interval: add a column `interval` that \
             numbers them (1, 2, ...), beside {}",
            cycles.cell(head)
        )));
    }
    let read = with_points(sheet, wanted.decimal, |_, _| false, |_, _, _| false)?;
    let text = |row: usize, column: Option<&Column>| -> &str {
        let cell = column.and_then(|column| read.rows[row].get(column.at));
        cell.map_or("", String::as_str)
    };
    let labels = ["quantity", "position", "trace", "face", "tooth"];
    let test = |row: usize| {
        let text = text(row, own("test"));
        wanted.test_of(text).unwrap_or(text).to_owned()
    };
    let part = |row: usize| {
        let member = text(row, own("member"));
        let member = names::member(member).map_or(member, |member| member.name());
        // traces follow the intervals where these have numbers
        let labels = labels.map(|name| match (name, stops) {
            ("trace", Some(_)) => "",
            _ => text(row, own(name)),
        });
        (test(row), member.to_owned(), labels)
    };
    let mut rows = Vec::new();
    for row in head + 1..read.rows.len() {
        let written = text(row, Some(cycles));
        if written.is_empty() {
            continue;
        }
        if wanted.decimal.is_none() && cycles.hours.is_none() {
            plain_count(written, row, cycles.at, read.plain_decimals)?;
        }
        let length = number(written, row, cycles.at)?;
        if length < 0.0 {
            return Err(ImportError(format!(
                "{}: `{written}` below `{}`: an interval has no negative length",
                cell_name(row, cycles.at),
                cycles.written
            )));
        }
        rows.push((row, length));
    }
    let totals = match stops {
        Some(stops) => {
            let mut numbered = Numbered::default();
            for &(row, length) in &rows {
                let stop = stop_of(text(row, Some(stops)), row, stops)?;
                let written = text(row, Some(cycles)).to_owned();
                numbered.take((row, stop), (length, written), test(row), part(row))?;
            }
            numbered.totals(&stops.written)?
        }
        None => {
            let mut sums = BTreeMap::new();
            let mut lacking = BTreeMap::new();
            let mut totals = Vec::new();
            let mut length = rows.iter().copied().peekable();
            for row in head + 1..read.rows.len() {
                let is_measured = || {
                    header
                        .iter()
                        .any(|c| is_measured(c) && !text(row, Some(c)).is_empty())
                };
                let Some((_, length)) = length.next_if(|(own, _)| *own == row) else {
                    if is_measured() {
                        lacking.entry(part(row)).or_insert(row);
                    }
                    continue;
                };
                if let Some(before) = lacking.get(&part(row)) {
                    return Err(ImportError(format!(
                        "{}: nothing stands here below `{}`: without the length of this interval the total of row {} is not known",
                        cell_name(*before, cycles.at),
                        cycles.written,
                        row + 1
                    )));
                }
                let sum: &mut f64 = sums.entry(part(row)).or_default();
                *sum += length;
                totals.push((row, *sum));
            }
            if sums.len() == totals.len() {
                return Err(one_interval("cycles"));
            }
            totals
        }
    };
    let has_commas = match wanted.decimal {
        Some(decimal) => decimal == Decimal::Comma,
        None => rows
            .iter()
            .any(|&(row, _)| text(row, Some(cycles)).contains(',')),
    };
    let how = match stops {
        Some(stops) => format!("those of the numbers in `{}`", stops.written),
        None => "the rows of each test and member in their order (a column `interval` with their numbers would be checked)".to_owned(),
    };
    said.push(format!(
        "`{}` is that of each interval alone: added up to totals since the start of the test; the intervals are {how}",
        cycles.written
    ));
    let at = cycles.at;
    for (row, total) in totals {
        let total = rounded(total).to_string();
        sheet.rows[row][at] = match has_commas {
            true => total.replace('.', ","),
            false => total,
        };
    }
    Ok(true)
}

/// The number of the interval of a row.
fn stop_of(text: &str, row: usize, column: &Column) -> Result<u32, ImportError> {
    let words = number_words(text);
    let number = match words[..] {
        [one] => pointed(one).parse::<f64>().ok(),
        _ => None,
    };
    let whole = number.filter(|n| n.fract() == 0.0 && (0.0..1e6).contains(n));
    whole.map(|n| n as u32).ok_or_else(|| {
        ImportError(format!(
            "{}: `{text}` below `{}`: write the number of the interval there, 1 for the first",
            cell_name(row, column.at),
            column.written
        ))
    })
}

/// What has rows of its own in each interval: test, member and labels.
type Part<'t> = (String, String, [&'t str; 5]);

/// The intervals of tests by their numbers, each with its length, as written too, and its first row.
#[derive(Default)]
struct Numbered<'t> {
    tests: BTreeMap<String, BTreeMap<u32, (f64, String, usize)>>,
    last: BTreeMap<Part<'t>, (u32, usize)>,
    rows: Vec<(usize, String, u32)>,
}

impl<'t> Numbered<'t> {
    /// Takes in a row.
    fn take(
        &mut self,
        (row, stop): (usize, u32),
        (length, written): (f64, String),
        test: String,
        part: Part<'t>,
    ) -> Result<(), ImportError> {
        if let Some((before, other)) = self.last.insert(part, (stop, row))
            && stop <= before
        {
            return Err(ImportError(match stop == before {
                true => format!(
                    "row {}: interval {stop} stands in row {} already: take one out",
                    row + 1,
                    other + 1
                ),
                false => format!(
                    "row {}: interval {stop} stands below interval {before} of row {}: put the rows in the order of the intervals",
                    row + 1,
                    other + 1
                ),
            }));
        }
        let intervals = self.tests.entry(test.clone()).or_default();
        let own = intervals
            .entry(stop)
            .or_insert_with(|| (length, written.clone(), row));
        if own.0 != length {
            return Err(ImportError(format!(
                "row {}: interval {stop} lasts `{written}`, in row {} it lasts `{}`: one of them is wrong",
                row + 1,
                own.2 + 1,
                own.1
            )));
        }
        self.rows.push((row, test, stop));
        Ok(())
    }

    /// The total until the end of each row's interval.
    fn totals(self, written: &str) -> Result<Vec<(usize, f64)>, ImportError> {
        let mut totals: BTreeMap<(&str, u32), f64> = BTreeMap::new();
        for (test, intervals) in &self.tests {
            let mut sum = 0.0;
            // a 0 may be the new part
            let first = u32::from(!intervals.contains_key(&0));
            for (next, (stop, (length, _, row))) in (first..).zip(intervals) {
                if *stop != next {
                    let of = match test.as_str() {
                        "" => String::new(),
                        id => format!(" of test {id}"),
                    };
                    return Err(ImportError(format!(
                        "row {}: interval {stop} below `{written}`, and interval {next}{of} is not there: without its length no total is known",
                        row + 1
                    )));
                }
                sum += length;
                totals.insert((test, *stop), sum);
            }
        }
        if self.tests.values().all(|intervals| intervals.len() == 1) {
            return Err(one_interval("cycles"));
        }
        let of = |(row, test, stop): &(usize, String, u32)| (*row, totals[&(test.as_str(), *stop)]);
        Ok(self.rows.iter().map(of).collect())
    }
}
