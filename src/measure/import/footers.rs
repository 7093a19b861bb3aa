//! Rows below a table: notes, and means and extremes of its columns.

use super::Sheet;
use super::numbers::{number_words, pointed};

/// Characters of a note that are quoted.
const QUOTED: usize = 40;

/// Empties the rows below the last one that begins with a number, where they begin with words, and says which.
pub(super) fn leave_out(sheet: &mut Sheet, head: usize) -> Vec<String> {
    let is_number = |text: &String| pointed(text).parse::<f64>().is_ok();
    let begins_with_number = |row: &Vec<String>| row.first().is_some_and(is_number);
    let Some(last) = sheet.rows.iter().rposition(begins_with_number) else {
        return Vec::new();
    };
    if last <= head {
        return Vec::new();
    }
    let mut said = Vec::new();
    for (row, cells) in sheet.rows.iter_mut().enumerate().skip(last + 1) {
        let Some(text) = cells.iter().find(|text| !text.is_empty()) else {
            continue;
        };
        // a place or a count that is misspelt is refused, not passed over
        let first = cells.first().map_or("", String::as_str);
        let holds_values = cells.iter().skip(1).any(is_number);
        let begins_with_words = is_words(first) && number_words(first).is_empty();
        if !is_words(text) || holds_values && !begins_with_words {
            continue;
        }
        let short: String = text.chars().take(QUOTED).collect();
        let more = if short.len() < text.len() { "…" } else { "" };
        said.push(format!(
            "row {} stands below the table (`{short}{more}`): passed over",
            row + 1
        ));
        cells.iter_mut().for_each(String::clear);
    }
    said
}

/// Whether a text begins with a letter and has two more of them.
fn is_words(text: &str) -> bool {
    text.starts_with(char::is_alphabetic)
        && text.chars().filter(|letter| letter.is_alphabetic()).count() > 2
}
