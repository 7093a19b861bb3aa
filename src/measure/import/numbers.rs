//! Numbers in the cells of tables: decimal marks, counts in headers, what is ambiguous.

use super::{ImportError, Sheet, cell_name};
use crate::measure::dialect::in_thousands;
use crate::measure::header::FOR_PEOPLE;

type Result<T> = std::result::Result<T, ImportError>;

/// How decimals are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decimal {
    /// `1.5`
    Point,
    /// `1,5`
    Comma,
}

/// The sheet with decimal points in its numbers.
///
/// Where nothing but marks between groups of three digits stands in the numbers (`1.234`, `26.500`), they may be marks between
/// thousands: then it has to be said.
pub(super) fn with_points(sheet: &Sheet, decimal: Option<Decimal>) -> Result<Sheet> {
    if sheet.plain_decimals && decimal.is_none() {
        return Ok(sheet.clone());
    }
    let mut sheet = sheet.clone();
    let mut unclear = None;
    let mut clear = false;
    for (row, cells) in sheet.rows.iter_mut().enumerate() {
        for (column, text) in cells.iter_mut().enumerate() {
            let number = text.contains(['.', ',']) && number_words(text) == [text.as_str()];
            // with several marks it is refused where it is read, as a count in thousands
            let several = text.matches(['.', ',']).count() > 1;
            if !number || several && decimal.is_none() {
                continue;
            }
            match decimal {
                Some(Decimal::Point) => *text = text.replace(',', ""),
                Some(Decimal::Comma) => *text = text.replace('.', "").replace(',', "."),
                None if in_thousands(text.trim_start_matches(['+', '-'])) => {
                    unclear.get_or_insert_with(|| (cell_name(row, column), text.clone()));
                }
                None => clear = true,
            }
        }
    }
    match unclear.filter(|_| !clear) {
        None => Ok(sheet),
        Some((cell, text)) => Err(ImportError(format!(
            "{cell}: is `{text}` {} or {}? No number of the table shows which: say --decimal point or --decimal comma",
            text.replace(',', "."),
            text.replace(['.', ','], "")
        ))),
    }
}

/// The one number of a header such as `250000 cycles` or `r = 26,5 mm`.
pub(super) fn header_number(text: &str, row: usize, column: usize) -> Result<f64> {
    let refuse = |why: &str| {
        let cell = cell_name(row, column);
        Err(ImportError(format!("{cell}: {why} in the header `{text}`")))
    };
    let words = number_words(text);
    let [one] = words[..] else {
        return refuse(if words.is_empty() {
            "no number"
        } else {
            "several numbers (write one, without marks between thousands)"
        });
    };
    let at = text.find(one).unwrap_or_default();
    let letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
    let (before, after) = (&text[..at], &text[at + one.len()..]);
    if letter(before.chars().next_back()) || letter(after.chars().next()) || scaled(after) {
        return refuse(
            "a number with a letter, a multiple or a time (write plain pinion revolutions or places)",
        );
    }
    match pointed(one).parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => refuse("no plain number (marks between thousands are left out)"),
    }
}

/// Whether what follows a number makes another one of it: `Mio`, `thousand`, `h`.
fn scaled(after: &str) -> bool {
    const WORDS: [&str; 14] = [
        "k", "m", "mio", "million", "millions", "thousand", "tsd", "h", "hour", "hours", "std",
        "min", "s", "days",
    ];
    let mut words = after.split(|c: char| !c.is_alphabetic());
    let first = words.find(|word| !word.is_empty()).unwrap_or_default();
    WORDS.contains(&first.to_lowercase().as_str())
}

/// Refuses a count of cycles that may be marked between its thousands: `250.000` is 250 or a quarter of a million.
pub(super) fn plain_cycles(text: &str, row: usize, column: usize) -> Result<()> {
    match number_words(text)
        .into_iter()
        .find(|word| in_thousands(word))
    {
        None => Ok(()),
        Some(word) => Err(ImportError(format!(
            "{}: are the cycles `{word}` marked between thousands? Write them without marks",
            cell_name(row, column)
        ))),
    }
}

/// A header row without marks between the thousands of its numbers, where one with several (`1.000.000`) tells what they are.
pub(super) fn without_thousands(header: &mut [String]) {
    let marked = |text: &String, least: usize| {
        let words = number_words(text).into_iter();
        let several = |word: &&str| in_thousands(word) && word.matches(['.', ',']).count() >= least;
        words.filter(several).map(str::to_owned).next()
    };
    if header.iter().any(|text| marked(text, 2).is_some()) {
        for text in header {
            if let Some(word) = marked(text, 1) {
                *text = text.replacen(&word, &word.replace(['.', ','], ""), 1);
            }
        }
    }
}

/// Whether a column is named as one for people.
pub(super) fn is_for_people(header: &str) -> bool {
    const GERMAN: [&str; 5] = ["kommentar", "bemerkung", "bemerkungen", "notiz", "hinweis"];
    let name = header.trim().to_lowercase();
    GERMAN.contains(&name.as_str()) || FOR_PEOPLE.contains(&name.as_str())
}

/// The words of a text that hold digits.
pub(super) fn number_words(text: &str) -> Vec<&str> {
    let part = |c: char| c.is_ascii_digit() || "+-.,eE".contains(c);
    text.split(|c: char| !part(c))
        .map(|word| word.trim_matches(['e', 'E', '.', ',']))
        .filter(|word| word.contains(|c: char| c.is_ascii_digit()))
        .collect()
}

pub(super) fn number(text: &str, row: usize, column: usize) -> Result<f64> {
    let found = pointed(text).parse::<f64>().ok().filter(|v| v.is_finite());
    found.ok_or_else(|| {
        ImportError(format!(
            "{}: `{text}` is not a number",
            cell_name(row, column)
        ))
    })
}

/// With a point for a decimal comma.
pub(super) fn pointed(text: &str) -> String {
    if text.matches(',').count() == 1 && !text.contains('.') {
        text.replace(',', ".")
    } else {
        text.to_owned()
    }
}

/// Nine digits: conversions leave no trail of rounding.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}
