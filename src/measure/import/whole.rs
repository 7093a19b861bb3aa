//! Wide tables of what a whole member has, a mass say: cycles in one direction, members in the other.

use super::entry::Entry;
use super::multiples::Multiple;
use super::numbers::{number, plain_cycles, with_points, without_thousands};
use super::sigmas::Sigmas;
use super::titles::Titles;
use super::wanted::Wanted;
use super::wide::{
    Across, Wide, across_numbers, checkpoint, counts_gear_revolutions, down_numbers, header,
    in_order, is_aside, leave_out_what_is_for_people, no_header, refuse_twice_in_a_line, unit_of,
};
use super::{
    ImportError, Sheet, cell_name, counts, decimal_commas, footers, header_points, long, nameless,
    no_values, units,
};
use crate::measure::{Place, Quantity, Subject, names};

type Result<T> = std::result::Result<T, ImportError>;

/// Members and checkpoints, each with its row or column.
struct Lines {
    head: usize,
    across: Across,
    members: Vec<(usize, Subject)>,
    cycles: Vec<(usize, f64)>,
}

impl Lines {
    /// With the revolutions that the counts of the table stand for.
    fn times(mut self, multiple: &Multiple) -> Result<Self> {
        for (_, cycles) in &mut self.cycles {
            *cycles = multiple.revolutions(*cycles)?;
        }
        Ok(self)
    }

    /// Row and column of the value where a member's line and a checkpoint's cross.
    fn crossing(&self, member: usize, checkpoint: usize) -> (usize, usize) {
        match self.across {
            Across::Checkpoints => (member, checkpoint),
            Across::Positions => (checkpoint, member),
        }
    }
}

/// The mapping of a wide table of a quantity without places.
pub(super) fn whole(sheet: &Sheet, quantity: Quantity, wanted: &Wanted<'_>) -> Result<Wide> {
    let test = wanted.one_test(sheet)?;
    let members_across = sheet.rows.iter().position(|row| is_header_of_members(row));
    let head = match members_across {
        Some(head) => head,
        None => header(sheet).map_err(|_| no_header(sheet))?,
    };
    decimal_commas::refuse(sheet, head)?;
    let mut sheet = sheet.clone();
    without_thousands(&mut sheet, wanted.decimal, head);
    let counts = |row, column| row > head && column > 0;
    let mut sheet = with_points(&sheet, wanted.decimal, counts, |_, _, _| false)?;
    let multiple = Multiple::taken(&sheet, head).map(|(without, multiple)| {
        sheet = without;
        multiple
    });
    let without_points = header_points::left_out(&sheet, wanted.decimal, head, wanted.end(&test.0));
    if let Some(plain) = without_points.filter(|_| multiple.is_none()) {
        sheet = plain;
    }
    let sigmas = Sigmas::taken(&mut sheet, head, wanted)?;
    let passed_over = leave_out_what_is_for_people(&mut sheet, head);
    let below = footers::leave_out(&mut sheet, head);
    nameless::refuse_numbers(&sheet, head, 1)?;
    let sheet = &sheet;
    let lines = match members_across {
        Some(head) => members_in_header(sheet, head)?,
        None => members_in_rows(sheet, head, quantity, wanted)?,
    };
    let lines = match &multiple {
        Some(multiple) => lines.times(multiple)?,
        None => lines,
    };
    let corner = cell(sheet, head, 0);
    let headers: Vec<&str> = sheet.rows[head]
        .iter()
        .skip(1)
        .map(String::as_str)
        .filter(|h| !h.is_empty())
        .collect();
    counts::refuse_others_above(sheet, head)?;
    let titles = Titles::of(sheet, head, quantity, &wanted.per_interval)?
        .without(|words| names_quantity(words) == Some(quantity));
    let all: Vec<&str> = headers.iter().copied().chain([corner]).collect();
    let unit = wanted.unit_of_values(quantity, unit_of(&all, quantity)?, titles.unit.as_deref())?;
    let factor = units::factor(&unit.0, quantity)?;
    let turned = titles.turns_sign(wanted.turn_sign)?;
    let of_gear = match lines.across {
        Across::Checkpoints => counts_gear_revolutions(corner, &headers)?,
        Across::Positions => counts_gear_revolutions(corner, &[])?,
    };
    let of_gear = of_gear || multiple.as_ref().is_some_and(Multiple::is_of_gear);
    let reading = Reading {
        wanted,
        test: &test.0,
        quantity,
        factor: if turned { -factor } else { factor },
        of_gear,
    };
    let (mut entries, empty) = reading.entries(sheet, &lines)?;
    let (mut left_out, _) = no_values::leave_out(&mut entries, sheet);
    left_out.extend(below);
    let mut arranged: Vec<String> = multiple.iter().map(Multiple::said).collect();
    if let Some(sigmas) = &sigmas {
        arranged.push(sigmas.state(&mut entries, (quantity, &unit.0), wanted)?);
    }
    let mut differences = false;
    if quantity == Quantity::MassLoss && !speaks_of_loss(sheet, head) {
        let way_out = "add those of the new parts, at 0, and the losses are taken from them; if the values are what was lost since the start, write \
                       `mass loss` into a row above the header";
        if long::from_start(&mut entries, way_out)? {
            differences = true;
            arranged.push(
                "mass loss: the mass at 0 less each one of the same member; those at 0 are not written themselves"
                    .to_owned(),
            );
        }
    }
    if differences {
        (wanted.per_interval).refuse_differences(&[Quantity::MassLoss])?;
    }
    arranged.extend(in_order(&mut entries, sigmas.is_some(), wanted)?);
    let mut checkpoints: Vec<f64> = entries.iter().map(|entry| entry.cycles).collect();
    checkpoints.dedup();
    Ok(Wide {
        test,
        members: lines.members.iter().map(|member| member.1).collect(),
        quantity,
        across: lines.across,
        position: None,
        corner: (cell_name(lines.head, 0), corner.to_owned()),
        checkpoints,
        of_gear,
        unit,
        titles,
        turned,
        flank: None,
        arranged,
        joined: Vec::new(),
        passed_over,
        left_out,
        empty,
        has_sigma: sigmas.is_some(),
        entries,
    })
}

