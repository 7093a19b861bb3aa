//! A row for each member with a column for each checkpoint, and one for the standard deviation beside each of them if it is stated:
//! `Test | Member | 60000 cycles | sd | 300000 cycles | sd`.

use super::arrange::merged;
use super::columns::{Column, What, columns, holds_only};
use super::numbers::{number_words, without_blanks};
use super::units::name_and_unit;
use super::{Sheet, row_sigmas};
use crate::measure::Quantity;
use crate::measure::names::{self, When};
use crate::measure::thousands::in_thousands;

/// The column of a checkpoint.
struct Checkpoint {
    at: usize,
    /// Its revolutions, as they are written.
    cycles: String,
    /// What its values are, if its header says so.
    value: Option<String>,
    unit: Option<String>,
}

/// The same with a row for each value, of the quantity that a row above or the headers say or that is `asked` for; none for other sheets, and where nothing
/// says what the values are.
pub fn checkpoints_across(sheet: &Sheet, asked: Option<Quantity>) -> Option<Sheet> {
    let (head, checkpoints) = (sheet.rows.iter().enumerate())
        .find_map(|(row, cells)| Some((row, checkpoints(cells)?)))?;
    let header = &sheet.rows[head];
    let is_sigma = |at: usize| header.get(at).is_some_and(|cell| row_sigmas::is_one(cell));
    let with_sigma = checkpoints
        .iter()
        .all(|checkpoint| is_sigma(checkpoint.at + 1));
    let is_own = |at: usize| {
        let mut all = checkpoints.iter();
        all.any(|checkpoint| at == checkpoint.at || with_sigma && at == checkpoint.at + 1)
    };
    let known = columns(header);
    let others: Vec<_> = (known.iter()).filter(|column| !is_own(column.at)).collect();
    let names_members = |column: &Column| match column.what {
        What::Own(own) => own == "member",
        What::Unknown => holds_only(sheet, head, column.at, |text| names::member(text).is_some()),
        _ => false,
    };
    let says_whose = |column: &Column| {
        let is_beside = matches!(
            column.what,
            What::Own("test") | What::ForPeople | What::Nameless
        );
        is_beside || names_members(column)
    };
    let has_members = others.iter().any(|column| names_members(column));
    if !has_members || !others.iter().all(|column| says_whose(column)) {
        return None;
    }
    let value = value(&sheet.rows[..head], &checkpoints, asked)?;
    let filled = merged::with_tests_filled(sheet, head);
    let cell = |cells: &[String], at: usize| cells.get(at).cloned().unwrap_or_default();
    let whose = |cells: &[String]| -> Vec<String> {
        others.iter().map(|column| cell(cells, column.at)).collect()
    };
    let sigma_of = |cells: &[String], at: usize| with_sigma.then(|| cell(cells, at + 1));
    let mut rows: Vec<Vec<String>> = sheet.rows[..head].to_vec();
    let mut named = whose(header);
    named.extend(["cycles".to_owned(), value]);
    named.extend(sigma_of(header, checkpoints[0].at));
    rows.push(named);
    for cells in &filled.rows[head + 1..] {
        for checkpoint in &checkpoints {
            let own = cell(cells, checkpoint.at);
            if !own.is_empty() {
                let mut row = whose(cells);
                row.extend([checkpoint.cycles.clone(), own]);
                row.extend(sigma_of(cells, checkpoint.at));
                rows.push(row);
            }
        }
    }
    Some(Sheet { rows, ..filled })
}

/// The name of the values' column: what a row above the header says they are, or the headers themselves, or else what is asked for, with the unit of the headers.
fn value(
    above: &[Vec<String>],
    checkpoints: &[Checkpoint],
    asked: Option<Quantity>,
) -> Option<String> {
    let is_title = |cells: &&Vec<String>| cells.iter().filter(|c| !c.is_empty()).count() == 1;
    let titles = above.iter().filter(is_title).flatten();
    let mut named = titles.filter(|title| is_of_values(title));
    let own = checkpoints[0].value.clone();
    let name = (named.next().cloned())
        .or(own)
        .or_else(|| Some(asked?.name().to_owned()))?;
    let unit = &checkpoints[0].unit;
    let is_same = |checkpoint: &Checkpoint| checkpoint.unit == *unit;
    match (name_and_unit(&name).1, unit) {
        (_, None) => Some(name),
        (None, Some(unit)) => Some(format!("{name} [{unit}]")),
        (Some(stated), Some(unit)) => (stated == *unit).then_some(name),
    }
    .filter(|_| checkpoints.iter().all(is_same))
}

/// Whether a header, or a title, names the values of a quantity.
fn is_of_values(written: &str) -> bool {
    matches!(columns(&[written.to_owned()])[0].what, What::Values(_))
}

/// The columns of checkpoints in a header; none where there are not several.
fn checkpoints(cells: &[String]) -> Option<Vec<Checkpoint>> {
    let all = (0..cells.len()).filter_map(|at| Checkpoint::of(at, &cells[at]));
    let all: Vec<Checkpoint> = all.collect();
    (all.len() > 1).then_some(all)
}

