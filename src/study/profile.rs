//! `profile_file`: the measured deviation of a flank as the member's unworn profile.
//!
//! ```text
//! radius,deviation          mm, µm; # starts a comment line
//! 27.9,0.4                  positive: material is missing, normal to the flank, against the involute
//! 28.1,1.1
//! ```
//! `lead_file` of [face.pinion] and [face.gear] is the same over the place across the face (`face,deviation`, mm from mid-face), and
//! `pitch_file` of [teeth.pinion] and [teeth.gear] over the teeth (`tooth,deviation`), one row for each from 1 on.
//! Between the rows the deviation is a straight line over the curvature radius (steps of the path of contact); beyond the
//! first and last row it stays as there.

use std::ops::Range;
use std::path::Path;

use super::quantity::Short;
use crate::gear::Gear;
use crate::source_text::{self, Diagnostic, Fault, Source, TextError, Wanted, nearest};

/// The file, to whoever cannot read it.
const WANTED: Wanted = Wanted {
    what: "profile file",
    ending: "csv",
    format: "CSV",
    hint: "profile_file in [gears.pinion] or [gears.gear] names it, relative to the study file",
};

/// The file of a measured lead, to whoever cannot read it.
const WANTED_LEAD: Wanted = Wanted {
    what: "lead file",
    ending: "csv",
    format: "CSV",
    hint: "lead_file in [face.pinion] or [face.gear] names it, relative to the study file",
};

/// The file of measured pitch deviations, to whoever cannot read it.
const WANTED_PITCH: Wanted = Wanted {
    what: "pitch file",
    ending: "csv",
    format: "CSV",
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

/// Largest deviation over the module; as for tip relief.
const LARGEST: f64 = 0.1;

/// Largest deviation, µm, below which a file was not written in µm: no measuring machine resolves it.
const LEAST_UM: f64 = 0.1;

/// Rounding of a radius that a file may have at the form and the tip circle, mm.
const ROUNDING: f64 = 1e-3;

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

fn rows(source: &Source, along: Along<'_>) -> Result<Vec<[f64; 2]>> {
    let names = along.columns();
    let gear = along.gear();
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
    let order = columns(&source.text, header, names)?;
    let mut out: Vec<[f64; 2]> = Vec::new();
    for line in lines {
        let cells = cells(&source.text, line.clone());
        if cells.len() != 2 {
            let message = format!("{} cells in a row of two", cells.len());
            return Err(fault(Fault::BadValue, "", message, line)
                .with_values("", names.join(","))
                .into());
        }
        let number = |column: usize| -> Result<f64> {
            let span = cells[order[column]].clone();
            let text = &source.text[span.clone()];
            match text.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                _ => {
                    let name = names[column];
                    let message = format!("{name} {text:?} is not a finite number");
                    let wanted = ["a number in mm", "a number in um"][column];
                    Err(fault(Fault::BadValue, name, message, span)
                        .with_values(text, wanted)
                        .into())
                }
            }
        };
        let (radius, deviation) = (number(0)?, number(1)?);
        match along {
            Along::Profile(gear) => {
                check_radius(radius, gear, out.last(), cells[order[0]].clone())?
            }
            Along::Face(width, _) => {
                check_face(radius, width, out.last(), cells[order[0]].clone())?
            }
            Along::Teeth(gear) => check_tooth(radius, gear, out.len(), cells[order[0]].clone())?,
        }
        let most = 1e3 * LARGEST * gear.rack.module;
        if deviation.abs() > most {
            let message = format!("deviation {} um is out of range", Short(deviation));
            return Err(fault(
                Fault::BadValue,
                "deviation",
                message,
                cells[order[1]].clone(),
            )
            .with_values(
                format!("{} um", Short(deviation)),
                format!("-{most} to {most} um, a tenth of the module"),
            )
            .with_hint("deviations are in micrometres, positive with material missing")
            .into());
        }
        out.push([radius, 1e-3 * deviation]);
    }
    if let Along::Teeth(gear) = along
        && out.len() < gear.spec.teeth as usize
    {
        let message = format!("a pitch chart of {} teeth", out.len());
        return Err(fault(Fault::Inconsistent, "tooth", message, end..end)
            .with_values(
                format!("{} rows", out.len()),
                format!("{} rows, one for each tooth", gear.spec.teeth),
            )
            .into());
    }
    if out.len() < 2 {
        let message = format!("a measured deviation of {} rows", out.len());
        return Err(fault(Fault::MissingKey, "", message, end..end)
            .with_values("", "at least two rows")
            .into());
    }
    let largest = out
        .iter()
        .fold(0.0, |m: f64, row| m.max(1e3 * row[1].abs()));
    if largest > 0.0 && largest < LEAST_UM {
        let message = format!(
            "the largest deviation is {} um: these look like millimetres",
            Short(largest)
        );
        return Err(fault(Fault::BadValue, "deviation", message, end..end)
            .with_values(format!("{} um at most", Short(largest)), "micrometres")
            .with_hint("1 mm = 1000 um: write 12 for 0.012 mm")
            .into());
    }
    Ok(out)
}

