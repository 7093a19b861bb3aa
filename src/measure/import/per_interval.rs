//! Losses that a table gives for each interval of a test alone, as totals since its start.

use std::collections::{BTreeMap, BTreeSet};

use super::entry::{Entry, four_digits};
use super::numbers::rounded;
use super::{ImportError, cell_name};
use crate::measure::{Place, Quantity, Subject};

/// Part by which a total may fall by the noise of its measurement.
const FALLS: f64 = 0.02;

/// What a table gives for each interval alone.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PerInterval {
    /// Revolutions or running times.
    pub cycles: bool,
    /// Losses.
    pub losses: Vec<Quantity>,
}

/// One place of a member in a test, or the whole member: what its losses add up on. Traces are not told apart, each checkpoint has its own.
type Series = (String, Subject, Quantity, Option<u64>, String, String);

impl PerInterval {
    /// Quantities of which an interval has a part.
    pub const LOSSES: [Quantity; 4] = [
        Quantity::WearDepth,
        Quantity::MassLoss,
        Quantity::SpanLoss,
        Quantity::ChordalLoss,
    ];

    /// Refuses a quantity that two measurements give already, as what was lost since the start.
    pub(super) fn refuse_differences(&self, quantities: &[Quantity]) -> Result<(), ImportError> {
        match self.losses.iter().find(|loss| quantities.contains(loss)) {
            None => Ok(()),
            Some(loss) => Err(ImportError(format!(
                "--per-interval {}: the table has measurements of the new and of the worn part, of which the losses since the start are taken: leave \
                 it out",
                loss.name()
            ))),
        }
    }

    /// What is said of losses that are taken as totals and do not grow as totals do: of depths, which a datum may move, beside cycles of each interval only.
    /// Those between two weighings are totals beyond doubt.
    pub(super) fn doubt(&self, entries: &[Entry], weighed: bool) -> Option<String> {
        let mut series: BTreeMap<Series, Vec<&Entry>> = BTreeMap::new();
        let is_total = |entry: &&Entry| {
            let is_loss = entry.quantity == Quantity::MassLoss
                || self.cycles && Self::LOSSES.contains(&entry.quantity);
            is_loss && !self.losses.contains(&entry.quantity)
        };
        for entry in entries.iter().filter(is_total) {
            series.entry(series_of(entry)).or_default().push(entry);
        }
        let falls = series.values_mut().find_map(|own| {
            own.sort_by(|a, b| a.cycles.total_cmp(&b.cycles));
            let pair =
                (own.windows(2)).find(|pair| pair[1].value < (1.0 - FALLS) * pair[0].value)?;
            Some(pair[1])
        })?;
        if weighed {
            return Some(format!(
                "{} of the {} in test {} falls at row {}, and what is worn off does not come back: look at that weighing and at the one before it",
                falls.quantity.name(),
                falls.member.name(),
                falls.test,
                falls.cell.0 + 1
            ));
        }
        Some(format!(
            "{} is taken as the total since the start of the test, but falls at {}; if it{} is of each interval alone, say --per-interval {}{}",
            falls.quantity.name(),
            cell_name(falls.cell.0, falls.cell.1),
            if self.cycles { " too" } else { "" },
            if self.cycles { "cycles," } else { "" },
            falls.quantity.name()
        ))
    }

