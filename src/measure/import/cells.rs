//! A table file as sheets of cells, each as the text that a person reads in it.

use std::path::Path;

use super::numbers::pointed;
use super::{ImportError, xlsx};
use crate::measure::table::field_spans;

/// One sheet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sheet {
    /// Its name; empty for a text file.
    pub name: String,
    /// Its rows from the first on, empty cells as empty texts.
    pub rows: Vec<Vec<String>>,
    /// The first cell with a formula of which the file holds no result.
    pub without_result: Option<String>,
    /// Whether `1.234` can only be one and a bit: numbers of a spreadsheet, and texts with commas between columns.
    pub plain_decimals: bool,
    /// What was made of its cells before it is read, in words.
    pub said: Vec<String>,
}

impl Sheet {
    /// Whether a row holds two numbers, as those of every table do but for covers and notes.
    pub fn holds_numbers(&self) -> bool {
        let is_number = |cell: &&String| pointed(cell).parse::<f64>().is_ok();
        (self.rows.iter()).any(|row| row.iter().filter(is_number).count() > 1)
    }
}

/// Spreadsheets that have to be saved in another form first.
const OTHERS: [&str; 5] = ["xls", "xlsb", "ods", "numbers", "gsheet"];

/// The sheets of a file.
///
/// # Errors
/// [`ImportError`] for a file that cannot be read.
pub fn sheets(path: &Path) -> Result<Vec<Sheet>, ImportError> {
    let ending = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let cannot = |why: String| ImportError(format!("cannot read {}: {why}", path.display()));
    if OTHERS.contains(&ending.as_str()) {
        return Err(cannot(format!(
            ".{ending} is not read; save it as .xlsx or .csv"
        )));
    }
    let bytes = std::fs::read(path).map_err(|error| cannot(error.to_string()))?;
    if ["xlsx", "xlsm"].contains(&ending.as_str()) {
        let mut sheets = xlsx::sheets(&bytes).map_err(cannot)?;
        for cell in sheets
            .iter_mut()
            .flat_map(|sheet| &mut sheet.rows)
            .flatten()
        {
            *cell = with_plain_marks(cell);
        }
        return Ok(sheets);
    }
    let text = utf_16(&bytes)
        .map_or_else(|| String::from_utf8(bytes), Ok)
        .or_else(|error| windows_1252(error.as_bytes()))
        .map_err(|()| cannot("it is not UTF-8 text; save it as UTF-8 or as .xlsx".to_owned()))?;
    Ok(vec![of_text(&text)])
}

