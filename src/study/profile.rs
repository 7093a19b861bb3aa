//! `profile_file`: the measured deviation of a flank as the member's unworn profile.
//!
//! ```text
//! radius,deviation          mm, µm; # starts a comment line
//! 27.9,0.4                  positive: material is missing, normal to the flank, against the involute
//! 28.1,1.1
//! ```
//! `lead_file` of [face.pinion] and [face.gear] is the same over the place across the face (`face,deviation`, mm from mid-face), and
//! `pitch_file` of [teeth.pinion] and [teeth.gear] over the teeth (`tooth,deviation`), one row for each from 1 on.
//! Semicolons or tabs may stand between the cells, as in the header, and numbers have decimal commas then if the spreadsheet writes them so.
//! Between the rows the deviation is a straight line over the curvature radius (steps of the path of contact); beyond the
//! first and last row it stays as there.

mod rows;

use std::ops::Range;
use std::path::Path;

use self::rows::{Rows, check_unit};
use super::marks::Marks;
use crate::gear::Gear;
use crate::source_text::{self, Diagnostic, Fault, Source, TextError, Wanted, nearest};

/// The file, to whoever cannot read it.
const WANTED: Wanted = Wanted {
    what: "profile file",
    ending: "csv",
    format: "CSV",
    header: &[],
    hint: "profile_file in [gears.pinion] or [gears.gear] names it, relative to the study file",
};

/// The file of a measured lead, to whoever cannot read it.
const WANTED_LEAD: Wanted = Wanted {
    what: "lead file",
    ending: "csv",
    format: "CSV",
    header: &[],
    hint: "lead_file in [face.pinion] or [face.gear] names it, relative to the study file",
};

/// The file of measured pitch deviations, to whoever cannot read it.
const WANTED_PITCH: Wanted = Wanted {
    what: "pitch file",
    ending: "csv",
    format: "CSV",
    header: &[],
    hint: "pitch_file in [teeth.pinion] or [teeth.gear] names it, relative to the study file",
};

