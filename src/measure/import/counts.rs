//! What the words beside a number of a header or above it make of it, if it is to be a count of revolutions.

use super::{ImportError, Sheet, cell_name, units};
use crate::measure::{Quantity, names};

type Result<T> = std::result::Result<T, ImportError>;

/// Words that may stand beside a count and leave it as it is; `U` are German revolutions.
const PLAIN: [&str; 5] = ["u", "load", "in", "total", "all"];

/// Words before a small number that make it the place in a sequence, beside those for stops.
const ORDINALS: [&str; 28] = [
    "step",
    "block",
    "check",
    "reading",
    "measurement",
    "phase",
    "fase",
    "no",
    "nr",
    "number",
    "schritt",
    "messung",
    "prufung",
    "mesure",
    "tooth",
    "zahn",
    "dent",
    "dente",
    "diente",
    "profile",
    "profil",
    "profilo",
    "perfil",
    "position",
    "trace",
    "spur",
    "curve",
    "kurve",
];
/// Numbers from which such a word does not make a place of a number: `stop 100000`.
const NO_ORDINAL: f64 = 1000.0;

/// Refuses the header of a checkpoint whose words behind the number say that it is none, or not in revolutions: `70 hrs`, `25 %`, `50 Nm`. The
/// unit of the `quantity` may stand there in brackets or behind the word for revolutions.
pub(super) fn refuse_others(
    header: &str,
    number: &str,
    quantity: Option<Quantity>,
    row: usize,
    column: usize,
) -> Result<()> {
    let start = header.find(number).unwrap_or(0);
    let (before, behind) = (&header[..start], &header[start + number.len()..]);
    let last = names::words(before).pop().unwrap_or_default();
    let in_sequence = names::is_stop(&last) || is_ordinal(&last);
    if in_sequence && number.parse().is_ok_and(|n: f64| n < NO_ORDINAL) {
        return Err(ImportError(format!(
            "{}: the header `{header}` counts stages, teeth or measurements: write the revolutions of the pinion there at which each was made; of several \
             curves from after as many revolutions make a row of each value, with a column `tooth` or `trace` (those of \
             teeth are read as they are with --cycles)",
            cell_name(row, column)
        )));
    }
    let refused = |what: &str| {
        Err(ImportError(format!(
            "{}: the header `{header}` has `{what}` behind its number: a checkpoint is a number of revolutions of the pinion (or of the gear: `100000 \
             gear rev`), without multiples; times, torques, speeds, temperatures and the like are none",
            cell_name(row, column)
        )))
    };
    let is_unit =
        |word: &str| quantity.is_some_and(|quantity| units::of_values(word, quantity).is_some());
    let bracketed = units::bracketed(behind);
    if let Some(text) = bracketed
        && !is_unit(text)
        && !is_plain(text)
    {
        return refused(text);
    }
    let before = behind.split(['[', '(']).next().unwrap_or(behind);
    let after = bracketed.map_or("", |_| behind.rsplit([']', ')']).next().unwrap_or_default());
    for (text, is_first) in [(before, true), (after, bracketed.is_none())] {
        let mut may_be_unit = !is_first;
        for word in text.split(|c: char| c.is_whitespace() || ",;:/-".contains(c)) {
            let word = word.trim_matches(['.', '"']);
            if word.is_empty() || is_plain(word) || may_be_unit && is_unit(word) {
                may_be_unit |= !word.is_empty();
                continue;
            }
            return refused(word);
        }
    }
    Ok(())
}

/// Whether a word before a small number makes it the place in a sequence.
pub(super) fn is_ordinal(word: &str) -> bool {
    ORDINALS.contains(&word)
}

/// Whether a word leaves a count as it is: revolutions, members, tests, quantities, and words that say nothing.
fn is_plain(text: &str) -> bool {
    let word = |word: &str| {
        names::revolutions(word).is_some()
            || names::member(word).is_some()
            || names::column(word) == Some("test")
            || names::quantity(word).is_some()
            || names::is_filler(word)
            || PLAIN.contains(&names::folded(word).as_str())
    };
    text.split_whitespace().all(word)
        && text.chars().all(|c| c.is_alphabetic() || c.is_whitespace())
}

/// Refuses a wide table of which a row above the header, or the header's first cell, says that its numbers count hours, millions or the like.
pub(super) fn refuse_others_above(sheet: &Sheet, head: usize) -> Result<()> {
    for (row, cells) in sheet.rows.iter().enumerate().take(head + 1) {
        let cells: Vec<&str> = if row == head {
            cells.first().map(String::as_str).into_iter().collect()
        } else {
            let cells = cells.iter().map(String::as_str);
            cells.filter(|cell| !cell.is_empty()).collect()
        };
        if row < head && is_fact(&cells) {
            continue;
        }
        let text = cells.join(" ");
        if let Some(what) = other_count(&text) {
            return Err(ImportError(format!(
                "row {}: `{text}` speaks of `{what}`, and the numbers of the checkpoints would be read as revolutions of the pinion: write revolutions \
                 there, or make a row of each value with a column `time [h]`",
                row + 1
            )));
        }
    }
    Ok(())
}

