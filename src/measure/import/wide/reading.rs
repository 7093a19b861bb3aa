//! From the cells of a wide table to rows of a measurement file.

use super::grid::{Grid, Places};
use super::{Across, Result};
use crate::measure::Quantity;
use crate::measure::import::entry::Entry;
use crate::measure::import::multiples::Multiple;
use crate::measure::import::numbers::{number, rounded};
use crate::measure::import::wanted::Wanted;

/// How the numbers of a wide table are read.
pub(super) struct Reading<'a> {
    pub(super) wanted: &'a Wanted<'a>,
    /// Id of the test.
    pub(super) test: &'a str,
    pub(super) quantity: Quantity,
    pub(super) across: Across,
    pub(super) places: &'a Places<'a>,
    /// From a value in the table to the quantity's own unit and sign.
    pub(super) factor: f64,
    /// Whether the checkpoints are revolutions of the gear.
    pub(super) of_gear: bool,
    /// The revolutions that their numbers stand for, if it is not one each.
    pub(super) multiple: Option<&'a Multiple>,
}

impl Reading<'_> {
    /// A row for each cell with a value, column by column, and the number of cells without one.
    pub(super) fn entries(&self, grid: &Grid<'_>) -> Result<(Vec<Entry>, usize)> {
        let mut entries = Vec::new();
        let mut empty = 0;
        for &(column, in_header) in &grid.across {
            for &(row, first) in &grid.down {
                let text = grid.cell(row, column);
                if text.is_empty() {
                    empty += 1;
                    continue;
                }
                let value = self.factor * number(text, row, column)?;
                let (cycles, place) = match self.across {
                    Across::Checkpoints => (in_header, first),
                    Across::Positions => (first, in_header),
                };
                entries.push(self.entry((row, column), cycles, place, value)?);
            }
        }
        Ok((entries, empty))
    }

    fn entry(&self, cell: (usize, usize), cycles: f64, place: f64, value: f64) -> Result<Entry> {
        let places = self.places;
        let position = places.kind.position(places.scale * place, places.gear);
        Ok(Entry {
            test: self.test.to_owned(),
            member: places.member,
            cycles: self.revolutions(cycles)?,
            quantity: self.quantity,
            position: Some(rounded(position)),
            value,
            sigma: None,
            trace: String::new(),
            face: String::new(),
            tooth: self.wanted.tooth.clone().unwrap_or_default(),
            repeat: self.wanted.repeat,
            cell,
        })
    }

    /// Revolutions of the pinion at a checkpoint of the table.
    pub(super) fn revolutions(&self, cycles: f64) -> Result<f64> {
        let cycles = match self.multiple {
            Some(multiple) => multiple.revolutions(cycles)?,
            None => cycles,
        };
        Ok(match self.of_gear {
            true => self.wanted.pinion_revolutions(self.test, cycles),
            false => cycles,
        })
    }
}
