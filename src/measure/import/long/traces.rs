//! Traces of a long table.

use std::collections::{BTreeMap, BTreeSet};

use super::Read;
use crate::measure::Subject;
use crate::measure::import::ImportError;
use crate::measure::import::entry::{Entry, name_repeat, refuse_twice};
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
        let mut of: BTreeMap<&str, BTreeSet<(&str, Subject)>> = BTreeMap::new();
        for entry in entries.iter().filter(|entry| !entry.trace.is_empty()) {
            of.entry(&entry.trace)
                .or_default()
                .insert((&entry.test, entry.member));
        }
        if of.values().any(|of| of.len() > 1) {
            for entry in entries.iter_mut().filter(|entry| !entry.trace.is_empty()) {
                entry.trace = format!("{}-{}-{}", entry.test, entry.member.name(), entry.trace);
            }
            "as the column says, with test and member before the name: it numbers them within these"
        } else {
            "as the column says"
        }
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
    name_repeat(entries, wanted);
    Ok(said)
}