/// Where deviations stand.
#[derive(Clone, Copy)]
enum Along<'a> {
    /// Over the radius of this gear.
    Profile(&'a Gear),
    /// Over the face, this wide, from its middle.
    Face(f64, &'a Gear),
    /// From tooth to tooth of this gear.
    Teeth(&'a Gear),
}

impl Along<'_> {
    fn columns(self) -> [&'static str; 2] {
        match self {
            Self::Profile(_) => ["radius", "deviation"],
            Self::Face(..) => ["face", "deviation"],
            Self::Teeth(_) => ["tooth", "deviation"],
        }
    }

    fn gear(&self) -> &Gear {
        match self {
            Self::Profile(gear) | Self::Face(_, gear) | Self::Teeth(gear) => gear,
        }
    }
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// Radius (mm) and missing material (mm) of every row.
///
/// # Errors
/// A [`TextError`] for the first fault of the file: unreadable, columns, numbers, order, radius off the flank, another unit.
pub(super) fn load(path: &Path, gear: &Gear) -> std::result::Result<Vec<[f64; 2]>, TextError> {
    let source = source_text::read(path, &WANTED)?;
    rows(&source, Along::Profile(gear)).map_err(|diagnostic| TextError::new(*diagnostic, source))
}

/// Place from mid-face (mm) and missing material (mm) of every row of a measured lead, of a face this wide (mm).
///
/// # Errors
/// As [`load`], for a place off the face.
pub(super) fn load_lead(
    path: &Path,
    width: f64,
    gear: &Gear,
) -> std::result::Result<Vec<[f64; 2]>, TextError> {
    let source = source_text::read(path, &WANTED_LEAD)?;
    let rows = rows(&source, Along::Face(width, gear));
    rows.map_err(|diagnostic| TextError::new(*diagnostic, source))
}

/// How far each tooth stands back, mm.
///
/// # Errors
/// As [`load`], for rows that are not the teeth from 1 on, one each.
pub(super) fn load_pitch(path: &Path, gear: &Gear) -> std::result::Result<Vec<f64>, TextError> {
    let source = source_text::read(path, &WANTED_PITCH)?;
    match rows(&source, Along::Teeth(gear)) {
        Ok(rows) => Ok(rows.iter().map(|row| row[1]).collect()),
        Err(diagnostic) => Err(TextError::new(*diagnostic, source)),
    }
}

/// Place (mm, or the number of a tooth) and missing material (mm) of every row.
fn rows(source: &Source, along: Along<'_>) -> Result<Vec<[f64; 2]>> {
    let names = along.columns();
    let mut lines = lines(&source.text);
    let end = source.text.trim_end().len();
    let Some(header) = lines.next() else {
        return Err(fault(Fault::MissingKey, "", "the file is empty", end..end)
            .with_values(
                "nothing",
                format!("the header {} and rows", names.join(",")),
            )
            .into());
    };
    let separator = separator(&source.text[header.clone()]);
    let order = columns(&source.text, header, names, separator)?;
    let mut marks = Marks::default();
    if separator != ',' {
        let below = self::lines(&source.text).skip(1);
        for cell in below.flat_map(|line| cells(&source.text, line, separator)) {
            marks.see(&source.text, &cell);
        }
    }
    let rows = Rows {
        text: &source.text,
        along,
        order,
        separator,
        decimal_comma: marks.decimal_comma(&source.text)?,
    };
    let mut out = Vec::new();
    for line in lines {
        out.push(rows.read(line, &out)?);
    }
    rows.check_count(&out, end)?;
    check_unit(&out, end)?;
    Ok(out)
}

/// What stands between the cells, as the header has it.
fn separator(header: &str) -> char {
    let stands = |separator: &char| header.contains(*separator);
    [';', '\t'].into_iter().find(stands).unwrap_or(',')
}

/// Which cell of a row holds the place and which the deviation.
fn columns(
    text: &str,
    header: Range<usize>,
    names: [&'static str; 2],
    separator: char,
) -> Result<[usize; 2]> {
    let cells = cells(text, header.clone(), separator);
    for cell in &cells {
        let name = &text[cell.clone()];
        if !names.contains(&name) {
            let near = nearest(name, names).unwrap_or_default();
            let message = format!("unknown column {name:?}");
            return Err(fault(Fault::UnknownKey, name, message, cell.clone())
                .with_values(format!("`{name}`"), names.join(", "))
                .with_hint(if near.is_empty() {
                    String::new()
                } else {
                    format!("the nearest column is `{near}`")
                })
                .into());
        }
    }
    let place = |name: &str| {
        let mut places = (0..cells.len()).filter(|&i| &text[cells[i].clone()] == name);
        match (places.next(), places.next()) {
            (Some(place), None) => Ok(place),
            (found, _) => {
                let often = found.map_or("is missing", |_| "stands twice");
                let message = format!("the column {name} {often}");
                Err(Box::new(
                    fault(Fault::MissingKey, name, message, header.clone())
                        .with_values(format!("`{}`", &text[header.clone()]), names.join(",")),
                ))
            }
        }
    };
    Ok([place(names[0])?, place(names[1])?])
}

fn fault(fault: Fault, column: &str, message: impl Into<String>, span: Range<usize>) -> Diagnostic {
    Diagnostic::new(fault, column, message).with_span(span)
}

/// The lines that say something, without outer blanks.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut at = 0;
    text.split('\n').filter_map(move |line| {
        let start = at;
        at += line.len() + 1;
        let span = trimmed(text, start..start + line.len());
        (!span.is_empty() && !text[span.clone()].starts_with('#')).then_some(span)
    })
}

fn cells(text: &str, line: Range<usize>, separator: char) -> Vec<Range<usize>> {
    let mut at = line.start;
    text[line]
        .split(separator)
        .map(|cell| {
            let start = at;
            at += cell.len() + 1;
            trimmed(text, start..start + cell.len())
        })
        .collect()
}

pub(super) fn trimmed(text: &str, span: Range<usize>) -> Range<usize> {
    let part = &text[span.clone()];
    let start = span.start + (part.len() - part.trim_start().len());
    start..start + part.trim().len()
}
