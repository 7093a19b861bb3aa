//! The columns and rows of a wide table with the number of each, and which of both are places.

use super::{Across, Result, across_numbers, checkpoint, down_numbers, refuse_twice_in_a_line};
use crate::gear::Gear;
use crate::measure::import::flank::{Flank, MOST, Side};
use crate::measure::import::numbers::{number_words, plain_cycles};
use crate::measure::import::place::PositionKind;
use crate::measure::import::wanted::Wanted;
use crate::measure::import::{ImportError, Sheet, cell_name, units};
use crate::measure::thousands::{has_certain_decimals, in_thousands};
use crate::measure::{Quantity, Subject};

/// How places on a flank are told.
pub(super) struct Places<'a> {
    pub(super) kind: PositionKind,
    /// From a number in the table to its place.
    pub(super) scale: f64,
    /// The gear of the flank; none where they are places in a rotation.
    pub(super) gear: Option<&'a Gear>,
    pub(super) member: Subject,
    /// None where they are no places along it.
    flank: Option<Flank<'a>>,
    /// The flank that the other member has in its place.
    other: Option<Flank<'a>>,
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
        let gear = wanted.gear_of(member);
        let flank_of = |member: Subject| match wanted.gear_of(member).filter(|_| kind.has_unit()) {
            Some(gear) => Flank::new(gear, member, kind, corner).map(Some),
            None => Ok(None),
        };
        Ok(Self {
            kind,
            scale,
            gear,
            member,
            flank: flank_of(member)?,
            other: flank_of(member.other())?,
        })
    }

    /// Whether a number can be such a place.
    fn holds(&self, number: f64) -> bool {
        match (&self.flank, self.gear) {
            (Some(flank), _) => flank.is_close(flank.radius(number)),
            (None, Some(gear)) => {
                let mut teeth = gear.spanned_teeth().into_iter();
                teeth.any(|teeth| f64::from(teeth) == number)
            }
            (None, None) => (0.0..=1.0).contains(&number),
        }
    }

    /// What such numbers are, in words.
    fn words(&self, corner: &str) -> String {
        match (&self.flank, self.gear) {
            (Some(flank), _) => flank.places(corner),
            (None, Some(_)) => "numbers of teeth that a span goes over".to_owned(),
            (None, None) => "rotations (0 to 1 base pitch)".to_owned(),
        }
    }

    /// That the numbers of a line, called `what`, lie on the flank of the other member, if most of them do.
    fn on_other_flank(&self, what: &str, line: &Line) -> Option<String> {
        let other = self.other.as_ref()?;
        let lies_there = |n: f64| other.is_close(other.radius(n));
        let there = line.iter().filter(|(_, n)| lies_there(*n)).count();
        (!line.is_empty() && there as f64 >= MOST * line.len() as f64).then(|| {
            format!(
                "the {what} lies on the {}: is the table of that member?",
                other.whose()
            )
        })
    }
}

/// Columns or rows with a number each.
type Line = Vec<(usize, f64)>;