/// The quantity without places that a row above a header of members names, or one above or before checkpoints with members down the first column:
/// `Massenverlust [g]`; or one over the rotation above places in base pitches.
pub(super) fn titled(sheet: &Sheet) -> Option<Quantity> {
    let across = (sheet.rows.iter()).position(|row| is_header_of_members(row));
    let named = |titles: &[Vec<String>], first: Option<&String>| {
        let mut titles = titles.iter().flatten().chain(first);
        titles.find_map(|title| names_quantity(title))
    };
    if let Some(head) = across {
        return named(&sheet.rows[..head], None);
    }
    let head = header(sheet).ok()?;
    // over a rotation, which its places tell from a flank's
    let corner = sheet.rows[head].first();
    if corner.is_some_and(|corner| names::is_in_base_pitches(corner)) {
        let mut titles = sheet.rows[..head].iter().flatten();
        return titles.find_map(|title| names_quantity_of(title, Place::Rotation));
    }
    let below = sheet.rows[head + 1..].iter();
    let mut first = below.filter_map(|row| row.first().filter(|cell| !cell.is_empty()));
    let is_of_member = first
        .next()
        .is_some_and(|name| names::one_member(name).is_some());
    is_of_member
        .then(|| named(&sheet.rows[..head], sheet.rows[head].first()))
        .flatten()
}

/// The quantity without places that a part of a title names.
fn names_quantity(title: &str) -> Option<Quantity> {
    names_quantity_of(title, Place::Whole)
}

fn names_quantity_of(title: &str, place: Place) -> Option<Quantity> {
    let parts = title.split([',', ';', ':']);
    let mut named = parts.flat_map(|part| {
        // `Massenverlust [g] seit Versuchsbeginn`
        let before = part.split(['[', '(']).next().unwrap_or_default().trim();
        let (name, _) = units::name_and_unit(part);
        let names = [
            name.as_str(),
            before,
            before.split(' ').next().unwrap_or_default(),
        ];
        names.map(names::quantity)
    });
    named
        .find_map(|named| named.filter(|(quantity, _)| quantity.place() == place))
        .map(|(quantity, _)| quantity)
}

/// Whether cycles head the first column of a row, and members all others that are not for people.
fn is_header_of_members(row: &[String]) -> bool {
    let mut names = row
        .iter()
        .skip(1)
        .filter(|cell| !cell.is_empty() && !is_aside(cell));
    let is_member = |cell: &String| {
        names::one_member(cell).is_some() && !cell.contains(|c: char| c.is_ascii_digit())
    };
    row.first()
        .is_some_and(|first| names::revolutions(&units::name_and_unit(first).0).is_some())
        && names.clone().next().is_some()
        && names.all(is_member)
}

