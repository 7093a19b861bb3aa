//! Long tables as people lay them out, as tables with a column for everything: what stands above the header (`Run: A`) as columns
//! below it, both members' columns side by side one member after the other, columns named after members alone as what the user states, a
//! mass, a span or a chord before and one after as a loss, a deviation before and one after as a depth. Cells keep their places, so messages name them as they stand in the table.

mod alone;
mod durations;
mod gauges;
mod intervals;
mod labels;
pub(super) mod merged;
mod pairs;
mod profiles;
mod sides;
mod speeds;
mod stated_losses;
mod torques;
mod totals;
mod weighings;

use std::collections::BTreeSet;

use super::columns::{Column, What, columns};
use super::numbers::{counts_without_blanks, pointed};
use super::{ImportError, Sheet, Wanted, cell_sigmas, decimal_commas, multiples, nameless};
use crate::measure::Quantity;

pub(super) use durations::hint;
pub(super) use labels::{flank_above, stated_above};
pub(super) use sides::side;
pub(super) use speeds::{passed_over as speed_passed_over, refuse_another as refuse_another_speed};
pub(super) use torques::refuse_another as refuse_another_torque;

/// A table with a column for everything, or one for each member.
#[derive(Debug)]
pub(super) struct Arranged {
    /// Row of the header, counted from 0.
    pub(super) head: usize,
    /// The tables.
    pub(super) sheets: Vec<Sheet>,
    /// What was made of the table, in words.
    pub(super) said: Vec<String>,
    /// The rows that are left out, in words.
    pub(super) left_out: Vec<String>,
    /// Whether the values are what deviations lost, whatever the sign of these.
    pub(super) differences: bool,
    /// Whether masses are what was lost between two weighings.
    pub(super) weighed: bool,
    /// Of each table the rows that go on where another one ended, in the order of the stops.
    pub(super) stops: Vec<Vec<Vec<usize>>>,
}

