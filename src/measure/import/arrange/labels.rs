//! What the rows above a header say of the whole table: `Run: A`, `Part | pinion`, `Revolutions of the pinion: 140000`.

use super::{has, is_curve, put_column, speeds, torques};
use crate::measure::import::columns::{Column, columns};
use crate::measure::import::numbers::{header_number, number_words, plain_count, without_blanks};
use crate::measure::import::{
    ImportError, Sheet, Titles, Wanted, cell_name, conditions_above, counts, units,
};
use crate::measure::{Subject, names};

type Result<T> = std::result::Result<T, ImportError>;

/// What may be said of a whole table; `time` is a running time in place of cycles.
const KEYS: [&str; 5] = ["test", "member", "cycles", "time", "tooth"];

/// One thing that a row says of the table.
struct Label {
    row: usize,
    /// The name as it is written.
    written: String,
    key: &'static str,
    /// The name of a column that says the same, and the text below it.
    column: String,
    text: String,
    /// Whether the row says it in passing, `Specimen: run A, gear`: a column of the table says it better.
    in_passing: bool,
}

impl Label {
    /// Its row, counted from 0, and what it says in words.
    fn obeyed(&self) -> (usize, String) {
        let words = format!(
            "row {}, `{}`: {} {}",
            self.row + 1,
            self.written,
            self.key,
            self.text
        );
        (self.row, words)
    }
}

/// Makes columns of what stands above the header, and of the cycles that the user states.
pub(super) fn as_columns(
    sheet: &mut Sheet,
    head: usize,
    wanted: &Wanted<'_>,
    said: &mut Vec<String>,
) -> Result<()> {
    let header = columns(&sheet.rows[head]);
    let has_cycles = has(&header, "cycles");
    let may_lack_cycles = is_curve(&header) || wanted.cycles.is_some();
    if !has(&header, "value") || !(has_cycles || may_lack_cycles) {
        return Ok(());
    }
    let mut labels = labels(sheet, head, &KEYS, wanted)?;
    if !has(&header, "test") {
        let above = labels.iter().find(|label| label.key == "test");
        let stated = wanted.one_test(sheet).ok().map(|(test, _)| test);
        let test = above.map(|label| label.text.clone()).or(stated);
        let member = labels.iter().find(|label| label.key == "member");
        let member = member
            .and_then(|label| names::member(&label.text))
            .or(wanted.member);
        conditions_above::agree(sheet, head, (test.as_deref(), member), wanted)?;
    }
    let is_said = |key: &str| labels.iter().any(|label| label.key == key);
    if let Some(cycles) = wanted.cycles {
        if has_cycles || is_said("cycles") || is_said("time") {
            return Err(says_cycles());
        }
        put_column(sheet, head, "cycles", &cycles.to_string());
    }
    let counts_cycles = has_cycles || wanted.cycles.is_some() || is_said("cycles");
    if !counts_cycles && !is_said("time") {
        refuse_unclear_time(sheet, head)?;
    }
    // beside cycles a running time says nothing more
    labels.retain(|label| label.key != "time" || !counts_cycles);
    let speeds: Vec<speeds::Stated> = (0..head).filter_map(|row| speed(sheet, row)).collect();
    for label in labels {
        let key = if label.key == "time" {
            "cycles"
        } else {
            label.key
        };
        let own = header.iter().find(|column| column.what.own() == Some(key));
        match own {
            Some(_) if label.in_passing => {}
            // a test may be said to last longer than until a checkpoint
            Some(_) if label.key == "cycles" => {}
            Some(column) => below_agrees(sheet, head, column, &label, wanted)?,
            None => {
                let (row, words) = label.obeyed();
                said.push(words);
                put_column(sheet, head, &label.column, &label.text);
                if !Titles::speak_of_values(&sheet.rows[row]) {
                    sheet.rows[row].clear();
                }
            }
        }
    }
    speeds::agree(sheet, head, &speeds, wanted, said)?;
    torques::agree(sheet, head, wanted, said)?;
    if speeds::are_needed(&columns(&sheet.rows[head])) {
        for speed in speeds {
            sheet.rows[speed.row].clear();
        }
    }
    Ok(())
}

/// Why `--cycles` cannot be obeyed.
pub(super) fn says_cycles() -> ImportError {
    ImportError(
        "--cycles is for a table that does not say after how many revolutions it was measured; this one does: leave it out".to_owned(),
    )
}

