//! Columns that number repeated measurements, as `--repeat` does for a whole table.

use std::collections::{BTreeMap, BTreeSet};

use crate::measure::import::Sheet;
use crate::measure::import::columns::{Column, What};
use crate::measure::import::numbers::pointed;
use crate::measure::import::wanted::Wanted;
use crate::measure::names;

/// Largest number of a repeat that is believed: larger ones count something else.
const MOST: u32 = 20;

/// Columns that tell what a row is of, beside its place.
const LABELS: [&str; 7] = [
    "test", "member", "cycles", "quantity", "trace", "face", "tooth",
];

/// Takes a column for the number of the repeat if its name may mean that and its small whole numbers tell whole curves apart; one that counts points,
/// checkpoints or orders does not. A second column of tests may be it (`run` beside `test`).
pub(super) fn by_content(columns: &mut [Column], sheet: &Sheet, head: usize, wanted: &Wanted<'_>) {
    let count = |name: &str| {
        columns
            .iter()
            .filter(|c| c.what.own() == Some(name))
            .count()
    };
    // where no trace is named there is nothing to tell apart
    let has_traces = wanted.traces && (count("quantity") == 0 || count("trace") > 0);
    let tests = count("test") + usize::from(wanted.test.is_some());
    let is_free = |column: &Column| match column.what {
        What::Unknown => true,
        What::Own("test") => tests > 1,
        _ => false,
    };
    let is_it = |column: &&Column| {
        is_free(column)
            && names::may_number_repeats(&column.name())
            && numbers_curves(column, columns, sheet, head)
    };
    let at = columns.iter().filter(|_| has_traces).find(is_it);
    if let Some(at) = at.map(|column| column.at) {
        columns[at].what = What::Repeat;
    }
}

/// Whether each number of a column stands beside several places of a curve, and beside others of the same curve or as the only one of the table.
fn numbers_curves(column: &Column, columns: &[Column], sheet: &Sheet, head: usize) -> bool {
    let is_label = |other: &&Column| {
        let own = other.what.own();
        other.at != column.at && own.is_some_and(|own| LABELS.contains(&own))
    };
    let labels: Vec<usize> = columns.iter().filter(is_label).map(|c| c.at).collect();
    let position = columns.iter().find(|c| c.what.own() == Some("position"));
    let Some(position) = position else {
        return false;
    };
    let mut curves: BTreeMap<Vec<&str>, BTreeMap<u32, BTreeSet<&str>>> = BTreeMap::new();
    for cells in sheet.rows.iter().skip(head + 1) {
        let text = |at: usize| cells.get(at).map_or("", String::as_str);
        if text(position.at).is_empty() {
            continue;
        }
        let Some(repeat) = number(text(column.at)) else {
            return false;
        };
        let curve = labels.iter().map(|&at| text(at)).collect();
        let places = curves.entry(curve).or_default().entry(repeat).or_default();
        places.insert(text(position.at));
    }
    let all: BTreeSet<u32> = curves.values().flat_map(BTreeMap::keys).copied().collect();
    let has_repeats = curves.values().any(|repeats| repeats.len() > 1);
    let mut places = curves.values().flat_map(BTreeMap::values);
    places.all(|places| places.len() > 1) && (has_repeats || all.len() == 1)
}

/// The number of a repeat that stands in a cell.
pub(super) fn number(text: &str) -> Option<u32> {
    let number: f64 = pointed(text).parse().ok()?;
    let is_small = number.fract() == 0.0 && (0.0..=f64::from(MOST)).contains(&number);
    is_small.then_some(number as u32)
}