/// The table so arranged; none if it is no long table.
///
/// # Errors
/// [`ImportError`] where a mass stands without the other one that makes it a loss or the word that it is one, and where what stands above the
/// header contradicts itself or what is stated elsewhere.
pub(super) fn arranged(
    sheet: &Sheet,
    wanted: &Wanted<'_>,
) -> Result<Option<Arranged>, ImportError> {
    for head in (0..sheet.rows.len()).filter(|&head| !is_title_of_multiples(sheet, head)) {
        if let Some(found) = with_header(sheet, head, wanted)? {
            return Ok(Some(found));
        }
    }
    for head in 0..sheet.rows.len() {
        if let Some(named) = alone::named(sheet, head, wanted)?
            && let Some(found) = with_header(&named, head, wanted)?
        {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// Whether a row says in words that cycles are counted in multiples, with no count below these words and nothing that names another column: a
/// title. A row of units may stand below a header.
fn is_title_of_multiples(sheet: &Sheet, row: usize) -> bool {
    let below = |column: usize| {
        let rows = sheet.rows[row + 1..].iter();
        let mut filled = rows.filter(|cells| cells.iter().any(|cell| !cell.is_empty()));
        filled.next().and_then(|cells| cells.get(column))
    };
    let cells = sheet.rows[row].iter().enumerate();
    let (named, others): (Vec<_>, Vec<_>) =
        cells.partition(|(_, cell)| multiples::in_brackets(cell).is_some());
    let is_column = |(_, cell): &(usize, &String)| {
        let column = columns(std::slice::from_ref(*cell));
        !cell.is_empty()
            && column
                .iter()
                .any(|column| matches!(column.what, What::Own(_)))
    };
    !others.iter().any(is_column)
        && named.into_iter().any(|(column, _)| {
            below(column).is_none_or(|cell| pointed(cell).parse::<f64>().is_err())
        })
}

/// The table below a header; none if this is no header of a long one.
fn with_header(
    sheet: &Sheet,
    head: usize,
    wanted: &Wanted<'_>,
) -> Result<Option<Arranged>, ImportError> {
    let mut sheet = sheet.clone();
    let of_signs = cell_sigmas::as_column(&mut sheet, head);
    let left_out = totals::leave_out(&mut sheet, head, wanted);
    let filled = merged::fill(&mut sheet, head, wanted);
    let (sheet, named) = durations::named(&sheet, head, wanted);
    let (mut sheet, of_one) = sides::of_one(&sheet, head, wanted);
    for column in columns(&sheet.rows[head]) {
        if column.what.own() == Some("cycles") {
            counts_without_blanks(&mut sheet, head, column.at);
        }
    }
    let named = [of_signs.into_iter().collect(), filled, named, of_one].concat();
    let both = match sides::apart(&sheet, head) {
        Some(both) => completed(both, &sheet, head, wanted)?,
        None => None,
    };
    let found = match both {
        Some(both) => Some(both),
        None => completed(vec![sheet.clone()], &sheet, head, wanted)?,
    };
    Ok(found.map(|found| Arranged {
        said: [named, found.said].concat(),
        left_out,
        ..found
    }))
}

/// The tables with what the whole sheet says of them; none if they are not long ones.
fn completed(
    mut sheets: Vec<Sheet>,
    whole: &Sheet,
    head: usize,
    wanted: &Wanted<'_>,
) -> Result<Option<Arranged>, ImportError> {
    let mut said = Vec::new();
    if sheets.len() > 1 {
        said.push("the columns of the pinion and of the gear side by side".to_owned());
    }
    let (mut differences, mut weighed) = (false, false);
    let mut stops = Vec::new();
    let mut added_up = true;
    for table in &mut sheets {
        if wanted.per_interval.cycles {
            added_up &= durations::as_totals(table, head, wanted, &mut said)?;
        }
        let header = columns(&table.rows[head]);
        stated_losses::pass_over(table, head, &header, wanted, &mut said)?;
        let header = columns(&table.rows[head]);
        let of_masses = weighings::could_be(&header);
        let of_gauges = !of_masses && gauges::could_be(&header, wanted);
        if of_masses || of_gauges {
            decimal_commas::refuse(table, head)?;
            nameless::refuse_numbers(table, head, 0)?;
        }
        stops.push(match (of_masses, of_gauges) {
            (true, _) => weighings::as_losses(table, head, &header, wanted, &mut said)?,
            (_, true) => gauges::as_losses(table, head, &header, wanted, &mut said)?,
            _ => Vec::new(),
        });
        let of_profiles = profiles::as_depths(table, head, &header, wanted, &mut said)?;
        differences |= of_gauges || of_profiles;
        weighed |= of_masses;
        let since_new = [
            (of_masses, Quantity::MassLoss),
            (of_gauges, Quantity::SpanLoss),
            (of_gauges, Quantity::ChordalLoss),
            (of_profiles, Quantity::WearDepth),
        ];
        let since_new = since_new.into_iter().filter(|(is_so, _)| *is_so);
        let since_new: Vec<Quantity> = since_new.map(|(_, quantity)| quantity).collect();
        wanted.per_interval.refuse_differences(&since_new)?;
    }
    if sheets.len() > 1 && !sheets.iter().all(|own| sides::is_table(own, whole, head)) {
        return Ok(None);
    }
    for table in &mut sheets {
        labels::as_columns(table, head, wanted, &mut said)?;
        if !has_cycles_and_values(&columns(&table.rows[head])) {
            return Ok(None);
        }
    }
    if !added_up {
        return Err(ImportError(format!(
            "--per-interval cycles: the header in row {} has no column of the lengths of the intervals (`time [h]`, `duration [h]`, `cycles`)",
            head + 1
        )));
    }
    let mut met = BTreeSet::new();
    said.retain(|words| met.insert(words.clone()));
    Ok(Some(Arranged {
        head,
        sheets,
        said,
        left_out: Vec::new(),
        differences,
        weighed,
        stops,
    }))
}

fn has(columns: &[Column], name: &str) -> bool {
    columns.iter().any(|column| column.what.own() == Some(name))
}

fn has_cycles_and_values(columns: &[Column]) -> bool {
    has(columns, "cycles") && has(columns, "value")
}

/// Whether a header has a column of positions and one of depths or the like: a curve.
fn is_curve(columns: &[Column]) -> bool {
    let values = |column: &Column| matches!(column.what, What::Values(_) | What::Own("value"));
    columns.iter().any(values) && has(columns, "position")
}

/// Puts a column behind all others, with one text in all rows below the header that hold something.
pub(super) fn put_column(sheet: &mut Sheet, head: usize, name: &str, text: &str) {
    let width = sheet.rows.iter().map(Vec::len).max().unwrap_or(0);
    for (row, cells) in sheet.rows.iter_mut().enumerate().skip(head) {
        if row == head || cells.iter().any(|cell| !cell.is_empty()) {
            cells.resize(width, String::new());
            cells.push(if row == head { name } else { text }.to_owned());
        }
    }
}
