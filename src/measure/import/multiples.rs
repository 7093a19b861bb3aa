//! Headers by which a table counts cycles in multiples: `Lastwechsel [1E6]`, `Lastwechsel in Mio.`, `0,25 [1E6]` in each of them.

use super::numbers::{header_number, number_words, pointed};
use super::wide::is_aside;
use super::{ImportError, Sheet, cell_name, units};
use crate::measure::names;

/// More revolutions than any test has: a factor that was multiplied in already.
const MOST: f64 = 1e10;

/// The revolutions that a count below such a header stands for.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Multiple {
    factor: f64,
    /// The header as it is written, and its cell.
    written: String,
    cell: String,
}

impl Multiple {
    /// Of the header in a row and column; none if it does not name cycles with a power of ten in brackets.
    pub(super) fn of(written: &str, row: usize, column: usize) -> Option<Self> {
        Some(Self {
            factor: factor(written)?,
            written: written.to_owned(),
            cell: cell_name(row, column),
        })
    }

    /// The sheet without the power of ten of the header in row `head` or above it, and what it was.
    pub(super) fn taken(sheet: &Sheet, head: usize) -> Option<(Sheet, Self)> {
        let rows = sheet.rows.iter().enumerate().take(head + 1);
        let mut cells = rows.flat_map(|(row, cells)| {
            cells
                .iter()
                .enumerate()
                .map(move |(column, text)| (row, column, text))
        });
        let (row, column, multiple) = cells
            .find_map(|(row, column, text)| Some((row, column, Self::of(text, row, column)?)))?;
        let mut sheet = sheet.clone();
        let text = &mut sheet.rows[row][column];
        let plain = in_brackets(text).unwrap_or_else(|| text.clone());
        let open = plain.rfind(['[', '('])?;
        // above the header it names what stands below in the header itself; the rest of a title may name the values
        let end = match row < head {
            true => plain[..open].rfind([',', ';']).unwrap_or(0),
            false => open,
        };
        *text = plain[..end].trim_end().to_owned();
        Some((sheet, multiple))
    }

    /// The revolutions that a count stands for.
    ///
    /// # Errors
    /// [`ImportError`] if no test has so many.
    pub(super) fn revolutions(&self, count: f64) -> Result<f64, ImportError> {
        let revolutions = super::numbers::rounded(self.factor * count);
        if revolutions <= MOST {
            return Ok(revolutions);
        }
        Err(ImportError(format!(
            "{}: `{}`: {count} would be {revolutions:e} revolutions: are they written in full below it? Then take the power of ten out",
            self.cell, self.written
        )))
    }

    /// Whether it counts revolutions of the gear.
    pub(super) fn is_of_gear(&self) -> bool {
        names::counts_gear_revolutions(&self.written)
    }

    /// How it is read.
    pub(super) fn said(&self) -> String {
        format!(
            "`{}`: each 1 stands for {} revolutions",
            self.written, self.factor
        )
    }
}

/// Words before a name of cycles that count it in multiples, with the unit that each is.
const COUNTED_IN: [(&str, &str); 8] = [
    ("milliers de ", "x1000"),
    ("migliaia di ", "x1000"),
    ("miles de ", "x1000"),
    ("thousands of ", "x1000"),
    ("thousand ", "x1000"),
    ("millions de ", "1E6"),
    ("milioni di ", "1E6"),
    ("millones de ", "1E6"),
];

/// A name of cycles with a multiple behind `in` or alone, or before it, as it would be with the multiple in brackets: `Lastwechsel in Mio.` as `Lastwechsel
/// [Mio.]`, `Umdrehungen x1000` as `Umdrehungen [x1000]`, `Milliers de tours` as `tours [x1000]`.
pub(super) fn in_brackets(header: &str) -> Option<String> {
    let (name, multiple) = multiple_apart(header)?;
    let last = name.rsplit([',', ';']).next().unwrap_or(name);
    let names_cycles = names::words(last)
        .iter()
        .any(|word| names::revolutions(word).is_some());
    let unit: String = multiple.split_whitespace().collect();
    (names_cycles && of_unit(&unit).is_some()).then(|| format!("{name} [{}]", multiple.trim()))
}

