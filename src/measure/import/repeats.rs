//! What stands out in the rows of a table before any physics: repeats that lie far apart, masses and teeth that grew, depths at the start, and places that were exchanged.

use std::collections::BTreeMap;

use super::Entry;
use super::entry::four_digits;
use super::exchanged::exchanged;
use crate::measure::Quantity;

/// Standard deviations of a difference beyond which two readings are hardly ones of the same.
const FAR: f64 = 5.0;
/// The same as a share of the larger one, where no standard deviation is stated.
const FAR_SHARE: f64 = 0.25;
/// Standard deviations by which a negative loss of mass is no noise, as comparisons have it.
const GAIN_SIGMAS: f64 = 2.0;

/// Warnings about rows, a line each.
pub fn doubtful(entries: &[Entry]) -> Vec<String> {
    let far = far_apart(entries).into_iter();
    let losses = [
        Quantity::MassLoss,
        Quantity::SpanLoss,
        Quantity::ChordalLoss,
    ];
    far.chain(before_the_first_cycle(entries))
        .chain(losses.into_iter().filter_map(|loss| grown(entries, loss)))
        .chain(exchanged(entries))
        .collect()
}

/// Readings of the same at one time and place that differ by more than their noise.
fn far_apart(entries: &[Entry]) -> Option<String> {
    let mut groups: BTreeMap<_, Vec<&Entry>> = BTreeMap::new();
    for entry in entries {
        let time = (&entry.test, entry.member, entry.cycles.to_bits());
        let labels = (&entry.trace, &entry.face, &entry.tooth);
        let place = entry.position.map(f64::to_bits);
        let key = (time, entry.quantity.name(), place, labels);
        groups.entry(key).or_default().push(entry);
    }
    let mut far: Vec<[&Entry; 2]> = groups
        .values()
        .filter_map(|group| farthest(group))
        .collect();
    far.sort_by_key(|[one, other]| one.cell.min(other.cell));
    let [one, other] = far.first()?;
    let others = match far.len() - 1 {
        0 => String::new(),
        n => format!(" ({n} more such)"),
    };
    Some(format!(
        "{}: {} and {} {} are taken as repeats, though they lie far apart{others}: is one of them of another checkpoint?",
        of(one),
        four_digits(one.value),
        four_digits(other.value),
        one.quantity.shown_unit()
    ))
}

/// The least and the largest of some readings of the same, as they stand in the table, if they are far apart.
fn farthest<'e>(group: &[&'e Entry]) -> Option<[&'e Entry; 2]> {
    let by_value = |a: &&&Entry, b: &&&Entry| a.value.total_cmp(&b.value);
    let least = *group.iter().min_by(by_value)?;
    let largest = *group.iter().max_by(by_value)?;
    let limit = match (least.sigma, largest.sigma) {
        (Some(one), Some(other)) => FAR * one.hypot(other),
        _ => FAR_SHARE * least.value.abs().max(largest.value.abs()),
    };
    let mut both = [least, largest];
    both.sort_by_key(|entry| entry.cell);
    (largest.value - least.value > limit).then_some(both)
}

/// Depths at 0 cycles, where nothing is worn: deviations of the new profile, it may be.
fn before_the_first_cycle(entries: &[Entry]) -> Option<String> {
    let depths = (entries.iter()).filter(|entry| entry.quantity == Quantity::WearDepth);
    let at_start = depths.filter(|entry| entry.cycles == 0.0);
    let largest = at_start.max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()))?;
    (largest.value.abs() > FAR * largest.sigma?).then(|| {
        format!(
            "{}: {} \u{b5}m, where nothing is worn yet: are these deviations from the nominal profile? A title that begins with them (`Profile deviation`) has what \
             they change by taken for the depth",
            of(largest),
            four_digits(largest.value)
        )
    })
}

/// Losses of mass or thickness that are negative beyond their noise.
fn grown(entries: &[Entry], loss: Quantity) -> Option<String> {
    let losses = || (entries.iter()).filter(|entry| entry.quantity == loss);
    let is_grown = |entry: &&Entry| entry.value < -GAIN_SIGMAS * entry.sigma.unwrap_or_default();
    let first = losses().find(is_grown)?;
    let (grown, all) = (losses().filter(is_grown).count(), losses().count());
    let (lost, reading) = match loss {
        Quantity::MassLoss => ("mass", "weighing"),
        _ => ("thickness", "reading"),
    };
    let advice = match 2 * grown > all {
        true => "turn the sign of these values (--turn-sign)".to_owned(),
        false => format!("is a {reading} wrong?"),
    };
    Some(format!(
        "{grown} of {all} values of {} are negative ({}: {} {}), and lost {lost} counts positive: {advice}",
        loss.name(),
        of(first),
        four_digits(first.value),
        loss.shown_unit()
    ))
}

/// What an entry is of, in words.
fn of(entry: &Entry) -> String {
    let place = (entry.position).map_or_else(String::new, |place| format!(" at {place}"));
    format!(
        "{} of the {} in test {} after {} cycles{place}",
        entry.quantity.name(),
        entry.member.name(),
        entry.test,
        entry.cycles
    )
}
