//! Numbers that a machine writes where it has no value: `-999`, `9999`, `-99.99`, far from all that was measured.

use super::entry::Entry;
use super::numbers::{pointed, rounded};
use super::{Sheet, cell_name};

/// So many times the largest of all other values such a number is at least: a true one hardly is.
const FAR: f64 = 20.0;
/// Least size of such a number as it is written.
const LEAST: f64 = 99.0;
/// So many cells are named.
const NAMED: usize = 6;

/// Takes the values that look like a machine's `no value` out of the rows of a sheet, and says which, one line for each quantity; also
/// the rows.
pub(super) fn leave_out(entries: &mut Vec<Entry>, sheet: &Sheet) -> (Vec<String>, Vec<usize>) {
    let mut quantities: Vec<_> = entries.iter().map(|entry| entry.quantity).collect();
    quantities.sort();
    quantities.dedup();
    let (mut said, mut rows) = (Vec::new(), Vec::new());
    for quantity in quantities {
        let is_own = |entry: &Entry| entry.quantity == quantity;
        let has_nines = |entry: &Entry| is_own(entry) && is_written_with_nines(text(sheet, entry));
        let size = |entry: &&Entry| entry.value.abs();
        let others = entries
            .iter()
            .filter(|entry| is_own(entry) && !has_nines(entry));
        let Some(largest) = others.map(|entry| size(&entry)).max_by(f64::total_cmp) else {
            continue;
        };
        let is_far = |entry: &Entry| largest > 0.0 && entry.value.abs() >= FAR * largest;
        let is_none = |entry: &Entry| has_nines(entry) && is_far(entry);
        let found: Vec<&Entry> = entries.iter().filter(|entry| is_none(entry)).collect();
        if found.is_empty() {
            continue;
        }
        said.push(in_words(&found, sheet, largest));
        rows.extend(found.iter().map(|entry| entry.cell.0));
        entries.retain(|entry| !is_none(entry));
    }
    (said, rows)
}

/// The cells, what stands in them and what it is taken for.
fn in_words(found: &[&Entry], sheet: &Sheet, largest: f64) -> String {
    let cells = found.iter().take(NAMED).map(|entry| {
        let (row, column) = entry.cell;
        format!("{}: `{}`", cell_name(row, column), text(sheet, entry))
    });
    let cells = cells.collect::<Vec<_>>().join(", ");
    let others = match found.len().saturating_sub(NAMED) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    let (looks, is) = match found.len() {
        1 => ("this looks", "it is"),
        _ => ("these look", "they are"),
    };
    let quantity = found[0].quantity;
    format!(
        "{cells}{others}: {looks} like a machine's `no value`, for no other {} is above {} {}: {is} passed over",
        quantity.name(),
        rounded(largest),
        quantity.shown_unit()
    )
}

fn text<'s>(sheet: &'s Sheet, entry: &Entry) -> &'s str {
    let (row, column) = entry.cell;
    let cell = sheet.rows.get(row).and_then(|cells| cells.get(column));
    cell.map_or("", String::as_str)
}

/// Whether a number has no other digits than nines, but for zeros at the end of its decimals.
fn is_written_with_nines(text: &str) -> bool {
    let number = pointed(text);
    let number = number.trim_start_matches(['+', '-', '\u{2212}']);
    let (whole, decimals) = number.split_once('.').unwrap_or((number, ""));
    let digits = [whole, decimals.trim_end_matches('0')].concat();
    let is_large = number.parse::<f64>().is_ok_and(|number| number >= LEAST);
    is_large && digits.len() >= 3 && digits.bytes().all(|digit| digit == b'9')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_nines_are_told() {
        for text in ["-999", "9999", "-99.99", "-99,99", "999.000", "-9999.99"] {
            assert!(is_written_with_nines(text), "{text}");
        }
        for text in [
            "99", "-9.99", "998", "1999", "0.999", "", "n/a", "99.0", "9990",
        ] {
            assert!(!is_written_with_nines(text), "{text}");
        }
    }
}