/// A name and the words beside it that may be a multiple.
fn multiple_apart(header: &str) -> Option<(&str, &str)> {
    let mut behind = [" in ", " en "].iter();
    if let Some(both) = behind.find_map(|word| header.rsplit_once(word)) {
        return Some(both);
    }
    let lower = header.to_lowercase();
    let counted = COUNTED_IN.iter().find_map(|(words, unit)| {
        let is_of_same_length = lower.len() == header.len();
        (is_of_same_length && lower.starts_with(words)).then(|| (&header[words.len()..], *unit))
    });
    counted.or_else(|| {
        let (name, last) = header.rsplit_once(' ')?;
        // without a sign or a letter it may be a count itself
        last.starts_with(|c: char| c.is_alphabetic() || c == '\u{d7}')
            .then_some((name, last))
    })
}

/// The sheet with plain revolutions in the headers that state a multiple each (`0,25 [1E6]`), and what was made of them, in words.
///
/// # Errors
/// [`ImportError`] for a number that is none, or of more revolutions than any test has.
pub(super) fn in_each_header(sheet: &Sheet) -> Result<(Sheet, Vec<String>), ImportError> {
    let mut sheet = sheet.clone();
    let mut said: Vec<String> = Vec::new();
    for row in 0..sheet.rows.len() {
        for column in places_of_counts(&sheet.rows[row]) {
            let written = sheet.rows[row][column].clone();
            let Some((factor, [before, number, behind])) = counted(&written) else {
                continue;
            };
            if factor == 1e3 && may_have_thousands(number) {
                return Err(ImportError(format!(
                    "{}: `{written}`: are these thousands of thousands, or decimals? Write the revolutions in full",
                    cell_name(row, column)
                )));
            }
            let multiple = Multiple {
                factor,
                cell: cell_name(row, column),
                written: written.clone(),
            };
            let revolutions = multiple.revolutions(header_number(number, row, column)?)?;
            sheet.rows[row][column] = format!("{before}{revolutions}{behind}");
            said.push(format!("`{}`: {revolutions} revolutions", multiple.written));
        }
    }
    if said.len() > 1 {
        said = vec![format!("{} and the like in each header", said[0])];
    }
    Ok((sheet, said))
}

/// Whether a mark in a number may stand between its thousands: `40.000`, and not `0.250`.
fn may_have_thousands(number: &str) -> bool {
    let parts = number.split_once(['.', ',']);
    parts.is_some_and(|(whole, rest)| rest.len() == 3 && !whole.starts_with('0'))
}

/// The columns of a row that may hold a count with its multiple: all but the first of a header, where each has a number, or the first one beside
/// values. A title has neither.
fn places_of_counts(row: &[String]) -> Vec<usize> {
    let is_count = |text: &String| counted(text).is_some();
    let is_filled = |text: &&String| !text.is_empty() && !is_aside(text);
    let behind: Vec<&String> = row.iter().skip(1).filter(is_filled).collect();
    let first = row.first().filter(|text| is_count(text));
    let is_value = |text: &&String| pointed(text).parse::<f64>().is_ok();
    match first {
        Some(_) if !behind.is_empty() && behind.iter().all(is_value) => vec![0],
        None if behind.iter().all(|text| !number_words(text).is_empty()) => {
            (1..row.len()).collect()
        }
        _ => Vec::new(),
    }
}

/// The factor of a header with a multiple right behind its number, what stands before the number, the number, and what stands behind the multiple; none where
/// it has words for other things than cycles.
fn counted(header: &str) -> Option<(f64, [&str; 3])> {
    let (factor, front, behind) = multiple_in_brackets(header).or_else(|| multiple_word(header))?;
    let [number] = number_words(front)[..] else {
        return None;
    };
    let at = front.find(number)?;
    let before = &front[..at];
    let says_cycles = |word: &String| {
        names::revolutions(word).is_some()
            || names::member(word).is_some()
            || names::is_filler(word)
    };
    // what the values are, with their unit in brackets, stands before it
    let is_value = |word: &String| names::quantity(word).is_some();
    let (of_values, _) = units::name_and_unit(before);
    let of_cycles = (names::words(&of_values).iter())
        .all(|word| says_cycles(word) || is_value(word))
        && names::words(behind).iter().all(says_cycles);
    let follows = front[at + number.len()..].trim().is_empty();
    (of_cycles && follows).then_some((factor, [before, number, behind]))
}

