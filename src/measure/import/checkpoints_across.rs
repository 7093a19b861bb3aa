//! A row for each member with a column for each checkpoint: `Test | Member | 60000 cycles | 300000 cycles`.

use super::Sheet;
use super::columns::{What, columns};
use super::numbers::number_words;
use super::units::name_and_unit;
use crate::measure::Quantity;
use crate::measure::names::{self, When};

/// The same with a row for each value, of the quantity that a row above says or that is `asked` for; none for other sheets, and where nothing says what the values are.
pub fn checkpoints_across(sheet: &Sheet, asked: Option<Quantity>) -> Option<Sheet> {
    let (head, checkpoints) = (sheet.rows.iter().enumerate())
        .find_map(|(row, cells)| Some((row, checkpoints(cells)?)))?;
    let header = &sheet.rows[head];
    let is_checkpoint = |at: usize| checkpoints.iter().any(|(column, _)| *column == at);
    let known = columns(header);
    let others: Vec<_> = (known.iter())
        .filter(|column| !is_checkpoint(column.at))
        .collect();
    let names_members = (others.iter()).any(|column| column.what.own() == Some("member"));
    let says_whose = |what: What| {
        let own = what.own();
        own == Some("test") || own == Some("member") || matches!(what, What::ForPeople)
    };
    if !names_members || !others.iter().all(|column| says_whose(column.what)) {
        return None;
    }
    let value = value(&sheet.rows[..head], asked)?;
    let whose = |cells: &[String]| -> Vec<String> {
        let cell = |at: usize| cells.get(at).cloned().unwrap_or_default();
        others.iter().map(|column| cell(column.at)).collect()
    };
    let mut rows: Vec<Vec<String>> = sheet.rows[..head].to_vec();
    rows.push([whose(header), vec!["cycles".to_owned(), value]].concat());
    for cells in &sheet.rows[head + 1..] {
        for (column, cycles) in &checkpoints {
            if let Some(cell) = cells.get(*column).filter(|cell| !cell.is_empty()) {
                rows.push([whose(cells), vec![cycles.clone(), cell.clone()]].concat());
            }
        }
    }
    Some(Sheet {
        rows,
        ..sheet.clone()
    })
}

/// The name of the values' column: what a row above the header says they are, or else what is asked for.
fn value(above: &[Vec<String>], asked: Option<Quantity>) -> Option<String> {
    let is_title = |cells: &&Vec<String>| cells.iter().filter(|c| !c.is_empty()).count() == 1;
    let titles = above.iter().filter(is_title).flatten();
    let mut named = titles.filter(|title| {
        let columns = columns(std::slice::from_ref(*title));
        matches!(columns[0].what, What::Values(_))
    });
    let asked = asked.map(|quantity| quantity.name().to_owned());
    named.next().cloned().or(asked)
}

/// The columns of checkpoints in a header with the revolutions of each, as they are written; none where there are not several.
fn checkpoints(cells: &[String]) -> Option<Vec<(usize, String)>> {
    let all: Vec<_> = (cells.iter().enumerate())
        .filter_map(|(column, cell)| Some((column, checkpoint(cell)?)))
        .collect();
    (all.len() > 1).then_some(all)
}

/// The revolutions after which a column's values were taken; none for other columns.
fn checkpoint(header: &str) -> Option<String> {
    let (name, unit) = name_and_unit(header);
    let (count, rest) = count_and_rest(&name)?;
    let is_bare = names::words(&name.replacen(&count, " ", 1)).is_empty();
    (unit.is_none() && rest.is_empty() && !is_bare).then_some(count)
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
            "Versuch|Rad|60000 LW|300000 LW",
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
