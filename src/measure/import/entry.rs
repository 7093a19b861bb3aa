//! Rows of a measurement file that a table gives.

use std::collections::HashMap;

use super::numbers::rounded;
use super::wanted::ShareOf;
use super::{ImportError, Wanted, cell_name};
use crate::measure::{Place, Quantity, Subject};

/// One of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Id of the test.
    pub test: String,
    /// What was measured on.
    pub member: Subject,
    /// Pinion revolutions.
    pub cycles: f64,
    /// What was measured.
    pub quantity: Quantity,
    /// Where, if the quantity has places.
    pub position: Option<f64>,
    /// In the quantity's own unit.
    pub value: f64,
    /// One standard deviation, in the same unit.
    pub sigma: Option<f64>,
    /// Name of the trace; empty for none.
    pub trace: String,
    /// Place across the face as it is written; empty for none.
    pub face: String,
    /// Label of the tooth; empty for none.
    pub tooth: String,
    /// Number of the repeated measurement that it is of.
    pub repeat: Option<u32>,
    /// Row and column of the value in the table, counted from 0.
    pub cell: (usize, usize),
}

impl Entry {
    /// The name of the trace of all that was measured at the same time as this, and at the place across the face that the user states.
    pub(super) fn own_trace(&self, wanted: &Wanted<'_>) -> String {
        let what = match self.quantity {
            Quantity::WearDepth => String::new(),
            other => format!("{}-", other.name()),
        };
        let tooth = match self.tooth.as_str() {
            "" => String::new(),
            tooth => format!("-tooth{tooth}"),
        };
        let place = match wanted.face {
            Some(face) if self.quantity.is_at_a_place_across_the_face() => format!("-face{face}"),
            _ => String::new(),
        };
        format!(
            "{}-{}-{what}{}{tooth}{place}",
            self.test,
            self.member.name(),
            self.cycles
        )
    }

    /// What it has in common with all that was measured on its curve: along a flank, or of a whole member over the test.
    fn curve(&self) -> (String, Subject, u64, Quantity, [String; 3]) {
        let labels = [&self.trace, &self.face, &self.tooth].map(String::clone);
        let cycles = match self.quantity.place() {
            Place::Whole => 0,
            _ => self.cycles.to_bits(),
        };
        (
            self.test.clone(),
            self.member,
            cycles,
            self.quantity,
            labels,
        )
    }

    /// Its row, with or without the columns `face` and `tooth`.
    fn line(&self, [face, tooth]: [bool; 2]) -> String {
        let number = |number: Option<f64>| number.map_or_else(String::new, |n| n.to_string());
        let mut line = format!(
            "{},{},{},{},{},{},{},{}",
            quoted(&self.test),
            self.member.name(),
            self.cycles,
            self.quantity.name(),
            number(self.position),
            rounded(self.value),
            number(self.sigma),
            quoted(&self.trace)
        );
        for (field, is_there) in [(&self.face, face), (&self.tooth, tooth)] {
            if is_there {
                line.push(',');
                line += &quoted(field);
            }
        }
        line
    }
}

/// The header and the rows of a measurement file with these entries.
pub fn lines(entries: &[Entry]) -> (String, Vec<String>) {
    let some = |field: fn(&Entry) -> &String| entries.iter().any(|entry| !field(entry).is_empty());
    let optional = [some(|entry| &entry.face), some(|entry| &entry.tooth)];
    let mut header = "test,member,cycles,quantity,position,value,sigma,trace".to_owned();
    for (name, is_there) in ["face", "tooth"].into_iter().zip(optional) {
        if is_there {
            header.push(',');
            header += name;
        }
    }
    (
        header,
        entries.iter().map(|entry| entry.line(optional)).collect(),
    )
}

/// Refuses two equal entries at the same place and time of one trace; other values there are repeats.
pub(super) fn refuse_twice(entries: &[Entry]) -> Result<(), ImportError> {
    let mut first = HashMap::new();
    for entry in entries {
        let key = (
            (
                &entry.test,
                entry.member,
                entry.cycles.to_bits(),
                entry.quantity,
                entry.value.to_bits(),
            ),
            (
                entry.position.map(f64::to_bits),
                &entry.trace,
                &entry.face,
                &entry.tooth,
                entry.repeat,
            ),
        );
        if let Some((row, column)) = first.insert(key, entry.cell) {
            let place = entry
                .position
                .map_or_else(String::new, |at| format!(" at {at}"));
            return Err(ImportError(format!(
                "{} and {} both hold the same {} of the {} in test {} after {} pinion revolutions{place}: take one out, or tell two measurements \
                 apart by a column `trace` (or `tooth`)",
                cell_name(row, column),
                cell_name(entry.cell.0, entry.cell.1),
                entry.quantity.name(),
                entry.member.name(),
                entry.test,
                entry.cycles
            )));
        }
    }
    Ok(())
}

