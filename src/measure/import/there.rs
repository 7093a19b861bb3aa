//! What the rows that are there already say of those that come behind them: the checkpoints they share.

use std::collections::{BTreeMap, BTreeSet};

use super::append::Rows;
use super::entry::Entry;
use super::long::SAME;

/// The rows with a place that are there already; nothing where there are none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct There {
    /// Cycles of each test.
    checkpoints: BTreeMap<String, Vec<f64>>,
}

impl There {
    /// Of the text of a measurement file. What cannot be read is passed over: it is refused elsewhere.
    pub fn of(text: &str) -> Self {
        let mut there = Self::default();
        let Some(rows) = Rows::of(text) else {
            return there;
        };
        for row in rows.records() {
            let field = |name: &str| rows.field(&row, name);
            let has_place = field("position").parse::<f64>().is_ok();
            let Some(cycles) = field("cycles").parse().ok().filter(|_| has_place) else {
                continue;
            };
            there
                .checkpoints
                .entry(field("test"))
                .or_default()
                .push(cycles);
        }
        for counts in there.checkpoints.values_mut() {
            counts.sort_by(f64::total_cmp);
            counts.dedup();
        }
        there
    }

    /// Gives curves whose cycles are within a thousandth of those of a checkpoint that is there the same, and says which, one line for each test.
    /// Of a table with `one_each` no two of its own checkpoints become one.
    pub(super) fn join(&self, entries: &mut [Entry], one_each: bool) -> Vec<String> {
        let mut said = Vec::new();
        for (test, known) in &self.checkpoints {
            let is_own = |entry: &Entry| entry.test == *test && entry.position.is_some();
            let counts: BTreeSet<u64> = (entries.iter())
                .filter(|entry| is_own(entry))
                .map(|entry| entry.cycles.to_bits())
                .collect();
            let mut taken: BTreeSet<u64> = counts.clone();
            let mut joined = BTreeMap::new();
            for bits in counts {
                let count = f64::from_bits(bits);
                let near = nearest(known, count).filter(|near| *near != count);
                let free = |near: &f64| !one_each || taken.insert(near.to_bits());
                if let Some(near) = near.filter(free) {
                    joined.insert(bits, near);
                }
            }
            if joined.is_empty() {
                continue;
            }
            for entry in entries.iter_mut().filter(|entry| is_own(entry)) {
                if let Some(near) = joined.get(&entry.cycles.to_bits()) {
                    entry.cycles = *near;
                }
            }
            let counts = joined.keys().map(|bits| f64::from_bits(*bits).to_string());
            let counts: Vec<String> = counts.collect();
            let mut onto: Vec<String> = joined.values().map(f64::to_string).collect();
            onto.dedup();
            let (words, them) = match onto.len() {
                1 => ("the checkpoint", "it"),
                _ => ("the checkpoints", "them"),
            };
            said.push(format!(
                "test {test}: {} read as {words} {} of the rows that are there, within 0.1 % of {them}",
                counts.join(", "),
                onto.join(", ")
            ));
        }
        said
    }
}

/// The nearest of several counts, if it is within a thousandth.
fn nearest(known: &[f64], count: f64) -> Option<f64> {
    let distance = |other: &f64| (other - count).abs();
    let nearest = known
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    (distance(nearest) <= SAME * nearest.min(count)).then_some(*nearest)
}
