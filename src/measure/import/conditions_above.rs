//! Rows above a header that state gears or the conditions of the test, `Module: 2.5`, `Torque [Nm] | 170`: where these are not the study's, the table is of
//! another test or of other gears.

use super::arrange::{refuse_another_speed, refuse_another_torque};
use super::numbers::pointed;
use super::wanted::Wanted;
use super::{ImportError, Sheet, units};
use crate::measure::{Subject, names};

type Result<T> = std::result::Result<T, ImportError>;

/// Part of a module by which a stated one may differ from the study's: a rounded number.
const SAME_MODULE: f64 = 0.005;
/// Names of what only its unit says.
const SPEED: &str = "speed";
const TORQUE: &str = "torque";

/// Refuses rows above `head` that state another module or other numbers of teeth than the study's, or another torque or speed than those of the one
/// `test` that the table is of, or the teeth of the one `member`; the rows that state something so compared.
pub(super) fn agree(
    sheet: &Sheet,
    head: usize,
    (test, member): (Option<&str>, Option<Subject>),
    wanted: &Wanted<'_>,
) -> Result<Vec<usize>> {
    let mut compared = Vec::new();
    for (row, cells) in sheet.rows.iter().enumerate().take(head) {
        for stated in statements(cells) {
            let place = format!("row {}: `{}`", row + 1, stated.written);
            let mut is_known = refuse_another_module(&stated, &place, wanted)?;
            is_known |= refuse_other_teeth(&stated, &place, member, wanted)?;
            if let Some(test) = test {
                let unit = stated.unit.as_deref();
                let number = stated.number.as_str();
                // letters and short words mean other things too
                let usual = |name: &str| (name.len() > 3).then_some("Nm");
                let torque = |name: &str| names::torque(name, unit.or_else(|| usual(name)));
                if let Some(of) = stated.means(torque) {
                    refuse_another_torque((number, unit, of), test, &place, wanted)?;
                    is_known = true;
                }
                if let Some(of) = stated.means(|name| names::speed(name, unit)) {
                    refuse_another_speed((number, of), test, &place, wanted)?;
                    is_known = true;
                }
            }
            compared.extend(is_known.then_some(row));
        }
    }
    Ok(compared)
}

/// A name with one number and its unit.
#[derive(Debug, PartialEq)]
struct Statement {
    written: String,
    /// Without what stands in brackets.
    name: String,
    number: String,
    unit: Option<String>,
    /// Whether the table names it; its unit alone may say what it is.
    is_named: bool,
}

impl Statement {
    /// What the longest end of its name means, `test torque` of `the test torque`.
    fn means<T>(&self, of: impl Fn(&str) -> Option<T>) -> Option<T> {
        let words: Vec<&str> = self.name.split_whitespace().collect();
        (0..words.len()).find_map(|from| of(&words[from..].join(" ")))
    }

    fn value(&self) -> Option<f64> {
        pointed(&self.number).parse().ok()
    }
}

/// What the cells of a row state, in one cell (`z = 27, m = 2`) or a name and a number side by side.
fn statements(cells: &[String]) -> Vec<Statement> {
    let filled = cells.iter().map(|cell| cell.trim());
    let filled: Vec<&str> = filled.filter(|cell| !cell.is_empty()).collect();
    let begins_with_digit = |cell: &&&str| cell.starts_with(|c: char| c.is_ascii_digit());
    let mut stated = Vec::new();
    for (at, cell) in filled.iter().enumerate() {
        let parts: Vec<&str> = (cell.split([';', '|']))
            .flat_map(|part| part.split(", "))
            .collect();
        // a number that stands alone in its cell belongs to what stands in others
        let is_among_others = parts.len() > 1;
        let all = parts.iter().filter_map(|part| in_one(part));
        stated.extend(all.filter(|one| is_among_others || one.is_named));
        let beside = filled.get(at + 1).filter(begins_with_digit);
        // several numbers behind a name are a list
        let is_list = filled
            .get(at + 2)
            .is_some_and(|next| begins_with_digit(&next));
        if let (Some(name), Some(value), false) = (parts.last(), beside, is_list) {
            stated.extend(statement(name, value).filter(|one| one.is_named));
        }
    }
    // several without a name may be those of several tests
    for name in [SPEED, TORQUE] {
        let is_it = |one: &Statement| !one.is_named && one.name == name;
        if stated.iter().filter(|one| is_it(one)).count() > 1 {
            stated.retain(|one| !is_it(one));
        }
    }
    stated
}

/// What a number without a name is by its unit: `2800 rpm`, `25 Nm`.
fn named_by_unit(unit: &str) -> Option<&'static str> {
    if names::speed(SPEED, Some(unit)).is_some() {
        Some(SPEED)
    } else {
        names::newton_metres(unit).map(|_| TORQUE)
    }
}

/// A name and a number with a colon or a sign of equality between them, or words before a number with a unit.
fn in_one(part: &str) -> Option<Statement> {
    if let Some((name, value)) = part.split_once([':', '=']) {
        return statement(name, value);
    }
    let mut before = ' ';
    let (at, _) = part.char_indices().find(|&(_, c)| {
        let is_first = c.is_ascii_digit() && before == ' ';
        before = c;
        is_first
    })?;
    statement(&part[..at], &part[at..]).filter(|stated| stated.unit.is_some())
}

