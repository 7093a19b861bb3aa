//! Numbers in the cells of tables: decimal marks, counts in headers, what is ambiguous.

use super::{ImportError, Sheet, cell_name, counts};
use crate::measure::names;
use crate::measure::thousands::{
    CountMarks, both_readings, has_certain_decimals, in_thousands, without_certain,
};

type Result<T> = std::result::Result<T, ImportError>;

/// How decimals are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decimal {
    /// `1.5`
    Point,
    /// `1,5`
    Comma,
}

/// The sheet with decimal points in its numbers; `counts` says which cells tell how decimals are written, `is_place` whether a number can be the place on a
/// flank that a cell tells.
///
/// Where nothing but marks between groups of three digits stands in the numbers (`1.234`, `26.500`), they may be marks between
/// thousands: then a place tells, which lies on the flank in one of the two readings, or it has to be said. Numbers of a spreadsheet have no marks of
/// their own.
pub(super) fn with_points(
    sheet: &Sheet,
    decimal: Option<Decimal>,
    counts: impl Fn(usize, usize) -> bool,
    is_place: impl Fn(usize, usize, f64) -> bool,
) -> Result<Sheet> {
    let is_text = sheet.name.is_empty();
    let mut sheet = sheet.clone();
    if decimal.is_none() {
        leave_out_certain_thousands(&mut sheet);
        if !is_text {
            return Ok(sheet);
        }
    }
    let plain = sheet.plain_decimals;
    // the first number with a point and the first with a comma
    let mut first: [Option<(String, String)>; 2] = [None, None];
    let mut unclear = None;
    let mut clear = false;
    for (row, cells) in sheet.rows.iter_mut().enumerate() {
        for (column, text) in cells.iter_mut().enumerate() {
            let number = text.contains(['.', ',']) && number_words(text) == [text.as_str()];
            // with several that are not all between thousands it is refused where it is read
            let several = text.matches(['.', ',']).count() > 1;
            if !number || several && decimal.is_none() {
                continue;
            }
            if let Some(decimal) = decimal {
                match without_groups(text, decimal, &cell_name(row, column)) {
                    Ok(plain) => *text = plain,
                    Err(error) if counts(row, column) => return Err(error),
                    // a date or a part's number in a title
                    Err(_) => {}
                }
                continue;
            }
            if !counts(row, column) {
                continue;
            }
            let mark = usize::from(text.contains(','));
            first[mark].get_or_insert_with(|| (cell_name(row, column), text.clone()));
            let is_place = |number: f64| is_place(row, column, number);
            if in_thousands(text.trim_start_matches(['+', '-']))
                && !is_decimal_place(text, is_place)
            {
                unclear.get_or_insert_with(|| (cell_name(row, column), text.clone()));
            } else {
                clear = true;
            }
        }
    }
    if let [Some((point, with_point)), Some((comma, with_comma))] = first {
        return Err(ImportError(format!(
            "{point}: `{with_point}` has a decimal point, {comma}: `{with_comma}` a comma; write all numbers with one of the two, and no \
             marks between thousands"
        )));
    }
    match unclear.filter(|_| !clear && !plain) {
        None => Ok(sheet),
        Some((cell, text)) => Err(ImportError(format!(
            "{cell}: is `{text}` {} or {}? No number of the table shows which: say --decimal point or --decimal comma",
            text.replace(',', "."),
            text.replace(['.', ','], "")
        ))),
    }
}

/// Whether a number with one mark lies on the flank if that is a decimal mark, and does not if it stands between thousands.
fn is_decimal_place(text: &str, is_place: impl Fn(f64) -> bool) -> bool {
    let reads_as_place = |text: String| text.parse::<f64>().is_ok_and(&is_place);
    reads_as_place(pointed(text)) && !reads_as_place(text.replace(['.', ','], ""))
}

/// Leaves the marks between thousands out of numbers where they can be nothing else: `1.000.000`, and `250.000` in the same column.
fn leave_out_certain_thousands(sheet: &mut Sheet) {
    let is_number = |text: &str| number_words(text) == [text];
    let width = sheet.rows.iter().map(Vec::len).max().unwrap_or(0);
    for column in 0..width {
        let mut marks = CountMarks::default();
        let cells = || sheet.rows.iter().filter_map(|row| row.get(column));
        let numbers = || cells().filter(|text| is_number(text));
        if numbers().all(|text| without_certain(text).is_none()) {
            continue;
        }
        numbers().for_each(|text| marks.see(text));
        let own = sheet.rows.iter_mut().filter_map(|row| row.get_mut(column));
        for text in own.filter(|text| is_number(text)) {
            if let Some(plain) = marks.plain(text) {
                *text = plain;
            }
        }
    }
}

/// Leaves blanks between thousands, `80 000`, out of a column of counts below row `head`.
pub(super) fn counts_without_blanks(sheet: &mut Sheet, head: usize, counts: usize) {
    let below = sheet.rows.iter_mut().skip(head + 1);
    for text in below.filter_map(|row| row.get_mut(counts)) {
        if let Some(plain) = without_blanks(text) {
            *text = plain;
        }
    }
}

