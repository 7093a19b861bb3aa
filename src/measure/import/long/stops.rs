//! Times since the start of a test, not those of each stop: rows that are known to follow each other have to stand at rising ones.

use std::collections::{BTreeMap, HashMap};

use super::Read;
use crate::measure::import::columns::{Column, What};
use crate::measure::import::entry::Entry;
use crate::measure::import::numbers::{number_words, pointed};
use crate::measure::import::{ImportError, Sheet};
use crate::measure::{Subject, names};

/// Refuses times or revolutions that do not rise from stop to stop; if there are several stops, says how they are taken. The order of the stops is
/// that of the weighings of a part (`chains`, by rows), and that of the numbers in a column of stops.
pub(super) fn refuse_times_of_each(
    entries: &[Entry],
    sheet: &Sheet,
    (read, columns): (&Read<'_>, &[Column]),
    chains: &[Vec<usize>],
) -> Result<Option<String>, ImportError> {
    let of_row: HashMap<usize, &Entry> = entries.iter().map(|e| (e.cell.0, e)).collect();
    let cell = |row: usize, column: &Column| {
        let cell = sheet.rows[row].get(column.at);
        cell.map_or("", String::as_str)
    };
    let written = &read.cycles.written;
    let what = match read.cycles.hours {
        Some(_) => "running times",
        None => "revolutions",
    };
    let check = |first: &Entry, second: &Entry, stops: &[usize], why: &str| {
        if second.cycles > first.cycles {
            return Ok(());
        }
        let [a, b] = [first, second].map(|entry| entry.cell.0);
        let texts: Vec<&str> = stops.iter().map(|&row| cell(row, read.cycles)).collect();
        Err(ImportError(format!(
            "row {}: `{}` below `{written}` is not more than the `{}` of row {}, although {why}: {what} since the start of the test are wanted, not \
             those of each stop. Add them up{}, or say --per-interval cycles, or --per-interval cycles,{} where these too are of each stop alone",
            b + 1,
            cell(b, read.cycles),
            cell(a, read.cycles),
            a + 1,
            totals(&texts),
            first.quantity.name()
        )))
    };
    for rows in chains {
        for pair in rows.windows(2) {
            if let [Some(first), Some(second)] = [pair[0], pair[1]].map(|row| of_row.get(&row)) {
                check(
                    first,
                    second,
                    rows,
                    "its weighing goes on where that one ended",
                )?;
            }
        }
    }
    let is_stop = |column: &&Column| column.what == What::Unknown && names::is_stop(&column.name());
    let column = columns.iter().find(is_stop);
    let mut parts: BTreeMap<(&str, Subject), BTreeMap<u32, Vec<&Entry>>> = BTreeMap::new();
    let numbered = entries.iter().filter_map(|entry| {
        let words = number_words(cell(entry.cell.0, column?));
        let [number] = words[..] else { return None };
        Some((entry, number.parse().ok()?))
    });
    for (entry, number) in numbered {
        let part = parts.entry((&entry.test, entry.member)).or_default();
        part.entry(number).or_default().push(entry);
    }
    for stops in parts.values() {
        let rows: Vec<usize> = stops.values().map(|own| own[0].cell.0).collect();
        let by_time = |a: &&&Entry, b: &&&Entry| a.cycles.total_cmp(&b.cycles);
        let of_each: Vec<(&u32, &Vec<&Entry>)> = stops.iter().collect();
        for pair in of_each.windows(2) {
            let last = pair[0].1.iter().rev().max_by(by_time);
            let next = pair[1].1.iter().min_by(by_time);
            if let (Some(last), Some(next)) = (last, next) {
                let name = column.map_or("", |column| column.written.as_str());
                let why = format!("`{name}` {} comes after {}", pair[1].0, pair[0].0);
                check(last, next, &rows, &why)?;
            }
        }
    }
    let several =
        chains.iter().any(|rows| rows.len() > 1) || parts.values().any(|stops| stops.len() > 1);
    Ok(several.then(|| {
        format!(
            "`{written}` is taken as the total since the start of the test at each stop; if it is that of each interval alone, say --per-interval cycles"
        )
    }))
}

/// What numbers of stops add up to, as they are written; nothing if they are no numbers.
fn totals(texts: &[&str]) -> String {
    let plain: Vec<String> = texts.iter().map(|text| pointed(text)).collect();
    let numbers: Option<Vec<f64>> = plain.iter().map(|text| text.parse().ok()).collect();
    let Some(numbers) = numbers else {
        return String::new();
    };
    let decimals = |text: &String| text.split_once('.').map_or(0, |(_, digits)| digits.len());
    let decimals = plain.iter().map(decimals).max().unwrap_or(0);
    let has_commas = texts.iter().any(|text| text.contains(','));
    let mut sum = 0.0;
    let sums = numbers.into_iter().map(|number| {
        sum += number;
        let text = format!("{sum:.decimals$}");
        if has_commas {
            text.replace('.', ",")
        } else {
            text
        }
    });
    format!(": {}", sums.collect::<Vec<String>>().join("; "))
}