/// What the rows above a wide table say of it.
pub(in crate::measure::import) struct Above<'w> {
    pub(in crate::measure::import) test: Option<&'w str>,
    pub(in crate::measure::import) member: Option<Subject>,
    pub(in crate::measure::import) tooth: Option<String>,
    /// The rows that say it, counted from 0, and what they say in words.
    pub(in crate::measure::import) obeyed: Vec<(usize, String)>,
    /// The first row that is not above the table.
    pub(in crate::measure::import) head: usize,
}

/// The test, the member and the tooth that the rows above a wide table say, where nothing else does; refused where they contradict what is
/// stated.
pub(in crate::measure::import) fn stated_above<'w>(
    sheet: &Sheet,
    wanted: &'w Wanted<'_>,
) -> Result<Above<'w>> {
    if wanted.cycles.is_some() {
        return Err(says_cycles());
    }
    let numbers = |cells: &Vec<String>| {
        let plain = |cell: &&String| match wanted.test_in_header(cell) {
            // the id of a test may hold digits of its own: `Essai V1, 80000 tours`
            Some((_, rest)) => number_words(&rest).len() == 1,
            None => number_words(cell).len() == 1 && !cell.contains([':', '=']),
        };
        cells.iter().filter(plain).count()
    };
    let head = sheet.rows.iter().position(|cells| numbers(cells) > 1);
    // how long a whole test lasted may stand there too
    let keys = ["test", "member", "tooth"];
    let labels = labels(sheet, head.unwrap_or(0), &keys, wanted)?;
    let of = |key: &str| labels.iter().find(|label| label.key == key);
    let test = of("test").and_then(|label| wanted.test_of(&label.text));
    let member = of("member").and_then(|label| names::member(&label.text));
    let tooth = of("tooth").map(|label| label.text.clone());
    Ok(Above {
        test,
        member,
        tooth,
        obeyed: labels.iter().map(Label::obeyed).collect(),
        head: head.unwrap_or(0),
    })
}

/// The flank that a row above a header says.
///
/// # Errors
/// [`ImportError`] where two rows say two.
pub(in crate::measure::import) fn flank_above(
    sheet: &Sheet,
    head: usize,
) -> Result<Option<String>> {
    let said = (0..head).filter_map(|row| {
        let (name, text) = name_and_text(&sheet.rows[row])?;
        names::is_flank(&units::name_and_unit(&name).0).then_some((row, text))
    });
    let mut said = said.filter(|(_, text)| !text.is_empty());
    let Some((row, flank)) = said.next() else {
        return Ok(None);
    };
    match said.find(|(_, other)| names::folded(other) != names::folded(&flank)) {
        Some((other_row, other)) => Err(ImportError(format!(
            "row {} says flank {flank}, row {} {other}: take the wrong one out",
            row + 1,
            other_row + 1
        ))),
        None => Ok(Some(flank)),
    }
}

