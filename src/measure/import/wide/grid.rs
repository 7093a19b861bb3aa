//! The columns and rows of a wide table with the number of each, and which of both are places.

use super::{
    Across, Result, across_numbers, checkpoint, down_numbers, from_to, refuse_twice_in_a_line,
};
use crate::gear::Gear;
use crate::measure::import::numbers::plain_cycles;
use crate::measure::import::place::PositionKind;
use crate::measure::import::wanted::Wanted;
use crate::measure::import::{ImportError, Sheet, cell_name, units};
use crate::measure::{Quantity, Subject};

/// How places on a flank are told.
pub(super) struct Places<'a> {
    pub(super) kind: PositionKind,
    /// From a number in the table to its place.
    pub(super) scale: f64,
    /// The gear of the flank; none where they are places in a rotation.
    pub(super) gear: Option<&'a Gear>,
    pub(super) member: Subject,
}

impl<'a> Places<'a> {
    /// As the user and the header of the first column, `corner`, state them.
    pub(super) fn of(
        (quantity, member): (Quantity, Subject),
        wanted: &'a Wanted<'_>,
        corner: &str,
    ) -> Result<Self> {
        let kind = PositionKind::of(quantity, wanted.position, corner);
        let scale = match kind.has_unit() {
            true => units::of_position(corner, kind == PositionKind::RollAngle)?,
            false => 1.0,
        };
        Ok(Self {
            kind,
            scale,
            gear: wanted.gear_of(member),
            member,
        })
    }

    /// Whether all of the numbers can be such places.
    fn hold(&self, numbers: &[f64]) -> bool {
        match self.gear {
            Some(gear) if self.kind == PositionKind::Teeth => {
                let teeth = gear.spanned_teeth();
                numbers
                    .iter()
                    .all(|&n| teeth.iter().any(|&teeth| f64::from(teeth) == n))
            }
            Some(gear) => numbers.iter().all(|&n| {
                let radius = self.kind.position(self.scale * n, Some(gear));
                (gear.form_radius - 0.01..=gear.tip_radius + 0.01).contains(&radius)
            }),
            None => numbers.iter().all(|n| (0.0..=1.0).contains(n)),
        }
    }

    /// What such numbers are, in words.
    fn words(&self, corner: &str) -> String {
        match self.gear {
            Some(_) if self.kind == PositionKind::Teeth => {
                "numbers of teeth that a span goes over".to_owned()
            }
            Some(gear) => {
                let unit = units::name_and_unit(corner).1;
                let kind = match &unit {
                    Some(unit) => format!("{} in {unit}", self.kind.word()),
                    None => self.kind.name().to_owned(),
                };
                format!(
                    "radii of the {}'s flank ({:.3} to {:.3} mm), read as {kind}",
                    self.member.name(),
                    gear.form_radius,
                    gear.tip_radius
                )
            }
            None => "rotations (0 to 1 base pitch)".to_owned(),
        }
    }
}

/// The cells of a wide table below and beside its header.
pub(super) struct Grid<'s> {
    sheet: &'s Sheet,
    /// Row of the header.
    head: usize,
    /// The columns with the number in the header of each.
    pub(super) across: Vec<(usize, f64)>,
    /// The rows with the number in the first cell of each.
    pub(super) down: Vec<(usize, f64)>,
}

impl<'s> Grid<'s> {
    pub(super) fn of(sheet: &'s Sheet, head: usize) -> Result<Self> {
        Ok(Self {
            sheet,
            head,
            across: across_numbers(sheet, head)?,
            down: down_numbers(sheet, head)?,
        })
    }

    pub(super) fn cell(&self, row: usize, column: usize) -> &'s str {
        self.sheet.rows[row].get(column).map_or("", String::as_str)
    }

    /// The header of the first column.
    pub(super) fn corner(&self) -> &'s str {
        &self.sheet.rows[self.head][0]
    }

    /// The headers of the other columns.
    pub(super) fn headers(&self) -> Vec<&'s str> {
        let columns = self.across.iter();
        columns
            .map(|&(column, _)| self.cell(self.head, column))
            .collect()
    }

    /// The numbers of the columns and of the rows.
    pub(super) fn numbers(&self) -> [Vec<f64>; 2] {
        [&self.across, &self.down].map(|lines| lines.iter().map(|line| line.1).collect())
    }

    /// What the columns are, as the user states it or by where their numbers and those of the rows can stand on the flank.
    pub(super) fn orientation(
        &self,
        places: &Places<'_>,
        stated: Option<Across>,
    ) -> Result<Across> {
        match (stated, self.orientation_by_numbers(places)) {
            (None, by_numbers) => by_numbers,
            (Some(stated), Ok(other)) if stated != other => Err(stated_otherwise(stated)),
            (Some(stated), _) => Ok(stated),
        }
    }

    fn orientation_by_numbers(&self, places: &Places<'_>) -> Result<Across> {
        let [columns, rows] = self.numbers();
        let what = places.words(self.corner());
        match (places.hold(&rows), places.hold(&columns)) {
            (true, false) => Ok(Across::Checkpoints),
            (false, true) => Ok(Across::Positions),
            (true, true) => Err(ImportError(format!(
                "both the first column and the header could be {what}: say --columns checkpoints or --columns positions"
            ))),
            (false, false) => {
                let [[row_from, row_to], [from, to]] = [from_to(&rows), from_to(&columns)];
                Err(ImportError(format!(
                    "neither the first column ({row_from} to {row_to}) nor the header ({from} to {to}) are {what}: look at --member, at \
                     --position and at the unit in the header"
                )))
            }
        }
    }

    /// Refuses numbers that stand twice, and checkpoints that are no plain numbers of revolutions.
    pub(super) fn refuse_unclear(&self, across: Across, quantity: Quantity) -> Result<()> {
        let head = self.head;
        refuse_twice_in_a_line(&self.across, |column| cell_name(head, column))?;
        refuse_twice_in_a_line(&self.down, |row| cell_name(row, 0))?;
        match across {
            Across::Checkpoints => (self.across.iter()).try_for_each(|&(column, _)| {
                checkpoint(self.cell(head, column), quantity, head, column)
            }),
            Across::Positions => {
                (self.down.iter()).try_for_each(|&(row, _)| plain_cycles(self.cell(row, 0), row, 0))
            }
        }
    }
}

/// The numbers of a table say that its columns are not what is stated.
fn stated_otherwise(stated: Across) -> ImportError {
    let (stated, places) = match stated {
        Across::Checkpoints => ("checkpoints", "header"),
        Across::Positions => ("positions", "first column"),
    };
    ImportError(format!(
        "--columns {stated}: only the numbers of the {places} can be positions; leave --columns out, or say the other"
    ))
}
