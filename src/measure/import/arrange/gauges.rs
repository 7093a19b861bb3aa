//! The span over several teeth, or the chord of one, of the new gear and of the worn: their difference is what was lost.

use super::has;
use super::intervals::{self, Weighed};
use super::pairs::{Losses, Pair};
use crate::measure::Quantity;
use crate::measure::import::columns::{Column, What};
use crate::measure::import::{ImportError, Sheet, Wanted};
use crate::measure::names::When;

/// What a gauge feels.
struct Gauge {
    what: fn(When) -> What,
    lost: Quantity,
    /// In words.
    name: &'static str,
    /// The columns of the two measurements, as one may call them.
    columns: [&'static str; 2],
}

const GAUGES: [Gauge; 2] = [
    Gauge {
        what: What::Span,
        lost: Quantity::SpanLoss,
        name: "span",
        columns: ["span new [mm]", "span worn [mm]"],
    },
    Gauge {
        what: What::Chord,
        lost: Quantity::ChordalLoss,
        name: "chord",
        columns: ["chordal thickness new [mm]", "chordal thickness worn [mm]"],
    },
];

/// Columns in which the rows of one place agree.
const PLACE: [&str; 6] = ["test", "member", "position", "face", "tooth", "trace"];

impl Gauge {
    fn is_there(&self, columns: &[Column]) -> bool {
        let times = [When::Before, When::After].map(self.what);
        columns.iter().any(|column| times.contains(&column.what))
    }
}

/// The measurements that are the values of a table, those of the quantity that is asked for if there are several; none where other values are.
fn of(columns: &[Column], wanted: &Wanted<'_>) -> Option<&'static Gauge> {
    // a word of a title is no header
    let is_header = has(columns, "test") || has(columns, "cycles") || has(columns, "position");
    if has(columns, "value") || !is_header {
        return None;
    }
    let there = || GAUGES.iter().filter(|gauge| gauge.is_there(columns));
    let asked = there().find(|gauge| wanted.quantity == Some(gauge.lost));
    asked.or_else(|| there().next())
}

/// Whether spans or chords are the values of a table.
pub(super) fn could_be(columns: &[Column], wanted: &Wanted<'_>) -> bool {
    of(columns, wanted).is_some()
}

/// Puts the loss in the place of the worn measurement. The rows of each place that was measured before and after each interval, in the order of
/// the stops.
pub(super) fn as_losses(
    sheet: &mut Sheet,
    head: usize,
    columns: &[Column],
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) -> Result<Vec<Vec<usize>>, ImportError> {
    let Some(gauge) = of(columns, wanted) else {
        return Ok(Vec::new());
    };
    let name = gauge.name;
    if wanted.quantity.is_none() && GAUGES.iter().filter(|g| g.is_there(columns)).count() > 1 {
        return Err(ImportError(format!(
            "row {}: spans and chords stand beside each other: say with --quantity span_loss or --quantity chordal_loss which are meant, and import \
             the table twice",
            head + 1
        )));
    }
    let [new, worn] = gauge.columns;
    let Some(pair) = Pair::of(columns, gauge.what) else {
        let is_it = |column: &&Column| {
            [When::Before, When::After]
                .map(gauge.what)
                .contains(&column.what)
        };
        let cells: Vec<String> = columns.iter().filter(is_it).map(|c| c.cell(head)).collect();
        return Err(ImportError(format!(
            "{}: a {name} is no loss: the table needs one column `{new}` and one column `{worn}`, or what was lost as `{name} loss [um]`. A nominal \
             {name} does not stand for the new one: what it differs by is not wear",
            cells.join(" and ")
        )));
    };
    if pair.after.unit.is_none() && wanted.unit.is_none() {
        return Err(ImportError(format!(
            "{}: write the unit into the header of both columns: `{new}`, `{worn}`",
            pair.after.cell(head)
        )));
    }
    let Losses {
        lost,
        stops,
        since_new,
    } = pair.losses(sheet, head, (&PLACE, wanted), |group, readings, pair| {
        // gauges are read anew each time, so no two readings of the new gear need to agree
        Ok(intervals::weighed(group, readings, pair).unwrap_or(Weighed::SinceNew))
    })?;
    let (before, after) = (&pair.before.written, &pair.after.written);
    if since_new {
        said.push(format!("{name} loss: `{before}` less `{after}`"));
    }
    if !stops.is_empty() {
        said.push(format!(
            "{name} loss: each `{before}` is `{after}` of the stop before it, so the losses are added up from the first `{before}` of each place"
        ));
    }
    pair.put_losses(sheet, head, &format!("{name} loss"), &lost, wanted);
    Ok(stops)
}