/// The cells of a wide table below and beside its header.
pub(super) struct Grid<'s> {
    sheet: &'s Sheet,
    /// Row of the header.
    head: usize,
    /// The columns with the number in the header of each.
    pub(super) across: Line,
    /// The rows with the number in the first cell of each.
    pub(super) down: Line,
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
        let what = places.words(self.corner());
        let good = |line: &Line| line.iter().filter(|(_, n)| places.holds(*n)).count();
        let are_places = |line: &Line| good(line) as f64 >= MOST * line.len() as f64;
        match (are_places(&self.down), are_places(&self.across)) {
            (true, false) => Ok(Across::Checkpoints),
            (false, true) => Ok(Across::Positions),
            (true, true) => Err(ImportError(format!(
                "both the first column and the header could be {what}: say --columns checkpoints or --columns positions"
            ))),
            (false, false) => {
                let [from, to] = self.ends(&self.across, |at| (self.head, at));
                let [row_from, row_to] = self.ends(&self.down, |at| (at, 0));
                let first = self.first_off(places, [good(&self.down), good(&self.across)]);
                let of_other = places.on_other_flank("first column", &self.down);
                let of_other = of_other.or_else(|| places.on_other_flank("header", &self.across));
                let hint = of_other.unwrap_or_else(|| {
                    "look at --member, at --position and at the unit in the header".to_owned()
                });
                Err(ImportError(format!(
                    "neither the first column ({row_from} to {row_to}) nor the header ({from} to {to}) are {what}{}: {hint}",
                    first.unwrap_or_default()
                )))
            }
        }
    }

    /// The least and the largest number of a line, as written where a mark may stand between thousands: `80.000`.
    fn ends(&self, line: &Line, cell: impl Fn(usize) -> (usize, usize)) -> [String; 2] {
        let shown = |end: Option<&(usize, f64)>| {
            end.map_or_else(String::new, |&(at, number)| {
                let (row, column) = cell(at);
                let mut words = number_words(self.cell(row, column)).into_iter();
                let marked = words.find(|word| in_thousands(word));
                marked.map_or_else(|| number.to_string(), str::to_owned)
            })
        };
        let by_number = |a: &&(usize, f64), b: &&(usize, f64)| a.1.total_cmp(&b.1);
        [
            shown(line.iter().min_by(by_number)),
            shown(line.iter().max_by(by_number)),
        ]
    }

    /// The first number that is no place, of the first column or of the header, whichever has more `good` ones; none where both have none.
    fn first_off(&self, places: &Places<'_>, good: [usize; 2]) -> Option<String> {
        let [of_rows, of_columns] = good;
        let is_rows = of_rows >= of_columns;
        let (line, good) = match is_rows {
            true => (&self.down, of_rows),
            false => (&self.across, of_columns),
        };
        let (at, number) = *line.iter().find(|(_, n)| !places.holds(*n))?;
        let cell = match is_rows {
            true => cell_name(at, 0),
            false => cell_name(self.head, at),
        };
        let all = line.len();
        (good > 0).then(|| format!(" ({good} of {all} are, but not {number} in {cell})"))
    }

    /// Takes out the rows or columns that lie a little off the flank, where most of them lie on it, and says how many.
    pub(super) fn leave_out(&mut self, across: Across, places: &Places<'_>) -> Result<Vec<String>> {
        let Some(flank) = &places.flank else {
            return Ok(Vec::new());
        };
        let head = self.head;
        match across {
            Across::Checkpoints => leave_out(&mut self.down, flank, "row", |row| cell_name(row, 0)),
            Across::Positions => leave_out(&mut self.across, flank, "column", |column| {
                cell_name(head, column)
            }),
        }
    }

    /// Refuses numbers that stand twice, and checkpoints that are no plain numbers of revolutions.
    /// `in_multiples`: of millions, say, which have decimals.
    pub(super) fn refuse_unclear(
        &self,
        across: Across,
        quantity: Quantity,
        in_multiples: bool,
    ) -> Result<()> {
        let head = self.head;
        refuse_twice_in_a_line(&self.across, |column| cell_name(head, column))?;
        refuse_twice_in_a_line(&self.down, |row| cell_name(row, 0))?;
        let headers = self
            .across
            .iter()
            .map(|(column, _)| self.cell(head, *column));
        let have_decimals = headers.flat_map(number_words).any(has_certain_decimals);
        match across {
            _ if in_multiples => Ok(()),
            Across::Checkpoints => (self.across.iter()).try_for_each(|&(column, _)| {
                if !have_decimals {
                    plain_cycles(self.cell(head, column), head, column)?;
                }
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

fn leave_out(
    places: &mut Line,
    flank: &Flank<'_>,
    what: &str,
    name: impl Fn(usize) -> String,
) -> Result<Vec<String>> {
    let side = |place: f64| flank.side(flank.radius(place));
    let off: Line = (places.iter().copied())
        .filter(|(_, place)| side(*place).is_some())
        .collect();
    // a few points may be a matter of rounding, of which the reader of the rows decides
    let is_trace = (places.len() - off.len()) as f64 >= MOST * places.len() as f64;
    if !is_trace {
        return Ok(Vec::new());
    }
    if let Some((at, place)) = off.iter().find(|(_, n)| !flank.is_near(flank.radius(*n))) {
        return Err(ImportError(format!(
            "{}: {}: look at the number",
            name(*at),
            flank.refused(*place)
        )));
    }
    places.retain(|(_, place)| side(*place).is_none());
    let said = [Side::Below, Side::Above].into_iter().filter_map(|of| {
        let own = off.iter().map(|(_, place)| *place);
        let own: Vec<f64> = own.filter(|place| side(*place) == Some(of)).collect();
        (!own.is_empty()).then(|| flank.left_out(of, (own.len(), what), &own))
    });
    Ok(said.collect())
}
