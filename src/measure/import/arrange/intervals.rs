//! Whether parts were weighed new and after each stop, or before and after each interval.

use std::collections::BTreeMap;

use super::pairs::{Pair, Reading};
use crate::measure::import::columns::{columns, known_by_content};
use crate::measure::import::numbers::pointed;
use crate::measure::import::{ImportError, Sheet, Wanted};

/// Since when a row's two weighings show a loss.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Weighed {
    /// Since the start of the test: all masses before are that of the new part.
    SinceNew,
    /// Since the last stop: each mass before is the mass after of the stop before.
    AtEachStop,
}

/// The readings of each test and member, by their numbers, along rising cycles; as they stand where cycles are no numbers.
pub(super) fn groups(
    sheet: &Sheet,
    head: usize,
    readings: &[Reading],
    wanted: &Wanted<'_>,
) -> Vec<Vec<usize>> {
    let mut columns = columns(&sheet.rows[head]);
    known_by_content(&mut columns, sheet, head, wanted);
    let text = |reading: &Reading, name: &str| {
        let column = columns.iter().find(|c| c.what.own() == Some(name));
        let cell = column.and_then(|column| sheet.rows[reading.row].get(column.at));
        cell.cloned().unwrap_or_default()
    };
    let mut groups: BTreeMap<[String; 2], Vec<usize>> = BTreeMap::new();
    for (n, reading) in readings.iter().enumerate() {
        let of = ["test", "member"].map(|name| text(reading, name));
        groups.entry(of).or_default().push(n);
    }
    let cycles = |n: &usize| pointed(&text(&readings[*n], "cycles")).parse::<f64>().ok();
    for group in groups.values_mut() {
        if group.iter().all(|n| cycles(n).is_some()) {
            group.sort_by(|a, b| cycles(a).partial_cmp(&cycles(b)).unwrap_or(a.cmp(b)));
        }
    }
    groups.into_values().collect()
}

/// How the readings of one test and member were weighed.
///
/// # Errors
/// [`ImportError`] where they are neither of the two: with another part or an interval left out no loss is known.
pub(super) fn weighed(
    group: &[usize],
    readings: &[Reading],
    pair: &Pair,
) -> Result<Weighed, ImportError> {
    let decimals = group.iter().map(|&n| readings[n].decimals).max();
    // one in the last decimal is rounding
    let rounding = 1.001 * 10f64.powi(-(decimals.unwrap_or(0) as i32));
    let is_same = |a: f64, b: f64| (a - b).abs() <= rounding;
    let first = &readings[group[0]];
    let mut found = None;
    for pair_of in group.windows(2) {
        let [last, this] = [&readings[pair_of[0]], &readings[pair_of[1]]];
        let allowed = [
            (is_same(this.before, first.before), Weighed::SinceNew),
            (is_same(this.before, last.after), Weighed::AtEachStop),
        ];
        let mut allowed = allowed
            .iter()
            .filter(|(is_it, how)| *is_it && found.is_none_or(|f| f == *how));
        let Some((_, how)) = allowed.next() else {
            return Err(refused(first, last, this, pair));
        };
        found = Some(*how);
    }
    Ok(found.unwrap_or(Weighed::SinceNew))
}

fn refused(first: &Reading, last: &Reading, this: &Reading, pair: &Pair) -> ImportError {
    let (before, after) = (&pair.before.written, &pair.after.written);
    ImportError(format!(
        "row {}: `{before}` is {}, in row {} it is {} and `{after}` in row {} is {}: of each test and member either all rows have the same \
         `{before}`, or each has `{after}` of the stop before it. Otherwise write what was lost since the start of the test as `mass loss [mg]`",
        this.row + 1,
        this.before,
        first.row + 1,
        first.before,
        last.row + 1,
        last.after
    ))
}