/// The multiple in the last brackets of a header, and what stands before and behind it: `0,25 [1E6]`.
fn multiple_in_brackets(header: &str) -> Option<(f64, &str, &str)> {
    let (front, rest) = header.split_at(header.rfind(['[', '('])?);
    Some((
        of_brackets(header)?,
        front,
        &rest[rest.find([']', ')'])? + 1..],
    ))
}

/// The same of a word behind the first number: `40 Tsd.`, `40k`.
fn multiple_word(header: &str) -> Option<(f64, &str, &str)> {
    let number = number_words(header).into_iter().next()?;
    let (front, rest) = header.split_at(header.find(number)? + number.len());
    let rest = rest.trim_start();
    let end = rest
        .find(|c: char| !c.is_alphabetic())
        .unwrap_or(rest.len());
    let (word, behind) = rest.split_at(end);
    let factor = match word {
        "k" => 1e3,
        _ => of_unit(word)?,
    };
    Some((factor, front, behind.trim_start_matches('.')))
}

/// The factor of a header that names cycles with a power of ten, or a word for one, in its last brackets or behind `in`.
pub(super) fn factor(header: &str) -> Option<f64> {
    let plain = in_brackets(header);
    let header = plain.as_deref().unwrap_or(header);
    let (name, _) = units::name_and_unit(header);
    let names_cycles = names::words(&name)
        .iter()
        .any(|word| names::revolutions(word).is_some());
    names_cycles.then(|| of_brackets(header)).flatten()
}

/// The factor in the last brackets of a header, before a word for revolutions too: `[1E6]`, `(x1000 rev)`.
fn of_brackets(header: &str) -> Option<f64> {
    let written = units::bracketed(header)?;
    if written.trim() == "k" {
        return Some(1e3);
    }
    let counts = |word: &&str| names::revolutions(word).is_some();
    let unit: String = match written.trim().rsplit_once(' ') {
        Some((multiple, word)) if counts(&word) => multiple.split_whitespace().collect(),
        _ => written.split_whitespace().collect(),
    };
    of_unit(&unit)
}

