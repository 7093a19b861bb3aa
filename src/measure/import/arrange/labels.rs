//! What the rows above a header say of the whole table: `Run: A`, `Part | pinion`, `Revolutions of the pinion: 140000`.

use super::{is_curve, put_column};
use crate::measure::import::columns::{Column, columns};
use crate::measure::import::numbers::number_words;
use crate::measure::import::{Sheet, Wanted};
use crate::measure::names;

/// What may be said of a whole table.
const KEYS: [&str; 3] = ["test", "member", "cycles"];

/// Makes columns of what stands above the header, and of the cycles that the user states for a curve.
pub(super) fn as_columns(
    sheet: &mut Sheet,
    head: usize,
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) {
    let header = columns(&sheet.rows[head]);
    let mut has: Vec<&str> = header
        .iter()
        .filter_map(|column| column.what.own())
        .collect();
    if !has.contains(&"value") || !(has.contains(&"cycles") || is_curve(&header)) {
        return;
    }
    for row in 0..head {
        let Some((written, key, text)) = label(&sheet.rows[row], wanted) else {
            continue;
        };
        if !has.contains(&key) {
            has.push(key);
            said.push(format!("row {}, `{written}`: {key} {text}", row + 1));
            put_column(sheet, head, &written, &text);
            sheet.rows[row].clear();
        }
    }
    if let Some(cycles) = wanted.cycles.filter(|_| !has.contains(&"cycles")) {
        put_column(sheet, head, "cycles", &cycles.to_string());
    }
}

/// The name, the column and the text of a row that says one thing of the table.
fn label(cells: &[String], wanted: &Wanted<'_>) -> Option<(String, &'static str, String)> {
    let mut filled = cells
        .iter()
        .map(|cell| cell.trim())
        .filter(|cell| !cell.is_empty());
    let first = filled.next()?;
    let (name, text) = match first.split_once([':', '=']) {
        Some((name, text)) if !text.trim().is_empty() => (name, text.trim()),
        _ => (first.trim_end_matches([':', '=']), filled.next()?),
    };
    // a unit or a remark may stand behind
    if filled.count() > 1 {
        return None;
    }
    let column = Column::of(0, name.trim());
    let key = column.what.own().filter(|own| KEYS.contains(own))?;
    let text = match key {
        "test" => wanted.test_of(text)?.to_owned(),
        "member" => names::one_member(text)?.name().to_owned(),
        _ => match number_words(text)[..] {
            [one] => one.to_owned(),
            _ => return None,
        },
    };
    Some((name.trim().to_owned(), key, text))
}
