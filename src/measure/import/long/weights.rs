//! Masses of a part, one at each stop of a test, in a column of which the user says that it holds what was lost.

use std::collections::BTreeMap;

use super::Read;
use crate::measure::import::entry::Entry;
use crate::measure::import::numbers::rounded;
use crate::measure::import::wanted::Wanted;
use crate::measure::import::{ImportError, cell_name};
use crate::measure::{Quantity, Subject, names};

/// Part of the largest value from which that at the start of a test is no scatter of a loss of nothing.
const START: f64 = 0.5;
/// Part of itself by which a loss grows at least over a test: masses stay the same to far less.
const GROWS: f64 = 0.01;

/// Takes masses from the mass at the start of the test, and says so; losses stay as they are.
///
/// # Errors
/// [`ImportError`] where masses that do not grow are called losses and none was weighed at the start.
pub(super) fn as_losses(
    entries: &mut Vec<Entry>,
    read: &Read<'_>,
    wanted: &Wanted<'_>,
) -> Result<Option<String>, ImportError> {
    let written = &read.value.written;
    let is_log = wanted.quantity == Some(Quantity::MassLoss)
        && names::is_mass(&read.value.name())
        && entries
            .iter()
            .all(|entry| entry.quantity == Quantity::MassLoss);
    if !is_log {
        return Ok(None);
    }
    let way_out = format!(
        "add the row of the new part, at 0, and the losses are taken from it; if `{written}` is what was lost since the start, call it `mass loss`"
    );
    let differences = from_start(entries, &way_out)?;
    Ok(differences.then(|| {
        format!(
            "mass loss: `{written}` at 0 less each `{written}` of the same test and member; the rows at 0 are not written themselves"
        )
    }))
}

/// Takes the masses of each test and member from that at 0 cycles; false where all are losses.
pub(in crate::measure::import) fn from_start(
    entries: &mut Vec<Entry>,
    way_out: &str,
) -> Result<bool, ImportError> {
    let mut parts: BTreeMap<(String, Subject), Vec<&Entry>> = BTreeMap::new();
    for entry in entries.iter() {
        let of = (entry.test.clone(), entry.member);
        parts.entry(of).or_default().push(entry);
    }
    let starts: BTreeMap<(String, Subject), Option<f64>> = (parts.iter())
        .map(|(of, own)| (of.clone(), start(own)))
        .collect();
    let is_mass = starts.values().any(Option::is_some);
    for (of, own) in &parts {
        let first = own[0];
        let cell = cell_name(first.cell.0, first.cell.1);
        let (test, member) = (&of.0, of.1.name());
        if is_mass && starts[of].is_none() {
            return Err(ImportError(format!(
                "{cell}: no mass of the {member} in test {test} stands at 0 h or 0 cycles, other parts have one: {way_out}"
            )));
        }
        if !is_mass && !grows(own) {
            return Err(ImportError(format!(
                "{cell}: {} mg of loss is the mass itself: the values of the {member} in test {test} do not grow with time, as losses do: {way_out}",
                rounded(first.value)
            )));
        }
    }
    if !is_mass {
        return Ok(false);
    }
    entries.retain_mut(|entry| {
        let start = starts[&(entry.test.clone(), entry.member)].unwrap_or_default();
        // where signs are turned, both have been
        let lost = start.abs() - entry.value.abs();
        let is_start = entry.cycles == 0.0;
        entry.value = rounded(lost);
        !is_start
    });
    match entries.is_empty() {
        true => Err(ImportError(
            "only the masses at 0 stand in the table: nothing was lost yet".to_owned(),
        )),
        false => Ok(true),
    }
}

/// The mass of a part at the start of a test, the mean of several; none where nothing was weighed then, or nothing lost.
fn start(own: &[&Entry]) -> Option<f64> {
    let values = own.iter().filter(|entry| entry.cycles == 0.0);
    let values: Vec<f64> = values.map(|entry| entry.value).collect();
    let largest = own
        .iter()
        .map(|entry| entry.value.abs())
        .fold(0.0, f64::max);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (mean.abs() > START * largest).then_some(mean)
}

/// Whether values may be losses: they grow from the first to the last time, or scatter about nothing. Of one time it is not known.
fn grows(own: &[&Entry]) -> bool {
    let by_time = |a: &&&Entry, b: &&&Entry| a.cycles.total_cmp(&b.cycles);
    let [Some(first), Some(last)] = [own.iter().min_by(by_time), own.iter().max_by(by_time)] else {
        return true;
    };
    let sizes = || own.iter().map(|entry| entry.value.abs());
    let is_nearly_one = sizes().fold(f64::INFINITY, f64::min) > START * sizes().fold(0.0, f64::max);
    first.cycles == last.cycles
        || !is_nearly_one
        || last.value.abs() > (1.0 + GROWS) * first.value.abs()
}