/// The factor of `1E6`, `10^6`, `x10^6`, `10⁶`, `x1000`, `Mio.`
fn of_unit(unit: &str) -> Option<f64> {
    let unit = unit.to_lowercase();
    let times = unit.trim_start_matches(['x', '*', '\u{d7}', '\u{b7}']);
    if times != unit {
        // without a sign it may be a count itself
        match times {
            "1000" | "1,000" | "1.000" => return Some(1e3),
            "1000000" | "1,000,000" | "1.000.000" => return Some(1e6),
            _ => {}
        }
    }
    let unit = times.trim_end_matches('.');
    if let "mio" | "mill" | "million" | "millions" | "millionen" | "milioni" | "millones" = unit {
        return Some(1e6);
    }
    if let "tsd" | "thousand" | "thousands" | "tausend" | "miles" | "milliers" | "migliaia" = unit {
        return Some(1e3);
    }
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| match RAISED.iter().position(|raised| *raised == c) {
        Some(digit) => char::from_digit(digit as u32, 10).unwrap_or(c),
        None => c,
    };
    let raised = (unit.strip_prefix("10")).filter(|rest| rest.starts_with(RAISED));
    let power = match raised {
        Some(rest) => rest.chars().map(digit).collect(),
        None => {
            let starts = ["10^", "10**", "1e"];
            starts
                .iter()
                .find_map(|start| unit.strip_prefix(start))?
                .to_owned()
        }
    };
    let power: i32 = power.trim_start_matches('+').parse().ok()?;
    (1..=9).contains(&power).then(|| 10f64.powi(power))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_of_what_may_have_thousands_are_refused() {
        for number in ["40.000", "1,250", "400.000"] {
            assert!(may_have_thousands(number), "{number}");
        }
        for number in ["40", "0.250", "12,5", "40.0"] {
            assert!(!may_have_thousands(number), "{number}");
        }
        let of = |header: &str| Sheet {
            name: String::new(),
            rows: vec![
                ["Radius [mm]", header, "80 Tsd."]
                    .map(str::to_owned)
                    .to_vec(),
            ],
            without_result: None,
            plain_decimals: false,
            said: Vec::new(),
        };
        assert!(in_each_header(&of("40.000 Tsd.")).is_err());
        assert!(in_each_header(&of("40 Tsd.")).is_ok());
    }

    #[test]
    fn powers_of_ten_in_brackets_are_factors_of_cycles() {
        for (header, expected) in [
            ("Lastwechsel [1E6]", Some(1e6)),
            ("Lastwechsel [10^6]", Some(1e6)),
            ("Vueltas del pi\u{f1}\u{f3}n (miles)", Some(1e3)),
            ("load cycles (x 10^3)", Some(1e3)),
            ("Pinion revs (x1000)", Some(1e3)),
            ("revolutions [\u{d7} 1,000,000]", Some(1e6)),
            ("cycles [1000]", None),
            ("cycles [10\u{2076}]", Some(1e6)),
            ("Lastspiele [Mio.]", Some(1e6)),
            ("cycles [thousand]", Some(1e3)),
            ("Lastspielzahl [10^6]", Some(1e6)),
            ("Lastwechsel in Mio.", Some(1e6)),
            ("Verschlei\u{df} [\u{b5}m], Lastwechsel in Mio.", Some(1e6)),
            ("Verschlei\u{df} in Mio.", None),
            ("cycles in total", None),
            ("Lastwechsel", None),
            ("Lastwechsel [-]", None),
            ("radius [1e6]", None),
            ("Lastwechsel [1E60]", None),
            ("Lastwechsel 1E6", None),
            ("Tours [k]", Some(1e3)),
            ("Milliers de tours", Some(1e3)),
            ("Migliaia di giri", Some(1e3)),
            ("Umdrehungen x1000", Some(1e3)),
            ("Lastwechsel Mio.", Some(1e6)),
            ("Milliers de Nm", None),
            ("Umdrehungen 1000", None),
        ] {
            assert_eq!(factor(header), expected, "{header}");
        }
    }

    #[test]
    fn a_multiple_beside_each_number_is_multiplied_in() {
        assert_eq!(
            counted("Lastwechsel 0,25 [1E6]"),
            Some((1e6, ["Lastwechsel ", "0,25", ""]))
        );
        assert_eq!(
            counted("0.5 (10^6) gear rev"),
            Some((1e6, ["", "0.5", " gear rev"]))
        );
        assert_eq!(counted("180 (x1000 rev)"), Some((1e3, ["", "180", ""])));
        assert_eq!(counted("40 Tsd."), Some((1e3, ["", "40", ""])));
        assert_eq!(counted("40k"), Some((1e3, ["", "40", ""])));
        assert_eq!(
            counted("0,25 Mio. Umdr. Rad"),
            Some((1e6, ["", "0,25", " Umdr. Rad"]))
        );
        assert_eq!(
            counted("Verschlei\u{df} [\u{b5}m] nach 0,1 Mio. LW"),
            Some((1e6, ["Verschlei\u{df} [\u{b5}m] nach ", "0,1", " LW"]))
        );
        for header in [
            "40 km",
            "40 k\u{3a9}",
            "k 40",
            "40 thousandths",
            "40 Tsd. h",
        ] {
            assert_eq!(counted(header), None, "{header}");
        }
        assert_eq!(counted("0,25 [mm]"), None);
        assert_eq!(counted("Lastwechsel [1E6]"), None);
        for title in [
            "Test 12, load cycles [10^6]",
            "Pruefstand 3 (1E3)",
            "Lastwechsel 12 Ritzel [1E6]",
        ] {
            assert_eq!(counted(title), None, "{title}");
        }
    }
}
