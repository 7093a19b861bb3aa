//! Points between the thousands of checkpoints in a header (`40.000`), above values with decimal commas.

use super::numbers::number_words;
use super::{Decimal, Sheet};
use crate::measure::thousands::in_thousands;

/// Part of a test that its last checkpoint reaches at least where its points are taken to stand between thousands: read as decimals, all would lie
/// within its first thousandth.
const LAST: f64 = 0.02;
/// By how much a checkpoint may lie beyond the stated end.
const ROUNDED: f64 = 1.01;

/// The sheet without points between the thousands of the checkpoints in row `head`, where its values have commas as decimal marks, or the user says so: a
/// point can be no decimal one there; or where only so they are spread over the `end` cycles of the test. None where nothing is to be left out.
pub(super) fn left_out(
    sheet: &Sheet,
    decimal: Option<Decimal>,
    head: usize,
    end: Option<f64>,
) -> Option<Sheet> {
    // the numbers of a spreadsheet's cells say nothing of how its texts are written
    let is_text = sheet.name.is_empty() && decimal.is_none();
    let below = || {
        let cells = sheet.rows.iter().skip(head + 1).flatten();
        cells.filter(|cell| number_words(cell) == [cell.as_str()])
    };
    let has = |mark: char| below().any(|cell| cell.contains(mark));
    let by_values = is_text && has(',') && !has('.');
    let is_thousands = |word: &str| in_thousands(word) && !word.contains(',');
    let headers = || sheet.rows[head].iter().skip(1);
    let is_decimal = |word: &str| word.contains(['.', ',']) && !is_thousands(word);
    let has_decimals = headers().any(|text| number_words(text).into_iter().any(is_decimal));
    let last = headers()
        .flat_map(|text| number_words(text))
        .filter_map(|word| word.replace('.', "").parse::<f64>().ok())
        .fold(0.0, f64::max);
    let is_spread = end.is_some_and(|end| (LAST * end..=ROUNDED * end).contains(&last));
    let may_be_thousands = !sheet.name.is_empty() || !has('.');
    let by_length = decimal.is_none() && may_be_thousands && is_spread;
    if has_decimals || !(by_values || by_length || decimal == Some(Decimal::Comma)) {
        return None;
    }
    let mut sheet = sheet.clone();
    let mut any = false;
    for text in sheet.rows[head].iter_mut().skip(1) {
        let word = number_words(text)
            .into_iter()
            .find(|word| is_thousands(word));
        if let Some(word) = word.map(str::to_owned) {
            *text = text.replacen(&word, &word.replace('.', ""), 1);
            any = true;
        }
    }
    any.then_some(sheet)
}