/// Least part of the largest sigma of a curve that another may have where it is a share of the value alone.
const LEAST_PART: f64 = 0.01;

/// Gives the entries without a standard deviation the one that the user states.
pub(super) fn state_sigma(entries: &mut [Entry], wanted: &Wanted<'_>) -> Result<(), ImportError> {
    if !wanted.states_sigma() {
        return Ok(());
    }
    if let Some(sigma) = wanted.sigma {
        refuse_far_too_large(entries, sigma)?;
    }
    let mut largest: HashMap<_, f64> = HashMap::new();
    for entry in entries.iter() {
        let most = largest.entry(entry.curve()).or_default();
        *most = most.max(entry.value.abs());
    }
    let share = wanted.relative_sigma;
    for entry in entries.iter_mut().filter(|entry| entry.sigma.is_none()) {
        let largest = largest[&entry.curve()];
        let relative = share
            * match wanted.relative_to {
                ShareOf::Value => entry.value.abs(),
                ShareOf::Largest => largest,
            };
        let sigma = match wanted.sigma {
            Some(sigma) => sigma.hypot(relative),
            None if relative <= LEAST_PART * share * largest => {
                return Err(ImportError(format!(
                    "{}: {share} of the value {} would be known far better than the others of its curve: add --sigma, the scatter where little is \
                     worn, or --relative-to largest",
                    cell_name(entry.cell.0, entry.cell.1),
                    rounded(entry.value)
                )));
            }
            None => relative,
        };
        entry.sigma = Some(four_digits(sigma));
    }
    Ok(())
}

/// So many values of a table, all below half of their standard deviation, are no noise of that size.
const FEWEST: usize = 8;

/// Refuses a stated standard deviation beside which nothing at all was measured: it is in another unit.
fn refuse_far_too_large(entries: &[Entry], sigma: f64) -> Result<(), ImportError> {
    for quantity in Quantity::ALL {
        let own = || entries.iter().filter(|entry| entry.quantity == quantity);
        let largest = own().map(|entry| entry.value.abs()).fold(0.0, f64::max);
        let is_far_too_large = largest > 0.0 && 2.0 * largest < sigma;
        if is_far_too_large && own().count() >= FEWEST {
            let (name, unit) = (quantity.name(), quantity.shown_unit());
            return Err(ImportError(format!(
                "--sigma {sigma}: this is {:.0} times the largest {name} of the table, {} {unit}; --sigma takes one standard deviation in {unit}, \
                 whatever the unit of the table",
                sigma / largest,
                rounded(largest)
            )));
        }
    }
    Ok(())
}

/// Gives the entries the place across the face that the user states.
pub(super) fn state_face(entries: &mut [Entry], wanted: &Wanted<'_>) -> Result<(), ImportError> {
    let Some(face) = wanted.face else {
        return Ok(());
    };
    let is_there = |entry: &Entry| entry.quantity.is_at_a_place_across_the_face();
    if let Some(first) = entries.first()
        && !entries.iter().any(is_there)
    {
        return Err(ImportError(format!(
            "--face is for what is measured at one place across the face; {} is of the whole face: leave it out",
            first.quantity.name()
        )));
    }
    for entry in entries.iter_mut().filter(|entry| is_there(entry)) {
        entry.face = face.to_string();
    }
    Ok(())
}

/// As many as a standard deviation is ever known to.
pub(super) fn four_digits(sigma: f64) -> f64 {
    format!("{sigma:.3e}").parse().unwrap_or(sigma)
}

/// The names of the traces of repeated measurements.
pub(super) fn name_repeats(entries: &mut [Entry]) {
    for entry in entries.iter_mut().filter(|entry| !entry.trace.is_empty()) {
        if let Some(repeat) = entry.repeat {
            entry.trace += &format!("-r{repeat}");
        }
    }
}

pub(super) fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
