//! Words that people and spreadsheets write where they have no value: `-`, `n.b.`, `#N/A`.

use super::numbers::pointed;
use super::{Sheet, cell_name};

/// What stands for no value, in small letters and without spaces.
const WORDS: [&str; 24] = [
    "-", "--", "---", "–", "—", "/", "n.b.", "n.d.", "nd", "n/d", "n/a", "n.a.", "na", "n.v.",
    "nv", "#n/a", "#nv", "nan", "null", "k.a.", "missing", "fehlt", "s.d.", "n.c.",
];
/// So many cells are named.
const NAMED: usize = 4;

/// The sheet with nothing in the cells that say so beside numbers of their row, and in words which these are. What names one of the `tests` stays.
pub fn without_words(sheet: &Sheet, tests: &[&str]) -> (Sheet, Option<String>) {
    let mut sheet = sheet.clone();
    let mut found = Vec::new();
    for (row, cells) in sheet.rows.iter_mut().enumerate() {
        if !cells
            .iter()
            .any(|text| pointed(text).parse::<f64>().is_ok_and(f64::is_finite))
        {
            continue;
        }
        for (column, text) in cells
            .iter_mut()
            .enumerate()
            .filter(|(_, text)| is_none(text) && !tests.contains(&text.as_str()))
        {
            found.push(format!("{} (`{text}`)", cell_name(row, column)));
            text.clear();
        }
    }
    let said = (!found.is_empty()).then(|| {
        let more = match found.len().saturating_sub(NAMED) {
            0 => String::new(),
            n => format!(" and {n} more"),
        };
        found.truncate(NAMED);
        format!("no value in {}{more}: read as empty", found.join(", "))
    });
    (sheet, said)
}

/// Whether a text says that there is no value.
fn is_none(text: &str) -> bool {
    let plain: String = text.to_lowercase().split_whitespace().collect();
    WORDS.contains(&plain.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_say_there_is_no_value_are_emptied_beside_numbers_only() {
        let row = |cells: [&str; 3]| cells.map(str::to_owned).to_vec();
        let sheet = Sheet {
            name: String::new(),
            rows: vec![
                row(["radius", "-", "n.b."]),
                row(["18,2", "n. b.", "3,4"]),
                row(["18.3", "5.1", "\u{2013}"]),
                row(["18.4", "5.0", "<0,2"]),
            ],
            without_result: None,
            plain_decimals: false,
            said: Vec::new(),
        };
        let (plain, said) = without_words(&sheet, &[]);
        assert_eq!(plain.rows[0], sheet.rows[0]);
        assert_eq!(plain.rows[1], row(["18,2", "", "3,4"]));
        assert_eq!(plain.rows[2], row(["18.3", "5.1", ""]));
        // a value below what can be seen is one
        assert_eq!(plain.rows[3], sheet.rows[3]);
        assert_eq!(
            said.unwrap(),
            "no value in B2 (`n. b.`), C3 (`\u{2013}`): read as empty"
        );
        assert_eq!(without_words(&plain, &[]).1, None);
        // a test of that name
        let of_test = Sheet {
            rows: vec![row(["ND", "26", "nd"])],
            ..sheet
        };
        assert_eq!(
            without_words(&of_test, &["ND"]).0.rows[0],
            row(["ND", "26", ""])
        );
    }
}