/// "Unicode text" as spreadsheets save it: two bytes a unit, the smaller or the larger first as the mark at the beginning has it; none without that mark.
fn utf_16(bytes: &[u8]) -> Option<String> {
    let unit: fn([u8; 2]) -> u16 = match bytes.get(..2)? {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let (pairs, []) = bytes[2..].as_chunks::<2>() else {
        return None;
    };
    let units: Vec<u16> = pairs.iter().map(|pair| unit(*pair)).collect();
    String::from_utf16(&units).ok()
}

/// Text as spreadsheets of western Europe save it: a byte a character, those from 0xA0 on as in Unicode. The letters and signs that
/// stand between 0x80 and 0x9F there (dashes, quotes, the euro) can only be in words for people, and become question marks; a zero byte
/// stands in no text of this kind.
fn windows_1252(bytes: &[u8]) -> std::result::Result<String, ()> {
    let character = |&byte: &u8| match byte {
        0 => Err(()),
        0x80..=0x9f => Ok('?'),
        byte => Ok(char::from(byte)),
    };
    bytes.iter().map(character).collect()
}

/// A text with the separator that most of its lines have most of; `#` begins comments, a line `sep=;` states the separator.
fn of_text(text: &str) -> Sheet {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = || {
        text.lines()
            .map(|line| if line.starts_with('#') { "" } else { line })
    };
    let count = |separator: u8| {
        let fields = lines().map(|line| field_spans(line, 0..line.len(), separator).len());
        fields.filter(|&n| n > 1).count()
    };
    // a comma stands inside numbers too, so the others come first
    let separators = [b';', b'\t', b','];
    let most = separators.into_iter().map(count).max().unwrap_or(0);
    let separator = separators
        .into_iter()
        .find(|&separator| 2 * count(separator) > most)
        .unwrap_or(b',');
    let rows = lines().map(|line| {
        if line.to_lowercase().starts_with("sep=") {
            return Vec::new();
        }
        let spans = field_spans(line, 0..line.len(), separator);
        let fields = spans.into_iter().map(|span| &line[span]);
        fields
            .map(|field| with_plain_marks(field.trim_matches('"').trim()))
            .collect()
    });
    Sheet {
        name: String::new(),
        rows: rows.collect(),
        without_result: None,
        plain_decimals: separator == b',',
        said: Vec::new(),
    }
}

/// Spaces that stand in numbers between thousands and nowhere else inside of them: no-break, narrow no-break, thin.
const SPACES: [char; 3] = ['\u{a0}', '\u{202f}', '\u{2009}'];
/// The sign that typesetters put in the place of a hyphen.
const MINUS: char = '\u{2212}';

/// A text without such spaces between the groups of its digits, and with hyphens before its negative numbers.
fn with_plain_marks(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let is_digit = |at: usize| chars.get(at).is_some_and(char::is_ascii_digit);
    let digits_before = |at: usize| (0..at).rev().take_while(|&n| is_digit(n)).count();
    let is_group = |at: usize| (at..at + 3).all(is_digit) && !is_digit(at + 3);
    let kept = chars.iter().enumerate().filter_map(|(at, &c)| match c {
        _ if SPACES.contains(&c) && (1..=3).contains(&digits_before(at)) && is_group(at + 1) => {
            None
        }
        MINUS if is_digit(at + 1) || chars.get(at + 1).is_some_and(|c| ".,".contains(*c)) => {
            Some('-')
        }
        c => Some(c),
    });
    kept.collect()
}

#[cfg(test)]
impl Sheet {
    /// Of rows with `|` between their cells.
    pub(super) fn of_rows(rows: &[&str]) -> Self {
        let cells = |row: &&str| row.split('|').map(str::to_owned).collect();
        Self {
            name: String::new(),
            rows: rows.iter().map(cells).collect(),
            without_result: None,
            plain_decimals: true,
            said: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spaces_between_thousands_and_minus_signs_are_plain() {
        for (text, plain) in [
            ("1\u{a0}000\u{a0}000", "1000000"),
            ("250\u{202f}000 rev", "250000 rev"),
            ("\u{2212}1\u{2009}234,5", "-1234,5"),
            ("1e\u{2212}3", "1e-3"),
            ("100000\u{a0}rev", "100000\u{a0}rev"),
            ("2026\u{a0}100", "2026\u{a0}100"),
            ("12\u{a0}34", "12\u{a0}34"),
            ("new \u{2212} worn", "new \u{2212} worn"),
            ("1 000", "1 000"),
        ] {
            assert_eq!(with_plain_marks(text), plain, "{text}");
        }
    }

    #[test]
    fn unicode_texts_of_spreadsheets_are_read_either_way_round() {
        let text = "Prüfung\tr [mm]\n26,5\t1,2 µm";
        let marked = || std::iter::once(0xfeff).chain(text.encode_utf16());
        let little: Vec<u8> = marked().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = marked().flat_map(u16::to_be_bytes).collect();
        assert_eq!(utf_16(&little).as_deref(), Some(text));
        assert_eq!(utf_16(&big).as_deref(), Some(text));
        // no mark, half a unit, nothing
        assert_eq!(utf_16(&little[2..]), None);
        assert_eq!(utf_16(&little[..little.len() - 1]), None);
        assert_eq!(utf_16(&[]), None);
    }

    #[test]
    fn texts_are_cut_at_their_separator() {
        let rows = |text: &str| of_text(text).rows;
        let cells = vec![
            vec!["r".to_owned(), "1e5".to_owned()],
            vec!["26,5".to_owned(), "1,2".to_owned()],
        ];
        assert_eq!(rows("r;1e5\n26,5;1,2\n"), cells);
        assert_eq!(rows("\u{feff}r\t1e5\n26,5\t1,2"), cells);
        assert_eq!(rows("r,1e5\n\"26,5\",\"1,2\"\n"), cells);
        assert_eq!(rows("# note; note\nsep=;\nr;1e5\n")[2], cells[0]);
    }
}