/// Leaves the marks between thousands out of a column of counts below row `head`, where its own numbers or the decimals of the `others`
/// tell what they are, as in measurement files. Of a spreadsheet its counts have to be texts: its own numbers have no marks but decimal points.
pub(super) fn counts_without_thousands(
    sheet: &mut Sheet,
    head: usize,
    counts: usize,
    others: &[usize],
) {
    // a number of a spreadsheet has no zero at the end of its decimals
    let is_typed = |text: &String| in_thousands(text) && text.ends_with('0');
    let mut typed = sheet.rows[head + 1..].iter();
    let is_text = sheet.name.is_empty() || typed.any(|row| row.get(counts).is_some_and(is_typed));
    if !is_text {
        return;
    }
    let mut marks = CountMarks::default();
    let below = sheet.rows.iter_mut().skip(head + 1);
    let mut below: Vec<&mut Vec<String>> = below.collect();
    for row in &below {
        let number = |at: usize| {
            let text = row.get(at)?.as_str();
            (number_words(text) == [text]).then_some(text)
        };
        number(counts).into_iter().for_each(|text| marks.see(text));
        let elsewhere = others.iter().filter_map(|&at| number(at));
        elsewhere.for_each(|text| marks.see_elsewhere(text));
    }
    for text in below.iter_mut().filter_map(|row| row.get_mut(counts)) {
        let is_number = number_words(text) == [text.as_str()];
        if let Some(plain) = marks.plain(text).filter(|_| is_number) {
            *text = plain;
        }
    }
}

/// Whether a number below row `head` is written with a comma and nothing else.
pub(super) fn has_decimal_commas(sheet: &Sheet, head: usize) -> bool {
    let mut cells = sheet.rows.iter().skip(head + 1).flatten();
    cells.any(|text| {
        let marks = text.matches(['.', ',']).count();
        marks == 1 && text.contains(',') && number_words(text) == [text.as_str()]
    })
}

/// A number with a decimal point and without marks between its thousands.
fn without_groups(text: &str, decimal: Decimal, cell: &str) -> Result<String> {
    let (mark, group, said) = match decimal {
        Decimal::Point => ('.', ',', "point"),
        Decimal::Comma => (',', '.', "comma"),
    };
    let whole = text.split(mark).next().unwrap_or_default();
    let groups = text.matches(group).count();
    let in_groups = in_thousands(whole.trim_start_matches(['+', '-']));
    if groups > 0 && !(in_groups && whole.matches(group).count() == groups) {
        return Err(ImportError(format!(
            "{cell}: `{text}` is no number with --decimal {said}: a `{group}` can only stand between thousands then"
        )));
    }
    Ok(text.replace(group, "").replace(mark, "."))
}

/// The one number of a header such as `250000 cycles` or `r = 26,5 mm`.
pub(super) fn header_number(text: &str, row: usize, column: usize) -> Result<f64> {
    let refuse = |why: &str| {
        let cell = cell_name(row, column);
        Err(ImportError(format!("{cell}: {why} in the header `{text}`")))
    };
    if is_date(text) {
        return Err(dated(text, row, column));
    }
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
            "{}: are the cycles `{word}` marked between thousands? {word}: {} Write them without marks",
            cell_name(row, column),
            both_readings(word)
        ))),
    }
}

/// The same of one cell or line of cycles. Where a point can only be a decimal one (`plain_decimals`) it is still none before a last zero: a
/// spreadsheet's own numbers have none there, and nobody counts 18 revolutions as `18.000`.
/// Beside a count whose decimals are certain (`0,15`) all have decimals.
pub(super) fn plain_count_of(sheet: &Sheet, text: &str, row: usize, column: usize) -> Result<()> {
    let below = sheet.rows.iter().filter_map(|cells| cells.get(column));
    if in_thousands(text) && below.map(String::as_str).any(has_certain_decimals) {
        return Ok(());
    }
    plain_count(text, row, column, sheet.plain_decimals)
}

/// The same of a cell by itself.
pub(super) fn plain_count(
    text: &str,
    row: usize,
    column: usize,
    plain_decimals: bool,
) -> Result<()> {
    let written = |word: &&str| in_thousands(word) && word.ends_with('0');
    if plain_decimals && !number_words(text).iter().any(written) {
        return Ok(());
    }
    plain_cycles(text, row, column)
}

