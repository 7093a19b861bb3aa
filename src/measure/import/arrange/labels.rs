//! What the rows above a header say of the whole table: `Run: A`, `Part | pinion`, `Revolutions of the pinion: 140000`.

use super::{has, is_curve, put_column};
use crate::measure::import::columns::{Column, columns};
use crate::measure::import::numbers::{header_number, number_words, plain_count};
use crate::measure::import::{ImportError, Sheet, Wanted, cell_name};
use crate::measure::{Subject, names};

type Result<T> = std::result::Result<T, ImportError>;

/// What may be said of a whole table.
const KEYS: [&str; 3] = ["test", "member", "cycles"];

/// One thing that a row says of the table.
struct Label {
    row: usize,
    /// The name as it is written.
    written: String,
    key: &'static str,
    /// The name of a column that says the same, and the text below it.
    column: String,
    text: String,
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
    let labels = labels(sheet, head, &KEYS, wanted)?;
    if let Some(cycles) = wanted.cycles {
        if has_cycles || labels.iter().any(|label| label.key == "cycles") {
            return Err(says_cycles());
        }
        put_column(sheet, head, "cycles", &cycles.to_string());
    }
    for label in labels {
        let own = header
            .iter()
            .find(|column| column.what.own() == Some(label.key));
        match own {
            // a test may be said to last longer than until a checkpoint
            Some(_) if label.key == "cycles" => {}
            Some(column) => below_agrees(sheet, head, column, &label, wanted)?,
            None => {
                let Label {
                    row,
                    written,
                    key,
                    text,
                    ..
                } = &label;
                said.push(format!("row {}, `{written}`: {key} {text}", row + 1));
                put_column(sheet, head, &label.column, text);
                sheet.rows[*row].clear();
            }
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

/// The test and the member that the rows above a wide table say, where nothing else does; refused where they contradict what is stated.
pub(in crate::measure::import) fn stated_above<'w>(
    sheet: &Sheet,
    wanted: &'w Wanted<'_>,
) -> Result<(Option<&'w str>, Option<Subject>)> {
    if wanted.cycles.is_some() {
        return Err(says_cycles());
    }
    let numbers = |cells: &Vec<String>| {
        let plain = |cell: &&String| number_words(cell).len() == 1 && !cell.contains([':', '=']);
        cells.iter().filter(plain).count()
    };
    let head = sheet.rows.iter().position(|cells| numbers(cells) > 1);
    // how long a whole test lasted may stand there too
    let labels = labels(sheet, head.unwrap_or(0), &["test", "member"], wanted)?;
    let of = |key: &str| labels.iter().find(|label| label.key == key);
    let test = of("test").and_then(|label| wanted.test_of(&label.text));
    let member = of("member").and_then(|label| names::member(&label.text));
    Ok((test, member))
}

/// All labels of some keys above a header, each key once.
fn labels(sheet: &Sheet, head: usize, keys: &[&str], wanted: &Wanted<'_>) -> Result<Vec<Label>> {
    let mut labels: Vec<Label> = Vec::new();
    for row in 0..head {
        let Some(label) = label(sheet, row, keys, wanted)? else {
            continue;
        };
        let refused = |other: String| {
            Err(ImportError(format!(
                "row {}: `{}` says {} {}, {other}: take the wrong one out",
                row + 1,
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
            continue;
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
    }
    Ok(labels)
}

/// What a row says of the table; none for other rows.
fn label(sheet: &Sheet, row: usize, keys: &[&str], wanted: &Wanted<'_>) -> Result<Option<Label>> {
    let cells = &sheet.rows[row];
    let filled: Vec<&str> = cells
        .iter()
        .map(|cell| cell.trim())
        .filter(|cell| !cell.is_empty())
        .collect();
    let Some((first, rest)) = filled.split_first() else {
        return Ok(None);
    };
    let (name, behind) = match first.split_once([':', '=']) {
        Some((name, text)) => (name.trim(), text.trim()),
        None => (*first, ""),
    };
    let parts: Vec<&str> = std::iter::once(behind)
        .chain(rest.iter().copied())
        .filter(|part| !part.is_empty())
        .collect();
    let text = parts.join(" ");
    let column = Column::of(0, name);
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
        }))
    };
    match key {
        "test" => match wanted.test_of(&text).or_else(|| wanted.test_named(&text)) {
            Some(id) => label(name.to_owned(), id.to_owned()),
            // a title, where the test is stated
            None if wanted.test.is_some() || parts.len() > 1 => Ok(None),
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
        _ if number_words(&text).is_empty() => Ok(None),
        _ => {
            let count = header_number(&text, row, 0)?;
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
