//! Sheets that have the columns of a measurement file, under English or German names.

use super::Sheet;
use super::numbers::is_for_people;
use super::wide::quoted;

/// Names of columns and of what stands in them, and what they are in a measurement file.
const NAMES: [(&str, &[&str]); 8] = [
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

/// A sheet in the columns of a measurement file, as its text; none if it has other columns.
pub fn as_measurements(sheet: &Sheet) -> Option<String> {
    let is_header = |row: &&Vec<String>| {
        let has = |name: &str| row.iter().any(|cell| column(cell) == Some(name));
        ["test", "member", "quantity"].into_iter().all(has)
    };
    let head = sheet.rows.iter().position(|row| is_header(&row))?;
    let header = &sheet.rows[head];
    // what is for people stays in the sheet
    let kept: Vec<(usize, &String)> = (header.iter().enumerate())
        .filter(|(_, name)| !is_for_people(name))
        .collect();
    let mut text = fields(kept.iter().map(|(_, cell)| match column(cell) {
        // the measurement file's reader knows its own names, units and all
        Some(name) if !cell.to_lowercase().starts_with(name) => name.to_owned(),
        _ => (*cell).clone(),
    }));
    let rows = sheet.rows[head + 1..].iter();
    for row in rows.filter(|row| !row.iter().all(String::is_empty)) {
        text += &fields(kept.iter().map(|&(i, name)| {
            let cell = row.get(i).map_or("", String::as_str);
            match column(name) {
                Some(name) if NAMED.contains(&name) => {
                    known(&CONTENTS, cell).unwrap_or(cell).to_owned()
                }
                _ => cell.to_owned(),
            }
        }));
    }
    Some(text)
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
            as_measurements(&sheet).unwrap(),
            "test,member,cycles,quantity,position,value,sigma\nA,pinion,250000,wear_depth,26.5,1.2,0.1\n\
             A,gear,250000,mass_loss,,4.5,0.1\n"
        );
        let other = Sheet {
            rows: vec![row("radius;100000"), row("26;1")],
            ..sheet
        };
        assert_eq!(as_measurements(&other), None);
    }
}