/// Leaves blanks between thousands out of the header row `head` and the first column, and marks out of the header, where one number there with several
/// (`1.000.000`) tells what they are; or where they are commas and the values below have points as decimal marks.
pub(super) fn without_thousands(sheet: &mut Sheet, decimal: Option<Decimal>, head: usize) {
    let marked = |text: &String, least: usize| {
        let words = number_words(text).into_iter();
        let several = |word: &&str| in_thousands(word) && word.matches(['.', ',']).count() >= least;
        words.filter(several).map(str::to_owned).next()
    };
    counts_without_blanks(sheet, head, 0);
    // the numbers of a spreadsheet's cells say nothing of how its texts are written
    let is_text = sheet.name.is_empty() && decimal != Some(Decimal::Comma);
    let (above, below) = sheet.rows.split_at_mut(head + 1);
    let header = &mut above[head];
    for text in header.iter_mut().skip(1) {
        if let Some(plain) = without_blanks(text) {
            *text = plain;
        }
    }
    let numbers = || {
        below
            .iter()
            .flatten()
            .filter(|cell| number_words(cell) == [cell.as_str()])
    };
    let has = |mark: char| numbers().any(|cell| cell.contains(mark));
    let is_decimal = |word: &&str| word.contains(',') && !in_thousands(word);
    let decimals = header
        .iter()
        .any(|text| number_words(text).iter().any(is_decimal));
    let commas = is_text && has('.') && !has(',') && !decimals;
    let several = header.iter().any(|text| marked(text, 2).is_some());
    for text in header {
        let word = marked(text, 1).filter(|word| several || commas && !word.contains('.'));
        if let Some(word) = word {
            *text = text.replacen(&word, &word.replace(['.', ','], ""), 1);
        }
    }
}

/// A header's one number without blanks between its thousands, `after 40 000 revolutions`; None without any, and where a word before it may make
/// its first group another number: `stop 2 500 000`.
pub(super) fn without_blanks(text: &str) -> Option<String> {
    let words: Vec<&str> = text.split(' ').collect();
    let is_digits = |word: &str| !word.is_empty() && word.bytes().all(|b| b.is_ascii_digit());
    let first = words.iter().position(|word| is_digits(word))?;
    let groups = words[first..].iter().take_while(|word| is_digits(word));
    let count = groups.count();
    let number = words[first..first + count].join(".");
    let (before, behind) = (&words[..first], &words[first + count..]);
    let last = before.iter().flat_map(|word| names::words(word)).last();
    let counts_something = last.is_some_and(|word| {
        let names_other = names::column(&word).is_some_and(|column| column != "cycles");
        names_other || names::is_stop(&word) || counts::is_ordinal(&word)
    });
    let has_digit = |word: &&str| word.contains(|c: char| c.is_ascii_digit());
    let has_others = before.iter().chain(behind).any(has_digit);
    let joined = number.replace('.', "");
    (in_thousands(&number) && !counts_something && !has_others)
        .then(|| [before, &[joined.as_str()], behind].concat().join(" "))
}

/// Whether a header holds one number, blanks between its thousands or not.
pub(super) fn has_one_number(header: &str) -> bool {
    let plain = without_blanks(header);
    number_words(plain.as_deref().unwrap_or(header)).len() == 1
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
        if is_date(text) {
            return dated(text, row, column);
        }
        if text.starts_with(['<', '>', '\u{2264}', '\u{2265}']) {
            return ImportError(format!(
                "{}: `{text}` is a limit of detection, not a value: leave the cell empty; a value that is only known to lie below or above a limit is \
                 not used",
                cell_name(row, column)
            ));
        }
        ImportError(format!(
            "{}: `{text}` is not a number; {}",
            cell_name(row, column),
            not_a_number(text)
        ))
    })
}

/// What to do about a cell that should hold a number.
fn not_a_number(text: &str) -> &'static str {
    let is_number = |part: &str| pointed(part).parse::<f64>().is_ok();
    let has_unit = text.split_once(' ').is_some_and(|(number, unit)| {
        is_number(number) && unit.trim_start().starts_with(char::is_alphabetic)
    });
    let parts: Vec<&str> = text.split(['.', '/', '-']).collect();
    let is_full_day = parts.len() == 3 && parts.iter().all(|part| is_number(part));
    // 03.Dez, 3-Dec, 03.12.2025: days and months of spreadsheet programs
    let is_day = text
        .split_once(['.', '-', ' ', '/'])
        .is_some_and(|(day, month)| {
            (1..=2).contains(&day.len())
                && is_number(day)
                && month.trim_start().starts_with(char::is_alphabetic)
        });
    if has_unit {
        "write the unit into the header and the number alone into the cell"
    } else if is_day || is_full_day {
        "if the spreadsheet program made a date of it, format the column as numbers and enter the value again"
    } else {
        "leave cells without a value empty; where the header stands again within the table, delete that row"
    }
}

/// Whether a text is a date as those of spreadsheets are read (`2024-04-03`), or a time of a day.
pub(super) fn is_date(text: &str) -> bool {
    let (date, time) = text.split_once([' ', 'T']).unwrap_or((text, ""));
    let has_digits = |text: &str, separator: char, counts: &[usize]| {
        let parts: Vec<&str> = text.split(separator).collect();
        let fits = |(part, count): (&&str, &usize)| {
            part.len() == *count && part.bytes().all(|b| b.is_ascii_digit())
        };
        parts.len() == counts.len() && parts.iter().zip(counts).all(fits)
    };
    has_digits(date, '-', &[4, 2, 2]) || time.is_empty() && has_digits(date, ':', &[2, 2])
}

/// What is said of a date in the place of a number.
fn dated(text: &str, row: usize, column: usize) -> ImportError {
    ImportError(format!(
        "{}: `{text}` is a date or a time; a number is wanted here: give the cell the format of a number in the spreadsheet, look whether its number is the \
         one that was meant, or leave the cell empty",
        cell_name(row, column)
    ))
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