/// Of a name and a text that is one number with or without a unit.
fn statement(name: &str, value: &str) -> Option<Statement> {
    let (name, value) = (name.trim().trim_end_matches([':', '=']), value.trim());
    let is_part = |c: char| c.is_ascii_digit() || ['.', ','].contains(&c);
    let end = value.find(|c| !is_part(c)).unwrap_or(value.len());
    let (number, behind) = value.split_at(end);
    let (plain, unit) = units::name_and_unit(name);
    let has_digit = |text: &str| text.contains(|c: char| c.is_ascii_digit());
    let behind = behind.trim().trim_matches(['[', ']', '(', ')']);
    let is_unit = behind.is_empty()
        || behind == "1/min"
        || !has_digit(behind) && behind.starts_with(char::is_alphabetic);
    let is_named = plain.contains(char::is_alphabetic);
    let own = match name {
        "" => named_by_unit(behind)?.to_owned(),
        _ if is_named => plain,
        _ => return None,
    };
    (has_digit(number) && is_unit).then(|| Statement {
        is_named,
        written: match is_named {
            true => format!("{}: {value}", name.trim()),
            false => value.to_owned(),
        },
        name: own,
        number: number.to_owned(),
        unit: unit.or_else(|| Some(behind.to_owned()).filter(|unit| !unit.is_empty())),
    })
}

fn refuse_another_module(stated: &Statement, place: &str, wanted: &Wanted<'_>) -> Result<bool> {
    let is_in_mm = stated.unit.as_deref().is_none_or(|unit| unit == "mm");
    let means_it = |name: &str| names::is_module(name).then_some(());
    let (true, Some(()), Some(module)) = (is_in_mm, stated.means(means_it), stated.value()) else {
        return Ok(false);
    };
    let [pinion, _] = wanted.gears;
    let transverse = pinion.rack.module;
    // a helical gear may be told by either section
    let normal = transverse * pinion.helix_angle.cos();
    let is = |own: f64| (module - own).abs() <= SAME_MODULE * own;
    if is(transverse) || is(normal) {
        return Ok(true);
    }
    Err(ImportError(format!(
        "{place} is another module than the study's, {normal} mm: is the table of other gears? Correct the one that is wrong, or take the row out"
    )))
}

fn refuse_other_teeth(
    stated: &Statement,
    place: &str,
    member: Option<Subject>,
    wanted: &Wanted<'_>,
) -> Result<bool> {
    let means_them = |name: &str| names::is_number_of_teeth(name).then_some(());
    let (None, Some(()), Some(teeth)) = (&stated.unit, stated.means(means_them), stated.value())
    else {
        return Ok(false);
    };
    let own = wanted.gears.map(|gear| gear.spec.teeth);
    // a line about the mate names it
    let member = names::one_member(&stated.name).or(member);
    let of_member = member.and_then(|member| Some(wanted.gear_of(member)?.spec.teeth));
    let is = |own: u32| f64::from(own) == teeth;
    if of_member.is_some_and(is) || own.into_iter().any(is) && of_member.is_none() {
        return Ok(true);
    }
    let [pinion, gear] = own;
    if let Some(member) = member.filter(|_| own.into_iter().any(is)) {
        return Err(ImportError(format!(
            "{place}: the study's pinion has {pinion} teeth, its gear {gear}, and the table is of the {}: is it the other member's? Correct what is wrong, or \
             take the row out",
            member.name()
        )));
    }
    Err(ImportError(format!(
        "{place}: the study's gears have {pinion} and {gear} teeth: is the table of other gears? Correct the one that is wrong, or take the row out"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_state_names_with_one_number() {
        let stated = |row: &str| -> Vec<(String, String, Option<String>)> {
            let cells: Vec<String> = row.split('\t').map(str::to_owned).collect();
            let stated = statements(&cells).into_iter();
            stated
                .map(|stated| (stated.name, stated.number, stated.unit))
                .collect()
        };
        let one = |name: &str, number: &str, unit: Option<&str>| {
            (name.to_owned(), number.to_owned(), unit.map(str::to_owned))
        };
        assert_eq!(
            stated("Test A, z = 27, m = 2, torque 100 Nm"),
            [
                one("z", "27", None),
                one("m", "2", None),
                one("torque", "100", Some("Nm"))
            ]
        );
        assert_eq!(
            stated("Test V2, 2800 rpm, 25 Nm, 80 min"),
            [
                one("speed", "2800", Some("rpm")),
                one("torque", "25", Some("Nm"))
            ]
        );
        assert_eq!(stated("V1: 25 Nm, V2, 40 Nm, 50 Nm").len(), 1);
        assert_eq!(
            stated("Drehmoment [Nm]\t170\tDrehzahl\t2000 1/min"),
            [
                one("Drehmoment", "170", Some("Nm")),
                one("Drehzahl", "2000", Some("1/min"))
            ]
        );
        for none in [
            "z1/z2 = 27/53",
            "Teeth\t1\t8\t15",
            "Report 4711",
            "T = 100-120 Nm",
        ] {
            assert_eq!(stated(none), [], "{none}");
        }
    }
}
