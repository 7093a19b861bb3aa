//! Rows behind those of a measurement file that is there already.

use std::collections::{BTreeMap, BTreeSet};

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
            "it has semicolons or tabs between its columns: import it into a file of its own first, and append to that".to_owned(),
        ));
    }
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
    let known = Known::of(records, &names);
    let mut taken = Vec::new();
    let mut elsewhere = Vec::new();
    for row in &rows {
        let field = |name: &Option<usize>| {
            let at = new_names
                .iter()
                .position(|new| name.is_some() && new == name);
            at.and_then(|at| row.get(at)).unwrap_or_default()
        };
        let line = line(names.iter().map(field));
        let written = record(&line);
        if known.has(&written, &names) {
            return Err(ImportError(format!(
                "the reading {line} is there already: was this table taken before? --repeat 2 is for a second measurement at the same \
                 checkpoints"
            )));
        }
        if let Some(faces) = known.has_at_a_face_that_one_lacks(&written, &names) {
            elsewhere.push((line.clone(), faces));
        }
        text += &line;
        text.push('\n');
        taken.push(written);
    }
    refuse_second_curve(&known.curves, &curves(taken.into_iter(), &names))?;
    // a few equal values may be chance
    match elsewhere.first() {
        Some((line, faces)) if 2 * elsewhere.len() > rows.len() => Err(ImportError(format!(
            "the reading {line} is there already {faces}: was this table taken before? Rows at another place across the face say so in a column \
             `face`, or by --face MM"
        ))),
        _ => Ok(text),
    }
}

/// The records of a measurement file with commas, by the names of its columns.
pub(super) struct Rows<'t> {
    text: &'t str,
    names: Vec<Option<usize>>,
}

impl<'t> Rows<'t> {
    /// None for a file without a header.
    pub(super) fn of(text: &'t str) -> Option<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let header = text.lines().find(is_record)?;
        let names = record(header).iter().map(column_named).collect();
        Some(Self { text, names })
    }

    /// Those below the header.
    pub(super) fn records(&self) -> impl Iterator<Item = StringRecord> {
        self.text.lines().filter(is_record).skip(1).map(record)
    }

    /// What stands in a record's column.
    pub(super) fn field(&self, row: &StringRecord, name: &str) -> String {
        field(row, &self.names, name)
    }
}

/// New places within the stretch of a trace from which they are another curve: a point or two may have been missing.
const FEWEST: usize = 3;

/// Places of each trace, by test, member, cycles, quantity, trace, face and tooth.
type Curves = BTreeMap<Vec<String>, Vec<f64>>;

/// The curves of some rows.
fn curves(rows: impl Iterator<Item = StringRecord>, names: &[Option<usize>]) -> Curves {
    let mut curves = Curves::new();
    for row in rows {
        let of = |name: &str| field(&row, names, name);
        let (trace, position) = (of("trace"), of("position").parse::<f64>());
        let (false, Ok(position)) = (trace.is_empty(), position) else {
            continue;
        };
        let key = [
            "test", "member", "cycles", "quantity", "trace", "face", "tooth",
        ]
        .map(of);
        curves.entry(key.to_vec()).or_default().push(position);
    }
    curves
}

/// Refuses a second curve in a trace that is there: one at other places of the same stretch of flank. The other half of a curve may follow, and repeats at
/// the same places.
fn refuse_second_curve(there: &Curves, new: &Curves) -> Result<(), ImportError> {
    for (key, places) in new {
        let Some(known) = there.get(key) else {
            continue;
        };
        let ends = |all: &[f64]| {
            let least = all.iter().copied().fold(f64::INFINITY, f64::min);
            (least, all.iter().copied().fold(f64::NEG_INFINITY, f64::max))
        };
        let ((first, last), (low, high)) = (ends(known), ends(places));
        let within = (places.iter()).filter(|place| (first..=last).contains(place));
        let elsewhere = within.filter(|place| !known.contains(place)).count();
        if elsewhere >= FEWEST && 2 * elsewhere > places.len() {
            return Err(ImportError(format!(
                "the trace {} is there already, from {first} to {last}, and these rows are another curve, from {low} to {high}: of the other \
                 member (--member), or of another checkpoint? --repeat 2 is for a second measurement of the same",
                key[4]
            )));
        }
    }
    Ok(())
}

/// Whether a line of a measurement file is its header or a row.
fn is_record(line: &&str) -> bool {
    !line.trim().is_empty() && !line.starts_with('#')
}

/// The rows that a file has: what each says but its sigma, and without face and trace the faces at which it is said.
struct Known {
    readings: BTreeSet<Vec<String>>,
    faces: BTreeMap<Vec<String>, BTreeSet<String>>,
    curves: Curves,
}

impl Known {
    fn of(rows: impl Iterator<Item = StringRecord>, names: &[Option<usize>]) -> Self {
        let mut known = Self {
            readings: BTreeSet::new(),
            faces: BTreeMap::new(),
            curves: Curves::new(),
        };
        let rows: Vec<StringRecord> = rows.collect();
        known.curves = curves(rows.iter().cloned(), names);
        for row in rows {
            known.readings.insert(reading(&row, names, &["sigma"]));
            let anywhere = reading(&row, names, &ANYWHERE);
            let faces = known.faces.entry(anywhere).or_default();
            faces.insert(field(&row, names, "face"));
        }
        known
    }

    fn has(&self, row: &StringRecord, names: &[Option<usize>]) -> bool {
        self.readings.contains(&reading(row, names, &["sigma"]))
    }

    /// Where the file has it, if either it or the file's row does not say at which face.
    fn has_at_a_face_that_one_lacks(
        &self,
        row: &StringRecord,
        names: &[Option<usize>],
    ) -> Option<String> {
        let faces = self.faces.get(&reading(row, names, &ANYWHERE))?;
        match field(row, names, "face").as_str() {
            "" => {
                let stated = faces.iter().find(|face| !face.is_empty())?;
                Some(format!("at face {stated}"))
            }
            _ => faces.contains("").then(|| "without a face".to_owned()),
        }
    }
}

/// Columns that say nothing of whether two rows are of one reading where one of them lacks its face: the names of traces follow the face.
const ANYWHERE: [&str; 3] = ["sigma", "trace", "face"];

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

/// What a row says by columns, without those that are left out: a sigma may be stated otherwise when a table is taken a second time.
fn reading(row: &StringRecord, names: &[Option<usize>], left_out: &[&str]) -> Vec<String> {
    let said = COLUMNS.iter().map(|(name, _)| *name);
    said.filter(|name| !left_out.contains(name))
        .map(|name| field(row, names, name))
        .collect()
}

/// What stands in a row's column, a number as it is written shortest.
fn field(row: &StringRecord, names: &[Option<usize>], name: &str) -> String {
    let column = COLUMNS.iter().position(|(own, _)| *own == name);
    let at = names.iter().position(|own| own.is_some() && *own == column);
    let text = at.and_then(|at| row.get(at)).unwrap_or_default();
    text.parse::<f64>()
        .map_or_else(|_| text.to_owned(), |number| number.to_string())
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
