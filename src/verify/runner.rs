//! Runs the families that are asked for and judges what they measured.

use std::time::Instant;

use crate::verify::contact_and_wear::Effort;
use crate::verify::registry::{self, Entry, Work};
use crate::verify::{Measured, challenge};

/// One case with its outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Id, unique: that of the benchmark, numbered where that has several figures (`B2.3`).
    pub id: String,
    /// Heading under which it is listed.
    pub group: &'static str,
    /// What is compared, unit included.
    pub quantity: String,
    /// Value to be met; none where a case was not run.
    pub target: Option<f64>,
    /// Where the target comes from.
    pub source: String,
    /// Value found.
    pub value: Option<f64>,
    /// Distance of the two in the sense of the tolerance.
    pub error: Option<f64>,
    /// Largest error that passes.
    pub tolerance: Option<f64>,
    /// True if error and tolerance are relative to the target.
    pub relative: bool,
    /// The outcome.
    pub verdict: Verdict,
    /// Reason of the tolerance, of skipping, of a failure or of a contradiction.
    pub reason: String,
    /// Wall clock time of its family, s.
    pub seconds: f64,
}

/// Outcome of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Within the tolerance.
    Pass,
    /// Outside the tolerance, or it could not be run.
    Fail,
    /// Not run on purpose.
    Skipped,
    /// A published number that theory rules out.
    ContradictsTheory,
}

/// Ids that a selection may name or begin with, sorted, without repetition.
pub fn known_ids() -> Vec<String> {
    let mut ids: Vec<String> = registry::entries()
        .into_iter()
        .flat_map(|entry| entry.ids)
        .collect();
    ids.extend(registry::skipped().iter().map(|s| s.id.to_owned()));
    ids.sort();
    ids.dedup();
    ids
}

/// True if `name` selects something: the beginning of an id, or a numbered figure of it.
pub fn is_known(name: &str) -> bool {
    !name.is_empty() && known_ids().iter().any(|id| may_contain(id, name))
}

/// Runs `entries` (those that `names` select; all if there is none) one after another.
///
/// `watch` is told the fraction done and the title of each family as it begins. A family that cannot be run gives one
/// failed row.
pub fn run(
    entries: &[Entry],
    names: &[String],
    effort: Effort,
    watch: &mut dyn FnMut(f64, &str),
) -> Vec<Row> {
    let wanted = |id: &str| names.is_empty() || names.iter().any(|name| may_contain(id, name));
    let chosen: Vec<&Entry> = entries
        .iter()
        .filter(|entry| entry.ids.iter().any(|id| wanted(id)))
        .collect();
    let mut rows = Vec::new();
    for (done, entry) in chosen.iter().enumerate() {
        watch(done as f64 / chosen.len() as f64, entry.title);
        rows.extend(run_entry(entry, effort));
    }
    rows.extend(skipped().filter(|row| wanted(&row.id)));
    let order = |row: &Row| {
        registry::GROUPS
            .iter()
            .position(|group| *group == row.group)
    };
    rows.sort_by_key(order);
    number(&mut rows);
    // a family may hold cases that were not asked for
    rows.retain(|row| names.is_empty() || names.iter().any(|name| row.id.starts_with(name)));
    rows
}

/// True if no case failed.
pub fn passed(rows: &[Row]) -> bool {
    rows.iter().all(|row| row.verdict != Verdict::Fail)
}

fn run_entry(entry: &Entry, effort: Effort) -> Vec<Row> {
    let begun = Instant::now();
    let measured = |measured: Vec<Measured>| -> Vec<Row> {
        measured.into_iter().map(|m| judged(entry, m)).collect()
    };
    let result = match entry.work {
        Work::Family(run) => run(effort).map(measured).map_err(|e| e.to_string()),
        Work::Elastic(run) => run().map(measured).map_err(|e| e.to_string()),
        Work::Histories(run) => run().map(measured).map_err(|e| e.to_string()),
        Work::Challenge(name) => challenge::judge(name)
            .map(measured)
            .map_err(|e| e.to_string()),
        Work::External(run, absent) => match run(effort) {
            Ok(none) if none.is_empty() => {
                Ok(vec![not_run(entry, Verdict::Skipped, absent.to_owned())])
            }
            other => other.map(measured).map_err(|e| e.to_string()),
        },
        Work::Rows(run) => run().map_err(|e| e.to_string()),
    };
    let mut rows = match result {
        Ok(rows) if rows.is_empty() => vec![failed(entry, "nothing was measured")],
        Ok(rows) => rows,
        Err(message) => vec![failed(entry, &message)],
    };
    let seconds = begun.elapsed().as_secs_f64();
    for row in &mut rows {
        row.seconds = seconds;
    }
    rows
}

fn judged(entry: &Entry, measured: Measured) -> Row {
    let verdict = if measured.passed() {
        Verdict::Pass
    } else {
        Verdict::Fail
    };
    // conditions that every family checks beside its own: B8 contact iterations, F1 balance of the worn area
    let id = ["B8", "F1"]
        .into_iter()
        .find(|common| *common != measured.id && measured.quantity.contains(&format!("{common} ")))
        .map_or(measured.id.to_owned(), |common| {
            format!("{common}.{}", measured.id)
        });
    let common = id.split('.').next().map(registry::origin);
    let (source, reason) = match common.unwrap_or_default() {
        ("", _) => (entry.source, entry.reason),
        own => own,
    };
    Row {
        id,
        group: entry.group,
        // the measure is not kept, but is what `Measured::relative` computes, to the last bit
        relative: measured.tolerance > 0.0
            && (measured.value / measured.target - 1.0).abs() == measured.error,
        quantity: measured.quantity,
        target: Some(measured.target),
        source: source.to_owned(),
        value: Some(measured.value),
        error: Some(measured.error),
        tolerance: Some(measured.tolerance),
        verdict,
        reason: reason.to_owned(),
        seconds: 0.0,
    }
}

fn failed(entry: &Entry, message: &str) -> Row {
    not_run(entry, Verdict::Fail, format!("could not be run: {message}"))
}

fn not_run(entry: &Entry, verdict: Verdict, reason: String) -> Row {
    Row {
        id: entry.ids.first().cloned().unwrap_or_default(),
        group: entry.group,
        quantity: entry.title.to_owned(),
        target: None,
        source: entry.source.to_owned(),
        value: None,
        error: None,
        tolerance: None,
        relative: false,
        verdict,
        reason,
        seconds: 0.0,
    }
}

fn skipped() -> impl Iterator<Item = Row> {
    registry::skipped().into_iter().map(|case| Row {
        id: case.id.to_owned(),
        group: registry::group_of(case.id),
        quantity: case.what.to_owned(),
        target: None,
        source: "benchmark list".to_owned(),
        value: None,
        error: None,
        tolerance: None,
        relative: false,
        verdict: Verdict::Skipped,
        reason: case.reason.to_owned(),
        seconds: 0.0,
    })
}

/// Gives ids that occur more than once a number, from 1.
fn number(rows: &mut [Row]) {
    let names: Vec<String> = rows.iter().map(|row| row.id.clone()).collect();
    for (i, row) in rows.iter_mut().enumerate() {
        let same = |names: &[String]| names.iter().filter(|name| **name == row.id).count();
        if same(&names) > 1 {
            row.id = format!("{}.{}", names[i], same(&names[..=i]));
        }
    }
}

/// Can a family with this id hold rows that `name` selects?
fn may_contain(id: &str, name: &str) -> bool {
    id.starts_with(name)
        || name
            .strip_prefix(id)
            .is_some_and(|rest| rest.starts_with('.'))
}