/// Refuses a table with a column of revolutions of which a row above the header says that they count millions or the like: `cycles in millions`.
pub(super) fn refuse_multiples_above(sheet: &Sheet, head: usize) -> Result<()> {
    for (row, cells) in sheet.rows.iter().enumerate().take(head) {
        let cells: Vec<&str> = (cells.iter().map(String::as_str))
            .filter(|cell| !cell.is_empty())
            .collect();
        let text = cells.join(" ");
        let words = names::words(&text);
        let speaks_of_revolutions = words.iter().any(|word| names::revolutions(word).is_some());
        let multiple = || words.iter().any(|word| names::is_multiple(word));
        if !is_fact(&cells)
            && speaks_of_revolutions
            && (multiple() || names::is_times_a_power(&text))
        {
            return Err(ImportError(format!(
                "row {}: `{text}` speaks of multiples, and the numbers of revolutions would be read as they are: write them in full",
                row + 1
            )));
        }
    }
    Ok(())
}

/// Whether a row tells a number of its own: `Operating hours: 1234`, `Operating hours | 1234`.
fn is_fact(cells: &[&str]) -> bool {
    let has_digit = |text: &str| text.contains(|c: char| c.is_ascii_digit());
    let behind = cells.first().and_then(|cell| cell.split_once([':', '=']));
    behind.is_some_and(|(_, text)| has_digit(text)) || cells.len() == 2 && has_digit(cells[1])
}

/// The word of a title by which numbers below it count hours or multiples of revolutions.
fn other_count(text: &str) -> Option<String> {
    let speaks_of_time = names::words(text).iter().any(|word| names::is_time(word));
    let unit = units::bracketed(text).filter(|unit| names::hours_of_unit(unit).is_some());
    if let Some(unit) = unit.filter(|_| speaks_of_time) {
        return Some(unit.to_owned());
    }
    let words: Vec<&str> = text
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .collect();
    let is_number = |at: usize| {
        words
            .get(at)
            .is_some_and(|word| word.starts_with(|c: char| c.is_ascii_digit()))
    };
    let found = words.iter().enumerate().find(|(at, word)| {
        // `Monday, 3 hours after the stop` and `week 12` say when
        let has_number = is_number(at + 1) || *at > 0 && is_number(at - 1);
        // shorter ones have other meanings too
        let is_time = word.len() > 3 || word.eq_ignore_ascii_case("hrs");
        !has_number && (names::is_multiple(word) || is_time && names::hours_of_unit(word).is_some())
    });
    let power = || names::is_times_a_power(text).then(|| "a power of ten".to_owned());
    found.map(|(_, word)| (*word).to_owned()).or_else(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_behind_a_count_are_known_or_refused() {
        let of = |header: &str| {
            let number = super::super::numbers::number_words(header)[0].to_owned();
            refuse_others(header, &number, Some(Quantity::WearDepth), 0, 1)
        };
        for header in [
            "100000",
            "100000 cycles",
            "100000 load cycles",
            "100000 gear rev",
            "100000 Umdrehungen Rad",
            "100000 [um]",
            "100000 (\u{b5}m)",
            "100000 cycles, um",
            "Verschlei\u{df} [mm] nach 250000",
            "100000 rev (pinion)",
            "250000 in total",
            "stop 250000",
        ] {
            assert_eq!(of(header), Ok(()), "{header}");
        }
        for header in [
            "stage 1",
            "after stage 2",
            "Messung Nr. 3",
            "wear after stop 4 [um]",
            "70 hrs",
            "2 wk",
            "25 %",
            "2000 rpm",
            "100 T",
            "20 \u{b0}C",
            "20 \u{b0}",
            "50 Nm",
            "50 [Nm]",
            "70 [h]",
            "5 mm",
            "1 day",
            "100000 left",
            "1 tooth",
        ] {
            assert!(of(header).is_err(), "{header}");
        }
    }

    #[test]
    fn titles_that_speak_of_hours_or_multiples_are_found() {
        for (text, word) in [
            (
                "Wear depth of the pinion in um, after running hours",
                Some("hours"),
            ),
            ("Verschlei\u{df} [\u{b5}m] nach Stunden", Some("Stunden")),
            ("Wear depth [um], cycles in millions", Some("millions")),
            ("Cycles x 1e6", Some("a power of ten")),
            ("revolutions [10^6]", Some("a power of ten")),
            ("time [h]", Some("h")),
            ("measured 3 hours after the stop", None),
            ("Wear depth in um, week 12", None),
            ("radius [mm]", None),
            ("Run A (10000 cycles)", None),
            ("run(s) of May", None),
        ] {
            assert_eq!(other_count(text).as_deref(), word, "{text}");
        }
        assert!(is_fact(&["Operating hours: 1234"]) && is_fact(&["Hours", "12"]));
    }
}
