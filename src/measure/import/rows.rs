//! Sheets that have the columns of a measurement file, under English or German names.

use super::numbers::{Decimal, is_for_people, plain_cycles, pointed, rounded, with_points};
use super::wide::quoted;
use super::{ImportError, Sheet, units};
use crate::measure::{Place, Quantity};

/// Names of columns and of what stands in them, and what they are in a measurement file.
const NAMES: [(&str, &[&str]); 9] = [
    ("test", &["versuch", "pr\u{fc}fung", "test id"]),
    ("member", &["rad", "bauteil", "part"]),
    (
        "cycles",
        &[
            "lastspiele",
            "lastwechsel",
            "umdrehungen",
            "zyklen",
            "revolutions",
        ],
    ),
    (
        "quantity",
        &["gr\u{f6}\u{df}e", "messgr\u{f6}\u{df}e", "groesse"],
    ),
    ("position", &["ort", "stelle", "radius"]),
    ("value", &["wert", "messwert"]),
    ("sigma", &["streuung", "standardabweichung", "unsicherheit"]),
    ("trace", &["spur", "kurve", "messkurve"]),
    ("face", &[]),
];
const CONTENTS: [(&str, &[&str]); 6] = [
    ("pinion", &["ritzel"]),
    ("gear", &["rad", "gro\u{df}rad", "wheel"]),
    ("pair", &["paar", "radpaar"]),
    (
        "wear_depth",
        &[
            "verschlei\u{df}",
            "verschlei\u{df}tiefe",
            "verschleisstiefe",
            "wear depth",
        ],
    ),
    ("mass_loss", &["massenverlust", "masseverlust", "mass loss"]),
    (
        "transmission_error",
        &[
            "drehfehler",
            "drehwegfehler",
            "drehabweichung",
            "transmission error",
        ],
    ),
];

/// Columns whose contents have names.
const NAMED: [&str; 2] = ["member", "quantity"];

/// Columns of numbers that may have decimals or marks between thousands.
const NUMBERS: [&str; 5] = ["cycles", "position", "value", "sigma", "face"];

/// A sheet in the columns of a measurement file, as its text; none if it has other columns.
///
/// Numbers get decimal points, and those of a column whose header states a unit the unit of the rows' quantities. A unit that does not
/// suit them all stays in the header, where the reader of measurements refuses it.
///
/// # Errors
/// [`ImportError`] where it cannot be told how decimals are written.
pub fn as_measurements(
    sheet: &Sheet,
    decimal: Option<Decimal>,
) -> Result<Option<String>, ImportError> {
    let is_header = |row: &Vec<String>| {
        let has = |name: &str| row.iter().any(|cell| column(cell) == Some(name));
        ["test", "member", "quantity"].into_iter().all(has)
    };
    let Some(head) = sheet.rows.iter().position(is_header) else {
        return Ok(None);
    };
    let header = &sheet.rows[head];
    let numbers = numbers(sheet, head, decimal)?;
    let filled = (head + 1..sheet.rows.len())
        .filter(|&row| !sheet.rows[row].iter().all(String::is_empty))
        .collect::<Vec<_>>();
    let quantities: Vec<Option<Quantity>> = {
        let at = header
            .iter()
            .position(|cell| column(cell) == Some("quantity"));
        let of = |&row: &usize| quantity(at.and_then(|at| sheet.rows[row].get(at))?);
        filled.iter().map(of).collect()
    };
    // what is for people stays in the sheet
    let kept = (0..header.len()).filter(|&i| !is_for_people(&header[i]));
    let mut columns = Vec::new();
    for i in kept {
        let name = column(&header[i]);
        let factors: Option<Vec<f64>> = (quantities.iter())
            .map(|quantity| factor_of(name?, &header[i], (*quantity)?))
            .collect();
        let unit = header[i].find(['[', '(']).map(|at| &header[i][at..]);
        let title = match (name, unit) {
            (None, _) => header[i].clone(),
            (Some(name), Some(unit)) if factors.is_none() => format!("{name} {unit}"),
            (Some(name), _) => name.to_owned(),
        };
        let cells = filled.iter().enumerate().map(|(n, &row)| {
            let cell = numbers.rows[row].get(i).map_or("", String::as_str);
            match (name, &factors) {
                (Some(name), _) if NAMED.contains(&name) => {
                    known(&CONTENTS, cell).unwrap_or(cell).to_owned()
                }
                (_, Some(factors)) => times(factors[n], cell),
                _ => cell.to_owned(),
            }
        });
        columns.push(std::iter::once(title).chain(cells).collect::<Vec<_>>());
    }
    let lines = (0..=filled.len()).map(|n| fields(columns.iter().map(|column| column[n].clone())));
    Ok(Some(lines.collect()))
}