fn cell(sheet: &Sheet, row: usize, column: usize) -> &str {
    sheet.rows[row].get(column).map_or("", String::as_str)
}

/// How the values of a table are read.
struct Reading<'a> {
    wanted: &'a Wanted<'a>,
    /// Id of the test.
    test: &'a str,
    quantity: Quantity,
    /// From a value in the table to the quantity's own unit and sign.
    factor: f64,
    /// Whether the checkpoints are revolutions of the gear.
    of_gear: bool,
}

impl Reading<'_> {
    /// A row of a measurement file for each cell with a value, and the number of cells without one.
    fn entries(&self, sheet: &Sheet, lines: &Lines) -> Result<(Vec<Entry>, usize)> {
        let mut empty = 0;
        let mut entries = Vec::new();
        for &(member_line, member) in &lines.members {
            for &(cycles_line, cycles) in &lines.cycles {
                let (row, column) = lines.crossing(member_line, cycles_line);
                let text = cell(sheet, row, column);
                if text.is_empty() {
                    empty += 1;
                    continue;
                }
                entries.push(Entry {
                    test: self.test.to_owned(),
                    member,
                    cycles: if self.of_gear {
                        self.wanted.pinion_revolutions(self.test, cycles)
                    } else {
                        cycles
                    },
                    quantity: self.quantity,
                    position: None,
                    value: number(text, row, column)? * self.factor,
                    sigma: None,
                    trace: String::new(),
                    face: String::new(),
                    tooth: String::new(),
                    repeat: self.wanted.repeat,
                    cell: (row, column),
                });
            }
        }
        Ok((entries, empty))
    }
}

/// Whether the header or a row above it says that its masses are what was lost.
fn speaks_of_loss(sheet: &Sheet, head: usize) -> bool {
    let is_loss = |word: &String| {
        let lost = names::quantity(word).is_some_and(|(named, _)| named == Quantity::MassLoss);
        lost && !names::is_mass(word)
    };
    let cells = sheet.rows[..=head].iter().flatten();
    cells
        .flat_map(|cell| names::words(cell))
        .any(|word| is_loss(&word))
}

/// A column for each member, cycles in the first one.
fn members_in_header(sheet: &Sheet, head: usize) -> Result<Lines> {
    let headers = sheet.rows[head].iter().enumerate().skip(1);
    let members: Vec<(usize, Subject)> = headers
        .filter_map(|(column, text)| Some((column, names::one_member(text)?)))
        .collect();
    let cycles = down_numbers(sheet, head)?;
    refuse_twice_in_a_line(&cycles, |row| cell_name(row, 0))?;
    for &(row, _) in &cycles {
        plain_cycles(&sheet.rows[row][0], row, 0)?;
    }
    Ok(Lines {
        head,
        across: Across::Positions,
        members,
        cycles,
    })
}

/// A column for each checkpoint; the first column names members, or the only row is of the stated one.
fn members_in_rows(
    sheet: &Sheet,
    head: usize,
    quantity: Quantity,
    wanted: &Wanted<'_>,
) -> Result<Lines> {
    let cycles = across_numbers(sheet, head)?;
    refuse_twice_in_a_line(&cycles, |column| cell_name(head, column))?;
    for &(column, _) in &cycles {
        checkpoint(&sheet.rows[head][column], quantity, head, column)?;
    }
    let filled =
        (head + 1..sheet.rows.len()).filter(|&row| !sheet.rows[row].iter().all(String::is_empty));
    let filled: Vec<usize> = filled.collect();
    let stated = wanted.stated_member(sheet, quantity)?;
    let members = filled.iter().map(|&row| {
        let text = &sheet.rows[row][0];
        let member = match names::one_member(text) {
            Some(named) => Some(named),
            None if filled.len() == 1 => stated,
            None => None,
        };
        member.map(|member| (row, member)).ok_or_else(|| {
            ImportError(format!(
                "{}: `{text}` names no member: {} has no positions; write pinion or gear into the first column, or state --member for \
                 a table with one row",
                cell_name(row, 0),
                quantity.name()
            ))
        })
    });
    let members = members.collect::<Result<Vec<_>>>()?;
    if members.is_empty() {
        return Err(ImportError(format!(
            "no row of numbers below the header in row {}",
            head + 1
        )));
    }
    Ok(Lines {
        head,
        across: Across::Checkpoints,
        members,
        cycles,
    })
}
