//! A mass before and a mass after: their difference is what was lost.

use super::has;
use super::intervals;
use super::pairs::{Losses, Pair, only};
use crate::measure::import::columns::{Column, What};
use crate::measure::import::{ImportError, Sheet, Wanted, cell_name};
use crate::measure::names::When;

/// Whether weighings are the values of a table: nothing else is.
pub(super) fn could_be(columns: &[Column]) -> bool {
    let weighings = columns
        .iter()
        .filter(|c| matches!(c.what, What::Weighing(_)));
    let count = weighings.count();
    // one alone may be a word of a title
    let is_header = count > 1 || count == 1 && has(columns, "member");
    is_header && !has(columns, "value")
}

/// Puts the loss in the place of the mass after. The rows of each test and member that were weighed at each stop, in the order of the stops.
pub(super) fn as_losses(
    sheet: &mut Sheet,
    head: usize,
    columns: &[Column],
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) -> Result<Vec<Vec<usize>>, ImportError> {
    let Some(pair) = Pair::of(columns, What::Weighing) else {
        let of = |when: When| only(columns, What::Weighing(when));
        let one = of(When::Before).or(of(When::After));
        let at = one.map_or(0, |column| column.at);
        return Err(ImportError(format!(
            "{}: `{}` is a mass and no loss: name the columns of the two weighings `mass before` and `mass after`, or write what was lost as \
             `mass loss [mg]`",
            cell_name(head, at),
            sheet.rows[head][at]
        )));
    };
    let by = (&["test", "member"][..], wanted);
    let Losses {
        lost,
        stops,
        since_new,
    } = pair.losses(sheet, head, by, intervals::weighed)?;
    let (before, after) = (&pair.before.written, &pair.after.written);
    if since_new {
        said.push(format!("mass loss: `{before}` less `{after}`"));
    }
    if !stops.is_empty() {
        said.push(format!(
            "mass loss: each `{before}` is `{after}` of the stop before it, so the losses are added up from the first `{before}` of each test and \
             member"
        ));
    }
    pair.put_losses(sheet, head, "mass loss", &lost, wanted);
    Ok(stops)
}
