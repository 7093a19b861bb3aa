//! A wide table with a second row of headers above its own, each over several columns: `Wear pinion T1 | | | Wear pinion T2`, the checkpoints of each below.

use super::numbers::{has_one_number, pointed};
use super::side_by_side::letters;
use super::{Sheet, Wanted};
use crate::measure::names;

/// A sheet of the columns below each of those headers, with the first column of the whole, and what its columns are called there; none for other sheets.
pub fn labelled_blocks(sheet: &Sheet, wanted: &Wanted<'_>) -> Option<Vec<(String, Sheet)>> {
    (1..sheet.rows.len()).find_map(|head| below_labels(sheet, head, wanted))
}

/// The same of the header in this row.
fn below_labels(sheet: &Sheet, head: usize, wanted: &Wanted<'_>) -> Option<Vec<(String, Sheet)>> {
    let (above, header) = (&sheet.rows[head - 1], &sheet.rows[head]);
    let filled = |cells: &[String]| -> Vec<usize> {
        let filled = |at: &usize| !cells[*at].is_empty();
        (1..cells.len()).filter(filled).collect()
    };
    let columns = filled(header);
    let is_headed = |at: &usize| {
        let cell = &header[*at];
        has_one_number(cell) || names::one_member(cell).is_some()
    };
    let below = sheet.rows[head + 1..].iter();
    let mut first_cells = below.filter_map(|cells| cells.first().filter(|cell| !cell.is_empty()));
    let is_number = |cell: &str| pointed(cell).parse::<f64>().is_ok();
    let is_table = first_cells.next().is_some_and(|cell| is_number(cell));
    // a row of values below the header that names the members
    let is_of_values = header.first().is_none_or(|cell| is_number(cell));
    if !is_table || is_of_values || !columns.iter().all(is_headed) {
        return None;
    }
    let mut starts = filled(above);
    // a spreadsheet saved as text may repeat what was in a merged cell
    starts.dedup_by(|next, before| above[*next] == above[*before]);
    let labels = starts.iter().map(|&at| label(&above[at], wanted));
    let labels: Vec<String> = labels.collect::<Option<_>>()?;
    let are_different = (1..labels.len()).all(|n| !labels[..n].contains(&labels[n]));
    if labels.len() < 2 || starts.first() != columns.first() || !are_different {
        return None;
    }
    let [over, corner] = [above, header].map(|cells| cells.first().map_or("", String::as_str));
    let (of_all, corner) = match corner {
        "" => ("", over),
        _ => (over, corner),
    };
    // a row further above may say something of each block too: `| Pinion | | Gear`
    let is_of_blocks = |cells: &[String]| {
        let own = filled(cells);
        own.len() > 1 && own.iter().all(|at| starts.contains(at))
    };
    let over_block = |cells: &[String], start: usize| {
        let own = filled(cells).into_iter().rfind(|at| *at <= start);
        own.map_or(String::new(), |at| cells[at].clone())
    };
    let ends = starts.iter().copied().skip(1).chain([usize::MAX]);
    let blocks = starts.iter().zip(ends).zip(&labels);
    let block = |((&start, end), label): ((&usize, usize), &String)| {
        let own: Vec<usize> = (columns.iter().copied())
            .filter(|at| (start..end).contains(at))
            .collect();
        let (first, last) = (*own.first()?, *own.last()?);
        let rows = sheet.rows.iter().enumerate().map(|(row, cells)| {
            if row + 1 < head {
                return match is_of_blocks(cells) {
                    true => vec![over_block(cells, start)],
                    false => cells.clone(),
                };
            }
            if row + 1 == head {
                let words = [label.as_str(), of_all];
                return vec![words.join(" ").trim().to_owned()];
            }
            let cell = |at: usize| cells.get(at).cloned().unwrap_or_default();
            let place = match row == head {
                true => corner.to_owned(),
                false => cell(0),
            };
            std::iter::once(place)
                .chain((first..=last).map(cell))
                .collect()
        });
        let own = Sheet {
            rows: rows.collect(),
            ..sheet.clone()
        };
        let columns = format!(
            "columns A and {} to {}, counted as A to {}",
            letters(first),
            letters(last),
            letters(1 + last - first)
        );
        Some((columns, own))
    };
    blocks.map(block).collect()
}

/// A header of several columns, the test that it names first; none if it names neither a test nor a member.
fn label(words: &str, wanted: &Wanted<'_>) -> Option<String> {
    if let Some(id) = wanted.test_of(words) {
        return Some(format!("Test {id}"));
    }
    match wanted.test_in_header(words) {
        Some((id, rest)) => {
            let rest: Vec<&str> = rest.split_whitespace().collect();
            Some(format!("Test {id}, {}", rest.join(" ")))
        }
        None => names::one_member(words).map(|_| words.to_owned()),
    }
}
