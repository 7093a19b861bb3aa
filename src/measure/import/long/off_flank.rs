//! Rows of curves that begin below the flank or end above it.

use std::collections::{BTreeMap, BTreeSet};

use super::line::Line;
use crate::measure::Subject;
use crate::measure::import::ImportError;
use crate::measure::import::entry::Entry;
use crate::measure::import::flank::{MOST, Side};

/// Takes out the rows of each curve that lie a little off the flank, where most of it lies on the flank, and says how many.
///
/// # Errors
/// [`ImportError`] for the first row that is off the flank otherwise.
pub(super) fn leave_out<'t>(
    entries: &mut Vec<Entry>,
    line: impl Fn(usize) -> Line<'t>,
) -> Result<Vec<String>, ImportError> {
    let curve = |entry: &Entry| {
        let labels = [&entry.test, &entry.trace, &entry.tooth, &entry.face].map(String::clone);
        (labels, entry.member, entry.cycles.to_bits(), entry.quantity)
    };
    let mut off: BTreeMap<usize, Side> = BTreeMap::new();
    let mut of_curve: BTreeMap<_, [usize; 2]> = BTreeMap::new();
    for entry in entries.iter() {
        let row = line(entry.cell.0);
        let Some((flank, _)) = row.flank(entry)? else {
            continue;
        };
        let side = flank.side(entry.position.unwrap_or_default());
        let [count, of_off] = of_curve.entry(curve(entry)).or_default();
        *count += 1;
        if let Some(side) = side {
            *of_off += 1;
            off.insert(entry.cell.0, side);
        }
    }
    let mut sides: BTreeMap<(Subject, Side), Vec<f64>> = BTreeMap::new();
    let mut said = Vec::new();
    for entry in entries
        .iter()
        .filter(|entry| off.contains_key(&entry.cell.0))
    {
        let row = line(entry.cell.0);
        let Some((flank, place)) = row.flank(entry)? else {
            continue;
        };
        let [count, of_off] = of_curve[&curve(entry)];
        let is_trace = (count - of_off) as f64 >= MOST * count as f64;
        if !is_trace || !flank.is_near(entry.position.unwrap_or_default()) {
            return row.off_flank(entry, &flank, place);
        }
        let side = off[&entry.cell.0];
        sides.entry((entry.member, side)).or_default().push(place);
    }
    let mut met = BTreeSet::new();
    for entry in entries.iter() {
        let Some(side) = off.get(&entry.cell.0) else {
            continue;
        };
        let row = line(entry.cell.0);
        if let Some((flank, _)) = row.flank(entry)?
            && met.insert((entry.member, *side))
        {
            let places = &sides[&(entry.member, *side)];
            said.push(flank.left_out(*side, (places.len(), "row"), places));
        }
    }
    entries.retain(|entry| !off.contains_key(&entry.cell.0));
    Ok(said)
}
