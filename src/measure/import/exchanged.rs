//! Two places of a curve that stand in each other's place.
//!
//! Rows may stand in any order; but where all places rise or fall and just two are out of turn, and the values make a smoother curve in the order of
//! the table than in that of the places, the two places were exchanged and not the rows.

use std::collections::BTreeMap;

use super::Entry;

/// Fewest points of a curve for which an order is told.
const FEWEST: usize = 10;
/// How much smoother the order of the table must be: sum of squared second differences over that of the places' order.
const SMOOTHER: f64 = 0.5;

/// A warning of the first curve with two exchanged places, and of how many others there are.
pub(super) fn exchanged(entries: &[Entry]) -> Option<String> {
    let mut curves: BTreeMap<_, Vec<&Entry>> = BTreeMap::new();
    for entry in entries.iter().filter(|entry| entry.position.is_some()) {
        let time = (&entry.test, entry.member, entry.cycles.to_bits());
        let labels = (&entry.trace, &entry.face, &entry.tooth);
        let key = (time, entry.quantity.name(), labels);
        curves.entry(key).or_default().push(entry);
    }
    let mut found: Vec<[&Entry; 2]> = (curves.into_values()).filter_map(out_of_turn).collect();
    found.sort_by_key(|[one, _]| one.cell);
    let [one, other] = found.first()?;
    let others = match found.len() - 1 {
        0 => String::new(),
        n => format!(" ({n} more such)"),
    };
    let [first, second] = [one, other].map(|entry| entry.position.unwrap_or_default());
    Some(format!(
        "{} of the {} in test {} after {} cycles: the places {first} and {second} are out of order, and the values would make a smoother \
         curve if the two were exchanged{others}: is that a slip?",
        one.quantity.name(),
        one.member.name(),
        one.test,
        one.cycles
    ))
}

/// The two entries of a curve, in the order of the table, whose places stand in each other's turn.
fn out_of_turn(mut curve: Vec<&Entry>) -> Option<[&Entry; 2]> {
    if curve.len() < FEWEST {
        return None;
    }
    curve.sort_by_key(|entry| entry.cell);
    let place = |entry: &&Entry| entry.position.unwrap_or_default();
    let mut by_place = curve.clone();
    by_place.sort_by(|a, b| place(a).total_cmp(&place(b)));
    let falls = place(curve.first()?) > place(curve.last()?);
    if falls {
        by_place.reverse();
    }
    let apart: Vec<usize> = (0..curve.len())
        .filter(|&i| place(&curve[i]) != place(&by_place[i]))
        .collect();
    let [one, other] = apart[..] else {
        return None;
    };
    (bends(&curve) < SMOOTHER * bends(&by_place)).then(|| [curve[one], curve[other]])
}

/// Sum of the squared second differences of the values in their order.
fn bends(curve: &[&Entry]) -> f64 {
    let second = |w: &[&Entry]| w[0].value - 2.0 * w[1].value + w[2].value;
    curve.windows(3).map(|w| second(w).powi(2)).sum()
}
