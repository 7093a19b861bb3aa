//! Rows behind those of a measurement file that is there already.

use std::collections::BTreeSet;

use csv::StringRecord;

use super::ImportError;
use crate::measure::dialect::Dialect;
use crate::measure::header::{COLUMNS, column_named};

/// The file's text with the rows behind its own. Columns that the file or the rows lack stay empty; the header gets those that only the
/// rows have.
///
/// # Errors
/// [`ImportError`] for a file that is not written with commas, and for a row that it has already.
pub fn appended(before: &str, header: &str, rows: &[String]) -> Result<String, ImportError> {
    let before = before.strip_prefix('\u{feff}').unwrap_or(before);
    if Dialect::of(before).separator != b',' {
        return Err(ImportError(
            "it has semicolons or tabulators between its columns: import it into a file of its own first, and append to that".to_owned(),
        ));
    }
    let is_record = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
    let Some(own_header) = before.lines().find(is_record) else {
        return Ok(format!("{before}{header}\n{}", ended(rows)));
    };
    let new_names: Vec<Option<usize>> = record(header).iter().map(column_named).collect();
    let mut names: Vec<Option<usize>> = record(own_header).iter().map(column_named).collect();
    let rows: Vec<StringRecord> = rows.iter().map(|row| record(row)).collect();
    let added: Vec<usize> = (new_names.iter().enumerate())
        .filter(|(at, name)| !names.contains(name) && rows.iter().any(|row| !row[*at].is_empty()))
        .filter_map(|(_, name)| *name)
        .collect();
    names.extend(added.iter().copied().map(Some));
    let mut text = String::new();
    let mut is_header = true;
    for line in before.lines() {
        text += line;
        if is_record(&line) {
            for &column in &added {
                text.push(',');
                text += if is_header { COLUMNS[column].0 } else { "" };
            }
            is_header = false;
        }
        text.push('\n');
    }
    let records = before.lines().filter(is_record).skip(1).map(record);
    let known: BTreeSet<Vec<String>> = records.map(|row| reading(&row, &names)).collect();
    for row in &rows {
        let field = |name: &Option<usize>| {
            let at = new_names
                .iter()
                .position(|new| name.is_some() && new == name);
            at.and_then(|at| row.get(at)).unwrap_or_default()
        };
        let line = line(names.iter().map(field));
        if known.contains(&reading(&record(&line), &names)) {
            return Err(ImportError(format!(
                "the reading {line} is there already: was this table taken before? --repeat 2 is for a second measurement at the same \
                 checkpoints"
            )));
        }
        text += &line;
        text.push('\n');
    }
    Ok(text)
}

/// Lines, each with its end.
fn ended(rows: &[String]) -> String {
    rows.iter().map(|row| format!("{row}\n")).collect()
}

/// The fields of a line.
fn record(line: &str) -> StringRecord {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .trim(csv::Trim::All)
        .from_reader(line.as_bytes());
    let first = reader.records().next();
    first.and_then(std::result::Result::ok).unwrap_or_default()
}

/// Fields as a line.
fn line<'f>(fields: impl Iterator<Item = &'f str>) -> String {
    let quoted = fields.map(super::entry::quoted);
    quoted.collect::<Vec<_>>().join(",")
}

/// What a row says, by columns and but its sigma, which may be stated otherwise when a table is taken a second time.
fn reading(row: &StringRecord, names: &[Option<usize>]) -> Vec<String> {
    let said = COLUMNS
        .iter()
        .enumerate()
        .filter(|(_, (name, _))| *name != "sigma");
    let said = said.map(|(column, _)| {
        let at = names.iter().position(|name| *name == Some(column));
        let text = at.and_then(|at| row.get(at)).unwrap_or_default();
        text.parse::<f64>()
            .map_or_else(|_| text.to_owned(), |number| number.to_string())
    });
    said.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const OWN: &str = "test,member,cycles,quantity,position,value,sigma";

    #[test]
    fn columns_that_one_lacks_stay_empty() {
        let before = format!("# weighed\n{OWN},comment\nA,gear,1e5,mass_loss,,4.2,0.4,ok\n");
        let header = format!("{OWN},trace");
        let depth = "A,gear,100000,wear_depth,52,1.5,0.1,t1".to_owned();
        assert_eq!(
            appended(&before, &header, std::slice::from_ref(&depth)).unwrap(),
            format!(
                "# weighed\n{OWN},comment,trace\nA,gear,1e5,mass_loss,,4.2,0.4,ok,\nA,gear,100000,wear_depth,52,1.5,0.1,,t1\n"
            )
        );
        // nothing stands in the column that the file lacks
        let mass = "A,gear,200000,mass_loss,,8.2,0.4,".to_owned();
        let text = appended(&before, &header, &[mass]).unwrap();
        assert!(
            text.ends_with(
                "comment\nA,gear,1e5,mass_loss,,4.2,0.4,ok\nA,gear,200000,mass_loss,,8.2,0.4,\n"
            ),
            "{text}"
        );
        let again = "A,gear,100000,mass_loss,,4.2,0.1,".to_owned();
        let refused = appended(&before, &header, &[again]).unwrap_err();
        assert!(refused.0.contains("--repeat 2"), "{refused}");
        assert!(appended(&before.replace(',', ";"), &header, &[depth]).is_err());
    }
}