/// The sheet with decimal points in its columns of numbers; only these tell how decimals are written.
fn numbers(sheet: &Sheet, head: usize, decimal: Option<Decimal>) -> Result<Sheet, ImportError> {
    if sheet.plain_decimals && decimal.is_none() {
        return Ok(sheet.clone());
    }
    let name_of = |i: usize| sheet.rows[head].get(i).and_then(|cell| column(cell));
    let is_number =
        |row: usize, i: usize| row > head && name_of(i).is_some_and(|name| NUMBERS.contains(&name));
    let mut only = sheet.clone();
    for (row, cells) in only.rows.iter_mut().enumerate() {
        for (i, cell) in cells.iter_mut().enumerate() {
            if !is_number(row, i) {
                cell.clear();
            }
        }
    }
    let only = with_points(&only, decimal)?;
    let mut sheet = sheet.clone();
    for row in head + 1..sheet.rows.len() {
        for i in 0..sheet.rows[row].len() {
            let cell = &only.rows[row][i];
            if name_of(i) == Some("cycles") && decimal.is_none() {
                plain_cycles(cell, row, i)?;
            }
            if is_number(row, i) {
                sheet.rows[row][i] = pointed(cell);
            }
        }
    }
    Ok(sheet)
}

fn quantity(cell: &str) -> Option<Quantity> {
    let name = known(&CONTENTS, cell).unwrap_or(cell);
    Quantity::ALL.into_iter().find(|known| known.name() == name)
}

/// From the unit that a header states to that of the quantity; none if it states none, or one that the quantity does not have.
fn factor_of(column: &str, header: &str, quantity: Quantity) -> Option<f64> {
    let unit = units::bracketed(header)?;
    match (column, quantity.place()) {
        ("value" | "sigma", _) => units::factor(unit, quantity).ok(),
        ("position", Place::Flank) => units::of_position(header, false).ok(),
        ("position", Place::Whole) => Some(1.0),
        _ => None,
    }
}

/// A number in another unit; what is no number is left for the reader to refuse.
fn times(factor: f64, cell: &str) -> String {
    match cell.parse::<f64>() {
        Ok(value) if factor != 1.0 => rounded(value * factor).to_string(),
        _ => cell.to_owned(),
    }
}

/// The column that a header names, units in brackets aside.
fn column(cell: &str) -> Option<&'static str> {
    let name = cell.split(['[', '(']).next().unwrap_or_default();
    known(&NAMES, name)
}

fn known(names: &[(&'static str, &[&str])], text: &str) -> Option<&'static str> {
    let text = text.trim().to_lowercase();
    let found = names
        .iter()
        .find(|(name, others)| *name == text || others.contains(&text.as_str()));
    found.map(|(name, _)| *name)
}

fn fields(cells: impl Iterator<Item = String>) -> String {
    cells
        .map(|cell| quoted(&cell))
        .collect::<Vec<_>>()
        .join(",")
        + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn german_names_are_known() {
        let row = |text: &str| text.split(';').map(str::to_owned).collect::<Vec<_>>();
        let sheet = Sheet {
            name: String::new(),
            rows: vec![
                row("Messung vom Montag"),
                row("Versuch;Rad;Lastspiele;Gr\u{f6}\u{df}e;Ort [mm];Wert;Kommentar;Streuung"),
                row("A;Ritzel;250000;Verschlei\u{df};26.5;1.2;nach Reinigung;0.1"),
                row("A;Rad;250000;Massenverlust;;4.5;;0.1"),
            ],
            plain_decimals: true,
        };
        assert_eq!(
            as_measurements(&sheet, None).unwrap().unwrap(),
            "test,member,cycles,quantity,position,value,sigma\nA,pinion,250000,wear_depth,26.5,1.2,0.1\n\
             A,gear,250000,mass_loss,,4.5,0.1\n"
        );
        let other = Sheet {
            rows: vec![row("radius;100000"), row("26;1")],
            ..sheet
        };
        assert_eq!(as_measurements(&other, None), Ok(None));
    }

    #[test]
    fn units_in_headers_are_obeyed_or_left_to_be_refused() {
        let read = |unit: &str, rows: [&str; 2]| {
            let header =
                format!("Versuch;Rad;Lastspiele;Gr\u{f6}\u{df}e;Ort;Wert [{unit}];Streuung");
            let rows = [header.as_str(), rows[0], rows[1]];
            let row = |text: &&str| text.split(';').map(str::to_owned).collect();
            let sheet = Sheet {
                name: String::new(),
                rows: rows.iter().map(row).collect(),
                plain_decimals: false,
            };
            as_measurements(&sheet, None).map(Option::unwrap)
        };
        let mass = "A;Rad;250000;Massenverlust;;0,00425;0,1";
        let depth = "A;Rad;250000;Verschlei\u{df};26,5;0,0012;0,1";
        let text = read("g", [mass, mass]).unwrap();
        assert!(text.contains(",value,sigma\nA,gear,250000,mass_loss,,4.25,0.1\n"));
        let text = read("mm", [depth, depth]).unwrap();
        assert!(text.contains(",value,sigma\nA,gear,250000,wear_depth,26.5,1.2,0.1\n"));
        // no unit of both: the header keeps it, and the numbers are as written
        let text = read("g", [mass, depth]).unwrap();
        assert!(text.contains(",value [g],sigma\nA,gear,250000,mass_loss,,0.00425,0.1\n"));
        let thousands = "A;Rad;250.000;Massenverlust;;0,0042;0,1";
        let refused = read("g", [mass, thousands]).unwrap_err();
        assert!(refused.0.starts_with("C3: are the cycles `250.000`"));
    }
}
