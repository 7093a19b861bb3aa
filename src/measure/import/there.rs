//! What the rows that are there already say of those that come behind them: the checkpoints they share, and the flank they should lie on.

use std::collections::{BTreeMap, BTreeSet};

use super::append::Rows;
use super::entry::Entry;
use super::long::SAME;
use crate::measure::{Place, Quantity, Subject};

/// The rows with a place that are there already; nothing where there are none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct There {
    /// Cycles of each test.
    checkpoints: BTreeMap<String, Vec<f64>>,
    /// Radii on the flank of each member, the least and the largest.
    flanks: BTreeMap<Subject, [f64; 2]>,
    /// Of each trace the tests, members and cycles at which it stands.
    traces: BTreeMap<String, BTreeSet<(String, String, u64)>>,
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
            let (Ok(cycles), Ok(position)) = (field("cycles").parse(), field("position").parse())
            else {
                continue;
            };
            let cycles: f64 = cycles;
            let of = (field("test"), field("member"), cycles.to_bits());
            there.traces.entry(field("trace")).or_default().insert(of);
            there
                .checkpoints
                .entry(field("test"))
                .or_default()
                .push(cycles);
            let quantity = Quantity::ALL
                .into_iter()
                .find(|known| known.name() == field("quantity"));
            let member = Subject::ALL
                .into_iter()
                .find(|known| known.name() == field("member"));
            if let (Some(member), true) = (member, quantity.is_some_and(lies_on_flank)) {
                widen(&mut there.flanks, member, position);
            }
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

    /// Whether the trace of an entry stands there at another test, member or checkpoint.
    pub(super) fn has_trace_elsewhere(&self, entry: &Entry) -> bool {
        let (test, member) = (entry.test.clone(), entry.member.name().to_owned());
        let own = (test, member, entry.cycles.to_bits());
        let known = self.traces.get(&entry.trace);
        known.is_some_and(|known| known.iter().any(|of| *of != own))
    }

    /// What is said of members whose rows lie apart from those that are there, and among those of the other member.
    pub fn swapped(&self, entries: &[Entry]) -> Vec<String> {
        let mut flanks = BTreeMap::new();
        for entry in entries.iter().filter(|entry| lies_on_flank(entry.quantity)) {
            if let Some(position) = entry.position {
                widen(&mut flanks, entry.member, position);
            }
        }
        let meet = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[1] && b[0] <= a[1];
        let is_swapped = |(member, own): (&Subject, &[f64; 2])| {
            let same = self.flanks.get(member)?;
            let others = self.flanks.get(&member.other())?;
            (!meet(own, same) && meet(own, others)).then(|| {
                format!(
                    "the radii of the {member}, {} to {} mm, lie apart from those of its rows that are there, {} to {} mm, and among the {other}'s, {} \
                     to {} mm: are the members swapped? --member or a column of members says whose they are",
                    own[0],
                    own[1],
                    same[0],
                    same[1],
                    others[0],
                    others[1],
                    member = member.name(),
                    other = member.other().name()
                )
            })
        };
        flanks.iter().filter_map(is_swapped).collect()
    }
}

/// Whether places of a quantity show which part of a flank was measured; a chord stands at a circle of its own.
fn lies_on_flank(quantity: Quantity) -> bool {
    quantity.place() == Place::Flank && quantity != Quantity::ChordalLoss
}

fn widen(flanks: &mut BTreeMap<Subject, [f64; 2]>, member: Subject, radius: f64) {
    let [least, most] = flanks.entry(member).or_insert([radius, radius]);
    *least = least.min(radius);
    *most = most.max(radius);
}

/// The nearest of several counts, if it is within a thousandth.
fn nearest(known: &[f64], count: f64) -> Option<f64> {
    let distance = |other: &f64| (other - count).abs();
    let nearest = known
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    (distance(nearest) <= SAME * nearest.min(count)).then_some(*nearest)
}
