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

/// The readings that agree in some columns, by their numbers, along rising cycles; as they stand where cycles are no numbers.
pub(super) fn groups(
    sheet: &Sheet,
    head: usize,
    readings: &[Reading],
    (names, wanted): (&[&str], &Wanted<'_>),
) -> Vec<Vec<usize>> {
    let mut columns = columns(&sheet.rows[head]);
    known_by_content(&mut columns, sheet, head, wanted);
    let text = |reading: &Reading, name: &str| {
        let column = columns.iter().find(|c| c.what.own() == Some(name));
        let cell = column.and_then(|column| sheet.rows[reading.row].get(column.at));
        cell.cloned().unwrap_or_default()
    };
    let mut groups: BTreeMap<Vec<String>, Vec<usize>> = BTreeMap::new();
    for (n, reading) in readings.iter().enumerate() {
        let of = names.iter().map(|name| text(reading, name)).collect();
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

/// How the readings of one group were weighed. Where they are neither of the two along their cycles, but each row goes on where the one above it
/// ended, the group is left in the order of the rows: then its cycles are not what they should be.
///
/// # Errors
/// [`ImportError`] where they are neither of the two: with another part or an interval left out no loss is known.
pub(super) fn weighed(
    group: &mut Vec<usize>,
    readings: &[Reading],
    pair: &Pair,
) -> Result<Weighed, ImportError> {
    let of = |group: &[usize]| {
        [Weighed::SinceNew, Weighed::AtEachStop]
            .into_iter()
            .find(|how| first_other(group, readings, &[*how]).is_none())
    };
    if let Some(how) = of(group) {
        return Ok(how);
    }
    let mut by_rows = group.clone();
    by_rows.sort_by_key(|&n| readings[n].row);
    if of(&by_rows) == Some(Weighed::AtEachStop) {
        *group = by_rows;
        return Ok(Weighed::AtEachStop);
    }
    let both = [Weighed::SinceNew, Weighed::AtEachStop];
    let at = first_other(group, readings, &both).unwrap_or(1);
    let [first, last, this] = [0, at - 1, at].map(|at| &readings[group[at]]);
    Err(refused(first, last, this, pair))
}

/// Place in a group of the first reading that shows that it was weighed in none of some ways.
fn first_other(group: &[usize], readings: &[Reading], ways: &[Weighed]) -> Option<usize> {
    let decimals = group.iter().map(|&n| readings[n].decimals).max();
    // one in the last decimal is rounding
    let rounding = 1.001 * 10f64.powi(-(decimals.unwrap_or(0) as i32));
    let is_same = |a: f64, b: f64| (a - b).abs() <= rounding;
    let first = &readings[group[0]];
    let mut ways = ways.to_vec();
    (1..group.len()).find(|&at| {
        let [last, this] = [at - 1, at].map(|at| &readings[group[at]]);
        ways.retain(|way| match way {
            Weighed::SinceNew => is_same(this.before, first.before),
            Weighed::AtEachStop => is_same(this.before, last.after),
        });
        ways.is_empty()
    })
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
