//! The rows of a file of measured deviations, each checked against the flank, the face or the teeth that it is of.

use std::ops::Range;

use super::{Along, Result, cells, fault};
use crate::gear::Gear;
use crate::source_text::{Diagnostic, Fault};
use crate::study::quantity::Short;

/// Largest deviation over the module; as for tip relief.
const LARGEST: f64 = 0.1;

/// Largest deviation, µm, below which a file was not written in µm: no measuring machine resolves it.
const LEAST_UM: f64 = 0.1;

/// Rounding of a radius that a file may have at the form and the tip circle, mm.
const ROUNDING: f64 = 1e-3;

/// How the rows of a file are read.
pub(super) struct Rows<'a> {
    pub(super) text: &'a str,
    pub(super) along: Along<'a>,
    /// Which cell of a row holds the place and which the deviation.
    pub(super) order: [usize; 2],
    /// What stands between the cells.
    pub(super) separator: char,
    pub(super) decimal_comma: bool,
}

impl Rows<'_> {
    /// Place and missing material (mm) of the row `line`, after those `before` it.
    pub(super) fn read(&self, line: Range<usize>, before: &[[f64; 2]]) -> Result<[f64; 2]> {
        let cells = cells(self.text, line.clone(), self.separator);
        if cells.len() != 2 {
            return Err(self.miscounted(cells.len(), line));
        }
        let [at, deviating] = self.order.map(|cell| cells[cell].clone());
        let place = self.number(0, at.clone())?;
        let deviation = self.number(1, deviating.clone())?;
        match self.along {
            Along::Profile(gear) => check_radius(place, gear, before.last(), at)?,
            Along::Face(width, _) => check_face(place, width, before.last(), at)?,
            Along::Teeth(gear) => check_tooth(place, gear, before.len(), at)?,
        }
        check_size(deviation, self.along.gear(), deviating)?;
        Ok([place, 1e-3 * deviation])
    }

    /// Refuses a row of `count` cells.
    fn miscounted(&self, count: usize, line: Range<usize>) -> Box<Diagnostic> {
        let written = &self.text[line.clone()];
        let between = match self.separator {
            ';' => "a semicolon",
            '\t' => "a tab",
            _ => "a comma",
        };
        let message = match count {
            1 => format!("the row `{written}` has one cell, not two"),
            count => format!("the row `{written}` has {count} cells, not two"),
        };
        let hint = if count > 2 && self.separator == ',' {
            "; decimals are written with a point then, or semicolons stand between all columns"
        } else {
            ""
        };
        let wanted = self.along.columns().join(&self.separator.to_string());
        Box::new(
            fault(Fault::BadValue, "", message, line)
                .with_values("", wanted)
                .with_hint(format!(
                    "{between} stands between the two, as in the header{hint}"
                )),
        )
    }

    fn number(&self, column: usize, span: Range<usize>) -> Result<f64> {
        let text = &self.text[span.clone()];
        let point = if self.decimal_comma {
            text.replace(',', ".")
        } else {
            text.to_owned()
        };
        match point.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => {
                let name = self.along.columns()[column];
                let message = format!("{name} {text:?} is not a finite number");
                let wanted = match (&self.along, column) {
                    (_, 1) => "a number in µm",
                    (Along::Teeth(_), _) => "the number of a tooth",
                    _ => "a number in mm",
                };
                Err(fault(Fault::BadValue, name, message, span)
                    .with_values(text, wanted)
                    .into())
            }
        }
    }

    /// Refuses fewer rows than there are teeth, or than a deviation needs; `end`: where the file ends.
    pub(super) fn check_count(&self, rows: &[[f64; 2]], end: usize) -> Result<()> {
        if let Along::Teeth(gear) = self.along
            && rows.len() < gear.spec.teeth as usize
        {
            let message = format!("a pitch chart of {} teeth", rows.len());
            return Err(fault(Fault::Inconsistent, "tooth", message, end..end)
                .with_values(
                    format!("{} rows", rows.len()),
                    format!("{} rows, one for each tooth", gear.spec.teeth),
                )
                .into());
        }
        if rows.len() < 2 {
            let message = format!("a measured deviation of {} rows", rows.len());
            return Err(fault(Fault::MissingKey, "", message, end..end)
                .with_values("", "at least two rows")
                .into());
        }
        Ok(())
    }
}

/// Refuses deviations that look like millimetres; `end`: where the file ends.
pub(super) fn check_unit(rows: &[[f64; 2]], end: usize) -> Result<()> {
    let largest = rows
        .iter()
        .fold(0.0, |m: f64, row| m.max(1e3 * row[1].abs()));
    if largest > 0.0 && largest < LEAST_UM {
        let message = format!(
            "the largest deviation is {} µm: these look like millimetres",
            Short(largest)
        );
        return Err(fault(Fault::BadValue, "deviation", message, end..end)
            .with_values(format!("{} µm at most", Short(largest)), "micrometres")
            .with_hint("1 mm = 1000 µm: write 12 for 0.012 mm")
            .into());
    }
    Ok(())
}

/// Refuses a deviation, um, that no flank of the gear has.
fn check_size(deviation: f64, gear: &Gear, span: Range<usize>) -> Result<()> {
    let most = 1e3 * LARGEST * gear.rack.module;
    if deviation.abs() > most {
        let message = format!("deviation {} µm is out of range", Short(deviation));
        return Err(fault(Fault::BadValue, "deviation", message, span)
            .with_values(
                format!("{} µm", Short(deviation)),
                format!("-{most} to {most} µm, a tenth of the module"),
            )
            .with_hint("deviations are in micrometres, positive with material missing")
            .into());
    }
    Ok(())
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