impl Checkpoint {
    /// Of a header that counts revolutions, and says what its values are or nothing else; none for others.
    fn of(at: usize, header: &str) -> Option<Self> {
        let (name, unit) = name_and_unit(header);
        let name = without_blanks(&name).unwrap_or(name);
        let (cycles, rest) = count_and_rest(&name)?;
        let words = names::words(&name.replacen(&cycles, " ", 1));
        // no part of a revolution is counted
        let cycles = match in_thousands(&cycles) {
            true => cycles.replace(['.', ','], ""),
            false => cycles,
        };
        let value = Some(rest.join(" ")).filter(|rest| !rest.is_empty());
        let says_what = value.as_ref().is_none_or(|rest| is_of_values(rest));
        // a number without a word for revolutions is none
        (says_what && rest.len() < words.len()).then_some(Self {
            at,
            cycles,
            value,
            unit,
        })
    }
}

/// The one number of a header, as it is written, and its words but those that say that it counts revolutions, or that something was after them.
pub(super) fn count_and_rest(name: &str) -> Option<(String, Vec<String>)> {
    let [count] = number_words(name)[..] else {
        return None;
    };
    let says_when = |word: &String| {
        names::revolutions(word).is_some() || names::time_alone(word) == Some(When::After)
    };
    let mut rest = names::words(&name.replacen(count, " ", 1));
    rest.retain(|word| !says_when(word));
    Some((count.to_owned(), rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_checkpoint_of_a_member_becomes_a_row() {
        let titled = Sheet::of_rows(&[
            "Massenverlust [mg]",
            "Versuch|Rad|60 000 LW|300.000 LW",
            "V1|Ritzel|12.3|44.1",
            "V1|Rad|6.3|",
        ]);
        let long = checkpoints_across(&titled, None).unwrap();
        assert_eq!(
            long.rows[1],
            ["Versuch", "Rad", "cycles", "Massenverlust [mg]"]
        );
        assert_eq!(long.rows[2], ["V1", "Ritzel", "60000", "12.3"]);
        assert_eq!(long.rows[3], ["V1", "Ritzel", "300000", "44.1"]);
        assert_eq!(long.rows[4], ["V1", "Rad", "60000", "6.3"]);
        assert_eq!(long.rows.len(), 5);
        // the second member's cell below the test's is merged with it
        let merged = Sheet::of_rows(&[
            "Massenverlust [mg]",
            "Versuch|Rad|60 000 LW|300.000 LW",
            "V1|Ritzel|12.3|44.1",
            "|Kunststoffrad|6.3|20.1",
            "V2|Ritzel|13.3|45.1",
            "|Kunststoffrad|7.3|21.1",
        ]);
        let long = checkpoints_across(&merged, None).unwrap();
        assert_eq!(long.rows[4], ["V1", "Kunststoffrad", "60000", "6.3"]);
        assert_eq!(long.rows[9], ["V2", "Kunststoffrad", "300000", "21.1"]);
        assert_eq!(
            long.said,
            ["`Versuch`: empty cells hold the value above them"]
        );
        // the headers say what the values are, and each has its sigma beside it
        let own = Sheet::of_rows(&[
            "Prova|Elemento|Perdita 60000 cicli [g]|sd [mg]|Perdita 300000 cicli [g]|sd [mg]",
            "V1|pignone|0,0123|0,5|0,0441|0,6",
            "V1|ruota||0,5|0,0402|0,6",
        ]);
        let long = checkpoints_across(&own, None).unwrap();
        assert_eq!(
            long.rows[0],
            ["Prova", "Elemento", "cycles", "perdita [g]", "sd [mg]"]
        );
        assert_eq!(long.rows[2], ["V1", "pignone", "300000", "0,0441", "0,6"]);
        assert_eq!(long.rows.len(), 4);
        // without a title the user says what the values are
        let untitled = Sheet::of_rows(&["Test|Member|after 6e4|after 3e5", "A|gear|1|2"]);
        assert!(checkpoints_across(&untitled, None).is_none());
        let masses = Some(Quantity::MassLoss);
        let long = checkpoints_across(&untitled, masses).unwrap();
        assert_eq!(long.rows[0], ["Test", "Member", "cycles", "mass_loss"]);
        // rows of places, another column of values, no member, one checkpoint
        for other in [
            "Radius [mm]|60000 cycles|300000 cycles",
            "Member|Radius [mm]|60000 cycles|300000 cycles",
            "Member|Mass loss [mg]|60000 cycles|300000 cycles",
            "Test|60000 cycles|300000 cycles",
            "Test|Member|60000 cycles",
            "Test|Member|60 000|300 000",
        ] {
            let sheet = Sheet::of_rows(&[other, "1|2|3|4"]);
            assert!(checkpoints_across(&sheet, masses).is_none(), "{other}");
        }
    }
}