/// All labels of some keys above a header, each key once.
fn labels(
    sheet: &Sheet,
    head: usize,
    keys: &[&'static str],
    wanted: &Wanted<'_>,
) -> Result<Vec<Label>> {
    let mut labels: Vec<Label> = Vec::new();
    for row in 0..head {
        for label in said_by(sheet, row, keys, wanted)? {
            agreeing(&mut labels, label, sheet, wanted)?;
        }
    }
    Ok(labels)
}

/// Puts a label to the others, once.
///
/// # Errors
/// [`ImportError`] where it contradicts one of them, the user or the sheet's name.
fn agreeing(
    labels: &mut Vec<Label>,
    label: Label,
    sheet: &Sheet,
    wanted: &Wanted<'_>,
) -> Result<()> {
    let refused = |other: String| {
        Err(ImportError(format!(
            "row {}: `{}` says {} {}, {other}: take the wrong one out",
            label.row + 1,
            label.written,
            label.key,
            label.text
        )))
    };
    let before = labels.iter().find(|before| before.key == label.key);
    if let Some(before) = before {
        if before.text != label.text {
            return refused(format!("row {} says {}", before.row + 1, before.text));
        }
        return Ok(());
    }
    let stated = match label.key {
        "test" => [
            (wanted.test, "--test"),
            (wanted.test_named(&sheet.name), "the sheet's name"),
        ],
        "member" => [
            (wanted.member.map(Subject::name), "--member"),
            (
                names::one_member(&sheet.name).map(Subject::name),
                "the sheet's name",
            ),
        ],
        _ => [(None, ""), (None, "")],
    };
    for (other, whose) in stated {
        if let Some(other) = other.filter(|other| *other != label.text) {
            return refused(format!("{whose} says {other}"));
        }
    }
    labels.push(label);
    Ok(())
}

/// What a row says of the table, with what its words say in passing: of which test a title speaks, and of which member beside the test.
fn said_by(
    sheet: &Sheet,
    row: usize,
    keys: &[&'static str],
    wanted: &Wanted<'_>,
) -> Result<Vec<Label>> {
    let words = filled(&sheet.rows[row]).join(" ");
    let in_passing = |key: &'static str, text: &str| Label {
        row,
        written: words.clone(),
        key,
        column: key.to_owned(),
        text: text.to_owned(),
        in_passing: true,
    };
    let mut said: Vec<Label> = label(sheet, row, keys, wanted)?.into_iter().collect();
    if said.is_empty() && keys.contains(&"test") {
        let test = wanted.test_in_title(&words);
        said.extend(test.map(|test| in_passing("test", test)));
    }
    if said.iter().any(|label| label.key == "test") && keys.contains(&"member") {
        let member = names::one_member(&words);
        said.extend(member.map(|member| in_passing("member", member.name())));
    }
    if said.iter().all(|label| label.key != "cycles") && keys.contains(&"cycles") {
        let count = count_in_title(&words, row, wanted)?;
        said.extend(count.map(|(column, count)| Label {
            column: column.to_owned(),
            ..in_passing("cycles", &count.to_string())
        }));
    }
    Ok(said)
}

/// The revolutions of which a title speaks between its commas, `Run A, 800000 cycles, 12 March`, and the name of their column.
fn count_in_title(
    title: &str,
    row: usize,
    wanted: &Wanted<'_>,
) -> Result<Option<(&'static str, f64)>> {
    let parts = title
        .split([';', '/', '|'])
        .flat_map(|part| part.split(", "));
    for part in parts {
        let joined = without_blanks(part);
        let part = joined.as_deref().unwrap_or(part);
        let says_revolutions = || {
            let words = names::words(part);
            words.iter().any(|word| names::revolutions(word).is_some())
        };
        let [number] = number_words(part)[..] else {
            continue;
        };
        let is_count = counts::refuse_others(part, number, None, row, 0).is_ok();
        let Some(count) = header_number(part, row, 0).ok().filter(|_| is_count) else {
            continue;
        };
        if !says_revolutions() {
            continue;
        }
        if wanted.decimal.is_none() {
            plain_count(part, row, 0, false)?;
        }
        let of_gear = names::counts_gear_revolutions(part);
        return Ok(Some((
            if of_gear { "cycles (gear)" } else { "cycles" },
            count,
        )));
    }
    Ok(None)
}

/// What a row says of the table; none for other rows.
fn label(
    sheet: &Sheet,
    row: usize,
    keys: &[&'static str],
    wanted: &Wanted<'_>,
) -> Result<Option<Label>> {
    let Some((name, text)) = name_and_text(&sheet.rows[row]) else {
        return Ok(None);
    };
    let name = name.as_str();
    let column = Column::of(0, name);
    let is_time = column.hours.is_some() || names::is_time(&column.name());
    if is_time && keys.contains(&"time") {
        return Ok(time(name, &column, &text).map(|(column, text)| Label {
            row,
            written: name.to_owned(),
            key: "time",
            column,
            text,
            in_passing: false,
        }));
    }
    let key = column.what.own().filter(|own| keys.contains(own));
    let Some(key) = key.filter(|_| !text.is_empty()) else {
        return Ok(None);
    };
    let label = |column: String, text: String| {
        Ok(Some(Label {
            row,
            written: name.to_owned(),
            key,
            column,
            text,
            in_passing: false,
        }))
    };
    match key {
        "test" => match (wanted.test_of(&text))
            .or_else(|| wanted.test_named(&text))
            // `Run A: pinion`
            .or_else(|| wanted.test_in_title(&format!("{name}: {text}")))
        {
            Some(id) => label(name.to_owned(), id.to_owned()),
            // a title, where the test is stated
            None if wanted.test.is_some() || filled(&sheet.rows[row]).len() > 2 => Ok(None),
            None => Err(ImportError(format!(
                "{}: `{name}` says {text}: {}",
                cell_name(row, 0),
                wanted.no_test(&text)
            ))),
        },
        "member" => match names::one_member(&text) {
            Some(member) => label(name.to_owned(), member.name().to_owned()),
            None => Ok(None),
        },
        // `1, 8, 15` are the teeth of a mean
        "tooth" if text.contains([' ', ',', ';', '-']) => Ok(None),
        "tooth" => label(name.to_owned(), text),
        _ if number_words(&text).is_empty() => Ok(None),
        _ => {
            let count = header_number(&text, row, 0)?;
            counts::refuse_others(&text, number_words(&text)[0], None, row, 0)?;
            if wanted.decimal.is_none() {
                plain_count(&text, row, 0, sheet.plain_decimals)?;
            }
            let is_of_gear = names::one_member(&text) == Some(Subject::Gear);
            let name = if is_of_gear && !column.of_gear {
                "cycles (gear)"
            } else {
                name
            };
            label(name.to_owned(), count.to_string())
        }
    }
}

/// The cells of a row that hold something.
fn filled(cells: &[String]) -> Vec<&str> {
    let cells = cells.iter().map(|cell| cell.trim());
    cells.filter(|cell| !cell.is_empty()).collect()
}

/// A row's first words up to a colon or the end of their cell, and the text behind them.
fn name_and_text(cells: &[String]) -> Option<(String, String)> {
    let filled = filled(cells);
    let (first, rest) = filled.split_first()?;
    let (name, behind) = match first.split_once([':', '=']) {
        Some((name, text)) => (name.trim(), text.trim()),
        None => (*first, ""),
    };
    let parts = std::iter::once(behind).chain(rest.iter().copied());
    let parts: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
    Some((name.to_owned(), parts.join(" ")))
}

/// The name of a column of a running time and the number below it, of a line that states it with a unit, in its name or behind its one number.
fn time(name: &str, column: &Column, text: &str) -> Option<(String, String)> {
    let [number] = number_words(text)[..] else {
        return None;
    };
    let (before, behind) = text.split_once(number)?;
    let behind = behind.trim().trim_matches(['[', ']', '(', ')', '.']);
    if !before.trim().is_empty() {
        return None;
    }
    match (column.hours, names::hours_of_unit(behind)) {
        (Some(_), None) if behind.is_empty() => Some((name.to_owned(), number.to_owned())),
        (Some(hours), Some(stated)) if hours == stated => {
            Some((name.to_owned(), number.to_owned()))
        }
        (None, Some(_)) => Some((format!("{name} [{behind}]"), number.to_owned())),
        _ => None,
    }
}

/// Names the line of a running time that is not understood, where nothing else says after how many revolutions a curve was measured.
fn refuse_unclear_time(sheet: &Sheet, head: usize) -> Result<()> {
    for row in 0..head {
        let Some((name, text)) = name_and_text(&sheet.rows[row]) else {
            continue;
        };
        let column = Column::of(0, &name);
        let is_time = column.hours.is_some() || names::is_time(&column.name());
        // a time of day is none
        let is_clock = text.contains(':');
        if is_time && !text.is_empty() && !is_clock && time(&name, &column, &text).is_none() {
            return Err(ImportError(format!(
                "row {}: `{name}` says `{text}`: write the running time as one number with a unit of h, min, s or d (`{name}: 8.333 h`), or the \
                 revolutions (`cycles: 1000000`)",
                row + 1
            )));
        }
    }
    Ok(())
}

/// The speed that a row states.
fn speed(sheet: &Sheet, row: usize) -> Option<speeds::Stated> {
    let (name, text) = name_and_text(&sheet.rows[row])?;
    speeds::stated(row, &name, &text)
}

/// Refuses a label that a cell of the column of the same contradicts.
fn below_agrees(
    sheet: &Sheet,
    head: usize,
    column: &Column,
    label: &Label,
    wanted: &Wanted<'_>,
) -> Result<()> {
    for (row, cells) in sheet.rows.iter().enumerate().skip(head + 1) {
        let cell = cells.get(column.at).map_or("", String::as_str);
        let says = match label.key {
            "test" => wanted.test_of(cell),
            "tooth" => Some(cell).filter(|cell| !cell.is_empty()),
            _ => names::member(cell).map(Subject::name),
        };
        if let Some(says) = says.filter(|says| *says != label.text) {
            return Err(ImportError(format!(
                "row {}: `{}` says {} {}, {} says {says}: take the wrong one out",
                label.row + 1,
                label.written,
                label.key,
                label.text,
                cell_name(row, column.at)
            )));
        }
    }
    Ok(())
}
