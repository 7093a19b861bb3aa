//! A row for each member with a column for each weighing: `Test | Member | Mass new [g] | Mass after 40000 cycles [g] | Mass after 100000 cycles [g]`;
//! or one for each test, the weighings of both members side by side: `Test | Pinion m0 [g] | Pinion 40000 cycles [g] | Gear m0 [g] | Gear 40000 cycles [g]`.

use super::arrange::merged;
use super::checkpoints_across::count_and_rest;
use super::{Sheet, columns, units};
use crate::measure::names::{self, When};
use crate::measure::thousands::in_thousands;
use crate::measure::{Quantity, Subject};

/// Letters for the mass of a new part.
const NEW: [&str; 3] = ["m0", "m₀", "masse0"];

/// The same with a row for each weighing but the first, both side by side; none for other sheets.
pub fn weighings_across(sheet: &Sheet) -> Option<Sheet> {
    let by_member = members_below(sheet);
    let sheet = by_member.as_ref().unwrap_or(sheet);
    let (head, weighings) =
        (sheet.rows.iter().enumerate()).find_map(|(row, cells)| Some((row, weighings(cells)?)))?;
    let header = &sheet.rows[head];
    let is_weighing = |at: &usize| weighings.iter().any(|(column, ..)| column == at);
    let others: Vec<usize> = (0..header.len()).filter(|at| !is_weighing(at)).collect();
    let known = columns::columns(&header[..]);
    let filled = merged::with_tests_filled(sheet, head);
    let names_members = known
        .iter()
        .any(|column| column.what.own() == Some("member"));
    let units: Vec<&Option<String>> = weighings.iter().map(|(.., unit)| unit).collect();
    if !names_members || units.iter().any(|unit| *unit != units[0]) {
        return None;
    }
    let cells_of = |cells: &[String]| -> Vec<String> {
        let cell = |&at: &usize| cells.get(at).cloned().unwrap_or_default();
        others.iter().map(cell).collect()
    };
    let unit = (units[0].as_ref()).map_or(String::new(), |unit| format!(" [{unit}]"));
    let (of_new, later): (Vec<_>, Vec<_>) =
        (weighings.iter()).partition(|(_, cycles, _)| cycles == "0");
    let masses = ["before", "after"].map(|when| format!("mass {when}{unit}"));
    let mut rows: Vec<Vec<String>> = sheet.rows[..head].to_vec();
    rows.push([&cells_of(header)[..], &["cycles".to_owned()], &masses].concat());
    for cells in filled.rows[head + 1..].iter() {
        let mass = |at: usize| cells.get(at).filter(|cell| !cell.is_empty());
        for (column, cycles, _) in &later {
            if let Some(worn) = mass(*column) {
                let new = mass(of_new[0].0).cloned().unwrap_or_default();
                rows.push([cells_of(cells), vec![cycles.clone(), new, worn.clone()]].concat());
            }
        }
    }
    Some(Sheet { rows, ..filled })
}

/// A row for each member in place of one for each test whose weighings of both stand side by side; none for other sheets.
fn members_below(sheet: &Sheet) -> Option<Sheet> {
    let (head, weighings) = (sheet.rows.iter().enumerate())
        .find_map(|(row, cells)| Some((row, weighings_of_members(cells)?)))?;
    let header = &sheet.rows[head];
    let is_weighing = |at: &usize| weighings.iter().any(|(column, ..)| column == at);
    let others: Vec<usize> = (0..header.len()).filter(|at| !is_weighing(at)).collect();
    let of = |member: Subject| {
        weighings
            .iter()
            .filter(move |weighing| weighing.1 == member)
    };
    let names = |member: Subject| of(member).map(|weighing| &weighing.2);
    if !names(Subject::Pinion).eq(names(Subject::Gear)) {
        return None;
    }
    let cell = |cells: &[String], at: usize| cells.get(at).cloned().unwrap_or_default();
    let row = |cells: &[String], member: &str, values: Vec<String>| -> Vec<String> {
        let whose = others.iter().map(|&at| cell(cells, at));
        whose.chain([member.to_owned()]).chain(values).collect()
    };
    let mut rows = sheet.rows[..head].to_vec();
    rows.push(row(
        header,
        "member",
        names(Subject::Pinion).cloned().collect(),
    ));
    let filled = |cells: &&Vec<String>| cells.iter().any(|cell| !cell.is_empty());
    for cells in sheet.rows[head + 1..].iter().filter(filled) {
        for member in [Subject::Pinion, Subject::Gear] {
            let values = of(member).map(|(at, ..)| cell(cells, *at)).collect();
            rows.push(row(cells, member.name(), values));
        }
    }
    Some(Sheet {
        rows,
        ..sheet.clone()
    })
}

