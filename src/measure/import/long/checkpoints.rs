//! Checkpoints that a counter or a rig's stop missed by a few revolutions: within a thousandth they are one.

use std::collections::BTreeSet;

use crate::measure::import::entry::Entry;

/// Part of a count by which two of one checkpoint may differ: far less than wear can show.
pub(in crate::measure::import) const SAME: f64 = 1e-3;

/// Gives the curves of a test that were measured at the same checkpoint the same cycles, those that most of them state, and says which. What has
/// no place may be a record of many times and stays as it is.
pub(super) fn join(entries: &mut [Entry]) -> Vec<String> {
    let tests: BTreeSet<String> = entries.iter().map(|entry| entry.test.clone()).collect();
    let mut said = Vec::new();
    for test in tests {
        let is_own = |entry: &Entry| entry.test == test && entry.position.is_some();
        let own = || entries.iter().filter(|entry| is_own(entry));
        let mut counts: Vec<f64> = own().map(|entry| entry.cycles).collect();
        counts.sort_by(f64::total_cmp);
        counts.dedup();
        let mut checkpoints: Vec<Vec<f64>> = Vec::new();
        for count in counts {
            match checkpoints.last_mut() {
                Some(of) if count - of[0] <= SAME * of[0] => of.push(count),
                _ => checkpoints.push(vec![count]),
            }
        }
        checkpoints.retain(|counts| counts.len() > 1);
        let joined: Vec<(f64, Vec<f64>)> = (checkpoints.into_iter())
            .map(|counts| (most_stated(&counts, own().collect()), counts))
            .collect();
        for (checkpoint, counts) in joined {
            let is_one = |entry: &&mut Entry| is_own(entry) && counts.contains(&entry.cycles);
            for entry in entries.iter_mut().filter(is_one) {
                entry.cycles = checkpoint;
            }
            let others = counts.iter().filter(|count| **count != checkpoint);
            let others: Vec<String> = others.map(f64::to_string).collect();
            said.push(format!(
                "test {test}: {} read as the checkpoint {checkpoint}, within 0.1 % of it",
                others.join(", ")
            ));
        }
    }
    said
}

/// Of several counts the one that most curves state; of equal ones that of most rows, then the roundest.
fn most_stated(counts: &[f64], entries: Vec<&Entry>) -> f64 {
    let rank = |count: f64| {
        let own = || entries.iter().filter(|entry| entry.cycles == count);
        let curves: BTreeSet<_> = own()
            .map(|entry| (entry.member, &entry.trace, &entry.tooth, &entry.face))
            .collect();
        let written = count.to_string();
        let zeros = written.len() - written.trim_end_matches('0').len();
        (curves.len(), own().count(), zeros)
    };
    let best = counts.iter().copied().max_by_key(|count| rank(*count));
    best.expect("several counts")
}
