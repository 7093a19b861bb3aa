//! Curves of several teeth side by side: `Radius [mm]; Zahn 1; Zahn 7; Zahn 13`. Their numbers are no checkpoints.

use super::arrange::put_column;
use super::{Sheet, units};
use crate::measure::{Quantity, names};

/// A table for each tooth, with its cells in their places and a column of the tooth behind them, and what was made of it, in words; none if it is no such
/// table.
pub(super) fn apart(sheet: &Sheet) -> Option<(Vec<Sheet>, String)> {
    let (head, teeth) =
        (sheet.rows.iter().enumerate()).find_map(|(row, cells)| Some((row, teeth_of(cells)?)))?;
    let of_one = |tooth: &Tooth| {
        let mut own = sheet.clone();
        for cells in &mut own.rows[head..] {
            let others = cells.iter_mut().enumerate().skip(1);
            let others = others.filter(|(at, _)| *at != tooth.at);
            others.for_each(|(_, cell)| cell.clear());
        }
        own.rows[head][tooth.at] = match &tooth.unit {
            Some(unit) => format!("wear depth [{unit}]"),
            None => "wear depth".to_owned(),
        };
        put_column(&mut own, head, "tooth", &tooth.number);
        own
    };
    let numbers: Vec<&str> = teeth.iter().map(|tooth| tooth.number.as_str()).collect();
    let said = format!("a curve of each of the teeth {}", numbers.join(", "));
    Some((teeth.iter().map(of_one).collect(), said))
}

/// A column that is headed by a tooth.
struct Tooth {
    at: usize,
    number: String,
    unit: Option<String>,
}

/// The teeth of a header that names places in its first cell and a tooth in each other one.
fn teeth_of(cells: &[String]) -> Option<Vec<Tooth>> {
    let (place, others) = cells.split_first()?;
    let tooth = |(at, cell): (usize, &String)| {
        let (name, unit) = units::name_and_unit(cell);
        let words: Vec<&str> = name.split_whitespace().collect();
        let [word, number] = words[..] else {
            return None;
        };
        let is_tooth = names::column(word) == Some("tooth");
        let is_unit = |unit: &String| units::of_values(unit, Quantity::WearDepth).is_some();
        let is_number = number.parse::<u32>().is_ok();
        (is_tooth && is_number && unit.iter().all(is_unit)).then(|| Tooth {
            at: at + 1,
            number: number.to_owned(),
            unit,
        })
    };
    let filled = others.iter().enumerate();
    let filled = filled.filter(|(_, cell)| !cell.is_empty());
    let teeth: Vec<Tooth> = filled.map(tooth).collect::<Option<_>>()?;
    let names_places = names::column(&units::name_and_unit(place).0) == Some("position");
    (names_places && !teeth.is_empty()).then_some(teeth)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(rows: &[&[&str]]) -> Sheet {
        Sheet {
            name: String::new(),
            rows: (rows.iter())
                .map(|row| row.iter().map(|cell| (*cell).to_owned()).collect())
                .collect(),
            without_result: None,
            plain_decimals: false,
            said: Vec::new(),
        }
    }

    #[test]
    fn each_tooth_has_a_table_of_its_own() {
        let table = sheet(&[
            &["Part: pinion"],
            &["Radius [mm]", "Zahn 1 [\u{b5}m]", "Zahn 7 [\u{b5}m]"],
            &["29.95", "4.8", "5.1"],
            &["30.1", "4.2", "4.5"],
        ]);
        let (sheets, said) = apart(&table).unwrap();
        assert_eq!(said, "a curve of each of the teeth 1, 7");
        let [first, second] = &sheets[..] else {
            panic!("{sheets:?}")
        };
        assert_eq!(
            first.rows[1],
            ["Radius [mm]", "wear depth [um]", "", "tooth"]
        );
        assert_eq!(first.rows[2], ["29.95", "4.8", "", "1"]);
        // in their places
        assert_eq!(second.rows[3], ["30.1", "", "4.5", "7"]);
        // checkpoints, other numbers, no places
        for header in [
            ["Radius [mm]", "80000", "200000"],
            ["Radius [mm]", "position 1", "position 2"],
            ["cycles", "tooth 1", "tooth 7"],
            ["Radius [mm]", "tooth 1", "200000"],
        ] {
            assert!(apart(&sheet(&[&header, &["29.95", "4.8", "5.1"]])).is_none());
        }
    }
}
