//! Traces of a long table.

use std::collections::{BTreeMap, BTreeSet};

use super::Read;
use crate::measure::Subject;
use crate::measure::import::ImportError;
use crate::measure::import::entry::{Entry, name_repeats, refuse_twice};
use crate::measure::import::wanted::Wanted;

type Result<T> = std::result::Result<T, ImportError>;

/// Names the traces, after two equal rows are refused; says where the names come from.
pub(super) fn name(
    entries: &mut [Entry],
    read: &Read<'_>,
    wanted: &Wanted<'_>,
) -> Result<&'static str> {
    refuse_twice(entries)?;
    let said = if !wanted.traces {
        entries.iter_mut().for_each(|entry| entry.trace.clear());
        "none: the instrument's zero is the same for all (--no-traces)"
    } else if read.trace.is_some() {
        as_the_column_says(entries, wanted)
    } else if read.quantity.is_some() {
        "none: there is no column of traces beside the quantities"
    } else {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for entry in entries.iter().filter(|entry| entry.position.is_some()) {
            *counts.entry(entry.own_trace(wanted)).or_default() += 1;
        }
        let mut any = false;
        for entry in entries.iter_mut() {
            let trace = entry.own_trace(wanted);
            if counts.get(&trace).is_some_and(|&points| points > 1) {
                entry.trace = trace;
                any = true;
            }
        }
        if any {
            "one for each test, member and checkpoint: the instrument's zero is not known (--no-traces: it is the same for all)"
        } else {
            "none: no curve has several points"
        }
    };
    if wanted.repeat.is_some() && entries.iter().all(|entry| entry.trace.is_empty()) {
        return Err(ImportError(
            "--repeat names traces, and these rows have none: leave it out".to_owned(),
        ));
    }
    name_repeats(entries);
    Ok(said)
}

/// Gives the names of a column what they lack to be of one zero each: a new test, member or checkpoint has another one, whatever a column numbers.
fn as_the_column_says(entries: &mut [Entry], wanted: &Wanted<'_>) -> &'static str {
    let named = || entries.iter().filter(|entry| !entry.trace.is_empty());
    let mut curves: BTreeMap<&str, BTreeMap<(&str, Subject), BTreeSet<u64>>> = BTreeMap::new();
    for entry in named() {
        let of = curves.entry(&entry.trace).or_default();
        let checkpoints = of.entry((&entry.test, entry.member)).or_default();
        // what has no place is a record of many times
        checkpoints.extend(entry.position.map(|_| entry.cycles.to_bits()));
    }
    // another table that comes behind this one may have the same number
    let are_numbers = curves.keys().any(|name| name.parse::<f64>().is_ok());
    let mut checkpoints = curves.values().flat_map(BTreeMap::values);
    let several = checkpoints.any(|of_curve| of_curve.len() > 1);
    let is_there =
        |entry: &Entry| entry.position.is_some() && wanted.there.has_trace_elsewhere(entry);
    let elsewhere = named().any(is_there);
    let (said, with_checkpoint) = if are_numbers {
        (
            "as the column says, with test, member and checkpoint before the name: it numbers them within these",
            true,
        )
    } else if several {
        (
            "as the column says, with test, member and checkpoint before the name: the same name stands at several checkpoints, and each has a zero of \
             its own",
            true,
        )
    } else if elsewhere {
        (
            "as the column says, with test, member and checkpoint before the name: the same name stands elsewhere in the rows that are there",
            true,
        )
    } else if curves.values().any(|of| of.len() > 1) {
        (
            "as the column says, with test and member before the name: it numbers them within these",
            false,
        )
    } else {
        return "as the column says";
    };
    for entry in entries.iter_mut().filter(|entry| !entry.trace.is_empty()) {
        let before = match entry.position {
            Some(_) if with_checkpoint => entry.own_trace(wanted),
            _ => format!("{}-{}", entry.test, entry.member.name()),
        };
        entry.trace = format!("{before}-{}", entry.trace);
    }
    said
}