    /// Adds up the losses of each place along the rows, and says so. In a table with a cell for `each_checkpoint`, whole members have a value at
    /// every one too.
    ///
    /// # Errors
    /// [`ImportError`] for rows that stand twice or are not in order, and where an interval is missing.
    pub(super) fn add_up(
        &self,
        entries: &mut [Entry],
        each_checkpoint: bool,
    ) -> Result<Vec<String>, ImportError> {
        let mut said = Vec::new();
        for &loss in &self.losses {
            let mut series: BTreeMap<Series, Vec<usize>> = BTreeMap::new();
            for (n, entry) in entries.iter().enumerate() {
                if entry.quantity == loss {
                    series.entry(series_of(entry)).or_default().push(n);
                }
            }
            let name = loss.name();
            if series.is_empty() {
                return Err(ImportError(format!(
                    "--per-interval {name}: the table holds no {name}"
                )));
            }
            if series.values().all(|own| own.len() == 1) {
                return Err(one_interval(name));
            }
            let in_each = each_checkpoint || loss.place() != Place::Whole;
            refuse_gaps(entries, &series, in_each)?;
            let mut has_sigma = false;
            for own in series.values() {
                let (mut total, mut variance) = (0.0, Some(0.0));
                for &n in own {
                    let entry = &mut entries[n];
                    total += entry.value;
                    entry.value = rounded(total);
                    variance = variance.zip(entry.sigma).map(|(v, s)| v + s * s);
                    entry.sigma = variance.map(|variance| four_digits(variance.sqrt()));
                    has_sigma |= entry.sigma.is_some();
                }
            }
            let along = match loss.place() {
                Place::Whole => "of each test and member",
                _ => "of each test, member and place",
            };
            let sigmas = match has_sigma {
                true => "; their sigmas are combined as the root of the sum of their squares",
                false => "",
            };
            said.push(format!(
                "{name}: the losses of the intervals {along} are added up to totals since the start{sigmas}"
            ));
        }
        Ok(said)
    }
}

/// Why one interval alone is not added up.
pub(super) fn one_interval(name: &str) -> ImportError {
    ImportError(format!(
        "--per-interval {name}: the table holds no second interval of anything, and intervals are added up within one table: put all of them into \
         it (what the first one alone gives is the total: leave --per-interval out)"
    ))
}

fn series_of(entry: &Entry) -> Series {
    (
        entry.test.clone(),
        entry.member,
        entry.quantity,
        entry.position.map(f64::to_bits),
        entry.tooth.clone(),
        entry.face.clone(),
    )
}

/// Refuses series whose cycles do not rise along the rows, and those that lack an interval which others of the same member have.
fn refuse_gaps(
    entries: &[Entry],
    series: &BTreeMap<Series, Vec<usize>>,
    in_each: bool,
) -> Result<(), ImportError> {
    let mut checkpoints: BTreeMap<(&str, Option<Subject>), BTreeSet<u64>> = BTreeMap::new();
    // whole members of a table share its checkpoints
    let of = |entry: &Entry| entry.position.map(|_| entry.member);
    for own in series.values() {
        for pair in own.windows(2) {
            let [last, this] = [pair[0], pair[1]].map(|n| &entries[n]);
            let why = if this.cycles == last.cycles {
                "both hold the loss"
            } else if this.cycles < last.cycles {
                "are not in the order of the intervals, the second is that"
            } else {
                continue;
            };
            return Err(ImportError(format!(
                "{} and {} {why} of the {} in test {} until {} pinion revolutions{}: the losses of intervals are added up along the rows, each \
                 once and the first on top",
                cell_name(last.cell.0, last.cell.1),
                cell_name(this.cell.0, this.cell.1),
                this.member.name(),
                this.test,
                this.cycles,
                place(this)
            )));
        }
        for &n in own {
            let entry = &entries[n];
            let all = checkpoints.entry((&entry.test, of(entry))).or_default();
            all.insert(entry.cycles.to_bits());
        }
    }
    if !in_each {
        return Ok(());
    }
    for own in series.values() {
        let last = &entries[own[own.len() - 1]];
        for &cycles in &checkpoints[&(last.test.as_str(), of(last))] {
            let cycles = f64::from_bits(cycles);
            if cycles < last.cycles && !own.iter().any(|&n| entries[n].cycles == cycles) {
                return Err(ImportError(format!(
                    "{}: the total of the {} in test {}{} is not known: its loss in the interval until {cycles} pinion revolutions is missing",
                    cell_name(last.cell.0, last.cell.1),
                    last.member.name(),
                    last.test,
                    place(last)
                )));
            }
        }
    }
    Ok(())
}

fn place(entry: &Entry) -> String {
    let at = |at| format!(" at {at}");
    entry.position.map_or_else(String::new, at)
}
