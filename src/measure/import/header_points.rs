//! Points between the thousands of checkpoints in a header (`40.000`), above values with decimal commas.

use super::numbers::number_words;
use super::{Decimal, Sheet};
use crate::measure::thousands::in_thousands;

/// The sheet without points between the thousands of the checkpoints in row `head`, where its values have commas as decimal marks, or the user says so: a
/// point can be no decimal one there. None where nothing is to be left out.
pub(super) fn left_out(sheet: &Sheet, decimal: Option<Decimal>, head: usize) -> Option<Sheet> {
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
    if has_decimals || !(by_values || decimal == Some(Decimal::Comma)) {
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