/// The columns of a header that name a member and its mass, each with the name of the weighing without that of the member; none where there are none of both.
fn weighings_of_members(cells: &[String]) -> Option<Vec<(usize, Subject, String)>> {
    let of_mass = |unit: &str| units::factor(unit, Quantity::MassLoss).is_ok();
    let all = cells.iter().enumerate().filter_map(|(at, header)| {
        let (name, unit) = units::name_and_unit(header);
        let unit = unit.filter(|unit| of_mass(unit))?;
        let member = names::one_member(&name)?;
        let words = name.split_whitespace();
        let rest: Vec<&str> = words.filter(|word| names::member(word).is_none()).collect();
        let rest = rest.join(" ");
        let is_new = NEW.contains(&names::folded(&rest).as_str());
        let count = count_and_rest(&rest).filter(|(_, words)| words.is_empty());
        let name = match count {
            _ if is_new => "mass new".to_owned(),
            // no part of a revolution is counted
            Some((count, _)) if in_thousands(&count) => {
                format!("mass after {} cycles", count.replace(['.', ','], ""))
            }
            Some((count, _)) => format!("mass after {count} cycles"),
            None => rest,
        };
        let name = format!("{name} [{unit}]");
        weighing(&name).map(|_| (at, member, name))
    });
    let all: Vec<(usize, Subject, String)> = all.collect();
    let has = |member: Subject| all.iter().any(|weighing| weighing.1 == member);
    (has(Subject::Pinion) && has(Subject::Gear)).then_some(all)
}

/// The columns of the weighings of a header with the cycles of each and its unit; none where there are not several, the first of the new part.
fn weighings(cells: &[String]) -> Option<Vec<(usize, String, Option<String>)>> {
    let all: Vec<_> = (cells.iter().enumerate())
        .filter_map(|(column, cell)| {
            let (cycles, unit) = weighing(cell)?;
            Some((column, cycles, unit))
        })
        .collect();
    let of_new = all.iter().filter(|(_, cycles, _)| cycles == "0").count();
    (all.len() > 2 && of_new == 1).then_some(all)
}

/// The cycles after which a column's mass was weighed, 0 of the new part, and its unit; none for other columns.
fn weighing(header: &str) -> Option<(String, Option<String>)> {
    let (name, unit) = units::name_and_unit(header);
    if names::weighed(&name) == Some(When::Before) {
        return Some(("0".to_owned(), unit));
    }
    let (count, rest) = count_and_rest(&name)?;
    names::is_mass(&rest.join(" ")).then_some((count, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_weighing_becomes_a_row() {
        let sheet = Sheet::of_rows(&[
            "Versuch|Rad|Masse neu [g]|Masse nach 40000 LW [g]|Masse nach 100000 LW [g]",
            "T1|Ritzel|612.4312|612.4097|612.3758",
            "T1|Rad|1893.1177|1893.0954|",
        ]);
        let long = weighings_across(&sheet).unwrap();
        let masses = ["mass before [g]", "mass after [g]"];
        assert_eq!(
            long.rows[0],
            [&["Versuch", "Rad", "cycles"][..], &masses].concat()
        );
        assert_eq!(
            long.rows[1],
            ["T1", "Ritzel", "40000", "612.4312", "612.4097"]
        );
        assert_eq!(
            long.rows[2],
            ["T1", "Ritzel", "100000", "612.4312", "612.3758"]
        );
        assert_eq!(long.rows.len(), 4);
        let side_by_side = Sheet::of_rows(&[
            "Versuch|Ritzel m0 [g]|Ritzel 60.000 LW [g]|Ritzel 300.000 LW [g]|Rad m0 [g]|Rad 60.000 LW [g]|Rad 300.000 LW [g]",
            "T1|612.4312|612.4097|612.3758|1893.1177|1893.0954|1893.0700",
        ]);
        let long = weighings_across(&side_by_side).unwrap();
        assert_eq!(long.rows[0][1..3], ["member", "cycles"]);
        assert_eq!(
            long.rows[4],
            ["T1", "gear", "300000", "1893.1177", "1893.0700"]
        );
        assert_eq!(long.rows.len(), 5);
        // two weighings alone are columns of their own; nothing of the new part; no member
        for other in [
            "Test|Member|Mass before [g]|Mass after [g]",
            "Test|Member|Mass after 1e4 [g]|Mass after 2e4 [g]|Mass after 3e4 [g]",
            "Test|Mass new [g]|Mass after 10000 [g]|Mass after 20000 [g]",
        ] {
            let rows = [other, "A|pinion|3|2|1"];
            assert!(
                weighings_across(&Sheet::of_rows(&rows)).is_none(),
                "{other}"
            );
        }
    }
}