fn check_radius(
    radius: f64,
    gear: &Gear,
    before: Option<&[f64; 2]>,
    span: Range<usize>,
) -> Result<()> {
    let (least, most) = (gear.form_radius, gear.tip_radius);
    let found = format!("{radius} mm");
    if radius < least - ROUNDING || radius > most + ROUNDING {
        let message = format!("radius {radius} mm is off the flank");
        let hint = match radius {
            r if r > 0.0 && (least..=most).contains(&(1e3 * r)) => {
                "this looks like metres: write millimetres"
            }
            r if (least..=most).contains(&(1e-3 * r)) => {
                "this looks like micrometres: write millimetres"
            }
            r if (least..=most).contains(&(0.5 * r)) => "this looks like a diameter",
            _ => "",
        };
        return Err(fault(Fault::BadValue, "radius", message, span)
            .with_values(found, format!("{least:.4} to {most:.4} mm"))
            .with_hint(hint)
            .into());
    }
    match before {
        Some([previous, _]) if radius <= *previous => {
            let message = format!("radius {radius} mm after {previous} mm");
            Err(fault(Fault::BadValue, "radius", message, span)
                .with_values(found, format!("above {previous} mm: radii ascend"))
                .into())
        }
        _ => Ok(()),
    }
}

fn check_face(place: f64, width: f64, before: Option<&[f64; 2]>, span: Range<usize>) -> Result<()> {
    let half = 0.5 * width;
    let found = format!("{place} mm");
    if place.abs() > half + ROUNDING {
        let message = format!("face {place} mm is off the face");
        let hint = match place {
            p if p > 0.0 && p <= width + ROUNDING => {
                "places count from mid-face: take off half of the width"
            }
            p if p.abs() > 50.0 * half && p.abs() <= 1e3 * half => {
                "this may be in micrometres: write millimetres"
            }
            _ => "",
        };
        return Err(fault(Fault::BadValue, "face", message, span)
            .with_values(found, format!("-{half} to {half} mm"))
            .with_hint(hint)
            .into());
    }
    match before {
        Some([previous, _]) if place <= *previous => {
            let message = format!("face {place} mm after {previous} mm");
            Err(fault(Fault::BadValue, "face", message, span)
                .with_values(found, format!("above {previous} mm: places ascend"))
                .into())
        }
        _ => Ok(()),
    }
}

fn check_tooth(tooth: f64, gear: &Gear, before: usize, span: Range<usize>) -> Result<()> {
    let (next, count) = (before + 1, gear.spec.teeth as usize);
    if next <= count && tooth == next as f64 {
        return Ok(());
    }
    let (message, wanted) = if next > count {
        let message = format!("tooth {} of a gear of {count} teeth", Short(tooth));
        (message, format!("{count} rows, one for each tooth"))
    } else {
        let message = format!("tooth {} where tooth {next} should stand", Short(tooth));
        (message, format!("{next}: teeth ascend by one, from 1"))
    };
    Err(fault(Fault::Inconsistent, "tooth", message, span)
        .with_values(Short(tooth).to_string(), wanted)
        .with_hint("teeth are numbered from 1 in the order in which they come into mesh")
        .into())
}

/// Which cell of a row holds the place and which the deviation.
fn columns(text: &str, header: Range<usize>, names: [&'static str; 2]) -> Result<[usize; 2]> {
    let cells = cells(text, header.clone());
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

fn cells(text: &str, line: Range<usize>) -> Vec<Range<usize>> {
    let mut at = line.start;
    text[line]
        .split(',')
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
