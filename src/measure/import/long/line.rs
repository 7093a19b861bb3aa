//! One row of a long table as an entry.

use super::{Read, repeats};
use crate::measure::import::columns::Column;
use crate::measure::import::entry::Entry;
use crate::measure::import::flank::Flank;
use crate::measure::import::multiples::Multiple;
use crate::measure::import::numbers::{number, plain_count_of, rounded};
use crate::measure::import::place::{PositionKind, on_flank};
use crate::measure::import::titles::Titles;
use crate::measure::import::wanted::Wanted;
use crate::measure::import::{ImportError, Sheet, cell_name, sigma_unit, units};
use crate::measure::{Place, Quantity, Subject, names};

type Result<T> = std::result::Result<T, ImportError>;

/// One row of a long table.
pub(super) struct Line<'t> {
    pub(super) read: &'t Read<'t>,
    pub(super) sheet: &'t Sheet,
    pub(super) row: usize,
    pub(super) wanted: &'t Wanted<'t>,
}

impl Line<'_> {
    fn text(&self, column: Option<&Column>) -> &str {
        let cell = column.and_then(|column| self.sheet.rows[self.row].get(column.at));
        cell.map_or("", String::as_str)
    }

    fn refused<T>(&self, column: &Column, why: &str) -> Result<T> {
        let cell = cell_name(self.row, column.at);
        let found = match self.text(Some(column)) {
            "" => "nothing stands here".to_owned(),
            text => format!("`{text}`"),
        };
        Err(ImportError(format!(
            "{cell}: {found} below `{}`: {why}",
            column.written
        )))
    }

    /// Its entry.
    pub(super) fn entry(
        &self,
        single: Option<Quantity>,
        titles: &Titles,
        turned: bool,
    ) -> Result<Entry> {
        let Read {
            cycles,
            value,
            sigma,
            ..
        } = *self.read;
        let quantity = match (single, self.read.quantity) {
            (None, Some(column)) => match names::quantity(self.text(Some(column))) {
                Some((quantity, _)) => quantity,
                None => {
                    let known = Quantity::ALL.map(Quantity::name);
                    return self
                        .refused(column, &format!("the quantities are {}", known.join(", ")));
                }
            },
            (quantity, _) => quantity.unwrap_or(Quantity::WearDepth),
        };
        let member = self.member(quantity)?;
        let (unit, _) = (self.wanted)
            .unit_of_values(quantity, value.unit.as_deref(), titles.unit.as_deref())
            .map_err(|error| {
                ImportError(format!(
                    "{}, with row {} of {}: {error}",
                    value.cell(self.read.head),
                    self.row + 1,
                    quantity.name()
                ))
            })?;
        let factor = units::factor(&unit, quantity).unwrap_or(1.0);
        let sign = if turned && (single.is_some() || quantity.is_wear()) {
            -1.0
        } else {
            1.0
        };
        let written = number(self.text(Some(value)), self.row, value.at)?;
        let written_sigma = match (sigma, self.text(sigma)) {
            (None, _) | (_, "") => None,
            (Some(column), text) => {
                let factor = sigma_unit::factor(
                    column,
                    value.unit.as_deref(),
                    (self.read.head, quantity),
                    self.wanted,
                )?;
                Some(rounded(factor * number(text, self.row, column.at)?))
            }
        };
        if let Some(column) = sigma
            && self.wanted.states_sigma()
            && !self.wanted.sigma_of_others
        {
            return Err(ImportError(format!(
                "--sigma or --relative-sigma: the table has a column of sigma, {}; leave one of them out",
                column.cell(self.read.head)
            )));
        }
        let value_here = rounded(sign * factor * written);
        let test = self.test()?;
        Ok(Entry {
            cycles: self.cycles(cycles, &test)?,
            test,
            member,
            quantity,
            position: self.position(quantity, member)?,
            value: value_here,
            sigma: written_sigma,
            trace: self.text(self.read.trace).to_owned(),
            face: self.text(self.read.face).replace(',', "."),
            tooth: self.text(self.read.tooth).to_owned(),
            repeat: self.repeat()?,
            cell: (self.row, value.at),
        })
    }

    fn repeat(&self) -> Result<Option<u32>> {
        let Some(column) = self.read.repeat else {
            return Ok(self.wanted.repeat);
        };
        match self.wanted.repeat {
            Some(stated) => Err(ImportError(format!(
                "--repeat {stated}: the table has a column of repeats, {}; leave the option out",
                column.cell(self.read.head)
            ))),
            None => Ok(repeats::number(self.text(Some(column)))),
        }
    }

    fn test(&self) -> Result<String> {
        let Some(column) = self.read.test else {
            return Ok(self.wanted.one_test(self.sheet)?.0);
        };
        let text = self.text(Some(column));
        let Some(id) = self.wanted.test_of(text) else {
            let why = match text {
                "" => "every row says of which test it is".to_owned(),
                text => self.wanted.no_test(text).0,
            };
            return self.refused(column, &why);
        };
        match self.wanted.test {
            Some(stated) if stated != id => self.refused(
                column,
                &format!("--test says {stated}; leave it out, the table has a column of tests"),
            ),
            _ => Ok(id.to_owned()),
        }
    }

    fn member(&self, quantity: Quantity) -> Result<Subject> {
        let subjects = quantity.subjects();
        let Some(column) = self.read.member else {
            return Ok(self
                .wanted
                .stated_member(self.sheet, quantity)?
                .unwrap_or(Subject::Pinion));
        };
        let text = self.text(Some(column));
        let named = match column.numbered {
            true => names::numbered_member(text),
            false => names::member(text),
        };
        let Some(member) = named else {
            return self.refused(column, "write pinion, gear or pair (or small, big, Ritzel, Rad, pignone, corona, pignon, roue, ...)");
        };
        if !subjects.contains(&member) {
            let allowed: Vec<&str> = subjects.iter().map(|subject| subject.name()).collect();
            return self.refused(
                column,
                &format!(
                    "{} is measured on {}",
                    quantity.name(),
                    allowed.join(" or ")
                ),
            );
        }
        match self.wanted.member {
            Some(stated) if stated != member => self.refused(
                column,
                &format!(
                    "--member says {}; leave it out, the table has a column of members",
                    stated.name()
                ),
            ),
            _ => Ok(member),
        }
    }

    fn cycles(&self, column: &Column, test: &str) -> Result<f64> {
        let text = self.text(Some(column));
        let multiple = Multiple::of(&column.written, self.read.head, column.at);
        if let Some(unit) = &column.unit
            && column.hours.is_none()
            && !["1", "-"].contains(&unit.as_str())
            && names::member(unit).is_none()
            && names::revolutions(unit).is_none()
            && multiple.is_none()
        {
            return Err(ImportError(format!(
                "{}: cycles in {unit} are not read; write plain pinion revolutions, or the power of ten that they are counted in behind their name: `cycles [1e3]`",
                column.cell(self.read.head)
            )));
        }
        if text.is_empty() {
            return self.refused(
                column,
                "every row says after how many revolutions of the pinion it was measured",
            );
        }
        if self.wanted.decimal.is_none() && column.hours.is_none() && multiple.is_none() {
            plain_count_of(self.sheet, text, self.row, column.at)?;
        }
        let cycles = number(text, self.row, column.at)?;
        let cycles = match multiple {
            Some(multiple) => multiple.revolutions(cycles)?,
            None => cycles,
        };
        Ok(match column.hours {
            Some(hours) => self.wanted.revolutions_after(test, text, cycles, hours),
            None if column.of_gear => self.wanted.pinion_revolutions(test, cycles),
            None => cycles,
        })
    }

    fn position(&self, quantity: Quantity, member: Subject) -> Result<Option<f64>> {
        let text = self.text(self.read.position);
        let column = match (self.read.position, quantity.place()) {
            (Some(column), Place::Whole) if !text.is_empty() => {
                return self.refused(
                    column,
                    &format!("{} has no position; leave it empty", quantity.name()),
                );
            }
            (_, Place::Whole) => return Ok(None),
            (None, _) => {
                return Err(ImportError(format!(
                    "row {}: {} needs a column of positions (`radius [mm]`)",
                    self.row + 1,
                    quantity.name()
                )));
            }
            (Some(column), _) => column,
        };
        if text.is_empty() {
            return self.refused(
                column,
                "every row of a quantity with positions says where it was measured",
            );
        }
        let kind = PositionKind::of(quantity, self.wanted.position, &column.written);
        let scale = if kind.has_unit() {
            units::of_position(&column.written, kind == PositionKind::RollAngle)?
        } else {
            1.0
        };
        let gear = self.wanted.gear_of(member);
        let place = number(text, self.row, column.at)?;
        Ok(Some(rounded(kind.position(scale * place, gear))))
    }

    /// The flank that a place of this row should lie on, and the place as it is written.
    pub(super) fn flank(&self, entry: &Entry) -> Result<Option<(Flank<'_>, f64)>> {
        let gear = self.wanted.gear_of(entry.member);
        let (Some(column), Some(gear)) = (self.read.position, gear) else {
            return Ok(None);
        };
        if entry.quantity.place() != Place::Flank {
            return Ok(None);
        }
        let kind = PositionKind::of(entry.quantity, self.wanted.position, &column.written);
        let place = number(self.text(Some(column)), self.row, column.at)?;
        let flank = Flank::new(gear, entry.member, kind, &column.written)?;
        Ok(Some((flank, place)))
    }

    /// Refuses a place that is off its flank.
    pub(super) fn off_flank<T>(&self, entry: &Entry, flank: &Flank<'_>, place: f64) -> Result<T> {
        let column = self.read.position.expect("a place stands in a column");
        let radius = entry.position.unwrap_or_default();
        let lies_on_other = (self.wanted.gears.iter()).any(|other| on_flank(other, radius));
        let is_diameter =
            (self.wanted.gear_of(entry.member)).is_some_and(|gear| on_flank(gear, 0.5 * radius));
        let hint = match lies_on_other {
            true => "it lies on the other member's flank: look at the column of members",
            false if is_diameter => "is it a diameter? --position diameter",
            false => "look at the unit in the header and at --position",
        };
        self.refused(column, &format!("{}; {hint}", flank.refused(place)))
    }
}
